#include "passes/sharing/share_across_definitions.hpp"

#include "ir/call.hpp"
#include "ir/cost_model.hpp"
#include "ir/fill_table.hpp"
#include "ir/rewrite.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <utility>

namespace rddlc::passes {
namespace {

// Operations (Properties::cost) that are worth an element, those of an element, and those that may
// be computed although no branch needs them.
constexpr double worth_an_element = 15;
constexpr double cost_of_shared_element = 2;
constexpr double cheap_enough_to_try = 3 * ir::elementary_cost;
constexpr double most_shared_elements = 1e6;

// How one CPF, or the reward, uses a node.
struct UseByDefinition {
    double times = 0;     // evaluations in a step
    bool always = false;  // and not in a branch
    bool waits = false;   // all of them are jumped over where an action chooses nothing
};
// The users are the CPFs in their order, and then the reward.
using UsesByDefinition = std::map<std::size_t, UseByDefinition>;

class DefinitionSharing {
  public:
    DefinitionSharing(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        find_uses();
        find_available();
        choose();
        replace();
        return ir::collect_garbage(std::move(program_));
    }

  private:
    // Worth a table, which the first user fills.
    struct Shared {
        ir::NodeId id;
        std::size_t first_user;
        ir::BufferId table;
    };

    // ------------------------------------------------------------------------------- uses

    void find_uses() {
        for (std::size_t user = 0; user < program_.step.size(); ++user)
            visit(program_.step[user].body, user, 1);
        const std::size_t reward = program_.step.size();
        visit(program_.reward.body, reward, 1);
        use(program_.reward.value, reward, {1, true});
    }

    void visit(const ir::Block& block, std::size_t user, double times) {
        const auto use_root = [&](ir::NodeId root) {
            use(root, user, {times, true});
        };
        for (const ir::Statement& statement : block) {
            match(
                statement.form, [&](const ir::Let& let) { use_root(let.value); },
                [&](const ir::Store& store) {
                    for (ir::NodeId index : store.indices) use_root(index);
                    use_root(store.value);
                },
                [&](const ir::Spread& spread) {
                    for (ir::NodeId index : spread.indices) use_root(index);
                    use_root(spread.bits);
                },
                [&](const ir::Loop& loop) {
                    visit(loop.body, user,
                          times * static_cast<double>(program_[loop.variable].size));
                },
                [](const ir::Visit&) {},  // reads what few need
                [&](const ir::Call& call) {
                    for (ir::NodeId operand : ir::operands_of(call)) use_root(operand);
                });
        }
    }

    void use(ir::NodeId id, std::size_t user, const UseByDefinition& more) {
        if (more.times == 0) return;
        UseByDefinition& use = uses_[id].try_emplace(user, more).first->second;
        use.times = std::max(use.times, more.times);
        use.always |= more.always;
        use.waits &= more.waits;
    }

    // The first user behind which everything is there that a node reads. A local value is there for
    // one user only.
    void find_available() {
        std::map<ir::BufferId, std::size_t> filled;
        for (std::size_t user = 0; user <= program_.step.size(); ++user) {
            for (const ir::BufferId table : ir::written_buffers(body_of(user)))
                filled[table] = user + 1;
        }
        available_.resize(program_.nodes.size());
        for (std::size_t index = 0; index < available_.size(); ++index) {
            const ir::Node& node = program_.nodes[index];
            const auto buffer = ir::buffer_read_by(node);
            const auto table = buffer ? filled.find(*buffer) : filled.end();
            std::size_t& available = available_[index];
            if (std::holds_alternative<ir::Local>(node.form)) available = program_.step.size() + 1;
            if (table != filled.end()) available = table->second;
            for (const ir::NodeId operand : ir::operands_of(node))
                available = std::max(available, available_[operand.index]);
        }
    }

    // ---------------------------------------------------------------------------- choosing

    // Visits the roots first, so that it finds the outermost expressions that are worth it; users
    // come behind their operands in the pool.
    void choose() {
        for (const auto& [id, uses] : uses_) {
            if (is_worthwhile(id, uses) && available_[id.index] <= uses.begin()->first) {
                share(id, uses);
            } else {
                for (const auto& [user, use] : uses) spread(id, user, use);
            }
        }
    }

    void spread(ir::NodeId id, std::size_t user, const UseByDefinition& of_node) {
        const ir::Node& node = program_[id];
        const auto bound = ir::bound_variable(node);
        const std::vector<ir::NodeId> operands = ir::operands_of(node);
        for (std::size_t k = 0; k < operands.size(); ++k) {
            const double repeated =
                bound && k == 0 ? static_cast<double>(program_[*bound].size) : 1;
            const auto* const select = std::get_if<ir::Select>(&node.form);
            const bool is_jump = select && select->evaluated == ir::Evaluated::Jump;
            use(operands[k], user,
                {of_node.times * repeated, of_node.always && !(select && k > 0),
                 of_node.waits || (is_jump && k == 1)});
        }
    }

    bool is_worthwhile(ir::NodeId id, const UsesByDefinition& uses) const {
        const ir::Properties& properties = builder_.properties(id);
        if (uses.size() < 2 || properties.may_fault || properties.uniform ||
            properties.cost < worth_an_element)
            return false;
        double elements = 1, evaluations = 0;
        for (ir::VariableId variable : properties.free_variables)
            elements *= static_cast<double>(program_[variable].size);
        bool always = false, waits = true;
        for (const auto& [user, use] : uses) {
            evaluations += use.times;
            always |= use.always;
            waits &= use.waits;
        }
        const double shared = elements * (properties.cost + cost_of_shared_element);
        return (always || (properties.cost <= cheap_enough_to_try && !waits)) &&
               elements <= most_shared_elements &&
               shared + evaluations * cost_of_shared_element < evaluations * properties.cost;
    }

    // The first user fills a table for it, and all read that.
    void share(ir::NodeId id, const UsesByDefinition& uses) {
        const std::size_t first_user = uses.begin()->first;
        double elements = 1;
        for (const ir::VariableId variable : builder_.properties(id).free_variables)
            elements *= static_cast<double>(program_[variable].size);
        spread(id, first_user, {elements, true});
        const Span span = first_user < program_.step.size() ? program_.step[first_user].span
                                                            : program_.reward.span;
        shared_.push_back({id, first_user, new_table(id, span)});
    }

    ir::Block& body_of(std::size_t user) {
        return user < program_.step.size() ? program_.step[user].body : program_.reward.body;
    }

    // --------------------------------------------------------------------------- replacing

    // Inner expressions first, so that outer ones read their tables.
    void replace() {
        std::ranges::reverse(shared_);
        std::map<ir::NodeId, ir::NodeId> known;
        std::map<std::size_t, ir::Block> fills;
        for (const Shared& shared : shared_) {
            const std::vector<ir::VariableId> variables =
                builder_.properties(shared.id).free_variables;
            const ir::NodeId value = ir::replace_in(builder_, shared.id, known);
            known[shared.id] =
                ir::fill_table(builder_, fills[shared.first_user], shared.table, variables, value);
            ++report_["expressions computed once for several CPFs"];
        }
        if (shared_.empty()) return;
        ir::replace_in_step(builder_, program_, known);
        for (auto& [user, fill] : fills) {
            ir::Block& body = body_of(user);
            std::ranges::move(body, std::back_inserter(fill));
            body = std::move(fill);
        }
    }

    ir::BufferId new_table(ir::NodeId id, Span span) {
        const ir::Properties properties = builder_.properties(id);
        return builder_.tables().scratch(name_for(id), program_[id].type, properties.range,
                                         properties.free_variables, span);
    }

    // cos(state.angle): "cos-angle".
    std::string name_for(ir::NodeId id) const {
        const std::string what = match(
            program_[id].form, [](const ir::Apply& form) { return std::string(name_of(form.op)); },
            [](const ir::Reduce& form) { return std::string(name_of(form.op)); },
            [](const ir::Bits&) { return std::string("bits"); },
            [](const auto&) { return std::string("value"); });
        const std::string of = first_fluent(id);
        return of.empty() ? what : what + "-" + of;
    }

    std::string first_fluent(ir::NodeId id) const {
        const auto buffer = ir::buffer_read_by(program_[id]);
        if (buffer && program_[*buffer].storage != ir::Storage::Constant)
            return program_[*buffer].name;
        for (ir::NodeId operand : ir::operands_of(program_[id])) {
            const std::string name = first_fluent(operand);
            if (!name.empty()) return name;
        }
        return "";
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    std::map<ir::NodeId, UsesByDefinition, std::greater<>> uses_;  // users before their operands
    std::vector<std::size_t> available_;  // by NodeId::index: the first user
    std::vector<Shared> shared_;
};

}  // namespace

ir::Program share_across_definitions(ir::Program program, Report& report) {
    return DefinitionSharing(std::move(program), report).run();
}

}  // namespace rddlc::passes
