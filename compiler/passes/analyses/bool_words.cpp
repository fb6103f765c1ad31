#include "passes/analyses/bool_words.hpp"

#include "support/match.hpp"

#include <algorithm>
#include <vector>

namespace rddlc::passes {
namespace {

constexpr std::int64_t few_objects = 16;
// Terms that are the same for all objects take longer to get into a register than as masks, and
// rows of more than 16 bytes are loaded in parts.
constexpr std::int64_t fewest_objects_of_row = 5, most_objects_of_row = 16;

// Depends on which object it is, or on something that a statement of the loop names.
bool differs(const ir::Program& program, ir::NodeId id, const ir::Nest& nest) {
    return ir::any_node_of(program, id, [&](ir::NodeId each) {
        const auto* index = std::get_if<ir::Index>(&program[each].form);
        return std::holds_alternative<ir::Local>(program[each].form) ||
               (index &&
                std::ranges::find(nest.variables, index->variable) != nest.variables.end());
    });
}

// Is the same for all objects, and in all environments: a register holds elements of one row.
bool is_row_index(const ir::Program& program, ir::NodeId id, const ir::Nest& nest) {
    return !differs(program, id, nest) && !ir::any_node_of(program, id, [&](ir::NodeId each) {
        const auto buffer = ir::buffer_read_by(program[each]);
        return buffer && program[*buffer].storage != ir::Storage::Constant;
    });
}

// Is known to be a probability: a constant, or the element of a table of constants that has the
// place of its object.
bool is_constant_probability(const ir::Program& program, ir::NodeId id, const ir::Nest& nest) {
    const auto is_probability = [](const ir::Value& value) {
        const double p = std::get<double>(value);
        return p >= 0 && p <= 1;
    };
    if (const auto* constant = std::get_if<ir::Constant>(&program[id].form))
        return is_probability(constant->value);
    const auto* load = std::get_if<ir::Load>(&program[id].form);
    return load && program[load->buffer].storage == ir::Storage::Constant &&
           ir::are_variables_of(program, load->indices, nest) &&
           program[load->buffer].values.all_of(is_probability);
}

template <class Form>
bool has(const ir::Program& program, const ir::Block& body) {
    return std::ranges::any_of(ir::roots_of(body),
                               [&](ir::NodeId root) { return ir::contains<Form>(program, root); });
}

}  // namespace

bool are_many(const ir::Program& program, const ir::Nest& nest) {
    return ir::combinations(program, nest.variables) > few_objects;
}

bool fill_a_row(const ir::Program& program, const ir::Nest& nest) {
    const std::int64_t objects = ir::combinations(program, nest.variables);
    return objects >= fewest_objects_of_row && objects <= most_objects_of_row;
}

bool is_of_bools(const ir::Program& program, ir::NodeId id, const ir::Nest& nest,
                 const std::function<bool(ir::NodeId)>& is_element) {
    const auto are_of_bools = [&](const std::vector<ir::NodeId>& ids) {
        return std::ranges::all_of(
            ids, [&](ir::NodeId each) { return is_of_bools(program, each, nest, is_element); });
    };
    if (is_element && is_element(id)) return true;
    const ir::Node& node = program[id];
    if (node.type != ir::Scalar::Bool) return false;
    if (!differs(program, id, nest)) return true;
    return match(
        node.form,
        [&](const ir::Load& load) {
            const auto outer = load.indices.size() - nest.variables.size();
            return ir::ends_with(program, load.indices, nest) &&
                   std::all_of(
                       load.indices.begin(), load.indices.begin() + outer,
                       [&](ir::NodeId index) { return is_row_index(program, index, nest); });
        },
        [](const ir::Element&) { return true; }, [](const ir::Local&) { return true; },
        [&](const ir::Apply& apply) { return are_of_bools(apply.operands); },
        [&](const ir::Select& select) {
            return are_of_bools({select.condition, select.then_value, select.else_value});
        },
        [&](const ir::Sample& sample) {
            return sample.distribution == Distribution::Bernoulli &&
                   ir::is_place_in(program, nest, sample.place.index) &&
                   is_constant_probability(program, sample.parameters.front(), nest);
        },
        [&](const ir::Reduce& reduce) {
            return is_quantifier(reduce.op) && !reduce.bounds && are_of_bools({reduce.body});
        },
        [](const auto&) { return false; });
}

bool is_of_words(const ir::Program& program, const ir::Loop& loop) {
    const ir::Nest nest = ir::nest_of(loop);
    // Draws beside a quantifier are better made for the objects that an action chooses.
    if (has<ir::Reduce>(program, *nest.body) &&
        (has<ir::Sample>(program, *nest.body) || !fill_a_row(program, nest)))
        return false;
    return std::ranges::all_of(*nest.body, [&](const ir::Statement& statement) {
        const auto* let = std::get_if<ir::Let>(&statement.form);
        const auto* store = std::get_if<ir::Store>(&statement.form);
        return (let && is_of_bools(program, let->value, nest)) ||
               (store && is_of_bools(program, store->value, nest));
    });
}

}  // namespace rddlc::passes
