#include "emit/externals.hpp"

#include "emit/identifiers.hpp"
#include "emit/layout.hpp"
#include "emit/tables.hpp"
#include "ir/analysis.hpp"
#include "ir/call.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace rddlc {
namespace {

// "std::span<const std::array<double, 2>, 3>"
std::string type_of(const ir::Program& program, const ir::TableView& view, std::string_view row) {
    const auto axes = ir::axes_of(program, view);
    std::string type = cpp::table_type(program[view.buffer].scalar);
    if (axes.empty()) return type;
    for (std::size_t axis = axes.size(); axis-- > 1;) {
        type = fmt::format("std::array<{}, {}>", type, axes[axis]);
    }
    return fmt::format("std::span<{}{}, {}>", row, type, axes.front());
}

// A function as the program calls it. RDDL names that C++ spells alike are one function.
struct Use {
    std::string rddl_name;
    std::string name;  // in C++
    std::string result;
    std::vector<std::string> parameters;
    Span span;

    bool operator==(const Use& other) const {
        return name == other.name && result == other.result && parameters == other.parameters;
    }
    // As a type.
    std::string signature() const {
        return fmt::format("{}({})", result, fmt::join(parameters, ", "));
    }
};

Use use_of(const ir::Program& program, ir::ExternalId id, const ir::Call& call) {
    const ir::External& external = program[id];
    Use use{external.name,
            cpp::external_identifier(external.name),
            type_of(program, call.output, ""),
            {},
            external.span};
    for (const ir::TableView& input : call.inputs) {
        use.parameters.push_back(type_of(program, input, "const "));
    }
    if (!ir::axes_of(program, call.output).empty()) {
        use.parameters.push_back(std::exchange(use.result, "void"));
    }
    return use;
}

// Each signature once, in the order of the program.
std::vector<Use> uses_of(const ir::Program& program) {
    std::vector<Use> uses;
    for (const ir::Block* block : ir::blocks_of(program)) {
        ir::for_each_statement<ir::Call>(*block, [&](const ir::Call& call) {
            const auto* id = std::get_if<ir::ExternalId>(&call.callee);
            if (!id) return;
            Use use = use_of(program, *id, call);
            if (std::ranges::find(uses, use) == uses.end()) uses.push_back(std::move(use));
        });
    }
    return uses;
}

// "void(std::span<const double, 3>,", "std::span<double, 3>)": lines that begin at a column.
std::vector<std::string> signature_lines(const Use& use, const std::string& head,
                                         std::size_t column) {
    if (use.parameters.empty()) return {head + "()"};
    std::vector<std::string> pieces = use.parameters;
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i) pieces[i] += ',';
    pieces.front().insert(0, head + "(");
    pieces.back() += ")";
    return cpp::fill(pieces, column, 0);
}

std::string assertion(const Use& use) {
    const std::string lead = "static_assert(rddl::external::fits<";
    const std::string margin = "\n" + std::string(std::string_view("static_assert(").size(), ' ');
    std::string text;
    for (const std::string& line : signature_lines(use, use.result, lead.size())) {
        text += (text.empty() ? lead : "\n" + std::string(lead.size(), ' ')) + line;
    }
    text += ">(" + margin + "    RDDL_EXTERN_FUNCTION(" + use.name + ")),";
    text += margin + "\"the external function $" + use.rddl_name + " must be callable as\"";
    const std::string head = use.result + " rddl_extern::" + use.name;
    for (const std::string& line : signature_lines(use, head, margin.size() + 2)) {
        text += margin + "\" " + line + "\"";
    }
    return text + ");\n";
}

}  // namespace

namespace cpp {

std::string external_includes(const ir::Program& program, const std::vector<std::string>& headers) {
    if (uses_of(program).empty()) return "";
    std::string text;
    for (const std::string& header : headers) text += fmt::format("#include \"{}\"\n", header);
    return text + "\n#include <rddl/external.hpp>\n";
}

std::string external_asserts(const Unit& unit) {
    std::string text;
    for (const Use& use : uses_of(unit.program)) {
        text += fmt::format("{}// ${}, {}\n", text.empty() ? "" : "\n", use.rddl_name,
                            unit.where(use.span));
        text += "// clang-format off\n" + assertion(use) + "// clang-format on\n";
    }
    return section("external functions", text);
}

}  // namespace cpp

std::string emit_external_library(const ir::Program& program,
                                  const std::vector<std::string>& headers) {
    const std::vector<Use> uses = uses_of(program);
    std::string text = "// External functions for the interpreter, made by rddlc.\n\n" +
                       cpp::external_includes(program, headers);
    std::vector<std::string> exported;
    for (const Use& use : uses) {
        text += "\n" + assertion(use);
        if (std::ranges::find(exported, use.name) != exported.end()) continue;
        exported.push_back(use.name);
        std::string signatures;
        for (const Use& each : uses) {
            if (each.name == use.name) signatures += ", " + each.signature();
        }
        text += fmt::format("RDDL_EXTERN({}{})\n", use.name, signatures);
    }
    return text;
}

std::string external_entry(std::string_view name) {
    return "rddl_extern_" + cpp::external_identifier(name);
}

std::string external_signature(const ir::Program& program, const ir::Call& call) {
    return use_of(program, std::get<ir::ExternalId>(call.callee), call).signature();
}

}  // namespace rddlc
