// Some of the blocks of a batch.
#pragma once

#include <cstdint>

namespace rddl {

// Half-open.
struct Range {
    std::int64_t begin;
    std::int64_t end;
};

}  // namespace rddl
