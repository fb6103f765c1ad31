// The simulator is a shared object, named on the command line.
#include <dlfcn.h>

#include "episode.hpp"

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    void* const library = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        std::fprintf(stderr, "%s\n", dlerror());
        return 1;
    }
    const auto entry =
        reinterpret_cast<rddl_simulator_entry_function>(dlsym(library, "rddl_simulator_entry"));
    return entry ? print_episode(entry()) : 1;
}
