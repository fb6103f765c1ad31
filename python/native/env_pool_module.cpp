// The batch as Python sees it.
#include "native/env_pool.hpp"

#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <span>

namespace nb = nanobind;

namespace rddlc::python {

namespace {

using Array = nb::ndarray<nb::numpy>;
using Bytes = nb::ndarray<std::uint8_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using ConstBytes = nb::ndarray<const std::uint8_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Records = nb::ndarray<const std::uint8_t, nb::c_contig, nb::device::cpu>;
using Integers = nb::ndarray<const std::int64_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Matrix = nb::ndarray<std::uint8_t, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Counts = nb::ndarray<std::int64_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Values = nb::ndarray<const float, nb::c_contig, nb::device::cpu>;

// The memory belongs to the batch, which lives as long as the array.
Array rows(nb::handle owner, void* data, std::int64_t count, std::int64_t columns,
           nb::dlpack::dtype type) {
    const std::size_t shape[] = {static_cast<std::size_t>(count),
                                 static_cast<std::size_t>(columns)};
    return Array(data, 2, shape, owner, nullptr, type);
}

Array column(nb::handle owner, void* data, std::int64_t count, nb::dlpack::dtype type) {
    const std::size_t shape[] = {static_cast<std::size_t>(count)};
    return Array(data, 1, shape, owner, nullptr, type);
}

EnvPool& env_pool_of(nb::handle self) {
    return nb::cast<EnvPool&>(self);
}

template <auto member>
Array records(nb::handle self, std::int64_t size) {
    EnvPool& batch = env_pool_of(self);
    return rows(self, (batch.arrays().*member).data(), batch.settings().environments, size,
                nb::dtype<std::uint8_t>());
}

template <auto member>
Array matrix(nb::handle self, std::int64_t columns) {
    EnvPool& batch = env_pool_of(self);
    return rows(self, (batch.arrays().*member).data(), batch.settings().environments, columns,
                batch.settings().doubles ? nb::dtype<double>() : nb::dtype<float>());
}

template <auto member, class T>
Array numbers(nb::handle self) {
    EnvPool& batch = env_pool_of(self);
    return column(self, (batch.arrays().*member).data(), batch.settings().environments,
                  nb::dtype<T>());
}

const rddl_problem& problem_of(nb::handle self) {
    return *env_pool_of(self).simulator().problem;
}

std::byte* bytes_of(const Bytes& array, std::int64_t size) {
    if (static_cast<std::int64_t>(array.size()) != size)
        throw Refused(fmt::format("a record has {} bytes, not {}", size, array.size()));
    return reinterpret_cast<std::byte*>(array.data());
}

void add_arrays(nb::class_<EnvPool>& batch) {
    using Arrays = EnvPool::Arrays;
    batch
        .def_prop_ro("actions",
                     [](nb::handle self) {
                         return records<&Arrays::actions>(self, problem_of(self).action_size);
                     })
        .def_prop_ro("observations",
                     [](nb::handle self) {
                         return records<&Arrays::observations>(self,
                                                               problem_of(self).observation_size);
                     })
        .def_prop_ro("final_observations",
                     [](nb::handle self) {
                         return records<&Arrays::final_observations>(
                             self, problem_of(self).observation_size);
                     })
        .def_prop_ro("action_values",
                     [](nb::handle self) {
                         return matrix<&Arrays::action_values>(self,
                                                               env_pool_of(self).action_columns());
                     })
        .def_prop_ro("observation_values",
                     [](nb::handle self) {
                         return matrix<&Arrays::observation_values>(
                             self, env_pool_of(self).observation_columns());
                     })
        .def_prop_ro("final_values",
                     [](nb::handle self) {
                         return matrix<&Arrays::final_values>(
                             self, env_pool_of(self).observation_columns());
                     })
        .def_prop_ro("rewards", numbers<&Arrays::rewards, double>)
        .def_prop_ro("terminated", numbers<&Arrays::terminated, bool>)
        .def_prop_ro("truncated", numbers<&Arrays::truncated, bool>)
        .def_prop_ro("causes", numbers<&Arrays::causes, std::uint8_t>);
}

void add_states(nb::class_<EnvPool>& batch) {
    batch
        .def("read_state",
             [](EnvPool& self, std::int64_t environment, const Bytes& record) {
                 self.read_state(environment,
                                 bytes_of(record, self.simulator().problem->state_size));
             })
        .def(
            "write_state",
            [](EnvPool& self, std::int64_t environment, const ConstBytes& record,
               std::int64_t steps) {
                const std::int64_t size = self.simulator().problem->state_size;
                if (static_cast<std::int64_t>(record.size()) != size)
                    throw Refused(fmt::format("a state has {} bytes, not {}", size, record.size()));
                self.write_states({&environment, 1},
                                  reinterpret_cast<const std::byte*>(record.data()), {&steps, 1});
            })
        .def(
            "write_states",
            [](EnvPool& self, const Integers& places, const Records& records,
               const Integers& steps) {
                const std::size_t count = places.size();
                const auto size = static_cast<std::size_t>(self.simulator().problem->state_size);
                if (steps.size() != count || records.size() != count * size)
                    throw Refused(fmt::format("{} states have {} bytes, not {}", count,
                                              count * size, records.size()));
                self.write_states({places.data(), count},
                                  reinterpret_cast<const std::byte*>(records.data()),
                                  {steps.data(), count});
            },
            nb::arg("places"), nb::arg("records"), nb::arg("steps"))
        .def(
            "read_states",
            [](EnvPool& self, const Matrix& records, const Counts& steps, const Counts& episodes,
               const Bytes& causes) {
                const auto count = static_cast<std::size_t>(self.settings().environments);
                const auto size = static_cast<std::size_t>(self.simulator().problem->state_size);
                if (records.size() != count * size || steps.size() != count ||
                    episodes.size() != count || causes.size() != count)
                    throw Refused(fmt::format("{} states have {} bytes, not {}", count,
                                              count * size, records.size()));
                self.read_states(reinterpret_cast<std::byte*>(records.data()), steps.data(),
                                 episodes.data(), causes.data());
            },
            nb::arg("records"), nb::arg("steps"), nb::arg("episodes"), nb::arg("causes"))
        .def("become", &EnvPool::become, nb::arg("other"))
        .def("read_interm",
             [](EnvPool& self, std::int64_t environment, const Bytes& record) {
                 self.read_interm(environment,
                                  bytes_of(record, self.simulator().problem->interm_size));
             })
        .def("progress", &EnvPool::progress, "Steps of the episode, and episodes ended before it.")
        .def("causes_of", &EnvPool::causes)
        .def("fault", &EnvPool::fault);
}

}  // namespace

void add_env_pool(nb::module_& module) {
    nb::class_<EnvPool> batch(module, "EnvPool",
                              "Environments, and the arrays that they read and fill: a row each.");
    batch.def(
        "__init__",
        [](EnvPool* self, const workbench::LoadedProblem& problem, std::int64_t environments,
           int threads, int autoreset, std::int64_t horizon, bool doubles, bool records,
           bool values) {
            new (self) EnvPool(problem.simulator,
                               {environments, threads, static_cast<rddl_autoreset>(autoreset),
                                horizon, doubles, records, values});
        },
        nb::arg("simulator"), nb::arg("environments") = 1, nb::arg("threads") = 1,
        nb::arg("autoreset") = 0, nb::arg("horizon") = 0, nb::arg("doubles") = false,
        nb::arg("records") = true, nb::arg("values") = true);
    batch.def("copy", [](EnvPool& self) {
        self.finish();
        return new EnvPool(self);
    });
    batch.def(
        "reset",
        [](EnvPool& self, std::optional<nb::ndarray<const bool, nb::ndim<1>, nb::c_contig>> mask) {
            if (mask && static_cast<std::int64_t>(mask->size()) != self.settings().environments)
                throw Refused(fmt::format("the mask has {} entries for {} environments",
                                          mask->size(), self.settings().environments));
            self.reset(mask ? reinterpret_cast<const std::uint8_t*>(mask->data()) : nullptr);
        },
        nb::arg("mask") = nb::none());
    batch.def(
        "step",
        [](EnvPool& self, const nb::object& into) { return self.step(self.outputs_in(into)); },
        nb::arg("into") = nb::none());
    batch.def(
        "step_values",
        [](EnvPool& self, const nb::object& into) {
            return self.step_values(self.outputs_in(into));
        },
        nb::arg("into") = nb::none());
    batch.def("finish", &EnvPool::finish, "Waits for a step that Ctrl-C has left.");
    batch.def("set_seed", &EnvPool::set_seed);
    batch.def("set_seeds",
              [](EnvPool& self, std::int64_t begin, const std::vector<std::uint64_t>& seeds) {
                  self.set_seeds(begin, seeds);
              });
    batch.def("violated_preconditions", [](EnvPool& self, const Records& records) {
        return self.violated_preconditions(
            std::as_bytes(std::span(records.data(), records.size())));
    });
    batch.def("violated_preconditions", [](EnvPool& self, const Values& values) {
        return self.violated_preconditions(std::span(values.data(), values.size()));
    });
    batch.def("explain_violation", &EnvPool::explain_violation);
    batch.def("choice_count", [](const EnvPool& self) {
        return self.simulator().action_choice_count(&self.simulator());
    });
    batch.def("choice", [](const EnvPool& self, std::int64_t choice) {
        rddl_choice out{};
        out.struct_size = sizeof out;
        check(self.simulator(),
              self.simulator().action_choice(&self.simulator(), choice, nullptr, &out));
        return nb::make_tuple(out.fluent, out.grounding, out.value);
    });
    batch.def("action_masks", [](EnvPool& self, const Bytes& masks) {
        const std::int64_t choices = self.simulator().action_choice_count(&self.simulator());
        self.action_masks(reinterpret_cast<std::uint8_t*>(
            bytes_of(masks, self.settings().environments * choices)));
    });
    batch.def("act", &EnvPool::act, "The policy block's actions, into `actions`.");
    add_arrays(batch);
    add_states(batch);
}

}  // namespace rddlc::python
