// The last stage: what is left on the disk.
#pragma once

#include "driver/driver.hpp"

#include <string>

namespace rddlc {

struct OutputTexts {
    const std::string& cpp;
    const std::string& declaration;
};

// The output in its form, its declaration and the dependency file. Reports what goes wrong; throws
// std::logic_error if the C++ compiler refuses the text.
void write_outputs(const CompileOptions& options, const OutputTexts& texts, UsedFiles& used,
                   Diagnostics& diagnostics);

}  // namespace rddlc
