// Evaluates expressions and statements over records of raw bytes (layout.hpp), with the runtime's
// own functions. Constant tables are packed once, unless they are huge; an evaluation does not
// allocate, unless a program needs more loop indices and locals than a Workspace holds.
#pragma once

#include "ir/external_functions.hpp"
#include "ir/ir.hpp"
#include "ir/outcomes.hpp"
#include "ir/rounding.hpp"
#include "vocabulary/kernels.hpp"

#include <rddl/values/reductions.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <vector>

namespace rddlc::ir {

// Writes a buffer's values to where it begins in a record.
void write_values(const Buffer& buffer, std::byte* to);

// A record for each storage; null if a computation does not use it.
struct Records {
    std::array<std::byte*, 8> begin{};  // by Storage

    // Also sets read-only storages: verify() says that nothing stores to them.
    Records& set(Storage storage, const std::byte* record) {
        begin[static_cast<std::size_t>(storage)] = const_cast<std::byte*>(record);
        return *this;
    }
};

class Evaluator {
  public:
    // The program must outlive the evaluator, and not change; more nodes that do not draw, and more
    // constant tables, may be added. The functions are by ExternalId; a program without calls needs
    // no functions.
    explicit Evaluator(const Program& program, ExternalFunctions functions = {});

    // Evaluates with other last digits from now on. `rounding` must outlive this.
    void round_by(Rounding& rounding) { rounding_ = &rounding; }

    // Call it before values that read new constant tables.
    void know_added_tables();

    // One evaluation: the records, and room for loop indices and locals.
    class Frame {
      public:
        // Draws are random without outcomes; with them, Failure says which draw has no finite list.
        Frame(const Evaluator& evaluator, Records records, Context& context,
              Outcomes* outcomes = nullptr);
        Frame(const Frame&) = delete;
        Frame& operator=(const Frame&) = delete;

        void set(VariableId variable, std::int64_t value) {
            slots_[variable.index].integer = value;
        }

      private:
        friend class Evaluator;
        union Slot {
            bool boolean;
            std::int64_t integer;
            double real;
        };
        template <class T>
        static T& of(Slot& slot);

        Records records_;
        Context& context_;
        Outcomes* outcomes_;
        Slot room_[512];  // left unset
        std::vector<Slot> more_room_;
        Slot* slots_;
    };

    // Gives a value to a local that no statement defines.
    void set(LocalId local, const Value& value, Frame& frame) const;

    void run(const Block& block, Frame& frame) const;
    // T is the C++ type of the node's type: bool, int64_t or double.
    template <class T>
    T value(NodeId id, Frame& frame) const;
    // The value of any type; nothing if a fault has been recorded.
    std::optional<Value> value_unless_fault(NodeId id, Frame& frame) const;

  private:
    static constexpr std::size_t no_slot = static_cast<std::size_t>(-1);

    // The place of a buffer's first element.
    struct Origin {
        std::size_t record;  // index into Records::begin
        std::size_t offset;
        bool is_looked_up = false;  // in Buffer::values: the table is too large to be packed
    };

    void find_passed_tables();
    void pack(BufferId table);
    void number_slots();

    // The place of the element, or of the part that the leading indices choose.
    std::int64_t row_major(BufferId id, const std::vector<NodeId>& indices, Frame& frame) const;
    template <class T>
    T load(const Load& form, Frame& frame) const;
    std::byte* element(BufferId id, const std::vector<NodeId>& indices, Frame& frame) const;
    rddl::Place place(const std::optional<Place>& place, Frame& frame) const;
    void store(const Store& store, Frame& frame) const;
    void spread(const Spread& spread, Frame& frame) const;
    void visit(const Visit& visit, Frame& frame) const;
    void mark(const std::vector<Mark>& marks, Frame& frame) const;
    void let(const Let& let, Frame& frame) const;
    void call(const Call& call, Frame& frame) const;
    template <class Callee>
    void call(Callee callee, const Call& call, Frame& frame) const;
    void call(ExternalId callee, const Call& call, Frame& frame) const;
    void call(Together callee, const Call& call, Frame& frame) const;

    template <class T>
    T apply(const Apply& form, Frame& frame) const;
    bool apply_to_bools(const Apply& form, Frame& frame) const;
    std::int64_t search(const Search& form, Frame& frame) const;
    std::int64_t bits(const Bits& form, Frame& frame) const;
    std::int64_t united(const Union& form, Frame& frame) const;
    bool element_at(const Element& form, Frame& frame) const;
    template <class T>
    T convert_operand(const Convert& form, Frame& frame) const;
    rddl::IndexRange range(const Reduce& form, Frame& frame) const;
    template <class T>
    T reduce(const Reduce& form, Frame& frame) const;
    double reduce_otherwise(const Reduce& form, Frame& frame) const;
    template <class T>
    T draw(const Sample& form, Frame& frame) const;
    std::int64_t draw(const Discrete& form, NodeId id, Frame& frame) const;
    std::int64_t draw(const DiscreteOver& form, Frame& frame) const;
    std::int64_t draw(const Interval& form, Frame& frame) const;
    // One of a finite draw's outcomes; 0 where it faults.
    template <class Weight>
    std::int64_t choose(rddl::Place place, bool normalise, rddl::Index size, Weight&& weight,
                        Frame& frame) const;

    const Program* program_;
    ExternalFunctions functions_;
    std::vector<Origin> origins_;            // by BufferId::index
    std::set<BufferId> passed_;              // to calls
    std::size_t packed_ = 0;                 // the first buffers, if they are Constant
    std::vector<std::byte> constants_;       // the record of all Constant buffers
    std::vector<std::size_t> local_slots_;   // by LocalId::index
    std::vector<std::size_t> weight_slots_;  // by NodeId::index: the first weight of a Discrete
    std::size_t slot_count_ = 0;             // loop indices come first
    Rounding* rounding_ = nullptr;
};

}  // namespace rddlc::ir
