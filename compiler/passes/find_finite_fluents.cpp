#include "passes/find_finite_fluents.hpp"

#include "ir/analysis.hpp"
#include "passes/constant_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace rddlc::passes {
namespace {

using Buffers = std::set<ir::BufferId>;

// In operations (Facts::cost), for all values of a divisor.
constexpr double affordable_for_divisor = 4e6;
constexpr double affordable_for_divisors = 1e8;

Buffers filled_by_calls(const ir::Program& program) {
    Buffers filled;
    for (const ir::Block* block : ir::blocks_of(program)) {
        ir::for_each_statement<ir::Call>(
            *block, [&](const ir::Call& call) { filled.insert(call.output.buffer); });
    }
    return filled;
}

// Not known to be finite yet, and computed by expressions alone.
Buffers candidates_in(const ir::Program& program) {
    const Buffers filled = filled_by_calls(program);
    Buffers candidates;
    for (std::uint32_t index = 0; index < program.buffers.size(); ++index) {
        const ir::Buffer& buffer = program.buffers[index];
        const bool is_computed =
            buffer.storage != ir::Storage::Constant && buffer.storage != ir::Storage::Action;
        if (is_computed && !buffer.finite && !filled.contains({index}) &&
            buffer.values.all_of(is_finite))
            candidates.insert({index});
    }
    return candidates;
}

double evaluations(const ir::Program& program, const ir::Facts& facts) {
    double count = 1;
    for (const ir::VariableId variable : facts.free_variables)
        count *= static_cast<double>(program[variable].size);
    return count;
}

// Has it only values that the instance fixes, by all of which a finite number may be divided?
// `left` is what may be spent.
bool is_safe_divisor(const ir::Program& program, const ir::Evaluator& evaluator, ir::NodeId id,
                     const std::vector<ir::Facts>& all, double& left) {
    const ir::Facts& facts = all[id.index];
    const double cost = facts.cost * evaluations(program, facts);
    if (!facts.uniform || cost > affordable_for_divisor || cost > left) return false;
    left -= cost;
    const auto values = constant_values(evaluator, program, id, facts.free_variables);
    return values && std::ranges::all_of(*values, [](const ir::Value& value) {
               const double divisor = std::get<double>(value);
               const std::optional range{ir::Range{divisor, divisor}};
               return std::isfinite(divisor) &&
                      ir::keeps_finite(Operator::Divide, std::array{range, range});
           });
}

// The quotients that are finite since their divisors are never zero, or near it.
std::set<ir::NodeId> safe_quotients(const ir::Program& program) {
    const std::vector<ir::Facts> facts = ir::all_facts(program);
    const ir::Evaluator evaluator(program);
    std::map<ir::NodeId, bool> divisors;
    double left = affordable_for_divisors;
    std::set<ir::NodeId> safe;
    for (std::uint32_t index = 0; index < program.nodes.size(); ++index) {
        const auto* apply = std::get_if<ir::Apply>(&program.nodes[index].form);
        if (!apply || apply->op != Operator::Divide) continue;
        const ir::NodeId divisor = apply->operands.back();
        const auto [known, is_new] = divisors.try_emplace(divisor, false);
        if (is_new) known->second = is_safe_divisor(program, evaluator, divisor, facts, left);
        if (known->second) safe.insert({index});
    }
    return safe;
}

// The facts of all nodes, as long as candidates turn out to be not finite.
class Refuting {
  public:
    // The candidates are marked as finite in the program.
    Refuting(ir::Program& program, Buffers candidates)
        : program_(program), candidates_(std::move(candidates)), safe_(safe_quotients(program)) {}

    // The candidates that are left.
    Buffers run() && {
        for (const ir::BufferId id : candidates_) program_.buffers[id.index].finite = true;
        for (std::uint32_t index = 0; index < program_.nodes.size(); ++index)
            facts_.push_back(facts_of({index}));
        find_users();
        for (const auto& [value, targets] : stores_)
            if (!facts_[value.index].finite) changed_.insert(value);
        while (!changed_.empty()) spread(*changed_.begin());
        return std::move(candidates_);
    }

  private:
    ir::Facts facts_of(ir::NodeId id) {
        ir::Facts facts = ir::facts_of(program_, program_[id], facts_, tables_);
        if (safe_.contains(id)) {
            const auto& quotient = std::get<ir::Apply>(program_[id].form);
            facts.finite = facts_[quotient.operands.front().index].finite;
        }
        return facts;
    }

    void find_users() {
        for (std::uint32_t index = 0; index < program_.nodes.size(); ++index) {
            const ir::Node& node = program_.nodes[index];
            for (const ir::NodeId operand : ir::operands_of(node))
                users_[operand].push_back({index});
            const auto* load = std::get_if<ir::Load>(&node.form);
            if (load && candidates_.contains(load->buffer)) loads_[load->buffer].push_back({index});
        }
        for (const ir::Block* block : ir::blocks_of(program_)) {
            ir::for_each_statement<ir::Store>(*block, [&](const ir::Store& store) {
                if (candidates_.contains(store.target))
                    stores_[store.value].push_back(store.target);
            });
        }
    }

    // Operands come first, so that a node is looked at behind all of them.
    void spread(ir::NodeId changed) {
        changed_.erase(changed);
        if (const auto stores = stores_.find(changed);
            stores != stores_.end() && !facts_[changed.index].finite) {
            for (const ir::BufferId target : stores->second) refute(target);
        }
        for (const ir::NodeId user : users_[changed]) update(user);
    }

    void update(ir::NodeId id) {
        ir::Facts facts = facts_of(id);
        ir::Facts& known = facts_[id.index];
        if (facts.finite == known.finite && facts.range == known.range &&
            facts.may_fault == known.may_fault)
            return;
        known = std::move(facts);
        changed_.insert(id);
    }

    // With the buffer of the next value, or of this one.
    void refute(ir::BufferId wrong) {
        for (const ir::BufferId id : same_fluent(wrong)) {
            if (candidates_.erase(id) == 0) continue;
            program_.buffers[id.index].finite = false;
            for (const ir::NodeId load : loads_[id]) update(load);
        }
    }

    const Buffers& same_fluent(ir::BufferId id) {
        if (fluents_.empty()) {
            for (const ir::BufferId candidate : candidates_)
                fluents_[fluent_of(program_[candidate])].insert(candidate);
        }
        return fluents_[fluent_of(program_[id])];
    }

    // One is the other in the next step, or both are the same.
    using FluentName = std::pair<std::string_view, ir::Storage>;
    static FluentName fluent_of(const ir::Buffer& buffer) {
        const auto without_next = [](ir::Storage storage) {
            if (storage == ir::Storage::Next) return ir::Storage::State;
            return storage == ir::Storage::NextMemory ? ir::Storage::Memory : storage;
        };
        return {buffer.name, without_next(buffer.storage)};
    }

    ir::Program& program_;
    Buffers candidates_;
    std::set<ir::NodeId> safe_;
    std::vector<ir::Facts> facts_;
    ir::TableFacts tables_;
    std::map<ir::NodeId, std::vector<ir::NodeId>> users_;
    std::map<ir::BufferId, std::vector<ir::NodeId>> loads_;   // of candidates
    std::map<ir::NodeId, std::vector<ir::BufferId>> stores_;  // to candidates, by value
    std::map<FluentName, Buffers> fluents_;                   // the first candidates
    std::set<ir::NodeId> changed_;                            // whose users are not updated yet
};

}  // namespace

ir::Program find_finite_fluents(ir::Program program, Report& report) {
    Buffers candidates = candidates_in(program);
    if (!candidates.empty()) candidates = Refuting(program, std::move(candidates)).run();
    report["tables found finite"] += static_cast<std::int64_t>(candidates.size());
    return program;
}

}  // namespace rddlc::passes
