#include "passes/sharing/share_subexpressions.hpp"

#include "ir/call.hpp"
#include "ir/cost_model.hpp"
#include "ir/rewrite.hpp"
#include "ir/shares.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <utility>

namespace rddlc::passes {
namespace {

// Operations (Properties::cost) that are worth a name.
constexpr double worth_a_name = 6;

// How a node below a statement is used.
struct Use {
    bool is_root = false;
    bool always = false;     // evaluated whenever the statement is
    bool repeated = false;   // below a loop of the statement, or a reduction
    bool is_test = false;    // decides between a cheap and a dear way
    double repetitions = 1;  // by these loops and reductions
    int count = 0;           // by different nodes, or twice by one
};

// The uses of all nodes below a statement, users before their operands. A statement does not look
// at the nodes of others, or the time would be the square of the program's length.
using Uses = std::map<ir::NodeId, Use, std::greater<>>;

class Sharing {
  public:
    Sharing(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        share_in(program_.step);
        share_in(program_.reward);
        for (auto* conditions :
             {&program_.preconditions, &program_.invariants, &program_.terminations}) {
            for (ir::Computation& condition : *conditions) share_in(condition);
        }
        if (program_.policy) share_in(program_.policy->act);
        return std::move(program_);
    }

  private:
    void share_in(std::vector<ir::Definition>& definitions) {
        for (ir::Definition& definition : definitions) {
            const bool runs = program_[definition.target].count() > 0;
            if (runs) share_in(definition.body);
        }
    }

    void share_in(ir::Block& block) {
        bound_.clear();
        share_below(block);
    }

    // The value is one more statement of the block.
    void share_in(ir::Computation& computation) {
        bound_.clear();
        share_below(computation.body);
        Uses uses;
        use(uses, computation.value, false);
        ir::Block lets =
            replace_shared(uses, {}, [&](const ir::Change& change) { change(computation.value); });
        std::ranges::move(lets, std::back_inserter(computation.body));
    }

    // Each statement by itself: between two there may be a store to what the second one loads.
    void share_below(ir::Block& block) {
        ir::Block result;
        for (ir::Statement& statement : block) {
            ir::Block single;
            single.push_back(std::move(statement));
            std::ranges::move(lets_before(single), std::back_inserter(result));
            if (auto* loop = std::get_if<ir::Loop>(&single.front().form)) {
                bound_.insert(loop->variable);
                share_below(loop->body);
                bound_.erase(loop->variable);
            }
            result.push_back(std::move(single.front()));
        }
        block = std::move(result);
    }

    ir::Block lets_before(ir::Block& single) {
        Uses uses;
        const bool is_loop = std::holds_alternative<ir::Loop>(single.front().form) ||
                             std::holds_alternative<ir::Visit>(single.front().form);
        const double repetitions = repetitions_of(single.front());
        for (ir::NodeId root : ir::roots_of(single)) use(uses, root, is_loop, repetitions);
        return replace_shared(uses, ir::written_buffers(single),
                              [&](const ir::Change& change) { ir::change_roots(single, change); });
    }

    // ---------------------------------------------------------------------------- uses

    static void use(Uses& uses, ir::NodeId root, bool repeated, double repetitions = 1) {
        Use& use = uses[root];
        use.is_root = use.always = true;
        use.repeated |= repeated;
        use.repetitions = std::max(use.repetitions, repetitions);
        ++use.count;
    }

    // Visits the roots first: users come behind their operands in the pool.
    void spread(Uses& uses) const {
        for (const auto& [id, use] : uses) {
            const ir::Node& node = program_[id];
            for (ir::NodeId operand : ir::operands_of(node)) {
                Use& used = uses[operand];
                ++used.count;
                used.repeated |= use.repeated || is_body(node, operand);
                used.repetitions =
                    std::max(used.repetitions, use.repetitions * repetitions_of(node, operand));
                used.always |= use.always && !is_lazy(node, operand);
                used.is_test |= is_test(node, operand);
            }
        }
    }

    bool is_lazy(const ir::Node& node, ir::NodeId operand) const {
        const auto* select = std::get_if<ir::Select>(&node.form);
        return select && operand != select->condition &&
               ir::is_lazy(program_, *select, builder_.properties(select->then_value),
                           builder_.properties(select->else_value));
    }

    static bool is_test(const ir::Node& node, ir::NodeId operand) {
        const auto* select = std::get_if<ir::Select>(&node.form);
        return select && select->evaluated == ir::Evaluated::MostlyFirst &&
               operand == select->condition;
    }

    static bool is_body(const ir::Node& node, ir::NodeId operand) {
        return ir::bound_variable(node) && operand == ir::operands_of(node).front();
    }

    double repetitions_of(const ir::Node& node, ir::NodeId operand) const {
        return is_body(node, operand) ? ir::repetitions(program_, node) : 1;
    }

    // How often loops right inside each other run the innermost statement.
    double repetitions_of(const ir::Statement& statement) const {
        const auto* loop = std::get_if<ir::Loop>(&statement.form);
        if (!loop || loop->body.empty()) return 1;
        return static_cast<double>(program_[loop->variable].size) *
               repetitions_of(loop->body.front());
    }

    // A Let may compute this though no evaluation needs it: it costs no more than the loop around,
    // which computes something each time, or decides that the loop has less work.
    bool may_be_in_vain(ir::NodeId id, const Use& use) const {
        const ir::Properties& properties = builder_.properties(id);
        return use.repeated && !properties.may_fault && !properties.random &&
               (properties.cost <= use.repetitions || use.is_test);
    }

    // ------------------------------------------------------------------------ choosing

    // Makes a Let of each node worth it and puts its Local in its place below the statement, whose
    // roots `change_roots` changes. Returns the Lets.
    template <class ChangeRoots>
    ir::Block replace_shared(Uses& uses, const std::set<ir::BufferId>& stored,
                             const ChangeRoots& change_roots) {
        spread(uses);
        const std::vector<ir::NodeId> shared = choose(uses, stored);
        if (shared.empty()) return {};
        report_["values named"] += static_cast<std::int64_t>(shared.size());
        std::map<ir::NodeId, ir::NodeId> replaced;
        ir::Block lets;
        for (ir::NodeId id : shared) {
            const ir::NodeId value = ir::replace_in(builder_, id, replaced);
            const ir::LocalId local{program_.local_count++};
            lets.push_back({ir::Let{local, value}});
            replaced[id] = builder_.local(local, program_[id].type);
        }
        change_roots([&](ir::NodeId& root) { root = ir::replace_in(builder_, root, replaced); });
        return lets;
    }

    // Defines them in the order of the pool, so that each may use those before it.
    std::vector<ir::NodeId> choose(const Uses& uses, const std::set<ir::BufferId>& stored) const {
        const std::set<ir::NodeId> fixed = fixed_nodes(uses, stored);
        const std::set<ir::NodeId> exposed = exposed_nodes(uses, fixed);
        const std::set<ir::NodeId> totals = totals_of_rows(uses);
        std::vector<ir::NodeId> chosen;
        for (const ir::NodeId id : fixed) {
            const Use& use = uses.at(id);
            if (is_plain_index(id) || totals.contains(id) ||
                builder_.properties(id).cost < worth_a_name)
                continue;
            const bool hoisted = use.repeated && exposed.contains(id);
            if (use.always ? use.count > 1 || hoisted : hoisted && may_be_in_vain(id, use))
                chosen.push_back(id);
        }
        return chosen;
    }

    // Draws from the weights of a row add them themselves.
    std::set<ir::NodeId> totals_of_rows(const Uses& uses) const {
        std::set<ir::NodeId> totals;
        for (const auto& [id, use] : uses) {
            const auto shares = ir::shares_of_elements(program_, program_[id]);
            if (shares && shares->is_row()) totals.insert(shares->total);
        }
        return totals;
    }

    // Neither the loops nor the stores of the statement change the node's value.
    std::set<ir::NodeId> fixed_nodes(const Uses& uses, const std::set<ir::BufferId>& stored) const {
        const auto is_bound = [&](ir::VariableId id) {
            return bound_.contains(id);
        };
        std::set<ir::NodeId> reads_stored, fixed;
        for (auto use = uses.rbegin(); use != uses.rend(); ++use) {
            const ir::NodeId id = use->first;
            const ir::Node& node = program_[id];
            const auto buffer = ir::buffer_read_by(node);
            const auto reads = [&](ir::NodeId operand) {
                return reads_stored.contains(operand);
            };
            if ((buffer && stored.contains(*buffer)) ||
                std::ranges::any_of(ir::operands_of(node), reads)) {
                reads_stored.insert(id);
            } else if (std::ranges::all_of(builder_.properties(id).free_variables, is_bound)) {
                fixed.insert(fixed.end(), id);
            }
        }
        return fixed;
    }

    // Used by something that is not fixed. What is used by fixed nodes alone goes with them.
    std::set<ir::NodeId> exposed_nodes(const Uses& uses, const std::set<ir::NodeId>& fixed) const {
        std::set<ir::NodeId> exposed;
        for (const auto& [id, use] : uses) {
            if (use.is_root) exposed.insert(id);
            if (fixed.contains(id)) continue;
            for (ir::NodeId operand : ir::operands_of(program_[id])) exposed.insert(operand);
        }
        return exposed;
    }

    // An index made of loop indices and constants stays one: it is the same in all lanes.
    bool is_plain_index(ir::NodeId id) const {
        return program_[id].type == ir::Scalar::Int && builder_.properties(id).uniform;
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    std::set<ir::VariableId> bound_;  // by the loops around the current block
};

}  // namespace

ir::Program share_subexpressions(ir::Program program, Report& report) {
    return ir::collect_garbage(Sharing(std::move(program), report).run());
}

}  // namespace rddlc::passes
