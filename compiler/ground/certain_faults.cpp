#include "ground/certain_faults.hpp"

#include "ground/codes.hpp"
#include "ir/analysis.hpp"
#include "ir/evaluator.hpp"

#include <rddl/interface/fault_text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::grounding {
namespace {

using Fault = rddl::FaultRecord;

// The limit in operations: longer trials are left to the runs.
constexpr double most_work = 1e6;

// Something that may fault, whose parameters the instance fixes.
struct Suspect {
    ir::NodeId node;
    ir::Site site;
    std::vector<ir::VariableId> variables;  // that the parameters use
};

// The variables of the parameters, which alone decide: the place only says where the fault is.
std::vector<ir::VariableId> variables_of(const ir::Builder& builder, const ir::Node& node,
                                         const ir::Place& place) {
    std::set<ir::VariableId> variables;
    for (const ir::NodeId operand : ir::operands_of(node)) {
        const auto& free = builder.properties(operand).free_variables;
        if (operand != place.index) variables.insert(free.begin(), free.end());
    }
    if (const auto bound = ir::bound_variable(node)) variables.erase(*bound);
    return {variables.begin(), variables.end()};
}

double work_for(const ir::Builder& builder, const Suspect& suspect) {
    double work = builder.properties(suspect.node).cost;
    for (const ir::VariableId variable : suspect.variables)
        work *= static_cast<double>(builder.program()[variable].size);
    return work;
}

// An ir::Fault was reported by the checks.
std::optional<Suspect> suspect_at(const ir::Builder& builder, ir::NodeId id) {
    const ir::Program& program = builder.program();
    const ir::Node& node = program[id];
    const std::optional<ir::Place> place = ir::place_of(node);
    if (!place || std::holds_alternative<ir::Fault>(node.form)) return std::nullopt;
    const auto is_fixed = [&](ir::NodeId operand) {
        return builder.properties(operand).uniform;
    };
    if (!std::ranges::all_of(ir::operands_of(node), is_fixed)) return std::nullopt;
    Suspect suspect{id, program[place->site], variables_of(builder, node, *place)};
    if (work_for(builder, suspect) > most_work) return std::nullopt;
    return suspect;
}

std::vector<Suspect> find_suspects(const ir::Builder& builder) {
    std::vector<Suspect> suspects;
    const std::vector<bool> reachable = ir::reachable_nodes(builder.program());
    for (std::uint32_t index = 0; index < reachable.size(); ++index) {
        if (!reachable[index]) continue;
        if (auto suspect = suspect_at(builder, {index})) suspects.push_back(*std::move(suspect));
    }
    return suspects;
}

// Evaluates suspects, for all objects.
class Trial {
  public:
    explicit Trial(const ir::Program& program)
        : program_(program), evaluator_(program), frame_(evaluator_, {}, context_) {
        // The place may use any variable.
        for (std::uint32_t index = 0; index < program.variables.size(); ++index)
            frame_.set({index}, 0);
    }

    // The first fault, if it is one for every object. A fault of a parameter is another suspect's.
    std::optional<Fault> fault_of(const Suspect& suspect) {
        first_ = {};
        const std::uint32_t site = ir::place_of(program_[suspect.node])->site.index;
        if (!faults_for_all(suspect.node, site, suspect.variables) || !first_) return std::nullopt;
        return first_;
    }

  private:
    bool faults_for_all(ir::NodeId node, std::uint32_t site,
                        std::span<const ir::VariableId> variables) {
        if (variables.empty()) return faults(node, site);
        for (std::int64_t object = 0; object < program_[variables.front()].size; ++object) {
            frame_.set(variables.front(), object);
            if (!faults_for_all(node, site, variables.subspan(1))) return false;
        }
        return true;
    }

    // A count is too large or not by chance.
    bool faults(ir::NodeId node, std::uint32_t site) {
        context_.fault = {};
        evaluator_.value_unless_fault(node, frame_);
        const Fault fault = context_.fault;
        if (!fault || fault.place.site != site || fault.kind == rddl::FaultKind::CountTooLarge)
            return false;
        if (!first_) first_ = fault;
        return true;
    }

    const ir::Program& program_;
    ir::Evaluator evaluator_;
    Context context_;
    ir::Evaluator::Frame frame_;
    Fault first_;
};

// "Bernoulli's probability must be in [0, 1], found 1.5"
std::string text_of(const Fault& fault, const Suspect& suspect) {
    std::array<char, 256> text;
    rddl::FixedText(text) << suspect.site.what << "'s " << rddl::requirement_of(fault.kind)
                          << ", found " << fault.value;
    return text.data();
}

}  // namespace

void warn_of_certain_faults(const ir::Builder& builder, Diagnostics& diagnostics) {
    const std::vector<Suspect> suspects = find_suspects(builder);
    if (suspects.empty()) return;
    Trial trial(builder.program());
    for (const Suspect& suspect : suspects) {
        const std::optional<Fault> fault = trial.fault_of(suspect);
        if (!fault) continue;
        diagnostics.report(
            {certain_fault, suspect.site.span,
             fmt::format("{}: this faults whenever it is evaluated{}", text_of(*fault, suspect),
                         suspect.variables.empty() ? "" : ", for all objects")});
    }
}

}  // namespace rddlc::grounding
