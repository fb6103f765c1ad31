#include "native/enumeration.hpp"

#include "engines/external_library.hpp"
#include "engines/load_simulator.hpp"
#include "exact/step_outcomes.hpp"
#include "ir/interpreter.hpp"
#include "native/paths.hpp"
#include "native/problem.hpp"

#include <fmt/format.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace nb = nanobind;

namespace rddlc::python {

namespace {

struct Mass {
    double probability = 0, reward = 0;  // the reward times the probability
};
// Outcomes by the record of the state and the causes of an end.
using Distribution = std::map<std::pair<std::string, std::uint8_t>, Mass>;

// Steps with every combination of what is drawn, by the interpreter.
class Enumeration {
  public:
    Enumeration(ir::Program program, workbench::ExternalLibrary library)
        : library_(std::move(library)),
          interpreter_(std::make_unique<ir::Interpreter>(std::move(program), library_.functions)),
          outcomes_(*interpreter_) {}

    // horizon: 0: no horizon. Refuses more than `most` combinations, and those that fault.
    Distribution next_states(const std::string& state, std::int64_t steps,
                             const std::string& action, std::int64_t horizon, std::int64_t most) {
        if (state.size() != interpreter_->state_size() ||
            action.size() != interpreter_->action_size())
            throw Refused("a record of another problem");
        Distribution found;
        std::int64_t combinations = 0;
        const int end = horizon > 0 && steps + 1 >= horizon ? RDDL_TRUNCATED_HORIZON : 0;
        outcomes_.visit(
            bytes(state), bytes(action), steps, [&](const workbench::ListedOutcome& outcome) {
                if (combinations % 256 == 0 && PyErr_CheckSignals() != 0) throw nb::python_error();
                if (++combinations > most)
                    throw Failure(fmt::format(
                        "a step has more than {} combinations of what it draws: allow more by "
                        "most_outcomes, or say samples=1000 for an estimate",
                        most));
                if (outcome.causes & RDDL_FAULTED)
                    throw Failure("one of the outcomes has no result: sample() reports the fault");
                const std::string record(reinterpret_cast<const char*>(outcome.next),
                                         interpreter_->state_size());
                Mass& mass = found[{record, static_cast<std::uint8_t>(outcome.causes | end)}];
                mass.probability += outcome.probability;
                mass.reward += outcome.probability * outcome.reward;
                return true;
            });
        return found;
    }

  private:
    static const std::byte* bytes(const std::string& record) {
        return reinterpret_cast<const std::byte*>(record.data());
    }

    workbench::ExternalLibrary library_;
    std::unique_ptr<const ir::Interpreter> interpreter_;  // stays where it is
    workbench::StepOutcomes outcomes_;
};

Enumeration enumeration_of(const workbench::LoadedProblem& problem, const nb::object& headers) {
    const std::vector<std::string> externs = paths_of(headers);
    workbench::LoadOptions options;
    options.engine = workbench::Engine::Interpreter;
    options.externs = {externs.begin(), externs.end()};
    Compilation compilation = workbench::compile_problem(problem.files, options);
    if (compilation.diagnostics.has_errors()) throw Failure("the problem's files have changed");
    workbench::ExternalLibrary library =
        workbench::external_library(*compilation.program, problem.files, options);
    return Enumeration(*std::move(compilation.program), std::move(library));
}

std::string text_of(const nb::bytes& bytes) {
    return {bytes.c_str(), bytes.size()};
}

}  // namespace

void add_enumeration(nb::module_& module) {
    nb::class_<Enumeration>(module, "Enumeration", "Exact distributions of next states.")
        .def(
            "next_states",
            [](Enumeration& self, const nb::bytes& state, std::int64_t steps,
               const nb::bytes& action, std::int64_t horizon, std::int64_t most) {
                nb::list all;
                for (const auto& [to, mass] :
                     self.next_states(text_of(state), steps, text_of(action), horizon, most))
                    all.append(nb::make_tuple(nb::bytes(to.first.data(), to.first.size()),
                                              static_cast<int>(to.second), mass.probability,
                                              mass.reward / mass.probability));
                return all;
            },
            nb::arg("state"), nb::arg("steps"), nb::arg("action"), nb::arg("horizon"),
            nb::arg("most"), "(record, causes, probability, mean reward) of each next state.");
    module.def("enumeration", enumeration_of, nb::arg("simulator"), nb::arg("externs"));
}

}  // namespace rddlc::python
