#include "fitting/open_parameters.hpp"

#include "support/failure.hpp"
#include "support/suggestion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <variant>

namespace rddlc::workbench {

namespace {

// The parts of a program that change.
struct Parts {
    std::vector<ast::PVariable*> non_fluents;
    ast::Cpfs* cpfs = nullptr;
    std::vector<ast::NonFluentValues*> values;
    ast::Instance* instance = nullptr;
    ast::InitState* initial = nullptr;
};

Parts parts_of(ast::Program& program) {
    Parts parts;
    for (ast::Block& block : program.blocks) {
        if (auto* const domain = std::get_if<ast::Domain>(&block)) {
            for (ast::DomainSection& section : domain->sections) {
                if (auto* const fluents = std::get_if<ast::PVariables>(&section.node))
                    for (ast::PVariable& fluent : fluents->declarations)
                        if (fluent.kind.text == "non-fluent") parts.non_fluents.push_back(&fluent);
                if (auto* const cpfs = std::get_if<ast::Cpfs>(&section.node)) parts.cpfs = cpfs;
            }
        } else if (auto* const constants = std::get_if<ast::NonFluents>(&block)) {
            for (ast::InstanceSection& section : constants->sections)
                if (auto* const values = std::get_if<ast::NonFluentValues>(&section.node))
                    parts.values.push_back(values);
        } else if (auto* const instance = std::get_if<ast::Instance>(&block)) {
            parts.instance = instance;
        }
    }
    if (!parts.instance) return parts;
    for (ast::InstanceSection& section : parts.instance->sections) {
        if (auto* const values = std::get_if<ast::NonFluentValues>(&section.node))
            parts.values.push_back(values);
        if (auto* const initial = std::get_if<ast::InitState>(&section.node))
            parts.initial = initial;
    }
    if (!parts.initial) {
        parts.instance->sections.push_back({ast::InitState{}, parts.instance->span});
        parts.initial = std::get_if<ast::InitState>(&parts.instance->sections.back().node);
        // The vector may have moved its sections.
        parts.values.clear();
        return parts_of(program);
    }
    return parts;
}

ast::PVariable& parameter_named(const Parts& parts, const std::string& name) {
    std::vector<std::string> reals;
    for (ast::PVariable* const fluent : parts.non_fluents) {
        if (fluent->name.text == name && fluent->range.text == "real") return *fluent;
        if (fluent->name.text == name)
            throw Failure(fmt::format("'{}' is a non-fluent of type {}: only reals can be fitted",
                                      name, fluent->range.text),
                          {}, usage_error);
        if (fluent->range.text == "real") reals.push_back(fluent->name.text);
    }
    const auto near = did_you_mean(name, reals);
    throw Failure(fmt::format("there is no real non-fluent '{}'{}", name,
                              near ? ending_with_name(near) : std::string()),
                  {}, usage_error);
}

// name'(?p0, ?p1) = name(?p0, ?p1);
ast::Cpf identity(const ast::PVariable& fluent) {
    ast::Cpf cpf;
    cpf.name = fluent.name;
    cpf.primed = true;
    cpf.span = fluent.span;
    ast::Reference same;
    same.name = fluent.name;
    for (std::size_t i = 0; i < fluent.parameters.size(); ++i) {
        const std::string variable = fmt::format("p{}", i);
        cpf.parameters.push_back({variable, fluent.span});
        same.arguments.push_back({ast::Variable{variable}, fluent.span});
    }
    cpf.body = {std::move(same), fluent.span};
    return cpf;
}

}  // namespace

void open_parameters(ast::Program& program, const std::vector<std::string>& names) {
    const Parts parts = parts_of(program);
    for (const std::string& name : names) {
        ast::PVariable& fluent = parameter_named(parts, name);
        if (fluent.kind.text == "state-fluent") continue;  // named twice
        fluent.kind.text = "state-fluent";
        if (parts.cpfs) parts.cpfs->definitions.push_back(identity(fluent));
        for (ast::NonFluentValues* const values : parts.values) {
            const auto is_its = [&](const ast::Assignment& assignment) {
                return assignment.name.text == name;
            };
            if (!parts.initial) continue;
            std::ranges::copy_if(values->assignments,
                                 std::back_inserter(parts.initial->assignments), is_its);
            std::erase_if(values->assignments, is_its);
        }
    }
}

}  // namespace rddlc::workbench
