/* simulator.h must compile as C99. */
#include <rddl/simulator.h>

int c_can_read_the_header(const rddl_simulator* simulator);
int c_can_read_the_header(const rddl_simulator* simulator) {
    return simulator->abi_version == RDDL_ABI_VERSION &&
           simulator->struct_size == sizeof(rddl_simulator);
}
