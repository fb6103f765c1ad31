// The entry of a shared object that holds a simulator once for each instruction set of x86-64.
//
// Functions that are in several of its objects are taken from the first that the linker reads, so
// this one, compiled for any processor, comes first, and then those of lower sets before higher.
#include <rddl/lanes/processor.hpp>
#include <rddl/simulator.h>

extern "C" {

const rddl_simulator* rddl_simulator_sse2(void);
const rddl_simulator* rddl_simulator_avx2(void);
const rddl_simulator* rddl_simulator_avx512(void);

RDDL_EXPORT const rddl_simulator* rddl_simulator_entry(void) {
    switch (rddl::allowed_instruction_set()) {
        case rddl::InstructionSet::Avx512:
            return rddl_simulator_avx512();
        case rddl::InstructionSet::Avx2:
            return rddl_simulator_avx2();
        case rddl::InstructionSet::Sse2:
            break;
    }
    return rddl_simulator_sse2();
}

}  // extern "C"
