// The last stage: what is left on the disk.
#pragma once

#include "driver/driver.hpp"

#include <string>

namespace rddlc {

// The output in its form, and the dependency file. Reports what goes wrong; throws
// std::logic_error if the C++ compiler refuses the text.
void write_outputs(const CompileOptions& options, const std::string& text, UsedFiles& used,
                   Diagnostics& diagnostics);

}  // namespace rddlc
