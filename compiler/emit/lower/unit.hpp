// The input of every part of the emitter: the program with its names and properties. It does not
// change.
#pragma once

#include "emit/emit.hpp"
#include "emit/lower/step_draws.hpp"
#include "emit/lower/step_normals.hpp"
#include "emit/names/names.hpp"
#include "ir/analysis.hpp"
#include "ir/ir.hpp"
#include "support/source.hpp"

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace rddlc::cpp {

struct Unit {
    Unit(const ir::Program& program, const Sources& sources, const EmitOptions& options);

    const ir::Program& program;
    const Sources& sources;
    const EmitOptions& options;
    Names names;
    std::vector<ir::Properties> properties;  // by NodeId
    std::vector<bool> uniform_ints;          // by NodeId; is_uniform tells
    std::vector<bool> contains_branch;       // by NodeId: it branches, or has what does inside
    bool tests_action_bools;                 // ir/action_bools.hpp
    std::vector<bool> narrow_bits;           // by NodeId; ir/narrow_bits.hpp
    std::set<ir::BufferId> left_out;         // tables that the text lacks; ir/shifted_row.hpp

    const ir::Properties& properties_of(ir::NodeId id) const { return properties[id.index]; }

    // An int that is spelled as one, not as one for each lane: made of loop indices, constants and
    // entries of constant tables by operators alone. It may stand in array[i], and number a place.
    bool is_uniform(ir::NodeId id) const { return uniform_ints[id.index]; }

    // As the text has them: a bool that is a factor of an int is not converted.
    std::vector<ir::NodeId> operands_of(const ir::Node& node) const;

    // The number of objects that a loop runs over, by the name of its type where it is all of them.
    std::string size_of(const ir::Variable& variable) const;
    // A number of objects, by the name of the type where it is all of them.
    std::string count_of(std::uint32_t type, std::int64_t size) const;
    // "domain.rddl:41"
    std::string where(Span span) const;

    // A draw that is made once in a step, not in a loop.
    bool is_lone(const ir::Place& place) const;
    // Whether tables alone decide, by a branch around it, for which objects of a loop a draw is
    // made: then its neighbours may well not be made.
    bool is_chosen_by_table(const ir::Place& place) const;
    // Whether batches are stepped in packs.
    bool has_packs() const;
    // Whether there may be packs whose ints are bytes.
    bool has_byte_ints() const { return has_packs() && options.byte_ints; }

    // Whether a step makes so many draws of neighbouring sites once that one environment makes
    // their numbers in a register.
    bool is_among_sites(const ir::Place& place) const;

    StepDraws step_draws;
    StepNormals step_normals;

  private:
    std::set<std::uint32_t> series_of_lone_draws() const;

    std::set<std::uint32_t> series_chosen_by_tables() const;

    std::set<std::uint32_t> lone_series_;
    std::set<std::uint32_t> chosen_series_;
};

}  // namespace rddlc::cpp
