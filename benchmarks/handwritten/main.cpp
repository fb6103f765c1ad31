// Compares an emitted simulator with one written by hand for the same instance: first whether they
// agree, then how fast they are, taking turns.
//
//     handwritten NAME SIMULATOR.so [SECONDS [ROUNDS]]
//
// prints a line of JSON, speeds in steps for a second of processor time, which other programs do not
// inflate. NAME is the name of the problem.
#include "agreement.hpp"
#include "cart_pole.hpp"
#include "measure/measurement.hpp"
#include "mountain_car.hpp"
#include "pendulum.hpp"
#include "reservoir.hpp"
#include "sysadmin.hpp"
#include "wildfire.hpp"

#include <dlfcn.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>

namespace {

using nlohmann::json;

using Maker = rddl_simulator (*)(const rddl_problem*);
const std::map<std::string, Maker> references = {
    {"MountainCar_ippc2023", handwritten::Reference<handwritten::MountainCar>::simulator},
    {"CartPole_Continuous_gym", handwritten::Reference<handwritten::CartPole>::simulator},
    {"Pendulum_gym", handwritten::Reference<handwritten::Pendulum>::simulator},
    {"SysAdmin_MDP_ippc2011", handwritten::Reference<handwritten::SysAdmin>::simulator},
    {"Wildfire_MDP_ippc2014", handwritten::Reference<handwritten::Wildfire>::simulator},
    {"Reservoir_ippc2023", handwritten::Reference<handwritten::Reservoir>::simulator},
};

const rddl_simulator& load(const char* file) {
    void* const library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    if (!library) throw std::runtime_error(dlerror());
    const auto entry =
        reinterpret_cast<rddl_simulator_entry_function>(dlsym(library, "rddl_simulator_entry"));
    if (!entry) throw std::runtime_error(std::string(file) + " is no simulator");
    return *entry();
}

json compare(const rddl_simulator& emitted, const rddl_simulator& reference,
             std::int64_t environments, double seconds, int rounds) {
    const auto course = rddlc::workbench::draw_course(emitted, environments, seconds);
    json figures{{"environments", environments},
                 {"difference", handwritten::greatest_difference(emitted, reference, course)},
                 {"emitted", json::array()},
                 {"handwritten", json::array()}};
    for (int round = 0; round < rounds; ++round) {
        const auto speed = [&](const rddl_simulator& simulator) {
            const auto measured = rddlc::workbench::measure(simulator, course, {0, 1}, seconds);
            return static_cast<double>(measured.steps) / measured.processor_seconds;
        };
        figures["emitted"].push_back(speed(emitted));
        figures["handwritten"].push_back(speed(reference));
    }
    return figures;
}

}  // namespace

int main(int count, char** arguments) try {
    if (count < 3)
        throw std::runtime_error("usage: handwritten NAME SIMULATOR.so [SECONDS [ROUNDS]]");
    const auto found = references.find(arguments[1]);
    if (found == references.end()) throw std::runtime_error("no reference for this problem");
    const double seconds = count > 3 ? std::atof(arguments[3]) : 1.0;
    const int rounds = count > 4 ? std::atoi(arguments[4]) : 5;

    const rddl_simulator& emitted = load(arguments[2]);
    const rddl_simulator reference = found->second(emitted.problem);
    json figures{{"problem", arguments[1]}, {"sizes", json::array()}};
    for (const std::int64_t environments : {1, 1024})
        figures["sizes"].push_back(compare(emitted, reference, environments, seconds, rounds));
    std::cout << figures.dump() << "\n";
    return 0;
} catch (const std::exception& error) {
    std::cerr << "handwritten: " << error.what() << "\n";
    return 1;
}
