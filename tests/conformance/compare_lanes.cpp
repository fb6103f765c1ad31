// Steps the same environments one by one, in packs, and in packs by two threads, and compares all
// bits of their outputs.
//
//     compare_lanes SIMULATOR.so STEPS ENVIRONMENTS
//
// Every second environment takes a choice (one value that is not the default), the others any
// action: every value drawn within its bounds. Preconditions are ignored, so that faults are also
// compared. Prints what was compared. Exit status: 0 if all agree, 1 if not, 2 if nothing could be
// compared.
#include "stepping.hpp"

#include <dlfcn.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace stepping;

const rddl_simulator& load(const char* path) {
    void* const object = dlopen(path, RTLD_NOW);
    if (!object) give_up(dlerror());
    void* const entry = dlsym(object, "rddl_simulator_entry");
    if (!entry) give_up(dlerror());
    return *reinterpret_cast<rddl_simulator_entry_function>(entry)();
}

}  // namespace

int main(int argument_count, char** arguments) {
    if (argument_count != 4) give_up("usage: compare_lanes SIMULATOR.so STEPS ENVIRONMENTS");
    const rddl_simulator& simulator = load(arguments[1]);
    const int steps = std::atoi(arguments[2]);
    const int count = std::atoi(arguments[3]);
    const int lanes = simulator.lane_count;
    ObservedBatch scalar(simulator, count, 1, 1);
    ObservedBatch packs(simulator, count, lanes, 1);
    ObservedBatch threads(simulator, count, lanes, 2);
    Records actions(simulator, static_cast<std::size_t>(count), RDDL_ACTION);
    std::int64_t ends = 0, faults = 0;
    for (int step = 0; step < steps; ++step) {
        actions.draw();
        for (ObservedBatch* const batch : {&scalar, &packs, &threads}) batch->step(actions.records);
        for (const std::uint8_t causes : scalar.told.causes) {
            ends += causes != RDDL_RUNNING;
            faults += (causes & RDDL_FAULTED) != 0;
        }
        for (const ObservedBatch* const other : {&packs, &threads})
            if (const char* const what = difference(scalar.told, other->told)) {
                std::printf("%s differ in step %d%s\n", what, step,
                            other == &threads ? ", with two threads" : "");
                return 1;
            }
    }
    std::printf("%d lanes (%s), %lld ends, %lld of them faults\n", lanes, simulator.instruction_set,
                static_cast<long long>(ends), static_cast<long long>(faults));
}
