#include "emit/lower/externals.hpp"

#include "emit/cpp/print.hpp"
#include "emit/lower/tables.hpp"
#include "emit/names/identifiers.hpp"
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
    // The parameter as a C++ type.
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

cpp::tree::Statement assertion(const Use& use) {
    namespace tree = cpp::tree;
    const std::string must = "the external function $" + use.rddl_name + " must be callable as ";
    tree::Expressions parameters;
    for (const std::string& type : use.parameters) parameters.push_back(tree::word(type));
    const tree::Expression fits{tree::Bracketed{tree::word("rddl::external::fits"),
                                                tree::Brackets::Angle,
                                                {tree::call(use.result, std::move(parameters))}}};
    return {
        tree::call("static_assert",
                   {tree::call(fits, {tree::call("RDDL_EXTERN_FUNCTION", {tree::word(use.name)})}),
                    tree::text(must + fmt::format("{} rddl_extern::{}({})", use.result, use.name,
                                                  fmt::join(use.parameters, ", ")))})};
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
    tree::Block asserts;
    for (const Use& use : uses_of(unit.program)) {
        asserts.push_back(assertion(use));
        asserts.back().comment = "$" + use.rddl_name + ", " + unit.where(use.span);
    }
    return section("external functions", tree::print(asserts, 0));
}

}  // namespace cpp

std::string emit_external_library(const ir::Program& program,
                                  const std::vector<std::string>& headers) {
    const std::vector<Use> uses = uses_of(program);
    std::string text = "// External functions for the interpreter, made by rddlc.\n\n" +
                       cpp::external_includes(program, headers);
    std::vector<std::string> exported;
    for (const Use& use : uses) {
        text += "\n" + cpp::tree::print({assertion(use)}, 0);
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
