#include "engines/faults.hpp"

#include <fmt/format.h>

namespace rddlc::workbench {

std::string source_text(const rddl_source& source) {
    return fmt::format("{}:{}:{}", source.file, source.line, source.column);
}

}  // namespace rddlc::workbench
