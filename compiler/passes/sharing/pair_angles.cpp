#include "passes/sharing/pair_angles.hpp"

#include "ir/analysis.hpp"
#include "ir/builder.hpp"
#include "ir/nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/needed_angles.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace rddlc::passes {
namespace {

// Two tables of so many packs of 16 fill half of the nearest cache.
constexpr std::int64_t most_elements = 64;

class Pairing {
  public:
    Pairing(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        find();
        std::map<ir::NodeId, ir::NodeId> known;
        std::vector<ir::Definition> fills;
        for (const ir::NodeId angle : in_order_)
            if (is_worth_it(angle)) fills.push_back(fill(angle, known));
        if (fills.empty()) return std::move(program_);
        ir::replace_in_step(builder_, program_, known);
        program_.step.insert(program_.step.begin(), fills.begin(), fills.end());
        return ir::collect_garbage(std::move(program_));
    }

  private:
    struct Functions {
        std::optional<ir::NodeId> sine, cosine;
        Span span = {};         // of the first user
        std::size_t users = 0;  // CPFs, and the reward
    };

    void find() {
        const NeededAngles needed(program_, builder_);
        for (const ir::Definition& definition : program_.step)
            add(needed.of(definition.body), definition.span);
        add(needed.of(program_.reward), program_.reward.span);
    }
    void add(const std::vector<ir::NodeId>& functions, Span span) {
        std::map<ir::NodeId, std::size_t> users;
        for (const ir::NodeId id : functions) {
            const auto& apply = std::get<ir::Apply>(program_[id].form);
            const ir::NodeId angle = apply.operands.front();
            const auto [entry, is_new] = found_.try_emplace(angle);
            Functions& of_angle = entry->second;
            if (is_new) {
                in_order_.push_back(angle);
                of_angle.span = span;
            }
            (apply.op == Operator::Sin ? of_angle.sine : of_angle.cosine) = id;
            if (users[angle]++ == 0) ++of_angle.users;
        }
    }

    // C++ compilers see both side by side where one CPF has them, or no loop is around them.
    bool is_worth_it(ir::NodeId angle) {
        const Functions& functions = found_.at(angle);
        const std::vector<ir::VariableId>& variables = builder_.properties(angle).free_variables;
        return functions.sine && functions.cosine && functions.users > 1 && !variables.empty() &&
               ir::combinations(program_, variables) <= most_elements;
    }

    ir::Definition fill(ir::NodeId angle, std::map<ir::NodeId, ir::NodeId>& known) {
        const Functions& functions = found_.at(angle);
        const std::vector<ir::VariableId> variables = builder_.properties(angle).free_variables;
        std::vector<ir::NodeId> indices;
        for (const ir::VariableId variable : variables) indices.push_back(builder_.index(variable));
        ir::Block lets, stores;
        const auto add = [&](Operator op, ir::NodeId function) {
            const std::string name = std::string(name_of(op)) + name_behind(angle);
            const ir::BufferId table = builder_.tables().scratch(
                name, ir::Scalar::Real, builder_.properties(function).range, variables,
                functions.span);
            const ir::NodeId value = let(lets, function);
            stores.push_back({ir::Store{table, indices, value}});
            known[function] = builder_.load(table, indices);
            return table;
        };
        const ir::BufferId sines = add(Operator::Sin, *functions.sine);
        add(Operator::Cos, *functions.cosine);
        std::ranges::move(stores, std::back_inserter(lets));
        ++report_["sines and cosines of one angle computed together"];
        return {sines, ir::looped(std::move(lets), variables), functions.span};
    }
    ir::NodeId let(ir::Block& block, ir::NodeId value) {
        const ir::LocalId local{program_.local_count++};
        block.push_back({ir::Let{local, value}});
        return builder_.local(local, ir::Scalar::Real);
    }
    // "-phi" if the angle is state.phi.
    std::string name_behind(ir::NodeId angle) const {
        const auto buffer = ir::buffer_read_by(program_[angle]);
        return buffer ? "-" + program_[*buffer].name : "";
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    std::vector<ir::NodeId> in_order_;  // angles, of their first use
    std::map<ir::NodeId, Functions> found_;
};

}  // namespace

ir::Program pair_angles(ir::Program program, Report& report) {
    return Pairing(std::move(program), report).run();
}

}  // namespace rddlc::passes
