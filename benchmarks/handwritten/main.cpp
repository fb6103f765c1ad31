// Compares an emitted simulator with one written by hand for the same instance: first whether they
// agree, then how fast they are, taking turns.
//
//     handwritten SIMULATOR.so REFERENCE.so [SECONDS [ROUNDS]]
//
// prints a line of JSON, speeds in steps for a second of processor time, which other programs do
// not inflate. REFERENCE.so is made of reference.cpp.
#include "agreement.hpp"
#include "benchmarks/shared_function.hpp"
#include "measure/measurement.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <stdexcept>

namespace {

using benchmarks::load;
using nlohmann::json;

// Legal actions are slow to draw, and the first steps of a batch are all near the initial state.
constexpr double least_seconds_of_drawing = 2;

json compare(const rddl_simulator& emitted, const rddl_simulator& reference,
             std::int64_t environments, double seconds, int rounds) {
    const auto course = rddlc::workbench::draw_course(emitted, environments,
                                                      std::max(seconds, least_seconds_of_drawing));
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
        throw std::runtime_error("usage: handwritten SIMULATOR.so REFERENCE.so [SECONDS [ROUNDS]]");
    const double seconds = count > 3 ? std::atof(arguments[3]) : 1.0;
    const int rounds = count > 4 ? std::atoi(arguments[4]) : 5;

    const rddl_simulator& emitted =
        *load<const rddl_simulator*()>(arguments[1], "rddl_simulator_entry")();
    const rddl_simulator reference =
        load<rddl_simulator(const rddl_problem*)>(arguments[2], "rddl_reference")(emitted.problem);
    json figures{{"sizes", json::array()}};
    for (const std::int64_t environments : {1, 1024})
        figures["sizes"].push_back(compare(emitted, reference, environments, seconds, rounds));
    std::cout << figures.dump() << "\n";
    return 0;
} catch (const std::exception& error) {
    std::cerr << "handwritten: " << error.what() << "\n";
    return 1;
}
