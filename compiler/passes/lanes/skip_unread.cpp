#include "passes/lanes/skip_unread.hpp"

#include "ir/analysis.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

using Tables = std::set<ir::BufferId>;

class Skipping {
  public:
    Skipping(ir::Program program, Report& report)
        : program_(std::move(program)),
          report_(report),
          properties_(ir::all_properties(program_)) {}

    ir::Program run() && {
        for (const ir::Definition& definition : program_.step)
            reads_.push_back(ir::buffers_read_by(program_, ir::roots_of(definition.body)));
        find_reads_behind_step();
        // Readers stand behind what they read, so that a chain of tables is found from its end.
        for (std::size_t k = program_.step.size(); k-- > 0;)
            if (!skip(k) && split(k)) skip(k + 1);
        return std::move(program_);
    }

  private:
    // Whether definition `k` is skipped now.
    bool skip(std::size_t k) {
        const ir::Definition& definition = program_.step[k];
        if (definition.unchosen) return false;
        const auto filled = tables_of_skippable(definition.body);
        const auto reader = filled ? first_of_skipped_readers(*filled, k) : std::nullopt;
        if (!reader || !may_move(k, *reader)) return false;
        program_.step[k].unchosen = {program_.step[*reader].unchosen->choices, std::nullopt};
        move_before(k, *reader);
        ++report_["definitions that nothing reads where nothing is chosen"];
        return true;
    }

    // Tables that a definition fills before its own one become definitions, if the rest is to be
    // skipped; it is one definition then, and stands behind them.
    bool split(std::size_t k) {
        const ir::Block& body = program_.step[k].body;
        const auto fills_another = [&](const ir::Statement& statement) {
            const auto* store = std::get_if<ir::Store>(&statement.form);
            return store && store->target != program_.step[k].target;
        };
        if (program_.step[k].unchosen || body.size() < 2 || !fills_another(body.front()))
            return false;
        const ir::Block rest(body.begin() + 1, body.end());
        const auto filled = tables_of_skippable(rest);
        const auto reader = filled ? first_of_skipped_readers(*filled, k) : std::nullopt;
        if (!reader || !may_move(k, *reader)) return false;
        ir::Definition before = program_.step[k];
        before.target = std::get<ir::Store>(body.front().form).target;
        before.body.resize(1);
        program_.step[k].body = rest;
        const Tables read = ir::buffers_read_by(program_, ir::roots_of(before.body));
        reads_[k] = ir::buffers_read_by(program_, ir::roots_of(rest));
        insert(program_.step, k, std::move(before));
        insert(reads_, k, read);
        return true;
    }
    template <class T>
    static void insert(std::vector<T>& all, std::size_t k, T value) {
        all.insert(all.begin() + static_cast<std::ptrdiff_t>(k), std::move(value));
    }

    // ------------------------------------------------------------------------------ finding

    // The tables of Scratch that the statements fill; nothing if these may not be skipped.
    std::optional<Tables> tables_of_skippable(const ir::Block& body) const {
        bool visits = false;
        ir::for_each_statement<ir::Visit>(body, [&](const ir::Visit&) { visits = true; });
        const bool may_fault = std::ranges::any_of(
            ir::roots_of(body), [&](ir::NodeId id) { return properties_[id.index].may_fault; });
        if (visits || may_fault || ir::calls_functions(body)) return std::nullopt;
        Tables filled = ir::buffers_filled_by(body);
        const bool are_scratch = std::ranges::all_of(filled, [&](ir::BufferId table) {
            return program_[table].storage == ir::Storage::Scratch;
        });
        return are_scratch ? std::optional(std::move(filled)) : std::nullopt;
    }

    // The first definition behind `k` that reads one of these tables, if the same test skips all
    // that do.
    std::optional<std::size_t> first_of_skipped_readers(const Tables& tables, std::size_t k) const {
        if (have_common(tables, read_behind_step_)) return std::nullopt;
        std::optional<std::size_t> first;
        for (std::size_t i = 0; i < program_.step.size(); ++i) {
            if (i == k || !have_common(tables, reads_[i])) continue;
            const auto& unchosen = program_.step[i].unchosen;
            if (i < k || !unchosen || !is_often_unchosen(*unchosen)) return std::nullopt;
            if (first && program_.step[*first].unchosen->choices != unchosen->choices)
                return std::nullopt;
            first = first.value_or(i);
        }
        return first;
    }
    // Actions that choose nothing at all are rare, so a test of all their tables hardly ever skips
    // anything, while the processor computes what stands before a jump as it waits for a wrong
    // guess.
    bool is_often_unchosen(const ir::Unchosen& unchosen) const {
        const auto tables = std::ranges::count_if(program_.buffers, [](const ir::Buffer& buffer) {
            return buffer.storage == ir::Storage::Action;
        });
        return static_cast<std::size_t>(tables) > unchosen.choices.size();
    }
    static bool have_common(const Tables& a, const Tables& b) {
        return std::ranges::any_of(a, [&](ir::BufferId table) { return b.contains(table); });
    }

    // Functions of tables work in their inputs.
    bool may_move(std::size_t from, std::size_t to) const {
        return std::ranges::none_of(
            std::span(program_.step).subspan(from, to - from),
            [](const ir::Definition& each) { return ir::calls_functions(each.body); });
    }
    void move_before(std::size_t from, std::size_t to) {
        const auto rotate = [&](auto& all) {
            const auto at = [&](std::size_t k) {
                return all.begin() + static_cast<std::ptrdiff_t>(k);
            };
            std::rotate(at(from), at(from + 1), at(to));
        };
        rotate(program_.step);
        rotate(reads_);
    }

    void find_reads_behind_step() {
        const auto add = [&](const ir::Computation& computation) {
            read_behind_step_.merge(ir::buffers_read_by(program_, ir::roots_of(computation)));
        };
        add(program_.reward);
        for (const auto* conditions :
             {&program_.preconditions, &program_.invariants, &program_.terminations})
            std::ranges::for_each(*conditions, add);
        for (const ir::Definition* definition : ir::definitions_of(program_)) {
            ir::for_each_statement<ir::Call>(definition->body, [&](const ir::Call& call) {
                for (const ir::TableView& input : call.inputs)
                    read_behind_step_.insert(input.buffer);
            });
        }
    }

    ir::Program program_;
    Report& report_;
    std::vector<ir::Properties> properties_;
    std::vector<Tables> reads_;  // by each definition of the step
    Tables read_behind_step_;    // or by calls
};

}  // namespace

ir::Program skip_unread(ir::Program program, Report& report) {
    return Skipping(std::move(program), report).run();
}

}  // namespace rddlc::passes
