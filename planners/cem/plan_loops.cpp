#include "planners/cem/plan_loops.hpp"

#include <rddl/lanes/processor.hpp>

#include <bit>
#include <limits>

namespace rddlc::planners {

// The same text for each instruction set. The headers above are compiled for any processor.
namespace portable {
#include "planners/cem/plan_loops_variant.hpp"
}

#ifdef __x86_64__
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif
namespace avx2 {
#include "planners/cem/plan_loops_variant.hpp"
}
#ifdef __clang__
#pragma clang attribute pop
#pragma clang attribute push(                                                    \
    __attribute__((target("avx512f,avx512bw,avx512cd,avx512dq,avx512vl,avx2"))), \
    apply_to = function)
#else
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("avx512f,avx512bw,avx512cd,avx512dq,avx512vl,avx2,prefer-vector-width=512")
#endif
namespace avx512 {
#include "planners/cem/plan_loops_variant.hpp"
}
#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

const PlanLoops& plan_loops() {
    switch (rddl::allowed_instruction_set()) {
        case rddl::InstructionSet::Avx512:
            return avx512::loops;
        case rddl::InstructionSet::Avx2:
            return avx2::loops;
        case rddl::InstructionSet::Sse2:
            break;
    }
    return portable::loops;
}
#else
const PlanLoops& plan_loops() {
    return portable::loops;
}
#endif

}  // namespace rddlc::planners
