#include "emit/lower/tables.hpp"

#include "emit/cpp/literals.hpp"
#include "emit/cpp/print.hpp"
#include "emit/lower/operators.hpp"
#include "ir/layout.hpp"
#include "support/match.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace rddlc::cpp {
namespace {

using tree::word;

// The initialiser of a nested std::array: {{ {1, 2}, {3, 4} }}, without the blanks.
tree::Expression initialiser(std::span<const std::int64_t> shape, std::span<const ir::Value> values,
                             RealType real) {
    if (shape.empty()) return word(table_entry(values.front(), real));
    if (shape.size() == 1) {
        tree::Words entries;
        for (const ir::Value& value : values) entries.texts.push_back(table_entry(value, real));
        return tree::braces("", tree::list(tree::Expression{std::move(entries)}));
    }
    tree::Expressions rows;
    const std::size_t stride = values.size() / static_cast<std::size_t>(shape.front());
    for (std::size_t begin = 0; begin < values.size(); begin += stride)
        rows.push_back(initialiser(shape.subspan(1), values.subspan(begin, stride), real));
    return tree::braces("", tree::list(tree::braces("", std::move(rows))));
}

bool is_zero(const ir::Value& value) {
    return match(
        value, [](bool v) { return !v; }, [](std::int64_t v) { return v == 0; },
        [](double v) { return v == 0 && !std::signbit(v); });
}

// The same table under the same name and, as reals are `real`, of the same type.
bool has_table(const Unit& unit, const std::string& name, const ir::Buffer& table, RealType real) {
    for (std::size_t index = 0; index < unit.program.buffers.size(); ++index) {
        const bool is_named =
            unit.names.buffers[index] == name || unit.names.initial[index] == name;
        if (!is_named || unit.left_out.contains({static_cast<std::uint32_t>(index)})) continue;
        const ir::Buffer& buffer = unit.program.buffers[index];
        const bool is_same_type = table.scalar != ir::Scalar::Real || unit.program.real == real;
        return is_same_type && buffer.scalar == table.scalar && buffer.shape == table.shape &&
               identical(buffer.values, table.values);
    }
    return false;
}

// "north, lake, ..."
std::string object_list(const ir::ObjectType& type) {
    constexpr std::size_t width = 40;
    std::string text;
    for (const std::string& object : type.objects) {
        const std::string next = (text.empty() ? "" : ", ") + comment_text(object);
        if (text.size() + next.size() > width) return text.empty() ? "..." : text + ", ...";
        text += next;
    }
    return text;
}

// Places take as few bytes as they need.
std::string element_type(const ir::Buffer& buffer, RealType real) {
    if (!buffer.holds_places) return table_type(buffer.scalar, real);
    std::int64_t last = 0;
    for (const ir::Value& place : buffer.values.dense())
        last = std::max(last, std::get<std::int64_t>(place));
    if (last <= std::numeric_limits<std::uint8_t>::max()) return "std::uint8_t";
    return last <= std::numeric_limits<std::uint16_t>::max() ? "std::uint16_t" : "std::uint32_t";
}

tree::Statement size_assert(tree::Expression size, std::size_t bytes) {
    return {tree::call("static_assert", {tree::operation(plain_operator(Operator::Equal),
                                                         {std::move(size), tree::number(bytes)})})};
}

void add_size_asserts(const Unit& unit, const std::string& name, ir::Storage storage,
                      tree::Block& asserts) {
    const ir::RecordLayout layout = ir::record_layout(unit.program, storage);
    if (layout.fields.empty()) return;
    const tree::Expression type = word(name + "<rddl::Scalar>");
    asserts.push_back(size_assert(tree::call("sizeof", {type}), layout.size));
    if (layout.fields.size() < 2) return;
    const ir::Field& last = layout.fields.back();
    const std::string& member = unit.names.buffers[last.buffer.index];
    asserts.push_back(size_assert(tree::call("offsetof", {type, word(member)}), last.offset));
}

}  // namespace

std::string section(const std::string& title, const std::string& text) {
    if (text.empty()) return "";
    const std::size_t width = 92;
    return "// " + std::string(width - 4 - title.size(), '-') + " " + title + "\n\n" + text;
}

std::string array_type(const Unit& unit, const ir::Buffer& buffer, const std::string& element) {
    std::string type = element;
    for (std::size_t d = buffer.shape.size(); d-- > 0;) {
        const bool all_objects =
            d < buffer.types.size() &&
            static_cast<std::int64_t>(unit.program.types[buffer.types[d]].objects.size()) ==
                buffer.shape[d];
        const std::string extent =
            all_objects ? unit.names.counts[buffer.types[d]] : std::to_string(buffer.shape[d]);
        type = "std::array<" + type + ", " + extent + ">";
    }
    return type;
}

bool are_equal(std::span<const ir::Value> values) {
    return std::ranges::all_of(values, [&](const ir::Value& v) { return identical(v, values[0]); });
}

tree::Statement table(const std::string& type, const std::string& name,
                      std::span<const std::int64_t> shape, std::span<const ir::Value> values,
                      RealType real) {
    const bool zero = !shape.empty() && std::ranges::all_of(values, is_zero);
    return {tree::Assign{{tree::Declared{"inline constexpr " + type, name}},
                         zero ? tree::braces("", {}) : initialiser(shape, values, real)}};
}

std::string objects(const Unit& unit) {
    tree::Block counts;
    for (std::size_t type = 0; type < unit.program.types.size(); ++type) {
        const ir::ObjectType& described = unit.program.types[type];
        counts.push_back(tree::assign("inline constexpr rddl::Index " + unit.names.counts[type],
                                      tree::number(described.objects.size())));
        counts.back().remark = object_list(described);
    }
    return section("objects", tree::print(counts, 0));
}

// [[no_unique_address]] rddl::SlidingBuffer<L, std::array<...>> flow_buffer;
tree::Block sliding_buffers(const Unit& unit) {
    tree::Block members;
    for (std::size_t index = 0; index < unit.program.buffers.size(); ++index) {
        const ir::Buffer& buffer = unit.program.buffers[index];
        const std::string& name = unit.names.sliding_buffers[index];
        if (name.empty() || buffer.storage != ir::Storage::State) continue;
        const std::string table =
            array_type(unit, buffer, "typename L::" + lane_type(buffer.scalar));
        members.push_back({tree::Expression{
            tree::Declared{"[[no_unique_address]] rddl::SlidingBuffer<L, " + table + ">", name}}});
    }
    return members;
}

std::string record(const Unit& unit, const std::string& name, ir::Storage storage) {
    tree::Record result{name, {}};
    for (std::size_t index = 0; index < unit.program.buffers.size(); ++index) {
        const ir::Buffer& buffer = unit.program.buffers[index];
        if (buffer.storage != storage) continue;
        const std::string type =
            array_type(unit, buffer, "typename L::" + lane_type(buffer.scalar));
        result.members.push_back(
            {.form = tree::Expression{tree::Declared{type, unit.names.buffers[index]}},
             .remark = unit.where(buffer.span)});
    }
    if (storage == ir::Storage::State) append(result.members, sliding_buffers(unit));
    return tree::print({{.form = std::move(result), .is_template = true}}, 0);
}

// inline constexpr std::array step_draws = {
//     rddl::counters_of_loop(1), rddl::counters_of_draws({{2, 0}, {3, 0}})
// };
tree::Statement draws_of_step(const StepDraws& draws) {
    tree::Expressions rows;
    for (const StepDraws::Row& row : draws.rows()) {
        if (row.loop) {
            rows.push_back(tree::call("rddl::counters_of_loop", {tree::number(*row.loop)}));
            continue;
        }
        tree::Expressions lanes;
        for (const auto& [series, index] : row.lone)
            lanes.push_back(tree::braces("", {tree::number(series), tree::number(index)}));
        rows.push_back(tree::call("rddl::counters_of_draws", {tree::braces("", std::move(lanes))}));
    }
    return {.form = tree::Assign{tree::declared("inline constexpr std::array", "step_draws"),
                                 tree::braces("", std::move(rows))},
            .comment = "draws of every step, whose numbers are made together"};
}

// inline constexpr std::array step_normals = {
//     rddl::LoopOfNormals{0, zone_count}, rddl::LoopOfNormals{1, zone_count * lift_count}
// };
tree::Statement normals_of_step(const Unit& unit) {
    tree::Expressions loops;
    for (const auto& [series, variables] : unit.step_normals.loops()) {
        std::vector<std::string> sizes;
        for (const ir::VariableId id : variables) sizes.push_back(unit.size_of(unit.program[id]));
        loops.push_back(
            tree::braces("rddl::LoopOfNormals",
                         {tree::number(series), word(fmt::format("{}", fmt::join(sizes, " * ")))}));
    }
    return {.form = tree::Assign{tree::declared("inline constexpr std::array", "step_normals"),
                                 tree::braces("", std::move(loops))},
            .comment = "normals of every step, made together"};
}

std::string tables(const Unit& unit, const Unit* around) {
    tree::Block definitions;
    for (std::size_t index = 0; index < unit.program.buffers.size(); ++index) {
        const ir::Buffer& buffer = unit.program.buffers[index];
        const std::string& initial = unit.names.initial[index];
        if (buffer.storage != ir::Storage::Constant && initial.empty()) continue;
        if (unit.left_out.contains({static_cast<std::uint32_t>(index)})) continue;
        const std::string& name = initial.empty() ? unit.names.buffers[index] : initial;
        const RealType real = unit.program.real;
        // Episodes start in the program around.
        if (around && (!initial.empty() || has_table(*around, name, buffer, real))) continue;
        const std::string type = array_type(unit, buffer, element_type(buffer, real));
        definitions.push_back(table(type, name, buffer.shape, buffer.values.dense(), real));
        definitions.back().comment = comment_text(buffer.name) + ", " + unit.where(buffer.span);
    }
    if (!unit.step_draws.rows().empty()) definitions.push_back(draws_of_step(unit.step_draws));
    if (!unit.step_normals.loops().empty()) definitions.push_back(normals_of_step(unit));
    return section("tables", tree::print(definitions, 0));
}

std::string records(const Unit& unit) {
    std::string text = record(unit, "State", ir::Storage::State) + "\n" +
                       record(unit, "Action", ir::Storage::Action) +
                       "\n// Values that CPFs compute and others read, within a step.\n" +
                       record(unit, "Scratch", ir::Storage::Scratch) + "\n" +
                       record(unit, "Observation", ir::Storage::Observation);
    if (unit.program.policy)
        text += "\n// What the policy remembers from one decision to the next.\n" +
                record(unit, "PolicyMemory", ir::Storage::Memory);
    return section("records", text);
}

std::string sliding_buffer_functions(const Unit& unit) {
    std::string sizes, calls;
    for (std::size_t index = 0; index < unit.program.buffers.size(); ++index) {
        const std::string& sliding = unit.names.sliding_buffers[index];
        if (sliding.empty() || unit.program.buffers[index].storage != ir::Storage::State) continue;
        sizes += (sizes.empty() ? "" : " +\n               ") +
                 fmt::format("rddl::bytes_of_sliding_buffer<decltype(State<L>::{})>", sliding);
        calls += fmt::format("        rddl::settle(state.{}, state.{});\n",
                             unit.names.buffers[index], sliding);
    }
    if (calls.empty()) return "";
    return "    // Tables of the state that may slide along buffers behind its other values\n"
           "    // (rddl/values/sliding_tables.hpp): the bytes of the buffers, and a state whose\n"
           "    // tables are in their places.\n"
           "    template <class L>\n    static constexpr std::size_t sliding_buffers_size() {\n    "
           "    "
           "return " +
           sizes + ";\n    }\n    template <class L>\n    static void settle(State<L>& state) {\n" +
           calls + "    }\n";
}

// That the records are laid out as the interpreter's are; Compiled checks that copies are trivial.
std::string asserts(const Unit& unit) {
    tree::Block result;
    add_size_asserts(unit, "State", ir::Storage::State, result);
    add_size_asserts(unit, "Action", ir::Storage::Action, result);
    add_size_asserts(unit, "Observation", ir::Storage::Observation, result);
    add_size_asserts(unit, "PolicyMemory", ir::Storage::Memory, result);
    return tree::print(result, 0);
}

}  // namespace rddlc::cpp
