#include "command_line/explain_option.hpp"

#include "driver/explain.hpp"

#include <fmt/format.h>

#include <optional>

namespace rddlc::cli {

namespace {

std::string explanation_of(const std::string& word) {
    if (word == "list") return list_of_codes();
    const std::optional<Code> code = parse_code(word);
    const auto page = code ? explain(*code) : std::nullopt;
    if (!page)
        throw UsageError(
            fmt::format("there is no diagnostic '{}'; '--explain list' shows all", word));
    return std::string(*page);
}

}  // namespace

void add_explain_option(Command& command, std::string& explanation) {
    add_option(command, "--explain", "CODE",
               "Explain a diagnostic, such as E0203, and exit; list: all codes",
               [&explanation](const std::string& word) { explanation = explanation_of(word); })
        .is_enough = true;
}

}  // namespace rddlc::cli
