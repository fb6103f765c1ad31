// Code that does not depend on the simulator, for emitted files that are compiled with
// -DRDDL_LINKS_BATCHES: simulators without packs, with packs of 16 or 64, the sizes that rddlc
// chooses (ir/lane_count.hpp), and with byte ints, of either type of reals; with
// -DRDDL_BATCHES_OF=double or float of that type alone, in half the time.
#include <rddl/interface/abi.hpp>
#include <rddl/lanes/pack.hpp>

#define RDDL_BATCHES(Real)                                                         \
    template rddl_simulator rddl::table_of(const SimulatorParts<ScalarOf<Real>>&); \
    template rddl_simulator rddl::table_of(const SimulatorParts<Pack<16, Real>>&); \
    template rddl_simulator rddl::table_of(const SimulatorParts<Pack<64, Real>>&);
#ifdef RDDL_SIMD_BYTE_INTS
#define RDDL_BYTE_INT_BATCHES(Real) \
    template rddl_simulator rddl::table_of(const SimulatorParts<ByteIntPack<Real>>&);
#else
#define RDDL_BYTE_INT_BATCHES(Real)
#endif

#ifdef RDDL_BATCHES_OF
RDDL_BATCHES(RDDL_BATCHES_OF)
RDDL_BYTE_INT_BATCHES(RDDL_BATCHES_OF)
#else
RDDL_BATCHES(double)
RDDL_BYTE_INT_BATCHES(double)
RDDL_BATCHES(float)
RDDL_BYTE_INT_BATCHES(float)
#endif
