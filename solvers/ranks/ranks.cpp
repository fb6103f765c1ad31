#include "solvers/ranks/ranks.hpp"

#include "support/program.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>

namespace rddlc::solvers {

namespace fs = std::filesystem;

namespace {

using namespace std::chrono_literals;

// The number of processes that mpirun has started: 1 without mpirun, 0 if it does not say. The
// names are those of Open MPI, of MPICH and srun, and of PMIx.
int processes_started() {
    for (const char* const name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MPI_LOCALNRANKS"})
        if (const char* const count = std::getenv(name)) return std::atoi(count);
    return std::getenv("PMIX_RANK") ? 0 : 1;
}

// Looks beside the program, both installed and built; then in the folder where rddlc was installed.
const RanksModule* load_module() {
    std::error_code ignored;
    const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
    for (const fs::path& folder :
         {program.parent_path().parent_path() / RDDL_MODULES_FROM_PREFIX, fs::path(RDDL_MODULES)}) {
        const fs::path file = folder / "rddl_mpi.so";
        if (!fs::exists(file, ignored)) continue;
        // Libraries that MPI loads look for its functions.
        void* const library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
        if (!library) throw Failure(fmt::format("cannot load MPI: {}", ::dlerror()));
        const auto get =
            reinterpret_cast<const RanksModule* (*)()>(::dlsym(library, ranks_module_function));
        const RanksModule* const module = get ? get() : nullptr;
        if (!module || module->version != ranks_module_version)
            throw Failure(fmt::format("'{}' is of another version", file.string()));
        return module;
    }
    return nullptr;
}

Ranks start_ranks(std::string_view program) {
    const int processes = processes_started();
    if (processes == 1) return {};
    Ranks ranks;
    ranks.module = load_module();
    if (!ranks.module && processes == 0) return {};
    if (!ranks.module)
        throw Failure(fmt::format("mpirun has started {} processes, and this {} was built without "
                                  "MPI: each would learn by itself",
                                  processes, program),
                      "install libopenmpi-dev and build it again, or start it without mpirun",
                      usage_error);
    ranks.module->start(&ranks.number, &ranks.count);
    if (processes > 1 && ranks.count != processes)
        throw Failure(fmt::format("mpirun has started {} processes, of which MPI knows {}",
                                  processes, ranks.count),
                      "use the mpirun of the MPI that rddlc was built with", usage_error);
    return ranks;
}

struct Meeting {
    explicit Meeting(const Ranks& ranks) : count(*ranks.meetings) { ++count; }
    ~Meeting() { ++count; }
    std::atomic<std::uint64_t>& count;
};

// mpirun stops the others when one of them dies. They wait for it, and would be killed.
class Watch {
  public:
    Watch(const Ranks& ranks, std::string_view program, const std::function<bool()>& stops)
        : thread_([this, ranks, program, stops] {
              std::uint64_t seen = 0;
              int waits = 0;
              while (!ends_) {
                  std::this_thread::sleep_for(50ms);
                  const std::uint64_t now = *ranks.meetings;
                  waits = now == seen && now % 2 == 1 && stops && stops() ? waits + 1 : 0;
                  seen = now;
                  if (waits < 8) continue;
                  tell(
                      "{}: error: rank {} lost contact with another rank, which has ended\n"
                      "  the last checkpoint is whole, and --resume continues from it\n",
                      program, ranks.number);
                  ::_exit(diagnosed);
              }
          }) {}
    ~Watch() {
        ends_ = true;
        thread_.join();
    }

  private:
    std::atomic<bool> ends_ = false;
    std::thread thread_;
};

// Leaves it to the first rank to report what all have seen; it then ends the others by a signal.
void let_the_first_tell(const std::function<bool()>& stops) {
    for (int i = 0; i < 20; ++i) {
        std::this_thread::sleep_for(50ms);
        if (stops && stops()) ::_exit(diagnosed);
    }
}

}  // namespace

void Ranks::add_up(std::span<float> numbers) const {
    if (count == 1) return;
    const Meeting meeting(*this);
    module->add_floats(numbers.data(), numbers.size());
}

void Ranks::add_up(std::span<double> numbers) const {
    if (count == 1) return;
    const Meeting meeting(*this);
    module->add_doubles(numbers.data(), numbers.size());
}

std::vector<std::string> Ranks::gather(std::string_view own) const {
    if (count == 1) return {std::string(own)};
    const Meeting meeting(*this);
    std::vector<std::string> all;
    module->gather(
        own.data(), own.size(),
        [](void* to, const char* bytes, std::size_t size) {
            static_cast<std::vector<std::string>*>(to)->emplace_back(bytes, size);
        },
        &all);
    return all;
}

bool Ranks::any(bool holds) const {
    double sum = holds ? 1 : 0;
    add_up({&sum, 1});
    return sum > 0;
}

ExitStatus run_on_ranks(std::string_view program, const std::function<bool()>& stops,
                        const std::function<ExitStatus(const Ranks&)>& work) {
    Ranks ranks = start_ranks(program);
    if (ranks.count == 1) {
        const ExitStatus status = work(ranks);
        if (ranks.module) ranks.module->finish();
        return status;
    }
    std::atomic<std::uint64_t> meetings = 0;
    ranks.meetings = &meetings;
    const Watch watch(ranks, program, stops);
    bool fails = false;
    const auto status = static_cast<ExitStatus>(run_program(program, "", [&] {
        try {
            return work(ranks);
        } catch (...) {
            fails = true;
            if (!ranks.is_first()) let_the_first_tell(stops);
            throw;
        }
    }));
    if (fails) ranks.module->end_all(status);
    ranks.module->finish();
    return status;
}

}  // namespace rddlc::solvers
