#include "passes/lanes/choose_evaluation.hpp"

#include "ir/analysis.hpp"
#include "ir/common_rows.hpp"
#include "ir/nest.hpp"
#include "ir/reduction_nest.hpp"
#include "ir/rewrite.hpp"
#include "ir/row_of_bools.hpp"
#include "passes/analyses/few_true.hpp"
#include "passes/analyses/object_lanes.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace rddlc::passes {
namespace {

// In operations (Properties::cost): what packs may compute for all lanes though no lane needs it.
constexpr double most_without_jumps = 128;
// C++ compilers take time to look through longer tables.
constexpr std::int64_t most_chances = 4096;

// ----------------------------------------------------------------- loads of several objects

class Gathering {
  public:
    Gathering(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        for (ir::Definition& definition : program_.step) gather_in(definition.body);
        gather_in(program_.reward.body);
        quantify_in(program_.reward.value, false);
        for (auto* conditions :
             {&program_.preconditions, &program_.invariants, &program_.terminations})
            for (ir::Computation& condition : *conditions) {
                ir::change_roots(condition.body, [&](ir::NodeId& id) { quantify_in(id, true); });
                quantify_in(condition.value, true);
            }
        return ir::collect_garbage(std::move(program_));
    }

  private:
    void gather_in(ir::Block& block) {
        for (ir::Statement& statement : block) {
            auto* const loop = std::get_if<ir::Loop>(&statement.form);
            if (auto* store = std::get_if<ir::Store>(&statement.form))
                quantify_in(store->value, false);
            if (auto* let = std::get_if<ir::Let>(&statement.form)) quantify_in(let->value, false);
            if (!loop) continue;
            if (!loop->several_at_once) {
                gather_in(loop->body);
                continue;
            }
            const ir::Nest nest = ir::nest_of(*loop);
            std::map<ir::NodeId, ir::NodeId> known;
            are_words_ = loop->as_words;
            ir::change_roots(ir::innermost_body(*loop), [&](ir::NodeId& id) {
                if (!std::holds_alternative<ir::Index>(program_[id].form))
                    id = gathered(id, nest, known);
            });
        }
    }

    void quantify_in(ir::NodeId& id, bool is_condition) {
        std::map<ir::NodeId, ir::NodeId> known;
        id = ir::replace_in(builder_, id, known,
                            [&](ir::NodeId each) { return quantified(each, is_condition); });
    }

    // An exists or forall that tests several objects at once. Common rows are looked at as words.
    // In a step the first object often decides, so elements that lie apart are not worth reading
    // there.
    std::optional<ir::NodeId> quantified(ir::NodeId id, bool is_condition) {
        const auto* reduce = std::get_if<ir::Reduce>(&program_[id].form);
        if (reduce && reduce->several_at_once) return id;
        const auto nest = ir::reduction_nest(program_, id);
        if (!nest || !is_quantifier(nest->op) || ir::common_rows(program_, *reduce))
            return std::nullopt;
        const ir::Nest objects{nest->variables, nullptr};
        const ObjectLanes several(builder_, objects);
        if (!several.are_enough(ir::Scalar::Real) || !several.can_evaluate(nest->body) ||
            !ir::is_droppable(builder_.properties(nest->body)) ||
            (!is_condition && chooses_elements(nest->body, objects)))
            return std::nullopt;
        ++report_["quantifiers over several objects at once"];
        std::map<ir::NodeId, ir::NodeId> known;
        const ir::NodeId body = gathered(nest->body, objects, known);
        const std::span<const ir::VariableId> variables = nest->variables;
        return builder_.reduce(nest->op, variables.front(),
                               ir::reduced(builder_, nest->op, variables.subspan(1), body), {},
                               false, true);
    }
    // Whether objects read elements that do not lie side by side.
    bool chooses_elements(ir::NodeId id, const ir::Nest& nest) const {
        return ir::any_node_of(program_, id, [&](ir::NodeId each) {
            const auto* load = std::get_if<ir::Load>(&program_[each].form);
            return load && ir::depends_on_any(builder_.properties(each), nest.variables) &&
                   !ir::ends_with(program_, load->indices, nest);
        });
    }

    ir::NodeId gathered(ir::NodeId id, const ir::Nest& nest,
                        std::map<ir::NodeId, ir::NodeId>& known) {
        return ir::replace_in(
            builder_, id, known, [&](ir::NodeId each) -> std::optional<ir::NodeId> {
                if (const auto* sample = std::get_if<ir::Sample>(&program_[each].form))
                    return drawn(each, *sample, nest, known);
                if (const auto* apply = std::get_if<ir::Apply>(&program_[each].form))
                    return are_words_ ? drawn_if_open(each, apply->op, nest, known) : std::nullopt;
                const auto* load = std::get_if<ir::Load>(&program_[each].form);
                if (!load || load->gather != ir::Gather::None) return std::nullopt;
                const ir::Gather gather = gather_of(*load, nest);
                if (gather == ir::Gather::None) return each;
                ++report_["loads of several objects"];
                const ir::BufferId buffer = load->buffer;
                std::vector<ir::NodeId> indices = load->indices;
                for (ir::NodeId& index : indices) index = gathered(index, nest, known);
                return builder_.load(buffer, std::move(indices), gather);
            });
    }

    // A condition whose draws are made for the objects for which the rest does not decide it.
    std::optional<ir::NodeId> drawn_if_open(ir::NodeId id, Operator op, const ir::Nest& nest,
                                            std::map<ir::NodeId, ir::NodeId>& known) {
        if (op != Operator::And && op != Operator::Or) return std::nullopt;
        std::vector<ir::NodeId> parts = ir::parts_of(program_, id, op);
        const auto is_random = [&](ir::NodeId part) {
            return builder_.properties(part).random;
        };
        const auto draws =
            std::stable_partition(parts.begin(), parts.end(), std::not_fn(is_random));
        if (draws == parts.begin() || draws == parts.end()) return std::nullopt;
        ++report_["draws that wait for the rest of their condition"];
        const ir::NodeId test = ir::joined(builder_, op, std::span(parts.begin(), draws));
        const ir::NodeId rest = ir::joined(builder_, op, std::span(draws, parts.end()));
        const ir::NodeId condition = gathered(test, nest, known);
        const ir::NodeId drawn = gathered(rest, nest, known);
        const ir::NodeId decided = builder_.constant(op == Operator::Or);
        return op == Operator::Or ? builder_.select(condition, decided, drawn)
                                  : builder_.select(condition, drawn, decided);
    }

    // A draw whose probabilities become chances.
    std::optional<ir::NodeId> drawn(ir::NodeId id, ir::Sample sample, const ir::Nest& nest,
                                    std::map<ir::NodeId, ir::NodeId>& known) {
        if (sample.distribution != Distribution::Bernoulli) return std::nullopt;
        const ir::NodeId p = sample.parameters.front();
        const auto chances =
            are_words_ ? chances_of_table(p, nest) : chances_of_one_of_two(p, nest, known);
        if (!chances) return std::nullopt;
        return builder_.sample(program_[id].type, sample.distribution, sample.place, {*chances});
    }
    std::optional<ir::NodeId> chances_of_table(ir::NodeId id, const ir::Nest& nest) {
        const auto* load = std::get_if<ir::Load>(&program_[id].form);
        if (!load || !are_chances(*load, nest) || are_all_random(*load)) return std::nullopt;
        ++report_["draws that are known where they are certain"];
        return chances_of(*load);
    }
    std::optional<ir::NodeId> chances_of_one_of_two(ir::NodeId id, const ir::Nest& nest,
                                                    std::map<ir::NodeId, ir::NodeId>& known) {
        const auto* found = std::get_if<ir::Select>(&program_[id].form);
        if (!found) return std::nullopt;
        const ir::Select select = *found;  // new nodes move the others
        const auto* first = std::get_if<ir::Load>(&program_[select.then_value].form);
        const auto* second = std::get_if<ir::Load>(&program_[select.else_value].form);
        if (!first || !second || !are_chances(*first, nest) || !are_chances(*second, nest))
            return std::nullopt;
        ++report_["draws by one of two tables"];
        const ir::Load other = *second;
        const ir::NodeId yes = chances_of(*first), no = chances_of(other);
        return builder_.select(gathered(select.condition, nest, known), yes, no);
    }
    ir::NodeId chances_of(ir::Load load) {
        return builder_.load(load.buffer, std::move(load.indices), ir::Gather::Chances);
    }
    bool are_chances(const ir::Load& load, const ir::Nest& nest) const {
        const ir::Buffer& table = program_[load.buffer];
        const auto is_probability = [](const ir::Value& p) {
            return std::get<double>(p) >= 0 && std::get<double>(p) <= 1;
        };
        return load.gather == ir::Gather::None && is_constant(load.buffer) &&
               ir::are_variables_of(program_, load.indices, nest) &&
               table.count() <= most_chances && table.values.all_of(is_probability);
    }
    bool are_all_random(const ir::Load& load) const {
        return program_[load.buffer].values.all_of(
            [](const ir::Value& p) { return std::get<double>(p) > 0 && std::get<double>(p) < 1; });
    }

    ir::Gather gather_of(const ir::Load& load, const ir::Nest& nest) const {
        if (are_rows(load, nest)) return ir::Gather::Rows;
        if (ir::begins_with(program_, load.indices, nest)) return ir::Gather::Adjacent;
        const auto are_same = [&](std::span<const ir::NodeId> indices) {
            return std::ranges::all_of(indices, [&](ir::NodeId index) {
                return ir::is_same_for_all(builder_.properties(index), nest);
            });
        };
        const auto is_of_object = [&](ir::NodeId index) {
            return ir::depends_on_any(builder_.properties(index), nest.variables);
        };
        const std::span<const ir::NodeId> indices = load.indices;
        // A word takes one bool for all of its objects, though environments may differ in it.
        const bool is_one_bool = are_words_ && std::ranges::none_of(indices, is_of_object);
        if (are_same(indices) || is_one_bool) return ir::Gather::None;
        const bool is_in_row = ir::ends_with(program_, load.indices, nest) &&
                               are_same(indices.first(indices.size() - nest.variables.size()));
        return is_in_row ? ir::Gather::InRow : ir::Gather::Own;
    }

    bool are_rows(const ir::Load& load, const ir::Nest& nest) const {
        if (load.indices.size() != 2 || !is_constant(load.buffer) ||
            program_[load.buffer].scalar != ir::Scalar::Real)
            return false;
        const auto are_objects = [&](const std::vector<ir::NodeId>& indices) {
            return ir::are_variables_of(program_, indices, nest);
        };
        const auto* kind = std::get_if<ir::Load>(&program_[load.indices[0]].form);
        return are_objects({load.indices[0]}) ||
               (kind && is_constant(kind->buffer) && are_objects(kind->indices));
    }
    bool is_constant(ir::BufferId id) const {
        return program_[id].storage == ir::Storage::Constant;
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    bool are_words_ = false;  // the values of the loop
};

// -------------------------------------------------------------------------------- choices

class Choices {
  public:
    explicit Choices(const ir::Program& program)
        : program_(program), properties_(ir::all_properties(program)) {}

    // The C++ compiler sees by itself that a number in the text is a probability.
    bool is_valid(const ir::Sample& sample) const {
        if (sample.distribution != Distribution::Bernoulli) return false;
        const ir::NodeId p = sample.parameters.front();
        return !std::holds_alternative<ir::Constant>(program_[p].form) &&
               always_in_domain(sample.distribution, std::array{of(p).range});
    }

    bool skips_int(const ir::Convert& convert, ir::Scalar type) const {
        const auto* apply = std::get_if<ir::Apply>(&program_[convert.operand].form);
        return apply && type == ir::Scalar::Real && typing_of(apply->op) == Typing::Rounding;
    }

    bool over_true(const ir::Reduce& reduce) const {
        const ir::Load* const table = ir::table_of_bools(program_, reduce);
        return ir::row_of_bools(program_, reduce) ||
               (table && begins_with_few_true(program_[table->buffer], least_per_visit));
    }

    ir::Evaluated evaluated(const ir::Select& select) const {
        if (select.evaluated == ir::Evaluated::MostlyFirst ||
            select.evaluated == ir::Evaluated::Jump)
            return select.evaluated;
        if (!is_lazy(select)) return ir::Evaluated::Both;
        return is_harmless(select) ? ir::Evaluated::PackBoth : ir::Evaluated::Branch;
    }

  private:
    // A chain of else-ifs is evaluated as one: all but its first condition are in branches.
    bool is_harmless(const ir::Select& first) const {
        double cost = 0;
        const auto add = [&](ir::NodeId id) {
            cost += of(id).cost;
            // Lanes that jump one after the other take less time than elementary functions.
            return ir::is_droppable(of(id)) && !of(id).elementary;
        };
        const ir::Select* last = &first;
        for (bool is_first = true; last; is_first = false) {
            if ((!is_first && !add(last->condition)) || !add(last->then_value)) return false;
            const auto* next = std::get_if<ir::Select>(&program_[last->else_value].form);
            if (!next || !is_lazy(*next)) break;
            last = next;
        }
        return add(last->else_value) && cost <= most_without_jumps;
    }
    bool is_lazy(const ir::Select& select) const {
        return ir::is_lazy(program_, select, of(select.then_value), of(select.else_value));
    }
    const ir::Properties& of(ir::NodeId id) const { return properties_[id.index]; }

    const ir::Program& program_;
    std::vector<ir::Properties> properties_;
};

}  // namespace

ir::Program choose_evaluation(ir::Program program, Report& report) {
    program = Gathering(std::move(program), report).run();
    const Choices choices(program);
    const auto choose = [&](auto& choice, auto chosen, const char* what) {
        report[what] += std::exchange(choice, chosen) != chosen;
    };
    for (ir::Node& node : program.nodes) {
        if (auto* select = std::get_if<ir::Select>(&node.form))
            choose(select->evaluated, choices.evaluated(*select), "selects without jumps");
        if (auto* sample = std::get_if<ir::Sample>(&node.form))
            choose(sample->is_valid, choices.is_valid(*sample), "draws without a check");
        if (auto* reduce = std::get_if<ir::Reduce>(&node.form))
            choose(reduce->over_true, choices.over_true(*reduce), "sums over true elements");
        if (auto* convert = std::get_if<ir::Convert>(&node.form))
            choose(convert->skips_int, choices.skips_int(*convert, node.type),
                   "rounded reals without an int");
    }
    return program;
}

}  // namespace rddlc::passes
