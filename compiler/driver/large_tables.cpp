#include "driver/large_tables.hpp"

#include "driver/codes.hpp"

#include <fmt/format.h>

namespace rddlc {
namespace {

// The limit of all values in an emitted file.
constexpr std::int64_t most_values = std::int64_t{1} << 25;

}  // namespace

void report_large_constant_tables(const ir::Program& program, Diagnostics& diagnostics) {
    std::int64_t values = 0;
    for (const ir::Buffer& buffer : program.buffers) {
        if (buffer.storage != ir::Storage::Constant) continue;
        const bool fits = buffer.count() <= most_values - values;
        if (fits) values += buffer.count();
        if (fits) continue;
        diagnostics.report({table_too_large, buffer.span,
                            fmt::format("'{}' has {} values, and which of them are needed is known "
                                        "only when the simulator runs",
                                        buffer.name, buffer.count())});
    }
}

}  // namespace rddlc
