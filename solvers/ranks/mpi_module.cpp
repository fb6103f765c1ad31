// The only file that knows MPI: a library that programs load when they are started by mpirun.
#include "solvers/ranks/module.hpp"

// The classes for C++ are left out; MPI has given them up.
#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1
#include <mpi.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace rddlc::solvers {
namespace {

constexpr std::size_t most_at_once = std::size_t{1} << 28;  // MPI counts in ints

void start(int* number, int* count) {
    // A rank lets others have its core while it waits: with fewer cores than processes, training
    // takes half of the time.
    ::setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
    int given = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &given);
    MPI_Comm_rank(MPI_COMM_WORLD, number);
    MPI_Comm_size(MPI_COMM_WORLD, count);
}

template <class Number>
void add(Number* numbers, std::size_t count, MPI_Datatype type) {
    for (std::size_t done = 0; done < count; done += most_at_once)
        MPI_Allreduce(MPI_IN_PLACE, numbers + done,
                      static_cast<int>(std::min(most_at_once, count - done)), type, MPI_SUM,
                      MPI_COMM_WORLD);
}

void add_floats(float* numbers, std::size_t count) {
    add(numbers, count, MPI_FLOAT);
}

void add_doubles(double* numbers, std::size_t count) {
    add(numbers, count, MPI_DOUBLE);
}

void gather(const char* bytes, std::size_t size,
            void (*take)(void* to, const char* bytes, std::size_t size), void* to) {
    int count = 0, number = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &count);
    MPI_Comm_rank(MPI_COMM_WORLD, &number);
    std::vector<unsigned long long> sizes(static_cast<std::size_t>(count));
    const unsigned long long own = size;
    MPI_Allgather(&own, 1, MPI_UNSIGNED_LONG_LONG, sizes.data(), 1, MPI_UNSIGNED_LONG_LONG,
                  MPI_COMM_WORLD);
    std::vector<char> room;
    for (int rank = 0; rank < count; ++rank) {
        room.resize(sizes[static_cast<std::size_t>(rank)]);
        if (rank == number) std::copy_n(bytes, size, room.data());
        for (std::size_t done = 0; done < room.size(); done += most_at_once)
            MPI_Bcast(room.data() + done,
                      static_cast<int>(std::min(most_at_once, room.size() - done)), MPI_CHAR, rank,
                      MPI_COMM_WORLD);
        take(to, room.data(), room.size());
    }
}

void finish() {
    MPI_Finalize();
}

void end_all(int status) {
    MPI_Abort(MPI_COMM_WORLD, status);
}

}  // namespace
}  // namespace rddlc::solvers

extern "C" const rddlc::solvers::RanksModule* rddl_ranks_module() {
    using namespace rddlc::solvers;
    static constexpr RanksModule module{
        ranks_module_version, start, add_floats, add_doubles, gather, finish, end_all};
    return &module;
}
