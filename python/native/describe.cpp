#include "native/describe.hpp"

#include "native/problem.hpp"

#include <cstdint>
#include <vector>

namespace nb = nanobind;

namespace rddlc::python {

namespace {

nb::tuple place(const rddl_source& source) {
    return nb::make_tuple(source.file, source.line, source.column);
}

nb::list types(const rddl_problem& problem) {
    nb::list all;
    for (std::int32_t i = 0; i < problem.type_count; ++i) {
        const rddl_type& type = *rddl_type_at(&problem, i);
        nb::list objects;
        for (std::int64_t k = 0; k < type.object_count; ++k) objects.append(type.objects[k]);
        nb::dict described;
        described["name"] = type.name;
        described["objects"] = nb::tuple(objects);
        described["enumerated"] = type.enumerated != 0;
        all.append(described);
    }
    return all;
}

nb::object bounds(const double* values, std::int64_t count) {
    if (!values) return nb::none();
    nb::list all;
    for (std::int64_t i = 0; i < count; ++i) all.append(values[i]);
    return all;
}

nb::dict fluent_of(const rddl_problem& problem, const rddl_fluent& fluent, std::int32_t index) {
    static constexpr const char* roles[] = {"non-fluent",    "state-fluent",   "action-fluent",
                                            "interm-fluent", "derived-fluent", "observ-fluent"};
    static constexpr const char* scalars[] = {"bool", "int", "real"};
    nb::list parameters;
    for (std::int32_t p = 0; p < fluent.rank; ++p)
        parameters.append(rddl_type_at(&problem, fluent.parameter_types[p])->name);
    nb::dict described;
    described["index"] = index;
    described["name"] = fluent.name;
    described["role"] = roles[fluent.role];
    described["scalar"] = scalars[fluent.scalar];
    described["range"] = fluent.range_type < 0 ? scalars[fluent.scalar]
                                               : rddl_type_at(&problem, fluent.range_type)->name;
    described["parameters"] = nb::tuple(parameters);
    described["count"] = fluent.count;
    described["offset"] = fluent.offset;
    described["lower"] = bounds(fluent.lower, fluent.count);
    described["upper"] = bounds(fluent.upper, fluent.count);
    described["source"] = place(fluent.source);
    return described;
}

nb::list fluents(const rddl_problem& problem) {
    nb::list all;
    for (std::int32_t i = 0; i < problem.fluent_count; ++i)
        all.append(fluent_of(problem, *rddl_fluent_at(&problem, i), i));
    return all;
}

nb::list conditions(const rddl_problem& problem, const rddl_condition* list, std::int32_t count) {
    nb::list all;
    for (std::int32_t i = 0; i < count; ++i) {
        const rddl_condition& condition = *rddl_condition_at(&problem, list, i);
        all.append(nb::make_tuple(condition.text, place(condition.source)));
    }
    return all;
}

template <class T>
nb::list read(const rddl_simulator& simulator, std::int32_t fluent, std::int64_t count) {
    std::vector<T> values(static_cast<std::size_t>(count));
    check(simulator, simulator.get_constants(&simulator, fluent, 0, count, values.data()));
    nb::list all;
    for (const T value : values) all.append(value);
    return all;
}

}  // namespace

nb::dict describe(const rddl_simulator& simulator) {
    const rddl_problem& problem = *simulator.problem;
    nb::dict all;
    all["domain"] = problem.domain;
    all["instance"] = problem.instance;
    all["types"] = types(problem);
    all["fluents"] = fluents(problem);
    all["state_size"] = problem.state_size;
    all["action_size"] = problem.action_size;
    all["observation_size"] = problem.observation_size;
    all["partially_observed"] = problem.partially_observed != 0;
    all["stochastic"] = problem.stochastic != 0;
    all["horizon"] = problem.horizon;
    all["discount"] = problem.discount;
    all["max_nondef_actions"] = problem.max_nondef_actions;
    all["preconditions"] = conditions(problem, problem.preconditions, problem.precondition_count);
    all["invariants"] = conditions(problem, problem.invariants, problem.invariant_count);
    all["terminations"] = conditions(problem, problem.terminations, problem.termination_count);
    return all;
}

nb::list constants(const rddl_simulator& simulator, std::int32_t fluent) {
    const rddl_problem& problem = *simulator.problem;
    if (fluent < 0 || fluent >= problem.fluent_count) throw Refused("there is no such fluent");
    const rddl_fluent& described = *rddl_fluent_at(&problem, fluent);
    switch (described.scalar) {
        case RDDL_BOOL: {
            nb::list all;
            for (const nb::handle value : read<std::uint8_t>(simulator, fluent, described.count))
                all.append(nb::cast<int>(value) != 0);
            return all;
        }
        case RDDL_INT:
            return read<std::int64_t>(simulator, fluent, described.count);
        case RDDL_REAL:
            return read<double>(simulator, fluent, described.count);
    }
    return {};
}

}  // namespace rddlc::python
