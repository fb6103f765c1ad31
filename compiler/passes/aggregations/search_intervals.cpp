#include "passes/aggregations/search_intervals.hpp"

#include "ir/evaluation_budget.hpp"
#include "ir/rewrite.hpp"
#include "passes/aggregations/take_only_objects.hpp"
#include "passes/analyses/constant_values.hpp"
#include "passes/analyses/piecewise_constant.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace rddlc::passes {
namespace {

// An expression that costs less than this many searches stays as it is.
constexpr double worth_a_search = 2;

// The values of an expression for numbers from all pieces.
class Trying {
  public:
    // The local, which no statement defines, stands for the number.
    Trying(ir::Builder& builder, const ir::Evaluator& evaluator, ir::LocalId local)
        : builder_(builder), evaluator_(evaluator), local_(local) {}

    // Pays for an expression in all pieces.
    bool pay(ir::EvaluationBudget& budget, ir::NodeId id, const PiecewiseConstant& pieces) const {
        return budget.pay(builder_.properties(id).cost *
                          static_cast<double>(pieces.breaks.size() + 2));
    }

    // Each by the objects of the variables, row-major. None if nan behaves like no piece.
    std::optional<std::vector<std::vector<ir::Value>>> of(
        ir::NodeId id, const PiecewiseConstant& pieces,
        const std::vector<ir::VariableId>& variables) {
        const ir::Scalar type = builder_.program()[pieces.number].type;
        std::map<ir::NodeId, ir::NodeId> known = {{pieces.number, builder_.local(local_, type)}};
        const ir::NodeId value = ir::replace_in(builder_, id, known);
        const auto with = [&](const ir::Value& number) {
            const ir::Program& program = builder_.program();
            return *constant_values(evaluator_, program, value, variables, Assumed{local_, number});
        };
        std::vector<std::vector<ir::Value>> values;
        for (const ir::Value& number : pieces.representatives()) values.push_back(with(number));
        // A search puts nan below all breaks.
        if (type == ir::Scalar::Real &&
            !are_identical(with(std::numeric_limits<double>::quiet_NaN()), values.front()))
            return std::nullopt;
        return values;
    }

  private:
    ir::Builder& builder_;
    const ir::Evaluator& evaluator_;
    ir::LocalId local_;
};

std::string name_of_number(const ir::Program& program, ir::NodeId number) {
    const auto* load = std::get_if<ir::Load>(&program[number].form);
    if (load) return program[load->buffer].name;
    for (ir::NodeId operand : ir::operands_of(program[number])) {
        const std::string name = name_of_number(program, operand);
        if (!name.empty()) return name;
    }
    return "";
}

// A table over the pieces or their breaks.
ir::BufferId new_table(ir::Builder& builder, const PiecewiseConstant& pieces,
                       const std::string& suffix, std::vector<ir::Value> values) {
    const ir::Program& program = builder.program();
    ir::Buffer table{.name = name_of_number(program, pieces.number) + suffix,
                     .storage = ir::Storage::Constant,
                     .scalar = ir::scalar_of(values.front()),
                     .shape = {static_cast<std::int64_t>(values.size())},
                     .values = std::move(values),
                     .span = program.reward.span};
    return builder.tables().constant(std::move(table));
}

// Joins neighbours of equal values. The values are those of the pieces that are left.
std::vector<ir::Value> joined(PiecewiseConstant& pieces, const std::vector<ir::Value>& values) {
    std::vector<ir::Value> breaks, entries, left = {values.front()};
    for (std::size_t k = 0; k < pieces.breaks.size(); ++k) {
        if (identical(values[k], values[k + 1])) continue;
        breaks.push_back(pieces.breaks[k]);
        entries.push_back(pieces.entries[k]);
        left.push_back(values[k + 1]);
    }
    pieces.breaks = std::move(breaks);
    pieces.entries = std::move(entries);
    return left;
}

ir::NodeId search(ir::Builder& builder, const PiecewiseConstant& pieces) {
    return builder.search(new_table(builder, pieces, "-breaks", pieces.entries), pieces.number);
}

// ------------------------------------------------------------------------- constant pieces

// Replaces the outermost expressions that are constant in each piece.
class PieceTabulation {
  public:
    PieceTabulation(ir::Program program, Report& report)
        : program_(std::move(program)),
          report_(report),
          local_{program_.local_count++},
          builder_(program_),
          evaluator_(program_) {}

    ir::Program run() && {
        std::map<ir::NodeId, ir::NodeId> done;
        const auto find = [&](ir::NodeId id) {
            return looked_up(id);
        };
        ir::change_roots(
            program_, [&](ir::NodeId& root) { root = ir::replace_in(builder_, root, done, find); });
        --program_.local_count;
        return ir::collect_garbage(std::move(program_));
    }

  private:
    std::optional<ir::NodeId> looked_up(ir::NodeId id) {
        const ir::Properties properties = builder_.properties(id);
        if (properties.uniform || !properties.free_variables.empty() || properties.may_fault)
            return std::nullopt;
        auto pieces = piecewise_constant_of(builder_, evaluator_, id);
        if (!pieces) return std::nullopt;
        Trying trying(builder_, evaluator_, local_);
        if (!trying.pay(budget_, id, *pieces)) return std::nullopt;
        const auto tried = trying.of(id, *pieces, {});
        if (!tried) return std::nullopt;
        std::vector<ir::Value> values;
        for (const auto& of_piece : *tried) values.push_back(of_piece.front());
        values = joined(*pieces, values);
        if (pieces->breaks.empty()) return builder_.constant(values.front());
        const double steps = std::log2(static_cast<double>(pieces->breaks.size())) + 1;
        if (properties.cost - builder_.properties(pieces->number).cost <
            worth_a_search * (2 * steps + 1))
            return std::nullopt;
        ++report_["aggregations made a search"];
        const ir::NodeId place = search(builder_, *pieces);
        return builder_.load(new_table(builder_, *pieces, "-values", std::move(values)), {place});
    }

    ir::Program program_;
    Report& report_;
    ir::LocalId local_;  // stands for a number that is tried
    ir::Builder builder_;
    ir::Evaluator evaluator_;
    ir::EvaluationBudget budget_;
};

// -------------------------------------------------------------- one object in each piece

// The object that fulfils a condition in each piece.
class ObjectsOfPieces {
  public:
    explicit ObjectsOfPieces(Report& report) : report_(report) {}

    // Always of the same program.
    std::optional<OnlyObject> find(ir::Program& program, ir::Builder& builder,
                                   const Condition& condition, ir::VariableId variable) {
        const ir::Properties properties = builder.properties(condition.id);
        const bool is_only_variable = properties.free_variables == std::vector{variable};
        if (properties.uniform || !is_only_variable || properties.may_fault) return std::nullopt;
        if (!compares_one_number(builder, condition.id)) return std::nullopt;
        know(program);
        const auto pieces = piecewise_constant_of(builder, *evaluator_, condition.id);
        Trying trying(builder, *evaluator_, local_);
        if (!pieces || !trying.pay(budget_, condition.id, *pieces)) return std::nullopt;
        const auto tried = trying.of(condition.id, *pieces, {variable});
        if (!tried) return std::nullopt;

        std::vector<ir::Value> objects, exists;
        for (const std::vector<ir::Value>& values : *tried) {
            const auto count = std::ranges::count(values, ir::Value(condition.needed));
            if (count > 1) return std::nullopt;
            const auto object = std::ranges::find(values, ir::Value(condition.needed));
            objects.emplace_back(count == 0 ? std::int64_t{0} : object - values.begin());
            exists.emplace_back(count == 1);
        }
        ++report_["aggregations replaced by the object of an interval"];
        const ir::NodeId place = search(builder, *pieces);
        return OnlyObject{
            builder.load(new_table(builder, *pieces, "-object", std::move(objects)), {place}),
            builder.load(new_table(builder, *pieces, "-is-there", std::move(exists)), {place})};
    }

  private:
    // The tables are packed once, not for each condition.
    void know(ir::Program& program) {
        if (evaluator_) return evaluator_->know_added_tables();
        local_ = ir::LocalId{program.local_count++};
        evaluator_.emplace(program);
        --program.local_count;
    }

    Report& report_;
    std::optional<ir::Evaluator> evaluator_;
    ir::LocalId local_{};  // stands for a number that is tried
    ir::EvaluationBudget budget_;
};

}  // namespace

ir::Program search_intervals(ir::Program program, Report& report) {
    program = PieceTabulation(std::move(program), report).run();
    ObjectsOfPieces objects(report);
    return take_only_objects(std::move(program),
                             [&](ir::Program& changed, ir::Builder& builder,
                                 const Condition& condition, ir::VariableId variable) {
                                 return objects.find(changed, builder, condition, variable);
                             });
}

}  // namespace rddlc::passes
