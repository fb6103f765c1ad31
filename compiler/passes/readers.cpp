#include "passes/readers.hpp"

#include "ir/analysis.hpp"
#include "ir/call.hpp"
#include "support/match.hpp"

#include <algorithm>

namespace rddlc::passes {
namespace {

class Counting {
  public:
    explicit Counting(const ir::Program& program)
        : program_(program), readers_(program.buffers.size()), listed_(program.nodes.size()) {}

    void count(const ir::Block& body) {
        variables_.clear();
        std::set<ir::BufferId> read;
        visit(body, 1, read);
        for (ir::BufferId buffer : read)
            readers_[buffer.index].variables.insert(variables_.begin(), variables_.end());
    }

    void count(const ir::Computation& computation) {
        ir::Block whole = computation.body;
        whole.push_back({ir::Let{{}, computation.value}});
        count(whole);
    }

    std::vector<Readers> result() && { return std::move(readers_); }

  private:
    void visit(const ir::Block& block, double times, std::set<ir::BufferId>& read) {
        for (const ir::Statement& statement : block) {
            match(
                statement.form, [&](const ir::Let& let) { visit(let.value, times, read); },
                [&](const ir::Store& store) {
                    for (ir::NodeId index : store.indices) visit(index, times, read);
                    visit(store.value, times, read);
                },
                [&](const ir::Loop& loop) {
                    variables_.insert(loop.variable);
                    visit(loop.body, times * size(loop.variable), read);
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
        std::vector<double> needed(root.index + 1), places(root.index + 1);
        needed[root.index] = times;
        places[root.index] = 1;
        std::vector<bool> lazy(root.index + 1);
        for (std::uint32_t index = root.index + 1; index-- > 0;) {
            if (needed[index] == 0) continue;
            const ir::Node& node = program_.nodes[index];
            if (const auto* load = std::get_if<ir::Load>(&node.form)) {
                Readers& readers = readers_[load->buffer.index];
                readers.reads += needed[index];
                readers.places += places[index];
                readers.lazy |= lazy[index];
                if (!listed_[index]) readers.loads.push_back({index});
                listed_[index] = true;
                read.insert(load->buffer);
            }
            const auto bound = ir::bound_variable(node);
            if (bound) variables_.insert(*bound);
            const std::vector<ir::NodeId> operands = ir::operands_of(node);
            for (std::size_t k = 0; k < operands.size(); ++k) {
                const bool is_body = bound && k == 0;
                const bool is_branch = std::holds_alternative<ir::Select>(node.form) && k > 0;
                if (lazy[index] || is_body || is_branch) lazy[operands[k].index] = true;
                places[operands[k].index] += places[index];
                double& of_operand = needed[operands[k].index];
                of_operand = std::max(of_operand, needed[index] * (is_body ? size(*bound) : 1));
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
    Counting counting(program);
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
