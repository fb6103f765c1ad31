// at_level LEVEL PROGRAM [ARGUMENTS...]: runs a program that is compiled for a level of x86-64, if
// this processor has it. Exit status 77, which CTest shows as skipped, if not.
#include <unistd.h>

#include <cstdio>
#include <string_view>

namespace {

bool processor_has(std::string_view level) {
#ifdef __x86_64__
    __builtin_cpu_init();
    const bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                    __builtin_cpu_supports("bmi2");
    const bool v4 = v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                    __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
    if (level == "x86-64-v3") return v3;
    if (level == "x86-64-v4") return v4;
    if (level == "x86-64-v4-vbmi")  // as rddlc compiles where it may (rddl/lanes/processor.hpp)
        return v4 && __builtin_cpu_supports("avx512vbmi") &&
               __builtin_cpu_supports("avx512vpopcntdq") && __builtin_cpu_supports("gfni");
#endif
    return level == "portable";
}

}  // namespace

int main(int count, char** arguments) {
    if (count < 3) return 2;
    if (!processor_has(arguments[1])) {
        std::printf("skipped: this processor does not have %s\n", arguments[1]);
        return 77;
    }
    execv(arguments[2], arguments + 2);
    std::perror(arguments[2]);
    return 1;
}
