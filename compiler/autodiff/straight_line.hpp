// A step as a list of instructions on numbers, without loops, branches or names: the form that
// exact derivatives are taken of.
//
// Loops over objects are unrolled, and expressions that the instance fixes are computed. Every
// value is a double in a slot: bools are 0 and 1, objects their index, and ints are exact up to
// 2^53. Each slot is written once.
#pragma once

#include "ir/ir.hpp"
#include "vocabulary/vocabulary.hpp"

#include <rddl/values/context.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rddlc::autodiff {

using Slot = std::uint32_t;
inline constexpr Slot no_slot = std::numeric_limits<Slot>::max();
// Ints beyond this are not exact in a double.
inline constexpr double largest_int = 9007199254740992.0;  // 2^53

enum class Code : std::uint8_t {
    RealOperator,    // op(a) or op(a, b), of reals
    IntOperator,     // the same of ints
    ToInt,           // op(a): Sign, Round, Floor or Ceil of a real
    Comparison,      // a op b, of numbers
    Logic,           // a op b, of bools; Not(a)
    Select,          // a ? b : c
    GuardedProduct,  // a == 0 ? a : a * b, which RDDL's products are
    Sum,             // of a list of reals, added to 0 from the first to the last
    IntSum,
    ForAll,  // of a list of bools
    Exists,
    ArgMin,  // the index of the first least number of a list
    ArgMax,
    Gather,     // the element of a list whose index is a
    Bernoulli,  // of the probability a
    DrawReal,   // of `distribution`, with parameters a and b
    DrawInt,
    Binomial,  // of a trials, with probability b
    Discrete,  // an index into a list of weights
    Fault,     // records one
};

struct Instruction {
    Code code;
    Operator op = Operator::Add;
    Distribution distribution = Distribution::Normal;
    bool normalise = false;  // Discrete: weights need not add up to 1
    Slot out = no_slot;
    Slot a = no_slot, b = no_slot, c = no_slot;
    std::uint32_t first = 0, count = 0;  // the list: operands[first .. first + count)
    Slot guard = no_slot;                // it may fault only where this is 1; absent: everywhere
    std::uint32_t place = 0;             // into `places`, for draws and faults
};

struct Constant {
    Slot slot;
    double value;
};

// A step, its inputs and its results. The numbers of a record are the elements of its fluents, in
// the order of the record (ir/layout.hpp).
struct StraightLine {
    std::vector<Instruction> instructions;
    // Those from this one on compute `over` alone, and are exact also where others are relaxed.
    std::size_t first_of_end = 0;
    std::vector<Slot> operands;  // of all lists
    std::vector<rddl::Place> places;
    std::vector<Constant> constants;
    Slot slot_count = 0;

    std::size_t state_count = 0, action_count = 0;  // inputs: first the state's, then the action's
    std::vector<Slot> next;                         // state_count
    Slot reward = no_slot;
    Slot over = no_slot;  // a bool: the next state terminates, or violates an invariant

    std::span<const Instruction> instructions_of_step() const {
        return std::span(instructions).first(first_of_end);
    }
    std::span<const Instruction> instructions_of_end() const {
        return std::span(instructions).subspan(first_of_end);
    }
    Slot state_slot(std::size_t number) const { return static_cast<Slot>(number); }
    Slot action_slot(std::size_t number) const { return static_cast<Slot>(state_count + number); }
};

// So many instructions at most, and as many operands of lists: beyond, Failure says that the
// problem is too large.
inline constexpr std::size_t most_instructions = 20'000'000;

// From the output of `ground`. Throws Failure with a sentence for external functions, functions of
// matrices and random vectors, which have no derivatives here.
StraightLine unroll(const ir::Program& program);

// That sentence, without unrolling; nothing: unroll() takes the program if it is not too large. It
// is also of the output of `ground`: passes add calls, and fold others.
std::optional<std::string> refusal_of(const ir::Program& program);

// Whether it has instructions whose derivatives a relaxation changes (evaluation.hpp).
bool can_be_relaxed(const StraightLine& program);

}  // namespace rddlc::autodiff
