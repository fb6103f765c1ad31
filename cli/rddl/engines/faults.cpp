#include "engines/faults.hpp"

#include <fmt/format.h>

namespace rddlc::cli {

std::string fault_text(const rddl_simulator& simulator, const rddl_batch& batch,
                       std::int64_t environment) {
    rddl_fault fault{};
    if (simulator.get_fault(&batch, environment, &fault) != RDDL_OK || !fault.faulty) return {};
    return fault.message;
}

std::string source_text(const rddl_source& source) {
    return fmt::format("{}:{}:{}", source.file, source.line, source.column);
}

}  // namespace rddlc::cli
