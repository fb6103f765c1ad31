#include "passes/lanes/shift_rows.hpp"

#include "ir/analysis.hpp"
#include "ir/shifted_row.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <variant>
#include <vector>

namespace rddlc::passes {
namespace {

// A row has so many elements for each term that is added at a place of its own.
constexpr std::int64_t least_per_term = 6;
constexpr std::int64_t least_row = 8;

class Shifting {
  public:
    Shifting(ir::Program& program, Report& report)
        : program_(program), report_(report), properties_(ir::all_properties(program)) {}

    // A definition that shifts goes to the end of the step, so that others read the state before.
    void run() {
        if (!program_.only_moderate) return;
        for (std::size_t k = 0, left = program_.step.size(); left > 0; --left) {
            ir::Loop* const loop = loop_of(k);
            if (!loop) {
                ++k;
                continue;
            }
            loop->shifts = true;
            shifted_.push_back(ir::shifted_row(program_, *loop)->from);
            std::rotate(program_.step.begin() + static_cast<std::ptrdiff_t>(k),
                        program_.step.begin() + static_cast<std::ptrdiff_t>(k) + 1,
                        program_.step.end());
            ++report_["tables whose rows are shifted"];
        }
    }

  private:
    // The loop that shifts, in the definition of this number; null if no loop does, or if it is
    // marked.
    ir::Loop* loop_of(std::size_t k) {
        ir::Definition& definition = program_.step[k];
        ir::Block* block = &definition.body;
        std::vector<ir::VariableId> around;
        for (;;) {
            auto* const loop =
                block->empty() ? nullptr : std::get_if<ir::Loop>(&block->back().form);
            if (!loop || !has_lets_before_last(*block)) return nullptr;
            around.push_back(loop->variable);
            block = &loop->body;
            if (block->size() != 1 || !std::holds_alternative<ir::Store>(block->front().form))
                continue;
            return !loop->shifts && shifts(*loop, around, k) ? loop : nullptr;
        }
    }
    static bool has_lets_before_last(const ir::Block& block) {
        return std::all_of(block.begin(), block.end() - 1, [](const ir::Statement& each) {
            return std::holds_alternative<ir::Let>(each.form);
        });
    }

    bool shifts(const ir::Loop& loop, const std::vector<ir::VariableId>& around,
                std::size_t k) const {
        const auto row = ir::shifted_row(program_, loop);
        if (!row) return false;
        const ir::Buffer& target = program_[row->target];
        return target.storage == ir::Storage::Next && target.scalar == ir::Scalar::Real &&
               target.name == program_[row->from].name && target.shape.back() >= least_row &&
               target.shape.back() >=
                   least_per_term * static_cast<std::int64_t>(row->terms.size()) &&
               takes_all_of(target, row->indices, around) && may_be_last(*row, k) &&
               std::ranges::all_of(row->terms, [&](const ir::PlacedTerm& each) {
                   return !properties_[each.value.index].random &&
                          !properties_[each.term.index].random;
               });
    }
    // The loops run over all rows, and over all elements of each.
    bool takes_all_of(const ir::Buffer& target, const std::vector<ir::NodeId>& indices,
                      const std::vector<ir::VariableId>& around) const {
        std::size_t next = 0;
        for (std::size_t d = 0; d < indices.size(); ++d) {
            const bool is_alone =
                target.shape[d] == 1 && ir::constant<std::int64_t>(program_, indices[d]) == 0;
            if (is_alone) continue;
            if (next + 1 >= around.size() || !ir::is_index_of(program_, indices[d], around[next]) ||
                program_[around[next]].size != target.shape[d])
                return false;
            ++next;
        }
        return next + 1 == around.size() && program_[around.back()].size == target.shape.back();
    }

    // No later definition reads what this one makes, nor the reward the state; the definition reads
    // the elements that it moves. Those that shift stand behind all others, and read no state that
    // one of them shifts.
    bool may_be_last(const ir::ShiftedRow& row, std::size_t k) const {
        for (std::size_t later = k + 1; later < program_.step.size(); ++later)
            if (reads(ir::roots_of(program_.step[later].body), row.target)) return false;
        std::vector<ir::NodeId> roots = ir::roots_of(program_.reward);
        const std::vector<ir::NodeId> own = ir::roots_of(program_.step[k].body);
        std::ranges::copy_if(own, std::back_inserter(roots), [&](ir::NodeId root) {
            return !ir::any_node_of(program_, root,
                                    [&](ir::NodeId each) { return each == row.moved; });
        });
        for (const ir::PlacedTerm& each : row.terms)
            roots.insert(roots.end(), {each.value, each.term});
        const bool reads_lost =
            std::ranges::any_of(shifted_, [&](ir::BufferId state) { return reads(own, state); });
        return !reads_lost && !reads(roots, row.from);
    }
    bool reads(const std::vector<ir::NodeId>& roots, ir::BufferId buffer) const {
        return ir::buffers_read_by(program_, roots).contains(buffer);
    }

    ir::Program& program_;
    Report& report_;
    std::vector<ir::Properties> properties_;
    std::vector<ir::BufferId> shifted_;  // of the state
};

}  // namespace

ir::Program shift_rows(ir::Program program, Report& report) {
    Shifting(program, report).run();
    return program;
}

}  // namespace rddlc::passes
