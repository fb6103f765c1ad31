#include "driver/given_blocks.hpp"

#include "check/check.hpp"
#include "driver/codes.hpp"
#include "support/match.hpp"
#include "support/suggestion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <variant>
#include <vector>

namespace rddlc {
namespace {

void report_no_instance(const std::string& name, std::vector<std::string> names,
                        Diagnostics& diagnostics) {
    constexpr std::size_t most_shown = 10;
    std::string hint = "the files hold no instance";
    if (const auto near = did_you_mean(name, names)) {
        hint = hint_of_name(near);
    } else if (!names.empty()) {
        const bool all = names.size() <= most_shown;
        if (!all) names.resize(most_shown);
        hint = fmt::format("the files hold '{}'{}", fmt::join(names, "', '"), all ? "" : ", ...");
    }
    diagnostics.report(
        Diagnostic{no_such_instance, {}, fmt::format("there is no instance '{}'", name)}.with_hint(
            std::move(hint)));
}

}  // namespace

void take_policy_alone(ast::Program& tree, FileId file, const Sources& sources,
                       Diagnostics& diagnostics) {
    const auto is_of_file = [&](const ast::Block& block) {
        return match(block, [](const auto& any) { return any.span; }).file == file;
    };
    const auto is_policy_of_file = [&](const ast::Block& block) {
        return is_of_file(block) && std::holds_alternative<ast::Policy>(block);
    };
    if (std::ranges::none_of(tree.blocks, is_policy_of_file))
        diagnostics.report(
            Diagnostic{no_policy_block,
                       {},
                       fmt::format("there is no policy block in '{}'", sources[file].path())}
                .with_hint("write one: policy NAME { cpfs { ... }; }"));
    std::erase_if(tree.blocks, [&](const ast::Block& block) {
        return is_of_file(block) && !std::holds_alternative<ast::Policy>(block);
    });
}

void take_instance(ast::Program& tree, const std::string& name, Diagnostics& diagnostics) {
    std::vector<std::string> names;
    std::string non_fluents;
    bool has_its_own = false;
    for (const ast::Block& block : tree.blocks) {
        const auto* instance = std::get_if<ast::Instance>(&block);
        if (!instance) continue;
        names.push_back(instance->name.text);
        if (instance->name.text != name) continue;
        const ast::Name* named = named_non_fluents(*instance);
        non_fluents = named ? named->text : "";
        has_its_own = std::ranges::any_of(instance->sections, [](const ast::InstanceSection& each) {
            return std::holds_alternative<ast::NonFluentValues>(each.node);
        });
    }
    if (std::ranges::find(names, name) == names.end())
        return report_no_instance(name, std::move(names), diagnostics);
    const auto is_named = [&](const ast::Block& block) {
        const auto* each = std::get_if<ast::NonFluents>(&block);
        return each && each->name.text == non_fluents;
    };
    const bool is_there = std::ranges::any_of(tree.blocks, is_named);
    std::erase_if(tree.blocks, [&](const ast::Block& block) {
        const auto* instance = std::get_if<ast::Instance>(&block);
        if (instance) return instance->name.text != name;
        return (is_there || has_its_own) && std::holds_alternative<ast::NonFluents>(block) &&
               !is_named(block);
    });
}

}  // namespace rddlc
