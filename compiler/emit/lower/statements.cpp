// Over 400 lines: a function for each kind of statement, and for each reason to name a part.
#include "emit/lower/statements.hpp"

#include "emit/cpp/literals.hpp"
#include "emit/cpp/print.hpp"
#include "emit/lower/operators.hpp"
#include "ir/shared_in_cases.hpp"
#include "ir/shifted_row.hpp"
#include "ir/visits.hpp"
#include "support/match.hpp"

#include <rddl/values/few_objects.hpp>

#include <algorithm>
#include <optional>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace rddlc::cpp {
namespace {

// Longer conditions get a name.
constexpr std::size_t longest_condition = 45;
// Longer operands of a chain get a name of their own instead of a line of their own.
constexpr std::size_t longest_operand = 75;
// Shorter texts are not worth a name.
constexpr std::size_t shortest_named = 12;
// Parts that are longer are not compared.
constexpr std::size_t longest_compared = 2000;
constexpr std::size_t operator_and_brackets = 4;  // of an operand in a chain
constexpr std::size_t assignment_width = 3;       // " = "
// An expression with more calls with lambdas inside is taken to pieces first.
constexpr std::size_t most_lambda_calls = 64;
// A small register (rddl::bytes_of_few) has a byte for each.
constexpr std::int64_t most_objects_in_bytes = 16;

// The table that the only statement of a nest fills.
ir::BufferId only_target(const ir::Nest& nest) {
    return ir::only_statement<ir::Store>(*nest.body)->target;
}

// Whether few objects of a loop over bools are a row: registers have it, unless the bools are
// drawn.
bool are_row(const ir::Program& program, const ir::Nest& nest) {
    const auto draws = [&](ir::NodeId id) {
        return std::holds_alternative<ir::Sample>(program[id].form);
    };
    return ir::combinations(program, nest.variables) <= most_objects_in_bytes &&
           std::ranges::none_of(ir::roots_of(*nest.body), [&](ir::NodeId root) {
               return ir::any_node_of(program, root, draws);
           });
}

// The terms of a loop over several objects that finds whether one of them, or all, are true
// (passes/lanes/quantify_together.hpp); null if it fills a table.
const ir::Apply* quantified(const ir::Program& program, const ir::Nest& nest) {
    const auto* store = std::get_if<ir::Store>(&nest.body->back().form);
    if (!store || !store->indices.empty()) return nullptr;
    const auto* apply = std::get_if<ir::Apply>(&program[store->value].form);
    if (!apply || (apply->op != Operator::Or && apply->op != Operator::And) ||
        ir::buffer_read_by(program[apply->operands.front()]) != store->target)
        throw std::logic_error(
            "a loop over several objects stores one value, and does not quantify");
    return apply;
}

// Whether the first statement stores what the second one, a loop that quantifies, finds in no
// objects: false for an exists, true for a forall.
bool stores_start(const ir::Program& program, const ir::Statement& first,
                  const ir::Statement& second) {
    const auto* start = std::get_if<ir::Store>(&first.form);
    const auto* loop = std::get_if<ir::Loop>(&second.form);
    if (!start || !loop || !loop->several_at_once) return false;
    const ir::Nest nest = ir::nest_of(*loop);
    const ir::Apply* const found = quantified(program, nest);
    return found && std::get<ir::Store>(nest.body->back().form).target == start->target &&
           ir::constant<bool>(program, start->value) == (found->op == Operator::And);
}

// Bools and ints of a step gain nothing in half a register, and neither do draws but normals.
bool is_of_reals(const ir::Program& program, ir::NodeId root) {
    return !ir::any_node_of(program, root, [&](ir::NodeId id) {
        const ir::Node& node = program[id];
        const auto buffer = ir::buffer_read_by(node);
        if (buffer && program[*buffer].storage != ir::Storage::Constant)
            return program[*buffer].scalar != ir::Scalar::Real;
        const auto* sample = std::get_if<ir::Sample>(&node.form);
        return (sample && sample->distribution != Distribution::Normal) ||
               std::holds_alternative<ir::DiscreteOver>(node.form) ||
               std::holds_alternative<ir::Interval>(node.form);
    });
}
// Whether the loop fills tables of reals alone, for so few objects that half a register has them.
bool fills_few_reals(const ir::Program& program, const ir::Nest& nest) {
    if (ir::combinations(program, nest.variables) > rddl::most_few_reals) return false;
    const auto is_of_ints = [&](const ir::Statement& statement) {
        const auto* store = std::get_if<ir::Store>(&statement.form);
        return store && program[store->target].scalar != ir::Scalar::Real;
    };
    return std::ranges::none_of(*nest.body, is_of_ints) &&
           std::ranges::all_of(ir::values_of(*nest.body),
                               [&](ir::NodeId value) { return is_of_reals(program, value); });
}

bool is_binder(const ir::Node& node) {
    return ir::bound_variable(node).has_value();
}

// Spelled by names alone; other elements than those at loop indices take a call.
bool is_leaf(const Unit& unit, ir::NodeId id) {
    const auto is_uniform = [&](ir::NodeId index) {
        return unit.is_uniform(index);
    };
    return match(
        unit.program[id].form, [](const ir::Constant&) { return true; },
        [](const ir::Index&) { return true; }, [](const ir::Local&) { return true; },
        [&](const ir::Load& load) { return std::ranges::all_of(load.indices, is_uniform); },
        [](const auto&) { return false; });
}

// The first of the operators that may follow each other in one chain; none: it makes no chains.
std::optional<Operator> chain_operator(const ir::Node& node) {
    const auto* apply = std::get_if<ir::Apply>(&node.form);
    if (!apply || apply->operands.size() != 2 || node.type == ir::Scalar::Int) return std::nullopt;
    if (apply->op == Operator::Subtract) return Operator::Add;
    if (apply->op == Operator::Divide) return Operator::Multiply;
    const bool makes_chains =
        is_one_of(apply->op, {Operator::Add, Operator::Multiply, Operator::And, Operator::Or,
                              Operator::Equal, Operator::NotEqual});
    return makes_chains ? std::optional(apply->op) : std::nullopt;
}

// The wish for the name of a value that is read from a record: that of the fluent.
std::optional<std::string> name_in_record(const ir::Program& program, ir::NodeId id) {
    const ir::Node& node = program[id];
    if (const auto* apply = std::get_if<ir::Apply>(&node.form)) {
        if (apply->op != Operator::Not) return std::nullopt;
        const auto negated = name_in_record(program, apply->operands.front());
        return negated ? std::optional("not_" + *negated) : std::nullopt;
    }
    const auto buffer = ir::buffer_read_by(node);
    if (!buffer || program[*buffer].storage == ir::Storage::Constant) return std::nullopt;
    const bool is_value = std::holds_alternative<ir::Load>(node.form) ||
                          std::holds_alternative<ir::Element>(node.form) ||
                          std::holds_alternative<ir::Bits>(node.form);
    return is_value ? std::optional(program[*buffer].name) : std::nullopt;
}

// The wish for the name of another value.
std::string_view wish_for(const ir::Node& node) {
    if (const auto* reduce = std::get_if<ir::Reduce>(&node.form)) {
        switch (reduce->op) {
            case Reduction::Sum:
                return "total";
            case Reduction::Product:
                return "product";
            case Reduction::Minimum:
                return "least";
            case Reduction::Maximum:
                return "greatest";
            case Reduction::ForAll:
                return "all";
            case Reduction::Exists:
                return "any";
            case Reduction::Average:
            case Reduction::ArgMin:
            case Reduction::ArgMax:
                return "best";
        }
    }
    if (std::holds_alternative<ir::Union>(node.form)) return "bits";
    const auto* apply = std::get_if<ir::Apply>(&node.form);
    if (apply && apply->op == Operator::CountOnes) return "count";
    if (apply && apply->op >= Operator::BitAnd && apply->op <= Operator::ShiftRight) return "bits";
    const bool draws = std::holds_alternative<ir::Sample>(node.form) ||
                       std::holds_alternative<ir::Discrete>(node.form) ||
                       std::holds_alternative<ir::DiscreteOver>(node.form) ||
                       std::holds_alternative<ir::Interval>(node.form);
    if (draws) return "draw";
    switch (node.type) {
        case ir::Scalar::Bool:
            return "condition";
        case ir::Scalar::Int:
            return "number";
        case ir::Scalar::Real:
            break;
    }
    return "term";
}

std::string wish_for(const ir::Program& program, ir::NodeId id) {
    return name_in_record(program, id).value_or(std::string(wish_for(program[id])));
}

// Whether the statements are visits that one function makes.
bool take_turns(const ir::Program& program, const ir::Statement& first,
                const ir::Statement& second) {
    const auto* a = std::get_if<ir::Visit>(&first.form);
    const auto* b = std::get_if<ir::Visit>(&second.form);
    return a && b && ir::may_take_turns(program, *a, *b);
}

}  // namespace

// --------------------------------------------------------------------------- statements

void FunctionBody::block(const ir::Block& block) {
    for (std::size_t k = 0; k < block.size(); ++k) {
        const ir::Statement* const next = k + 1 < block.size() ? &block[k + 1] : nullptr;
        if (next && stores_start(program(), block[k], *next)) {
            over_several_objects(std::get<ir::Loop>(next->form), true);
            ++k;
        } else if (next && take_turns(program(), block[k], *next)) {
            visits({&std::get<ir::Visit>(block[k].form), &std::get<ir::Visit>(next->form)});
            ++k;
        } else
            match(block[k].form, [&](const auto& form) { statement(form); });
    }
}

// if (rddl::keep_unchosen(next.seen, state.seen, action.use)) return;
// if (rddl::keep_unchosen(rddl::tables(next.seen, next.lost), rddl::tables(state.seen, state.lost),
//                         action.use)) return;
// if (rddl::is_unchosen(action.use)) return;
void FunctionBody::keep_unchosen(std::span<const ir::Definition> definitions) {
    tree::Expressions next, state;
    for (const ir::Definition& definition : definitions) {
        if (!definition.unchosen->kept) continue;
        next.push_back(expressions_.target(definition.target, {}));
        state.push_back(expressions_.record(*definition.unchosen->kept));
    }
    const auto one_or_all = [](tree::Expressions tables) {
        return tables.size() == 1 ? std::move(tables.front())
                                  : tree::call("rddl::tables", std::move(tables));
    };
    const bool keeps = !next.empty();
    tree::Expressions arguments;
    if (keeps) arguments = tree::list(one_or_all(std::move(next)), one_or_all(std::move(state)));
    append(arguments, tables(definitions.front().unchosen->choices));
    const char* const test = keeps ? "rddl::keep_unchosen" : "rddl::is_unchosen";
    statements_.push_back(
        {tree::If{tree::call(test, std::move(arguments)), tree::Statement{tree::word("return")}}});
}

tree::Expressions FunctionBody::tables(const std::vector<ir::BufferId>& buffers) {
    tree::Expressions result;
    for (const ir::BufferId buffer : buffers) result.push_back(expressions_.record(buffer));
    return result;
}

void FunctionBody::return_value(ir::NodeId id) {
    const Use use{std::string_view("return ").size(), true};
    prepare(use, id);
    statements_.push_back({tree::Return{value(use, id)}});
}

void FunctionBody::statement(const ir::Let& let) {
    expressions_.name(let.local, declare(let.value));
}

void FunctionBody::statement(const ir::Store& store) {
    const auto before = expressions_.mark();
    tree::Expression target = expressions_.target(store.target, store.indices);
    const Use use{width(target) + assignment_width};
    prepare(use, store.value);
    statements_.push_back({tree::Assign{std::move(target), value(use, store.value)}});
    // Values that were named on the way may change with the next store; their names stay taken.
    expressions_.forget(before);
}

// rddl::shift<time_count>(context, state.flow, state.flow_buffer, next.flow, next.flow_buffer);
void FunctionBody::shift(const ir::Loop& loop) {
    const ir::ShiftedRow row = ir::shifted_row(program(), loop).value();
    const std::string size = expressions_.unit().size_of(program()[loop.variable]);
    expressions_.uses().context = true;
    tree::Expressions arguments = {tree::word(expressions_.context())};
    append(arguments, expressions_.with_sliding_buffer(row.from));
    append(arguments, expressions_.with_sliding_buffer(row.target));
    statements_.push_back({tree::call("rddl::shift<" + size + ">", std::move(arguments))});
}

// rddl::add_to_row(rddl::window(next.flow, next.flow_buffer)[u], next.flow_buffer,
//                  rddl::Added<Int, Real>{scratch.due[u], scratch.in[u]});
void FunctionBody::add_to_row(const ir::Loop& loop) {
    const auto before = expressions_.mark();
    const ir::ShiftedRow row = ir::shifted_row(program(), loop).value();
    const std::string type = "rddl::Added<" + expressions_.type(ir::Scalar::Int) + ", " +
                             expressions_.type(ir::Scalar::Real) + ">";
    tree::Expressions arguments = {expressions_.target(row.target, row.indices),
                                   expressions_.sliding_buffer(row.target)};
    const Use use{type.size()};
    for (const ir::PlacedTerm& each : row.terms) {
        prepare(use, each.value);
        tree::Expression place = value(use, each.value);
        if (each.first != 0)
            place = tree::call("rddl::wrap_sub",
                               tree::list(std::move(place), tree::number(each.first)));
        prepare(use, each.term);
        arguments.push_back(
            tree::braces(type, tree::list(std::move(place), value(use, each.term))));
    }
    statements_.push_back({tree::call("rddl::add_to_row", std::move(arguments))});
    expressions_.forget(before);
}

void FunctionBody::statement(const ir::Loop& loop) {
    if (loop.shifts) return add_to_row(loop);
    if (loop.several_at_once) return over_several_objects(loop);
    const auto before = expressions_.mark();
    const std::string name = expressions_.enter(loop.variable);
    const std::string size = expressions_.unit().size_of(program()[loop.variable]);
    statements_.push_back({tree::For{name, size, inner(1, [&] { block(loop.body); })}});
    expressions_.return_to(before);
}

// rddl::for_each_object<computer_count>(context, [&](auto& several, auto x) { ... });
// rddl::for_few_objects<rod_count>(context, [&](auto& several, auto x) { ... });
// rddl::for_few_reals<joint_count>(context, [&](auto& several, auto x) { ... });
// rddl::for_affected_objects<cell_count>(context, state.at, at_affects_rows_, at_affects_, next.at,
//                                        [&](auto& several, auto c) { ... });
// rddl::for_chosen_objects<course_count>(context, action.take, state.passed, next.passed,
//                                        [&](auto& several, auto c) { ... });
// rddl::for_chosen_objects<tank_count>(context, action.fill, scratch.fills,
//                                      [&](auto& several, auto t) { ... });
// rddl::for_many_objects<cell_count>(context, [&](auto& several, auto c) { ... });
// rddl::for_rows_of_bools<cell_count>(context, [&](auto& several, auto c) { ... });
// scratch.on_exists = rddl::exists_object<n>(context, [&](auto& several, auto x) { ... });
void FunctionBody::over_several_objects(const ir::Loop& loop, bool is_from_start) {
    const auto before = expressions_.mark();
    const ir::Nest nest = ir::nest_of(loop);
    const auto [context, objects] = expressions_.enter(nest);
    const std::string count = expressions_.count_of(nest.variables);

    const tree::Expressions numbers =
        loop.clearances ? numbers_near(*loop.clearances) : tree::Expressions{};
    // Whether the context has a name is known when the body is.
    expressions_.uses().context = false;
    const ir::Apply* const found = quantified(program(), nest);
    tree::Block body = inner(1, [&, innermost = nest.body] {
        if (!found) return block(*innermost);
        block({innermost->begin(), innermost->end() - 1});
        return_value(found->operands.back());
    });
    const bool has_context = std::exchange(expressions_.uses().context, true);
    tree::Expressions parameters = {Expressions::context_parameter(has_context, context),
                                    {tree::Declared{"auto", objects}}};
    tree::append(parameters, numbers);
    tree::Expression lambda{tree::Lambda{std::move(parameters), std::move(body)}};
    const bool is_unrolled = expressions_.looks_at_few_bits() &&
                             ir::combinations(program(), nest.variables) <= rddl::most_few_objects;
    const bool are_rows = loop.as_words && are_row(program(), nest);
    expressions_.leave_nest();
    expressions_.return_to(before);
    if (loop.affected) {
        const auto& [few, rows, affected, moves] = *loop.affected;
        const std::string its_context = moves ? expressions_.claim("apart") : "context";
        tree::Expression all =
            tree::call("rddl::for_affected_objects<" + count + ">",
                       tree::list(tree::word(its_context), expressions_.record(few),
                                  expressions_.record(rows), expressions_.record(affected),
                                  expressions_.record(only_target(nest)), std::move(lambda)));
        statements_.push_back(
            {moves ? or_move(loop, its_context, std::move(all)) : std::move(all)});
    } else if (loop.chosen) {
        tree::Expressions arguments =
            tree::list(tree::word("context"), expressions_.record(loop.chosen->few));
        if (loop.chosen->kept) arguments.push_back(expressions_.record(*loop.chosen->kept));
        arguments.push_back(expressions_.record(only_target(nest)));
        arguments.push_back(std::move(lambda));
        statements_.push_back(
            {tree::call("rddl::for_chosen_objects<" + count + ">", std::move(arguments))});
    } else if (found) {
        const std::string function =
            found->op == Operator::Or ? "rddl::exists_object<" : "rddl::for_all_objects<";
        const ir::BufferId target = std::get<ir::Store>(nest.body->back().form).target;
        tree::Expression result =
            loop.clearances ? near_object(*loop.clearances, count, std::move(lambda))
                            : tree::call(function + count + ">",
                                         tree::list(tree::word("context"), std::move(lambda)));
        if (!is_from_start)
            result = tree::operation(plain_operator(found->op),
                                     {expressions_.record(target), std::move(result)});
        statements_.push_back({tree::Assign{expressions_.target(target, {}), std::move(result)}});
    } else {
        const std::string function = are_rows                           ? "rddl::for_rows_of_bools<"
                                     : loop.as_words                    ? "rddl::for_many_objects<"
                                     : is_unrolled                      ? "rddl::for_few_objects<"
                                     : fills_few_reals(program(), nest) ? "rddl::for_few_reals<"
                                                                        : "rddl::for_each_object<";
        statements_.push_back({tree::call(function + count + ">",
                                          tree::list(tree::word("context"), std::move(lambda)))});
    }
}

// rddl::move_only_true<at_moves_>(
//     context, state.at, rddl::tables(action.north, action.south), next.at,
//     [&](auto& several, auto c) { return rddl::sample::valid_bernoulli(several, {0, c}, ...); },
//     [&](auto& apart) { rddl::for_affected_objects<cell_count>(apart, ...); });
tree::Expression FunctionBody::or_move(const ir::Loop& loop, const std::string& context_of_loop,
                                       tree::Expression loop_of_affected) {
    const ir::Moves& moves = *loop.affected->moves;
    const auto before = expressions_.mark();
    const ir::Nest nest = ir::nest_of(loop);
    const ir::BufferId target = only_target(nest);
    const auto draw =
        ir::only_bernoulli(program(), ir::only_statement<ir::Store>(*nest.body)->value);
    const auto [context, objects] = expressions_.enter(nest);
    tree::Expression drawing{
        tree::Lambda{{{tree::Declared{"auto&", context}}, {tree::Declared{"auto", objects}}},
                     inner(1, [&] { return_value(*draw); })}};
    expressions_.leave_nest();
    expressions_.return_to(before);
    tree::Block body;
    body.push_back({std::move(loop_of_affected)});
    tree::Expression otherwise{
        tree::Lambda{{{tree::Declared{"auto&", context_of_loop}}}, std::move(body)}};
    return tree::call(
        "rddl::move_only_true<" + expressions_.unit().names.buffers[moves.table.index] + ">",
        tree::list(tree::word("context"), expressions_.record(loop.affected->few),
                   tree::call("rddl::tables", tables(moves.choices)), expressions_.record(target),
                   std::move(drawing), std::move(otherwise)));
}

// The parameters of a body that one environment of a pack may run: places and moves get names.
tree::Expressions FunctionBody::numbers_near(const ir::Clearances& clearances) {
    tree::Expressions parameters;
    for (const auto* const buffers : {&clearances.places, &clearances.moves})
        for (const ir::BufferId buffer : *buffers) {
            const std::string name = expressions_.claim(program()[buffer].name);
            const ir::Load load{buffer, {}};
            for (std::uint32_t i = 0; i < program().nodes.size(); ++i)
                if (const auto* each = std::get_if<ir::Load>(&program().nodes[i].form);
                    each && *each == load)
                    expressions_.name(ir::NodeId{i}, name);
            parameters.push_back({tree::Declared{"auto", name}});
        }
    return parameters;
}

// const rddl::Grid<2> grid{{0.0, 0.0}, {32.0, 32.0}, 0.001, 1e-09};
// const std::array places{state.x, state.y};
// const std::array moves{scratch.dx, scratch.dy};
// ... rddl::exists_near_object<wall_count, clearances_>(
//         context, grid, places, moves, [&](auto& several, auto w, auto x, auto y, ...) { ... });
tree::Expression FunctionBody::near_object(const ir::Clearances& clearances,
                                           const std::string& count, tree::Expression lambda) {
    const auto real = [&](double value) {
        return tree::word(literal(value, program().real));
    };
    const auto reals = [&](const std::vector<double>& values) {
        tree::Expressions items;
        for (const double value : values) items.push_back(real(value));
        return tree::braces("", std::move(items));
    };
    const auto declare = [&](const std::string& type, const char* wish, tree::Expressions items) {
        const std::string name = expressions_.claim(wish);
        tree::Expression variable = tree::braces("const " + type + " " + name, std::move(items));
        statements_.push_back({std::move(variable)});
        return tree::word(name);
    };
    const auto array = [&](const char* wish, const std::vector<ir::BufferId>& numbers) {
        tree::Expressions items;
        for (const ir::BufferId number : numbers) items.push_back(expressions_.record(number));
        if (!items.empty()) return declare("std::array", wish, std::move(items));
        return declare("std::array<" + expressions_.type(ir::Scalar::Real) + ", 0>", wish, {});
    };
    const std::string dimensions = std::to_string(clearances.places.size());
    const char* const of_reals = program().real == RealType::Float ? ", float" : "";
    tree::Expression grid =
        declare("rddl::Grid<" + dimensions + of_reals + ">", "grid",
                tree::list(reals(clearances.begin), reals(clearances.cells_per_unit),
                           real(clearances.unit), real(clearances.least_move)));
    tree::Expression places = array("places", clearances.places);
    tree::Expression moves = array("moves", clearances.moves);
    return tree::call("rddl::exists_near_object<" + count + ", " +
                          expressions_.unit().names.buffers[clearances.table.index] + ">",
                      tree::list(tree::word("context"), std::move(grid), std::move(places),
                                 std::move(moves), std::move(lambda)));
}

// rddl::spread(next.at[c], rddl::union_of<moves_>(rddl::bits(state.at[c]), action.move[c]));
void FunctionBody::statement(const ir::Spread& spread) {
    const auto before = expressions_.mark();
    prepare({line_width}, spread.bits);
    tree::Expression row = expressions_.target(spread.target, spread.indices);
    statements_.push_back(
        {tree::call("rddl::spread", tree::list(std::move(row), value({line_width}, spread.bits)))});
    expressions_.forget(before);
}

// const auto& near = rddl::true_elements(state.near);
// rddl::visit_true(near, ROAD_rows_, [&](rddl::Index x, rddl::Index entry,
//                                              const Bool& is_there) { ... });
void FunctionBody::statement(const ir::Visit& visit) {
    visits({&visit});
}

// One visit, or two of the same elements that take turns (rddl::visit_true_in_turn).
void FunctionBody::visits(const std::vector<const ir::Visit*>& all) {
    const ir::Visit& first = *all.front();
    const auto& few = std::get<ir::Load>(program()[first.condition].form);
    const auto [elements, is_first] = true_elements_.try_emplace(few.buffer);
    if (is_first) {
        elements->second = expressions_.claim(program()[few.buffer].name);
        statements_.push_back(
            {tree::Assign{{tree::Declared{"const auto&", elements->second}},
                          tree::call("rddl::true_elements", {expressions_.record(few.buffer)})}});
    }
    tree::Expressions arguments = {tree::word(elements->second)};
    if (first.entries) arguments.push_back(expressions_.record(first.entries->rows));
    for (const ir::Visit* const visit : all) arguments.push_back(marks_of(*visit));
    statements_.push_back({tree::call(
        all.size() > 1 ? "rddl::visit_true_in_turn" : "rddl::visit_true", std::move(arguments))});
}

// [&](rddl::Index x, rddl::Index entry, const Bool& is_there) { ... }
tree::Expression FunctionBody::marks_of(const ir::Visit& visit) {
    const auto before = expressions_.mark();
    const auto index = [&](ir::VariableId variable) {
        return tree::Expression{tree::Declared{"rddl::Index", expressions_.enter(variable)}};
    };
    tree::Expressions parameters = {index(visit.visited)};
    if (visit.entries) parameters.push_back(index(visit.entries->variable));
    const std::string is_there = expressions_.claim("is_there");
    parameters.push_back(
        {tree::Declared{"const " + expressions_.type(ir::Scalar::Bool) + "&", is_there}});
    tree::Block body = inner(1, [&] {
        for (auto each = visit.marks.begin(); each != visit.marks.end(); ++each) {
            const bool is_shared =
                std::find_if(std::next(each), visit.marks.end(), [&](const ir::Mark& other) {
                    return other.condition == each->condition;
                }) != visit.marks.end();
            if (is_shared && !is_leaf(expressions_.unit(), each->condition))
                name_value(each->condition);
            mark(*each, is_there);
        }
    });
    expressions_.return_to(before);
    return {tree::Lambda{std::move(parameters), std::move(body)}};
}

// rddl::mark<true>(next.at[x], is_there && action.go[x]);
void FunctionBody::mark(const ir::Mark& mark, const std::string& is_there) {
    const auto before = expressions_.mark();
    tree::Expression element = expressions_.target(mark.target, mark.indices);
    prepare({line_width}, mark.condition);
    const auto* constant = std::get_if<ir::Constant>(&program()[mark.condition].form);
    tree::Expression condition =
        constant && constant->value == ir::Value(true)
            ? tree::word(is_there)
            : tree::operation(plain_operator(Operator::And),
                              {tree::word(is_there), value({line_width}, mark.condition)});
    statements_.push_back({tree::call(mark.value ? "rddl::mark<true>" : "rddl::mark<false>",
                                      tree::list(std::move(element), std::move(condition)))});
    expressions_.forget(before);
}

void FunctionBody::statement(const ir::Call& call) {
    statements_.push_back(expressions_.lower(call));
}

// --------------------------------------------------------------------------- preparation

void FunctionBody::prepare(Use use, ir::NodeId id) {
    name_parts_in_order(id);
    if (const ir::Select* select = lazy_select(id)) return prepare_branch(*select);
    const ir::Node& node = program()[id];
    if (is_block(id) || is_binder(node)) return;
    while (!reads_well(use, id)) {
        if (std::holds_alternative<ir::Discrete>(node.form)) return prepare_weights(node);
        if (!name_longest_part(id)) return;
    }
}

bool FunctionBody::reads_well(Use use, ir::NodeId id) {
    if (fits(use, id)) return true;
    const std::vector<ir::NodeId> parts = chain_parts(id);
    if (parts.size() < 2) return false;
    // Two operands shall not stand in three lines.
    const std::size_t beside = room({}) + indentation;
    if (!use.returns && parts.size() == 2 &&
        (use.width + expressions_.width_within(parts[0], line_width) + 1 > beside ||
         use.width + expressions_.width_within(parts[1], line_width) > beside))
        return false;
    return std::ranges::all_of(parts, [&](ir::NodeId part) {
        std::vector<ir::NodeId> lambdas;
        collect_lambda_calls(part, lambdas);
        const std::size_t width = expressions_.width_within(part, longest_operand);
        return lambdas.empty() && width <= longest_operand &&
               width + operator_and_brackets <= room(use);
    });
}

void FunctionBody::prepare_branch(const ir::Select& select) {
    const std::size_t width = expressions_.width_within(select.condition, longest_condition);
    if (width > longest_condition) name_value(select.condition);
}

void FunctionBody::prepare_weights(const ir::Node& draw) {
    for (const ir::NodeId weight : expressions_.listed_weights(draw).weights)
        prepare({width(tree::element(tree::word("weights"), tree::word("0"))) + assignment_width},
                weight);
}

// Gives names to the parts of `id` that are blocks, from the outside in. C++ may evaluate operands
// in any order, but the first fault is the one that is told: of several operands that may fault,
// all but the last also get names.
void FunctionBody::name_parts_in_order(ir::NodeId id) {
    const std::vector<ir::NodeId> parts = eager_parts(id);
    const auto may_fault = [&](ir::NodeId part) {
        return !expressions_.is_named(part) && expressions_.unit().properties_of(part).may_fault;
    };
    for (auto part = parts.begin(); part != parts.end(); ++part) {
        const bool is_binder_block = is_block(*part) && is_binder(program()[*part]);
        const bool before_others =
            may_fault(*part) && std::any_of(part + 1, parts.end(), may_fault);
        if (before_others || is_binder_block || lazy_select(*part)) {
            name_value(*part);
        } else if (is_block(*part) || may_fault(*part)) {
            name_parts_in_order(*part);
        }
    }
}

// False if no part is worth a name.
bool FunctionBody::name_longest_part(ir::NodeId id) {
    const std::vector<ir::NodeId> parts = nameable_parts(id);
    std::vector<std::size_t> lengths;
    for (const ir::NodeId& part : parts) {
        const bool has_name = expressions_.is_named(part) || is_leaf(expressions_.unit(), part) ||
                              expressions_.unit().is_uniform(part);
        lengths.push_back(has_name ? 0 : expressions_.width_within(part, longest_compared));
    }
    const std::size_t longest = lengths.empty() ? 0 : std::ranges::max(lengths);
    if (longest < shortest_named) return false;
    // The first of those that are about as long, so that names come in the order of the text.
    const auto first = std::ranges::find_if(
        lengths, [&](std::size_t length) { return 3 * length >= 2 * longest; });
    const ir::NodeId part = parts[static_cast<std::size_t>(first - lengths.begin())];
    // Where it has parts that need names itself, these may be enough.
    const std::size_t names_before = expressions_.named_count();
    prepare_declaration(part);
    if (expressions_.named_count() == names_before) name_value(part);
    return true;
}

void FunctionBody::name_value(ir::NodeId id) {
    if (!expressions_.is_named(id)) expressions_.name(id, declare(id));
}

// "const Real total = ...;"
std::string FunctionBody::declare(ir::NodeId id) {
    // The parts that need names get them first, so that numbers grow from top to bottom.
    prepare_declaration(id);
    const std::string name = expressions_.claim(wish_for(program(), id));
    const std::string type = type_in_declaration(id);
    tree::Expression initial = value({type.size() + 1 + name.size() + assignment_width}, id);
    statements_.push_back({tree::Assign{{tree::Declared{type, name}}, std::move(initial)}});
    return name;
}

void FunctionBody::prepare_declaration(ir::NodeId id) {
    const std::string type = expressions_.measured([&] { return type_in_declaration(id); });
    prepare({type.size() + 1 + wish_for(program(), id).size() + assignment_width}, id);
}

std::string FunctionBody::type_in_declaration(ir::NodeId id) {
    // Narrow bits have a type of their own in packs.
    if (expressions_.is_over_several() || expressions_.unit().narrow_bits[id.index])
        return "const auto";
    const bool is_index = expressions_.unit().is_uniform(id);
    return "const " + (is_index ? "rddl::Index" : expressions_.type(program()[id].type));
}

// -------------------------------------------------------------------------------- values

tree::Expression FunctionBody::value(Use use, ir::NodeId id) {
    if (const ir::Select* select = lazy_select(id)) return branch(*select);
    const ir::Node& node = program()[id];
    if (is_binder(node) && !expressions_.is_named(id))
        return expressions_.lower_binder(node, [&](ir::NodeId body) { return returning(body, 1); });
    if (std::holds_alternative<ir::Discrete>(node.form) && !fits(use, id)) return discrete(node);
    return use.returns ? expressions_.result(id) : expressions_.lower(id);
}

// A chain of else-ifs is one call: its conditions after the first are lambdas, like its values.
// Branches that packs evaluate in all lanes need no context.
tree::Expression FunctionBody::branch(const ir::Select& select) {
    std::vector<ir::NodeId> lambdas = {select.then_value};
    ir::NodeId last = select.else_value;
    while (const ir::Select* next = lazy_select(last)) {
        lambdas.insert(lambdas.end(), {next->condition, next->then_value});
        last = next->else_value;
    }
    lambdas.push_back(last);

    tree::Expressions arguments;
    if (select.evaluated != ir::Evaluated::PackBoth) {
        expressions_.uses().context = true;
        arguments.push_back(tree::word(expressions_.context()));
    }
    arguments.push_back(expressions_.lower(select.condition));
    auto shared = ir::shared_in_cases(program(), expressions_.unit().properties, select);
    for (ir::NodeId lambda : lambdas)
        arguments.push_back({tree::Lambda{{}, returning(lambda, 2, std::exchange(shared, {}))}});
    return tree::call("rddl::branch", std::move(arguments));
}

// Too many weights for one line are set one by one.
tree::Expression FunctionBody::discrete(const ir::Node& draw) {
    const std::string name = expressions_.claim("weights");
    const auto& form = std::get<ir::Discrete>(draw.form);
    const std::string type = expressions_.weights_type(form);
    const Expressions::ListedWeights listed = expressions_.listed_weights(draw);
    statements_.push_back({tree::Expression{tree::Declared{type, name}}});
    for (std::size_t k = 0; k < listed.weights.size(); ++k) {
        tree::Expression weight = tree::element(tree::word(name), tree::number(k));
        const Use use{width(weight) + assignment_width};
        statements_.push_back({tree::Assign{std::move(weight), value(use, listed.weights[k])}});
    }
    return expressions_.discrete_call(form, listed, tree::word(name));
}

template <class Add>
tree::Block FunctionBody::inner(std::size_t levels, Add&& add) {
    tree::Block around = std::exchange(statements_, {});
    level_ += levels;
    add();
    level_ -= levels;
    return std::exchange(statements_, std::move(around));
}

tree::Block FunctionBody::returning(ir::NodeId id, std::size_t levels,
                                    const std::vector<ir::NodeId>& named) {
    const auto before = expressions_.mark();
    tree::Block body = inner(levels, [&] {
        for (const ir::NodeId each : named) name_value(each);
        return_value(id);
    });
    expressions_.return_to(before);
    return body;
}

// ------------------------------------------------------------------------------ questions

// In one line, behind a return or below what it is assigned to, with its semicolon.
std::size_t FunctionBody::room(Use use) const {
    const std::size_t before = level_ * indentation + (use.returns ? use.width : indentation);
    return line_width - std::min(line_width, before + 1);
}

bool FunctionBody::fits(Use use, ir::NodeId id) {
    const std::size_t most = room(use);
    return expressions_.width_within(id, most) <= most;
}

bool FunctionBody::is_block(ir::NodeId id) const {
    if (expressions_.is_named(id) || !expressions_.unit().contains_branch[id.index]) return false;
    if (lazy_select(id)) return true;
    const auto operands = ir::operands_of(program()[id]);
    return std::ranges::any_of(operands, [&](ir::NodeId operand) { return is_block(operand); });
}

const ir::Select* FunctionBody::lazy_select(ir::NodeId id) const {
    if (expressions_.is_named(id)) return nullptr;
    const auto* select = std::get_if<ir::Select>(&program()[id].form);
    return select && select->evaluated != ir::Evaluated::Both ? select : nullptr;
}

// a + b - c -> a, b, c
std::vector<ir::NodeId> FunctionBody::chain_parts(ir::NodeId id) const {
    const auto op = chain_operator(program()[id]);
    if (!op || expressions_.is_named(id)) return {id};
    const auto& operands = std::get<ir::Apply>(program()[id].form).operands;
    const auto parts_of = [&](ir::NodeId operand) {
        return chain_operator(program()[operand]) == op ? chain_parts(operand)
                                                        : std::vector{operand};
    };
    std::vector<ir::NodeId> parts = parts_of(operands[0]);
    const bool is_associative = is_one_of(*op, {Operator::And, Operator::Or});
    for (const ir::NodeId part : is_associative ? parts_of(operands[1]) : std::vector{operands[1]})
        parts.push_back(part);
    return parts;
}

// The parts that are evaluated whenever `id` is, before it.
std::vector<ir::NodeId> FunctionBody::eager_parts(ir::NodeId id) const {
    if (expressions_.is_named(id) || is_binder(program()[id])) return {};
    if (const ir::Select* select = lazy_select(id)) return {select->condition};
    return expressions_.unit().operands_of(program()[id]);
}

// Calls with lambdas inside of it first, since they take many lines, unless there are too many;
// else its operands.
std::vector<ir::NodeId> FunctionBody::nameable_parts(ir::NodeId id) const {
    std::vector<ir::NodeId> parts;
    for (ir::NodeId part : eager_parts(id)) collect_lambda_calls(part, parts);
    if (parts.empty() || parts.size() > most_lambda_calls) parts = chain_parts(id);
    const bool is_itself = parts.size() == 1 && parts.front() == id;
    return is_itself ? eager_parts(id) : parts;
}

// The outermost ones, and no more than it takes to see that there are too many.
void FunctionBody::collect_lambda_calls(ir::NodeId id, std::vector<ir::NodeId>& calls) const {
    if (expressions_.is_named(id) || calls.size() > most_lambda_calls) return;
    if (is_binder(program()[id])) {
        calls.push_back(id);
        return;
    }
    for (ir::NodeId part : eager_parts(id)) collect_lambda_calls(part, calls);
}

}  // namespace rddlc::cpp
