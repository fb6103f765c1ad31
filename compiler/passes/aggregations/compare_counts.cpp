#include "passes/aggregations/compare_counts.hpp"

#include "ir/reduction_nest.hpp"
#include "ir/rewrite.hpp"

#include <map>
#include <set>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// The nest of a sum that counts where a bool is true; its body is the bool.
std::optional<ir::ReductionNest> counted(const ir::Program& program, ir::NodeId id) {
    std::optional<ir::ReductionNest> nest = ir::whole_reduction_nest(program, id, Reduction::Sum);
    if (!nest || program[id].type != ir::Scalar::Int) return std::nullopt;
    const auto* convert = std::get_if<ir::Convert>(&program[nest->body].form);
    if (!convert) return std::nullopt;
    nest->body = convert->operand;
    return nest;
}

class Comparing {
  public:
    explicit Comparing(ir::Program program) : program_(std::move(program)), builder_(program_) {}

    ir::Program run(Report& report) && {
        ir::change_roots(program_, [&](ir::NodeId& root) {
            std::map<ir::NodeId, ir::NodeId> known = comparisons_below(root);
            if (known.empty()) return;
            report["aggregations made comparisons of counts"] += std::ssize(known);
            root = ir::replace_in(builder_, root, known);
        });
        return ir::collect_garbage(std::move(program_));
    }

  private:
    // The keys are the nodes that the comparisons replace.
    std::map<ir::NodeId, ir::NodeId> comparisons_below(ir::NodeId root) {
        std::set<ir::NodeId> below;
        collect(root, below);
        std::map<ir::ReductionNest, ir::NodeId> counts;
        for (ir::NodeId id : below) {
            if (const auto nest = counted(program_, id)) counts[*nest] = id;
        }
        std::map<ir::NodeId, ir::NodeId> comparisons;
        for (ir::NodeId id : below) {
            if (const auto comparison = comparison_for(id, counts)) comparisons[id] = *comparison;
        }
        return comparisons;
    }

    void collect(ir::NodeId id, std::set<ir::NodeId>& below) const {
        if (!below.insert(id).second) return;
        for (ir::NodeId operand : ir::operands_of(program_[id])) collect(operand, below);
    }

    std::optional<ir::NodeId> comparison_for(
        ir::NodeId id, const std::map<ir::ReductionNest, ir::NodeId>& counts) {
        const ir::NodeId zero = builder_.constant(std::int64_t{0});
        const auto count_of = [&](const ir::ReductionNest& nest, ir::NodeId condition) {
            return counts.find({Reduction::Sum, nest.variables, condition});
        };
        if (const auto nest = ir::whole_reduction_nest(program_, id, Reduction::Exists)) {
            const auto count = count_of(*nest, nest->body);
            if (count != counts.end())
                return builder_.apply(Operator::Greater, {count->second, zero});
        }
        if (const auto nest = ir::whole_reduction_nest(program_, id, Reduction::ForAll)) {
            const auto count = count_of(*nest, builder_.apply(Operator::Not, {nest->body}));
            if (count != counts.end())
                return builder_.apply(Operator::Equal, {count->second, zero});
        }
        return std::nullopt;
    }

    ir::Program program_;
    ir::Builder builder_;
};

}  // namespace

ir::Program compare_counts(ir::Program program, Report& report) {
    return Comparing(std::move(program)).run(report);
}

}  // namespace rddlc::passes
