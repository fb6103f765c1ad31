#include "passes/share_across_definitions.hpp"

#include "ir/call.hpp"
#include "ir/nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/new_tables.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace rddlc::passes {
namespace {

// In operations (Facts::cost): what is worth an element, what an element costs, and what may be
// computed although no branch needs it.
constexpr double worth_an_element = 15;
constexpr double cost_of_element = 2;
constexpr double cheap_enough_to_try = 64;
constexpr double most_elements = 1e6;

// How one CPF, or the reward, uses the nodes.
struct Use {
    std::vector<double> times;  // by NodeId::index: evaluations in a step; 0 if it is not used
    std::vector<bool> always;   // and not in a branch
    std::set<ir::BufferId> filled;
};

class Counting {
  public:
    Counting(const ir::Program& program, const std::map<ir::NodeId, ir::NodeId>& shared)
        : program_(program), shared_(shared) {}

    Use of(const ir::Block& body) {
        use_ = {.times = std::vector<double>(program_.nodes.size()),
                .always = std::vector<bool>(program_.nodes.size()),
                .filled = ir::written_buffers(body)};
        visit(body, 1);
        spread();
        return std::move(use_);
    }

  private:
    void visit(const ir::Block& block, double times) {
        const auto use = [&](ir::NodeId root) {
            use_.times[root.index] = std::max(use_.times[root.index], times);
            use_.always[root.index] = true;
        };
        for (const ir::Statement& statement : block) {
            match(
                statement.form, [&](const ir::Let& let) { use(let.value); },
                [&](const ir::Store& store) {
                    for (ir::NodeId index : store.indices) use(index);
                    use(store.value);
                },
                [&](const ir::Loop& loop) {
                    visit(loop.body, times * static_cast<double>(program_[loop.variable].size));
                },
                [&](const ir::Call& call) {
                    for (ir::NodeId operand : ir::operands_of(call)) use(operand);
                });
        }
    }

    // From the roots down: users come behind their operands in the pool.
    void spread() {
        for (std::uint32_t index = static_cast<std::uint32_t>(use_.times.size()); index-- > 0;) {
            if (use_.times[index] == 0 || shared_.contains({index})) continue;
            const ir::Node& node = program_.nodes[index];
            const auto bound = ir::bound_variable(node);
            const std::vector<ir::NodeId> operands = ir::operands_of(node);
            for (std::size_t k = 0; k < operands.size(); ++k) {
                const double repeated =
                    bound && k == 0 ? static_cast<double>(program_[*bound].size) : 1;
                double& times = use_.times[operands[k].index];
                times = std::max(times, use_.times[index] * repeated);
                const bool is_branch = std::holds_alternative<ir::Select>(node.form) && k > 0;
                if (use_.always[index] && !is_branch) use_.always[operands[k].index] = true;
            }
        }
    }

    const ir::Program& program_;
    const std::map<ir::NodeId, ir::NodeId>& shared_;
    Use use_;
};

class Sharing {
  public:
    Sharing(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        while (const auto found = find()) share(found->id, found->first_user);
        return ir::collect_garbage(std::move(program_));
    }

  private:
    struct Found {
        ir::NodeId id;
        std::size_t first_user;
    };

    // The CPFs, then the reward.
    std::vector<ir::Block> users() const {
        std::vector<ir::Block> blocks;
        for (const ir::Definition& definition : program_.step) blocks.push_back(definition.body);
        blocks.push_back(program_.reward.body);
        blocks.back().push_back({ir::Let{{}, program_.reward.value}});
        return blocks;
    }

    // The outermost expression that is worth it.
    std::optional<Found> find() const {
        std::vector<Use> uses;
        for (const ir::Block& block : users())
            uses.push_back(Counting(program_, elements_).of(block));
        for (std::uint32_t index = static_cast<std::uint32_t>(program_.nodes.size());
             index-- > 0;) {
            const auto used = [&](const Use& use) {
                return use.times[index] > 0;
            };
            if (elements_.contains({index}) || std::ranges::count_if(uses, used) < 2) continue;
            const auto first = std::ranges::find_if(uses, used);
            if (!is_worthwhile({index}, uses) || !is_known_before({index}, first->filled)) continue;
            return Found{{index}, static_cast<std::size_t>(first - uses.begin())};
        }
        return std::nullopt;
    }

    bool is_worthwhile(ir::NodeId id, const std::vector<Use>& uses) const {
        const ir::Facts& facts = builder_.facts(id);
        if (facts.may_fault || facts.uniform || facts.cost < worth_an_element) return false;
        double elements = 1, evaluations = 0;
        for (ir::VariableId variable : facts.free_variables)
            elements *= static_cast<double>(program_[variable].size);
        for (const Use& use : uses) evaluations += use.times[id.index];
        const bool always =
            std::ranges::any_of(uses, [&](const Use& use) { return use.always[id.index]; });
        const double shared = elements * (facts.cost + cost_of_element);
        return (always || facts.cost <= cheap_enough_to_try) && elements <= most_elements &&
               shared + evaluations * cost_of_element < evaluations * facts.cost;
    }

    // Neither a local value nor what the first user itself fills is part of it.
    bool is_known_before(ir::NodeId id, const std::set<ir::BufferId>& filled) const {
        const ir::Node& node = program_[id];
        if (std::holds_alternative<ir::Local>(node.form)) return false;
        const auto buffer = ir::buffer_read_by(node);
        if (buffer && filled.contains(*buffer)) return false;
        return std::ranges::all_of(ir::operands_of(node), [&](ir::NodeId operand) {
            return is_known_before(operand, filled);
        });
    }

    // ---------------------------------------------------------------------------- sharing

    void share(ir::NodeId id, std::size_t first_user) {
        const std::vector<ir::VariableId> variables = builder_.facts(id).free_variables;
        const bool in_step = first_user < program_.step.size();
        ir::Block& body = in_step ? program_.step[first_user].body : program_.reward.body;
        const ir::BufferId table =
            new_table(id, in_step ? program_.step[first_user].span : program_.reward.span);
        std::vector<ir::NodeId> indices;
        for (ir::VariableId variable : variables) indices.push_back(builder_.index(variable));
        const ir::NodeId element = builder_.load(table, indices);

        std::map<ir::NodeId, ir::NodeId> known = {{id, element}};
        const ir::Change change = [&](ir::NodeId& root) {
            root = ir::replace_in(builder_, root, known);
        };
        for (ir::Definition& definition : program_.step) ir::change_roots(definition.body, change);
        ir::change_roots(program_.reward.body, change);
        change(program_.reward.value);
        elements_[element] = element;

        ir::Block fill;
        fill.push_back({ir::Store{table, indices, id}});
        fill = ir::looped(std::move(fill), variables);
        body.insert(body.begin(), std::move(fill.front()));
        ++report_["expressions computed once for several CPFs"];
    }

    ir::BufferId new_table(ir::NodeId id, Span span) {
        const ir::Facts facts = builder_.facts(id);
        return scratch_table(program_, name_for(id), program_[id].type, facts.finite,
                             facts.free_variables, span);
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
    std::map<ir::NodeId, ir::NodeId> elements_;  // loads of what is shared already
};

}  // namespace

ir::Program share_across_definitions(ir::Program program, Report& report) {
    return Sharing(std::move(program), report).run();
}

}  // namespace rddlc::passes
