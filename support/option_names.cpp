#include "support/option_names.hpp"

#include "support/diagnostic.hpp"
#include "support/suggestion.hpp"

#include <algorithm>

namespace rddlc {

namespace {

// "--learning-rate" and "learning_rate" are the same name.
std::string as_keyword(std::string_view name) {
    name.remove_prefix(std::min(name.find_first_not_of('-'), name.size()));
    std::string keyword(name);
    std::ranges::replace(keyword, '-', '_');
    return keyword;
}

// The option that has the name, or another name, for which this holds.
template <class Holds>
std::optional<std::string> find_option(const std::vector<KnownOption>& known, Holds&& holds) {
    for (const KnownOption& option : known)
        if (holds(option.name) || std::ranges::any_of(option.others, holds)) return option.name;
    return std::nullopt;
}

}  // namespace

std::optional<std::string> option_meant(std::string_view given,
                                        const std::vector<KnownOption>& known) {
    const std::string keyword = as_keyword(given);
    if (keyword.empty()) return std::nullopt;
    if (auto same = find_option(
            known, [&](const std::string& name) { return as_keyword(name) == keyword; }))
        return same;
    std::vector<std::string> names, others;
    for (const KnownOption& option : known) {
        names.push_back(option.name);
        others.insert(others.end(), option.others.begin(), option.others.end());
    }
    if (auto near = did_you_mean(given, names)) return near;
    const auto near = did_you_mean(keyword, others);
    if (!near) return std::nullopt;
    return find_option(known, [&](const std::string& name) { return name == *near; });
}

std::string option_meant_text(std::string_view given, const std::vector<KnownOption>& known) {
    return ending_with_name(option_meant(given, known));
}

}  // namespace rddlc
