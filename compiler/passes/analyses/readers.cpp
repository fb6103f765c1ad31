#include "passes/analyses/readers.hpp"

#include "ir/analysis.hpp"
#include "ir/call.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <functional>
#include <map>

namespace rddlc::passes {
namespace {

class ReaderCounting {
  public:
    explicit ReaderCounting(const ir::Program& program)
        : program_(program), readers_(program.buffers.size()), listed_(program.nodes.size()) {}

    void count(const ir::Block& body) {
        variables_.clear();
        std::set<ir::BufferId> read;
        visit(body, 1, read);
        for (ir::BufferId buffer : read) {
            ++readers_[buffer.index].definitions;
            readers_[buffer.index].variables.insert(variables_.begin(), variables_.end());
        }
    }

    void count(const ir::Computation& computation) {
        ir::Block whole = computation.body;
        whole.push_back({ir::Let{{}, computation.value}});
        count(whole);
    }

    std::vector<Readers> result() && { return std::move(readers_); }

  private:
    struct Need {
        double times = 0, places = 0;
        bool lazy = false;
    };

    void visit(const ir::Block& block, double times, std::set<ir::BufferId>& read) {
        for (const ir::Statement& statement : block) {
            match(
                statement.form, [&](const ir::Let& let) { visit(let.value, times, read); },
                [&](const ir::Store& store) {
                    for (ir::NodeId index : store.indices) visit(index, times, read);
                    visit(store.value, times, read);
                },
                [&](const ir::Spread& spread) {
                    for (ir::NodeId index : spread.indices) visit(index, times, read);
                    visit(spread.bits, times, read);
                    readers_[spread.target.index].functions = true;
                },
                [&](const ir::Loop& loop) {
                    variables_.insert(loop.variable);
                    visit(loop.body, times * size(loop.variable), read);
                },
                [&](const ir::Visit& few) {
                    variables_.insert(few.visited);
                    if (few.entries) variables_.insert(few.entries->variable);
                    visit(few.condition, size(few.visited), read);
                    const double marks = size(few.entries ? few.entries->variable : few.visited);
                    for (const ir::Mark& mark : few.marks) {
                        for (ir::NodeId index : mark.indices) visit(index, marks, read);
                        visit(mark.condition, marks, read);
                        readers_[mark.target.index].functions = true;
                    }
                },
                [&](const ir::Call& call) {
                    for (ir::NodeId operand : ir::operands_of(call)) visit(operand, times, read);
                    for (const auto& input : call.inputs)
                        readers_[input.buffer.index].functions = true;
                    for (ir::BufferId written : ir::written_buffers(call))
                        readers_[written.index].functions = true;
                });
        }
    }

    // A node that is used several times is evaluated once where it is needed most often.
    void visit(ir::NodeId root, double times, std::set<ir::BufferId>& read) {
        // Users come before what they use.
        std::map<ir::NodeId, Need, std::greater<>> needs = {{root, {times, 1, false}}};
        for (; !needs.empty(); needs.erase(needs.begin())) {
            const auto& [id, need] = *needs.begin();
            if (need.times == 0) continue;
            const ir::Node& node = program_[id];
            if (const auto* load = std::get_if<ir::Load>(&node.form)) {
                Readers& readers = readers_[load->buffer.index];
                readers.reads += need.times;
                readers.places += need.places;
                readers.lazy |= need.lazy;
                if (!listed_[id.index]) readers.loads.push_back(id);
                listed_[id.index] = true;
                read.insert(load->buffer);
            }
            const auto bound = ir::bound_variable(node);
            if (bound) variables_.insert(*bound);
            const std::vector<ir::NodeId> operands = ir::operands_of(node);
            for (std::size_t k = 0; k < operands.size(); ++k) {
                const bool is_body = bound && k == 0;
                const bool is_branch = std::holds_alternative<ir::Select>(node.form) && k > 0;
                Need& of_operand = needs[operands[k]];
                of_operand.lazy |= need.lazy || is_body || is_branch;
                of_operand.places += need.places;
                of_operand.times =
                    std::max(of_operand.times, need.times * (is_body ? size(*bound) : 1));
            }
        }
    }

    double size(ir::VariableId variable) const {
        return static_cast<double>(program_[variable].size);
    }

    const ir::Program& program_;
    std::vector<Readers> readers_;
    std::vector<bool> listed_;
    std::set<ir::VariableId> variables_;
};

}  // namespace

std::vector<Readers> readers_of_step(const ir::Program& program) {
    ReaderCounting counting(program);
    for (const ir::Definition& definition : program.step) counting.count(definition.body);
    counting.count(program.reward);
    return std::move(counting).result();
}

std::set<ir::VariableId> bound_variables(const ir::Program& program, ir::NodeId id) {
    std::set<ir::VariableId> variables;
    if (const auto bound = ir::bound_variable(program[id])) variables.insert(*bound);
    for (ir::NodeId operand : ir::operands_of(program[id]))
        variables.merge(bound_variables(program, operand));
    return variables;
}

}  // namespace rddlc::passes
