// One reference as a shared object, compiled with -include HEADER and -DREFERENCE=TYPE.
#include "reference.hpp"

// The problem's description is that of the emitted simulator.
extern "C" [[gnu::visibility("default")]] rddl_simulator rddl_reference(
    const rddl_problem* problem) {
    return handwritten::Reference<handwritten::REFERENCE>::simulator(problem);
}
