// Code that does not depend on the simulator, for emitted files that are compiled with
// -DRDDL_LINKS_BATCHES: simulators without packs, and with packs of 16 or 64, the sizes that rddlc
// chooses (ir/lane_count.hpp), of either type of reals; with -DRDDL_BATCHES_OF=double or float of
// that type alone, in half the time.
#include <rddl/interface/abi.hpp>
#include <rddl/lanes/pack.hpp>

#ifdef RDDL_BATCHES_OF
template rddl_simulator rddl::table_of(const SimulatorParts<ScalarOf<RDDL_BATCHES_OF>>&);
template rddl_simulator rddl::table_of(const SimulatorParts<Pack<16, RDDL_BATCHES_OF>>&);
template rddl_simulator rddl::table_of(const SimulatorParts<Pack<64, RDDL_BATCHES_OF>>&);
#else
template rddl_simulator rddl::table_of(const SimulatorParts<ScalarOf<double>>&);
template rddl_simulator rddl::table_of(const SimulatorParts<Pack<16, double>>&);
template rddl_simulator rddl::table_of(const SimulatorParts<Pack<64, double>>&);
template rddl_simulator rddl::table_of(const SimulatorParts<ScalarOf<float>>&);
template rddl_simulator rddl::table_of(const SimulatorParts<Pack<16, float>>&);
template rddl_simulator rddl::table_of(const SimulatorParts<Pack<64, float>>&);
#endif
