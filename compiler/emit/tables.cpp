#include "emit/tables.hpp"

#include "emit/layout.hpp"
#include "emit/literals.hpp"
#include "ir/layout.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <cmath>

namespace rddlc::cpp {
namespace {

const std::string format_off = "// clang-format off\n";
const std::string format_on = "// clang-format on\n";

std::string lane_type(ir::Scalar scalar) {
    switch (scalar) {
        case ir::Scalar::Bool:
            return "typename L::Bool";
        case ir::Scalar::Int:
            return "typename L::Int";
        case ir::Scalar::Real:
            break;
    }
    return "typename L::Real";
}

std::string at_column(const std::string& text, std::size_t columns) {
    return std::string(columns, ' ') + text;
}

std::vector<std::string> with_commas(std::vector<std::string> items) {
    for (std::size_t i = 0; i + 1 < items.size(); ++i) items[i] += ',';
    return items;
}

// The initialiser of a nested std::array: {{ {1, 2}, {3, 4} }}, without the blanks.
class TableWriter {
  public:
    TableWriter(std::span<const std::int64_t> shape, std::span<const ir::Value> values,
                RealType real)
        : shape_(shape), values_(values), real_(real) {}

    std::string on_one_line(std::size_t dimension, std::size_t begin) const {
        if (dimension == shape_.size()) return table_entry(values_[begin], real_);
        const bool innermost = dimension + 1 == shape_.size();
        std::string text = innermost ? "{" : "{{";
        for (std::int64_t i = 0; i < shape_[dimension]; ++i) {
            text += i > 0 ? ", " : "";
            text +=
                on_one_line(dimension + 1, begin + static_cast<std::size_t>(i) * stride(dimension));
        }
        return text + (innermost ? "}" : "}}");
    }

    // Begins behind `lead` at `column`; ends with `tail`.
    std::string on_lines(const std::string& lead, std::size_t column, std::size_t dimension,
                         std::size_t begin, const std::string& tail) const {
        const bool innermost = dimension + 1 == shape_.size();
        if (innermost) {
            const std::string row = lead + on_one_line(dimension, begin) + tail;
            if (column + row.size() <= line_width) return at_column(row, column) + "\n";
        }
        std::string text = at_column(lead + (innermost ? "{" : "{{") + "\n", column);
        text += innermost ? wrapped_row(column + indentation, begin) : "";
        for (std::int64_t i = 0; !innermost && i < shape_[dimension]; ++i) {
            text += on_lines("", column + indentation, dimension + 1,
                             begin + static_cast<std::size_t>(i) * stride(dimension), ",");
        }
        return text + at_column((innermost ? "}" : "}}") + tail + "\n", column);
    }

  private:
    std::size_t stride(std::size_t dimension) const {
        std::size_t count = 1;
        for (std::size_t d = dimension + 1; d < shape_.size(); ++d) {
            count *= static_cast<std::size_t>(shape_[d]);
        }
        return count;
    }

    std::string wrapped_row(std::size_t column, std::size_t begin) const {
        std::vector<std::string> entries;
        for (std::size_t i = 0; i < static_cast<std::size_t>(shape_.back()); ++i) {
            entries.push_back(table_entry(values_[begin + i], real_));
        }
        std::string text;
        for (const std::string& line : fill(with_commas(std::move(entries)), column, 1)) {
            text += at_column(line, column) + "\n";
        }
        return text;
    }

    std::span<const std::int64_t> shape_;
    std::span<const ir::Value> values_;
    RealType real_;
};

// Where there is no room for both, the name has a line of its own.
std::string member(const std::string& type, const std::string& name) {
    const std::string line = "    " + type + " " + name + ";";
    if (line.size() <= line_width) return line;
    const std::string first = "    " + type;
    if (first.size() <= line_width) return first + "\n        " + name + ";";
    const std::size_t extent = first.rfind(", ") + 1;
    const std::string aligned(std::string_view("    std::array<").size(), ' ');
    return first.substr(0, extent) + "\n" + aligned + first.substr(extent + 1) + "\n        " +
           name + ";";
}

// The same table under the same name and, as reals are `real`, of the same type.
bool has_table(const Unit& unit, const std::string& name, const ir::Buffer& table, RealType real) {
    for (std::size_t index = 0; index < unit.program.buffers.size(); ++index) {
        const bool is_named =
            unit.names.buffers[index] == name || unit.names.initial[index] == name;
        if (!is_named) continue;
        const ir::Buffer& buffer = unit.program.buffers[index];
        const bool is_same_type = table.scalar != ir::Scalar::Real || unit.program.real == real;
        return is_same_type && buffer.scalar == table.scalar && buffer.shape == table.shape &&
               identical(buffer.values, table.values);
    }
    return false;
}

std::string policy_record(const Unit& unit) {
    if (!unit.program.policy) return "";
    return "\n// What the policy remembers from one decision to the next.\n" +
           record(unit, "PolicyMemory", ir::Storage::Memory);
}

// "north, lake, ...", cut to the width.
std::string object_list(const ir::ObjectType& type, std::size_t width) {
    std::string text;
    for (const std::string& object : type.objects) {
        const std::string next = (text.empty() ? "" : ", ") + comment_text(object);
        if (text.size() + next.size() + 5 > width) return text.empty() ? "..." : text + ", ...";
        text += next;
    }
    return text;
}

std::string size_assert(const Unit& unit, const std::string& name, ir::Storage storage) {
    const ir::RecordLayout layout = ir::record_layout(unit.program, storage);
    if (layout.fields.empty()) return "";
    const std::string type = name + "<rddl::Scalar>";
    std::string text =
        "static_assert(sizeof(" + type + ") == " + std::to_string(layout.size) + ");\n";
    if (layout.fields.size() > 1) {
        const ir::Field& last = layout.fields.back();
        text += "static_assert(offsetof(" + type + ", " + unit.names.buffers[last.buffer.index] +
                ") == " + std::to_string(last.offset) + ");\n";
    }
    return text;
}

}  // namespace

std::string section(const std::string& title, const std::string& text) {
    if (text.empty()) return "";
    const std::size_t width = 92;
    return "// " + std::string(width - 4 - title.size(), '-') + " " + title + "\n\n" + text;
}

std::string with_comments(const std::vector<CommentedLine>& lines) {
    std::size_t column = 0, width = 0;
    for (const CommentedLine& line : lines) {
        column = std::max(column, line.text.size() + 2);
        width = std::max(width, 3 + line.comment.size());
    }
    std::string result;
    for (const auto& [text, comment] : lines) {
        result += text;
        if (!comment.empty() && column + width <= line_width) {
            result += std::string(column - text.size(), ' ') + "// " + comment;
        }
        result += "\n";
    }
    return result;
}

std::string with_joined_regions(std::string text) {
    const std::string seam = format_on + "\n" + format_off;
    for (std::size_t at; (at = text.find(seam)) != std::string::npos;) {
        text.replace(at, seam.size(), "\n");
    }
    return text;
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

std::string table_type(ir::Scalar scalar, RealType real) {
    switch (scalar) {
        case ir::Scalar::Bool:
            return "bool";
        case ir::Scalar::Int:
            return "std::int64_t";
        case ir::Scalar::Real:
            break;
    }
    return std::string(name_of(real));
}

bool is_zero(const ir::Value& value) {
    return match(
        value, [](bool v) { return !v; }, [](std::int64_t v) { return v == 0; },
        [](double v) { return v == 0 && !std::signbit(v); });
}

bool are_equal(std::span<const ir::Value> values) {
    return std::ranges::all_of(values, [&](const ir::Value& v) { return identical(v, values[0]); });
}

std::string table(const std::string& declaration, std::span<const std::int64_t> shape,
                  std::span<const ir::Value> values, RealType real) {
    // Long types have the name on a line of its own.
    const bool too_wide = declaration.size() + std::string_view(" = {{").size() > line_width;
    const std::size_t name = declaration.rfind(' ');
    const std::string lead =
        (too_wide ? declaration.substr(0, name) + "\n   " + declaration.substr(name)
                  : declaration) +
        " = ";
    const bool zero = std::ranges::all_of(values, is_zero);
    if (zero && !shape.empty()) return lead + "{};\n";
    const TableWriter writer(shape, values, real);
    // Only tables that may fit are worth writing out on one line.
    if (values.size() < line_width / 2) {
        const std::string text = lead + writer.on_one_line(0, 0) + ";";
        if (text.size() <= line_width) return text + "\n";
    }
    return format_off + writer.on_lines(lead, 0, 0, 0, ";") + format_on;
}

std::string list(const std::string& declaration, const std::vector<std::string>& items) {
    std::string text;
    for (const std::string& item : items) text += (text.empty() ? "" : ", ") + item;
    const std::string whole = declaration + " = {" + text + "};";
    if (whole.size() <= line_width) return whole + "\n";
    std::string lines;
    for (const std::string& line : fill(with_commas(items), indentation, 1)) {
        lines += at_column(line, indentation) + "\n";
    }
    return format_off + declaration + " = {\n" + lines + "};\n" + format_on;
}

std::string objects(const Unit& unit) {
    std::vector<CommentedLine> lines;
    std::size_t width = 0;
    for (std::size_t type = 0; type < unit.program.types.size(); ++type) {
        lines.push_back({"inline constexpr rddl::Index " + unit.names.counts[type] + " = " +
                             std::to_string(unit.program.types[type].objects.size()) + ";",
                         ""});
        width = std::max(width, lines.back().text.size());
    }
    for (std::size_t type = 0; type < lines.size(); ++type) {
        const std::size_t room = line_width - std::min(line_width, width + 5);
        lines[type].comment = object_list(unit.program.types[type], room);
    }
    return section("objects", with_comments(lines));
}

std::string record(const Unit& unit, const std::string& name, ir::Storage storage) {
    std::vector<CommentedLine> members;
    for (std::size_t index = 0; index < unit.program.buffers.size(); ++index) {
        const ir::Buffer& buffer = unit.program.buffers[index];
        if (buffer.storage != storage) continue;
        const std::string type = array_type(unit, buffer, lane_type(buffer.scalar));
        members.push_back({member(type, unit.names.buffers[index]), unit.where(buffer.span)});
    }
    const std::string head = "template <class L>\nstruct " + name + " {";
    return head + (members.empty() ? "" : "\n" + with_comments(members)) + "};\n";
}

std::string tables(const Unit& unit, const Unit* around) {
    std::string text;
    for (std::size_t index = 0; index < unit.program.buffers.size(); ++index) {
        const ir::Buffer& buffer = unit.program.buffers[index];
        const std::string& initial = unit.names.initial[index];
        if (buffer.storage != ir::Storage::Constant && initial.empty()) continue;
        const std::string& name = initial.empty() ? unit.names.buffers[index] : initial;
        const RealType real = unit.program.real;
        // Episodes start in the program around.
        if (around && (!initial.empty() || has_table(*around, name, buffer, real))) continue;
        const std::string type = array_type(unit, buffer, table_type(buffer.scalar, real));
        text += (text.empty() ? "" : "\n") + std::string("// ") + comment_text(buffer.name) + ", " +
                unit.where(buffer.span) + "\n";
        text += table("inline constexpr " + type + " " + name, buffer.shape, buffer.values.dense(),
                      real);
    }
    return section("tables", with_joined_regions(std::move(text)));
}

std::string records(const Unit& unit) {
    return section("records", record(unit, "State", ir::Storage::State) + "\n" +
                                  record(unit, "Action", ir::Storage::Action) + "\n" +
                                  "// What the CPFs tell each other within a step.\n" +
                                  record(unit, "Scratch", ir::Storage::Scratch) + "\n" +
                                  record(unit, "Observation", ir::Storage::Observation) +
                                  policy_record(unit));
}

// That the records are laid out as the interpreter's are; Compiled checks that copies are trivial.
std::string asserts(const Unit& unit) {
    return size_assert(unit, "State", ir::Storage::State) +
           size_assert(unit, "Action", ir::Storage::Action) +
           size_assert(unit, "Observation", ir::Storage::Observation) +
           size_assert(unit, "PolicyMemory", ir::Storage::Memory);
}

}  // namespace rddlc::cpp
