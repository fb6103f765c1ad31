// The answers to requests, a file for each. Each takes the names around a file and gives the result
// of the protocol, which may be null.
#pragma once

#include "lsp/checks.hpp"
#include "lsp/lookup.hpp"
#include "support/standard.hpp"

#include <stdexcept>

namespace rddlc::lsp {

// A request that cannot be answered, with a sentence for the user.
struct Refusal : std::runtime_error {
    using std::runtime_error::runtime_error;
};

Json hover(const Lookup& lookup, std::uint32_t offset, const FileChecks& checks);

// navigation.cpp
Json definition(const Lookup& lookup, std::uint32_t offset);
Json references(const Lookup& lookup, std::uint32_t offset, bool with_declaration);
Json highlights(const Lookup& lookup, std::uint32_t offset);

// rename.cpp: throws a Refusal
Json prepare_rename(const Lookup& lookup, std::uint32_t offset);
Json rename(const Lookup& lookup, std::uint32_t offset, std::string name);

Json completion(const Lookup& lookup, std::uint32_t offset, Standard standard);
Json document_symbols(const File& file);
Json formatting(const File& file, Standard standard);
Json inlay_hints(const Lookup& lookup, Place place);
// The fixes of the diagnostics that a place touches.
Json quick_fixes(const FileChecks& checks, const Json& range);

}  // namespace rddlc::lsp
