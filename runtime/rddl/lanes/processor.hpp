// The levels of x86-64 that simulators are compiled for, and which of them this processor has.
#pragma once

#include <cstdlib>
#include <cstring>

namespace rddl {

enum class InstructionSet { Sse2, Avx2, Avx512 };  // x86-64, x86-64-v3, x86-64-v4

#ifdef __x86_64__

// The greatest one of this processor.
inline InstructionSet processor_instruction_set() {
    __builtin_cpu_init();
    const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2") &&
                          __builtin_cpu_supports("fma");
    if (!has_avx2) return InstructionSet::Sse2;
    const bool has_avx512 =
        __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512cd");
    return has_avx512 ? InstructionSet::Avx512 : InstructionSet::Avx2;
}

// Whether it also has what processors with AVX-512 have gained since 2019: permutations of the
// bytes of a register, counts of bits, and products of matrices of bits.
inline bool processor_permutes_bytes() {
    __builtin_cpu_init();
    return __builtin_cpu_supports("avx512vbmi") && __builtin_cpu_supports("avx512vpopcntdq") &&
           __builtin_cpu_supports("gfni");
}

// The same, but no greater than the environment variable RDDL_INSTRUCTION_SET allows: sse2, avx2
// or avx512. Other words allow all.
inline InstructionSet allowed_instruction_set() {
    const InstructionSet processor = processor_instruction_set();
    const char* const limit = std::getenv("RDDL_INSTRUCTION_SET");
    if (limit == nullptr) return processor;
    if (std::strcmp(limit, "sse2") == 0) return InstructionSet::Sse2;
    if (std::strcmp(limit, "avx2") == 0 && processor == InstructionSet::Avx512)
        return InstructionSet::Avx2;
    return processor;
}

#endif

}  // namespace rddl
