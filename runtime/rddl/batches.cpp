// What does not depend on the simulator, for emitted files that are compiled with
// -DRDDL_LINKS_BATCHES: simulators without packs, and with packs of 16, of either type of
// reals.
#include <rddl/abi.hpp>
#include <rddl/pack.hpp>

template rddl_simulator rddl::table_of(const SimulatorParts<Scalar>&);
template rddl_simulator rddl::table_of(const SimulatorParts<Pack<16>>&);
template rddl_simulator rddl::table_of(const SimulatorParts<ScalarOf<float>>&);
template rddl_simulator rddl::table_of(const SimulatorParts<Pack<16, float>>&);
