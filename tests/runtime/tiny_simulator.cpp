#include "tiny_simulator.hpp"

namespace tiny {

const rddl_simulator* simulator() {
    static const rddl::SimulatorTable<rddl::Compiled<Simulator, problem>,
                                      rddl::Packed<Simulator, problem, 16>>
        table({problem, sites, {}}, {});
    return table.get();
}

}  // namespace tiny
