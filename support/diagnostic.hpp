// Diagnostics are values: a code, a place, a sentence, notes and a hint.
// They are collected per stage and printed in one place (render.hpp).
#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "support/source.hpp"

namespace rddlc {

// 'E' 203 is printed "E0203". Each stage lists its codes in its own codes.hpp;
// docs/diagnostics/E0203.md explains the code to the user.
struct Code {
    char letter;  // 'E' error, 'W' warning
    int number;

    auto operator<=>(const Code&) const = default;
};
std::string to_string(Code code);
// "E0203", "e0203" -> Code; nothing for any other form.
std::optional<Code> parse_code(std::string_view text);

struct Note {
    std::optional<Span> span;  // "declared here" notes have one
    std::string message;
};

// Another text for a place; an empty place inserts.
struct Replacement {
    Span span;
    std::string text;
};

// What to try after a diagnostic.
struct Hint {
    Hint(std::string words = {}, std::vector<Replacement> changes = {})
        : text(std::move(words)), fix(std::move(changes)) {}
    Hint(const char* words) : text(words) {}

    std::string text;  // a whole clause; may be empty
    // The changes that do it, all together, for editors; empty if the hint leaves a choice.
    std::vector<Replacement> fix;
};

struct Diagnostic {
    Code code;
    std::optional<Span> span;  // absent for what has no place, such as a missing file
    std::string message;       // lower case, no full stop, names in single quotes
    std::vector<Note> notes = {};
    std::string hint = {};     // what to try, a whole clause; may be empty
    std::vector<Replacement> fix = {};  // as in Hint; may be there without a hint in words

    // Chaining, so that a report reads as one sentence.
    Diagnostic&& note(Span span, std::string message) &&;
    Diagnostic&& with_hint(Hint hint) &&;
    Diagnostic&& fixed_by(Span span, std::string text) &&;
};

struct DiagnosticOptions {
    std::set<Code> disabled_warnings;  // -Wno-W0210
    bool all_warnings_disabled = false;  // -w
    bool warnings_as_errors = false;   // -Werror
    std::set<Code> codes_as_errors;    // -Werror=W0210
};

class Diagnostics {
  public:
    explicit Diagnostics(DiagnosticOptions options = {}) : options_(std::move(options)) {}

    // Drops silenced warnings; keeps the order of reporting.
    void report(Diagnostic diagnostic);

    bool has_errors() const { return error_count_ > 0; }
    std::size_t error_count() const { return error_count_; }
    const std::vector<Diagnostic>& all() const { return diagnostics_; }
    bool is_error(const Diagnostic& diagnostic) const;

    // Sorts by file and position; diagnostics without a place come first.
    void sort_by_position();

  private:
    DiagnosticOptions options_;
    std::vector<Diagnostic> diagnostics_;
    std::size_t error_count_ = 0;
};

// The candidate nearest to `name` by edit distance, if near enough to be a likely misspelling.
std::optional<std::string> did_you_mean(std::string_view name,
                                        const std::vector<std::string>& candidates);

}  // namespace rddlc
