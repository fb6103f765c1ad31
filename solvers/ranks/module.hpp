// The interface between a program and the library that knows MPI. Programs load that library only
// if mpirun started them, so that other programs do not pay for it.
#pragma once

#include <cstddef>

namespace rddlc::solvers {

// All functions but the first and the last are called by all ranks, in the same order.
struct RanksModule {
    int version;
    void (*start)(int* number, int* count);
    // Each number becomes the sum of those of all ranks; all ranks get the same bits.
    void (*add_floats)(float* numbers, std::size_t count);
    void (*add_doubles)(double* numbers, std::size_t count);
    // Takes the bytes of each rank, in the order of the ranks.
    void (*gather)(const char* bytes, std::size_t size,
                   void (*take)(void* to, const char* bytes, std::size_t size), void* to);
    void (*finish)();
    void (*end_all)(int status);  // ends all ranks at once; does not return
};
inline constexpr int ranks_module_version = 1;
inline constexpr const char* ranks_module_function = "rddl_ranks_module";
// extern "C" const RanksModule* rddl_ranks_module();

}  // namespace rddlc::solvers
