#include "ground/memory.hpp"

#include "ground/codes.hpp"
#include "ir/layout.hpp"
#include "support/memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rddlc {
namespace {

// How often each value is held: what may change is there twice, before a step and after it.
double copies_of(ir::Storage storage) {
    switch (storage) {
        case ir::Storage::State:
        case ir::Storage::Memory:
            return 2;
        case ir::Storage::Action:
        case ir::Storage::Observation:
        case ir::Storage::Scratch:
            return 1;
        case ir::Storage::Constant:  // as sparse as it is written
        case ir::Storage::Next:
        case ir::Storage::NextMemory:
            break;
    }
    return 0;
}

// Includes the bounds of numbers that the user sees.
double bytes_of(const ir::Buffer& buffer) {
    const bool is_bounded =
        (buffer.storage == ir::Storage::State || buffer.storage == ir::Storage::Action) &&
        buffer.scalar != ir::Scalar::Bool;
    const double bounds = is_bounded ? 2 * sizeof(double) : 0;
    return static_cast<double>(buffer.count()) *
           (copies_of(buffer.storage) * static_cast<double>(ir::size_of(buffer.scalar)) + bounds);
}

}  // namespace

void report_memory(const ir::Program& program, std::int64_t limit, Diagnostics& diagnostics) {
    double all = 0;
    const ir::Buffer* largest = nullptr;
    for (const ir::Buffer& buffer : program.buffers) {
        all += bytes_of(buffer);
        if (!largest || bytes_of(buffer) > bytes_of(*largest)) largest = &buffer;
    }
    if (all <= static_cast<double>(limit)) return;
    diagnostics.report(
        Diagnostic{grounding::too_much_memory, largest->span,
                   fmt::format("one environment of this problem takes {}, more than the limit of "
                               "{}: '{}' alone takes {}",
                               memory_text(all), memory_text(static_cast<double>(limit)),
                               largest->name, memory_text(bytes_of(*largest)))}
            .with_hint(fmt::format("--memory-limit={:.0f}G allows it", std::ceil(all / 0x1p30))));
}

}  // namespace rddlc
