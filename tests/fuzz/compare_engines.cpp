// Compares compiled simulators with the interpreter, bit for bit: single environments and packs.
//
//   fuzz_engines OBJECT.so
//       reads one JSON object a line, writes one a line:
//       {"file": "problem.rddl", "entry": "rddl_simulator_fuzz_i7", "fast_math": false,
//        "wild": false, "steps": 12}
//       {"lanes": 16, "instruction_set": "AVX2", "ends": 3, "faults": 1, "difference": ""}
//       {"too_large": true}
//
// Environments start from the initial state, and now and then from a random one, which holds nan
// and the like if it is wild. They take random actions, or every other step those of the policy
// block, if there is one.
#include "../conformance/stepping.hpp"
#include "driver/driver.hpp"
#include "engines/interpreted_simulator.hpp"
#include "exercise.hpp"
#include "twins.hpp"

#include <dlfcn.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <exception>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace stepping;
using nlohmann::json;
using Simulator = std::shared_ptr<const rddl_simulator>;

// Null for a problem that is too large.
Simulator interpreted(const json& request) {
    rddlc::CompileOptions options;
    options.inputs = {request.at("file").get<std::string>()};
    options.stop_after = rddlc::Stage::Optimise;
    options.standard = rddlc::Standard::Rddlc;
    options.passes.fast_math = request.value("fast_math", false);
    for (const json& name : request.value("without", json::array()))
        options.passes.without.insert(name);
    rddlc::Compilation compilation = rddlc::compile(options);
    if (!compilation.program) throw std::runtime_error("rejected");
    const double most_operations = rddlc::fuzzing::Exercise{}.most_operations;
    if (rddlc::fuzzing::step_cost(*compilation.program) > most_operations) return nullptr;
    return rddlc::workbench::interpreted_simulator(*std::move(compilation.program),
                                                   std::move(compilation.sources));
}

const rddl_simulator& compiled(void* object, const std::string& name) {
    void* const entry = dlsym(object, name.c_str());
    if (!entry) throw std::runtime_error(dlerror());
    return *reinterpret_cast<rddl_simulator_entry_function>(entry)();
}

// One nan is like another.
void make_nan_unique(Bytes& records, const rddl_problem& problem, std::int64_t size, auto role) {
    for (int f = 0; f < problem.fluent_count; ++f) {
        const rddl_fluent& fluent = problem.fluents[f];
        if (fluent.role != role || fluent.scalar != RDDL_REAL) continue;
        for (std::int64_t at = fluent.offset; at < std::ssize(records); at += size) {
            for (std::int64_t i = 0; i < fluent.count; ++i) {
                std::uint8_t* const place = records.data() + at + 8 * i;
                double value;
                std::memcpy(&value, place, sizeof value);
                if (std::isnan(value)) value = std::nan("");
                std::memcpy(place, &value, sizeof value);
            }
        }
    }
}

void make_nan_unique(Told& told, const rddl_problem& problem) {
    make_nan_unique(told.states, problem, problem.state_size, RDDL_STATE);
    const auto role = problem.partially_observed ? RDDL_OBSERVATION : RDDL_STATE;
    for (Bytes* records : {&told.observations, &told.final_observations})
        make_nan_unique(*records, problem, problem.observation_size, role);
    for (double& reward : told.rewards)
        if (std::isnan(reward)) reward = std::nan("");
}

struct Engine {
    std::string name;
    std::unique_ptr<ObservedBatch> batch;
    std::vector<std::int32_t> violated = {};
    Bytes actions = {};

    void look(const Bytes& taken) {
        const rddl_simulator& simulator = batch->simulator();
        violated.resize(batch->told.rewards.size());
        simulator.violated_preconditions(batch->get(), taken.data(), violated.data());
        if (!simulator.policy) return;
        actions.assign(taken.size(), 0);
        simulator.policy_act(batch->get(), actions.data());
        make_nan_unique(actions, *simulator.problem, simulator.problem->action_size, RDDL_ACTION);
    }
};

std::string difference(const Engine& expected, const Engine& found) {
    if (expected.violated != found.violated) return "violated preconditions";
    if (expected.actions != found.actions) return "the policy's actions";
    const char* const what = difference(expected.batch->told, found.batch->told);
    return what ? what : "";
}

json compare(void* object, const json& request) {
    const Simulator oracle = interpreted(request);
    if (!oracle) return {{"too_large", true}};
    const rddl_simulator& simulator = compiled(object, request.at("entry").get<std::string>());
    const int lanes = simulator.lane_count, count = lanes + 5, steps = request.value("steps", 12);
    std::vector<Engine> engines;
    engines.push_back({"interpreter", std::make_unique<ObservedBatch>(*oracle, count, 1, 1)});
    engines.push_back({"single", std::make_unique<ObservedBatch>(simulator, count, 1, 1)});
    if (lanes > 1)
        engines.push_back({"packs", std::make_unique<ObservedBatch>(simulator, count, lanes, 1)});
    Records actions(simulator, static_cast<std::size_t>(count), RDDL_ACTION);
    Records states(simulator, static_cast<std::size_t>(count), RDDL_STATE,
                   request.value("wild", false) ? Given::Anything : Given::Usual);
    json answer = {{"lanes", lanes},
                   {"instruction_set", simulator.instruction_set},
                   {"ends", 0},
                   {"faults", 0},
                   {"difference", ""}};
    for (int step = 0; step < steps; ++step) {
        actions.draw();
        if (step % 4 == 3) states.draw();
        for (Engine& engine : engines) {
            if (step % 4 == 3)
                engine.batch->simulator().set_state(engine.batch->get(), 0, count,
                                                    states.records.data(), nullptr);
            engine.look(actions.records);
            const bool decides = simulator.policy && step % 2 == 0;
            engine.batch->step(decides ? engine.actions : actions.records);
            make_nan_unique(engine.batch->told, *simulator.problem);
        }
        for (const std::uint8_t causes : engines[0].batch->told.causes) {
            answer["ends"] = answer["ends"].get<int>() + (causes != RDDL_RUNNING);
            answer["faults"] = answer["faults"].get<int>() + ((causes & RDDL_FAULTED) != 0);
        }
        for (std::size_t i = 1; i < engines.size(); ++i) {
            const std::string what = difference(engines[0], engines[i]);
            if (what.empty()) continue;
            answer["difference"] =
                engines[i].name + ": " + what + " in step " + std::to_string(step);
            return answer;
        }
    }
    return answer;
}

}  // namespace

int main(int argument_count, char** arguments) {
    if (argument_count != 2) give_up("usage: fuzz_engines OBJECT.so");
    void* const object = dlopen(arguments[1], RTLD_NOW);
    if (!object) give_up(dlerror());
    for (std::string line; std::getline(std::cin, line);) {
        json answer;
        try {
            answer = compare(object, json::parse(line));
        } catch (const std::exception& error) {
            answer = {{"difference", error.what()}};
        }
        std::cout << answer.dump() << std::endl;
    }
}
