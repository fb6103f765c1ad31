// Spellings of other languages: 1e-3, &&, /* */, and characters that RDDL does not have.
#pragma once

#include "parse/distribution_names.hpp"
#include "parse/tokens.hpp"

namespace rddlc {

// Reports such tokens and returns the others, with the meant token in place of the written one if
// that is clear: the parser must not find a second error in the same place.
TokenList repair_spelling(FileId file, const Source& source, Standard standard, TokenList tokens,
                          Diagnostics& diagnostics);

}  // namespace rddlc
