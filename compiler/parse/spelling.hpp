// Spellings of other languages: 1e-3, &&, /* */, and characters that RDDL does not have.
#pragma once

#include "parse/distribution_names.hpp"
#include "parse/tokens.hpp"

namespace rddlc {

// Reports such tokens and returns the others, with what was meant in place of what was written
// where that is clear: the parser shall find no second error in the same place.
TokenList repair_spelling(FileId file, const Source& source, Standard standard, TokenList tokens,
                          Diagnostics& diagnostics);

}  // namespace rddlc
