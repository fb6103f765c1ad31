#include "solvers/files/fingerprint.hpp"

#include "support/text_hash.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstddef>

namespace rddlc::solvers {

namespace {

void add_number(TextHash& hash, std::int64_t number) {
    hash.add(static_cast<std::uint64_t>(number));
}

void add_type(TextHash& hash, const rddl_problem& problem, std::int32_t number) {
    const rddl_type& type = *rddl_type_at(&problem, number);
    hash.add(type.name);
    add_number(hash, type.object_count);
    for (std::int64_t o = 0; o < type.object_count; ++o) hash.add(type.objects[o]);
}

void add_bounds(TextHash& hash, const double* bounds, std::int64_t count) {
    for (std::int64_t g = 0; bounds && g < count; ++g)
        hash.add(std::bit_cast<std::uint64_t>(bounds[g]));
}

void add_fluent(TextHash& hash, const rddl_problem& problem, const rddl_fluent& fluent) {
    hash.add(fluent.name);
    add_number(hash, fluent.role);
    add_number(hash, fluent.scalar);
    if (fluent.range_type >= 0) add_type(hash, problem, fluent.range_type);
    for (std::int32_t p = 0; p < fluent.rank; ++p)
        add_type(hash, problem, fluent.parameter_types[p]);
    add_number(hash, fluent.count);
    if (fluent.role != RDDL_ACTION) return;  // what is observed has bounds of its own nowhere
    add_bounds(hash, fluent.lower, fluent.count);
    add_bounds(hash, fluent.upper, fluent.count);
}

std::uint64_t initial_state_of(const rddl_simulator& simulator) {
    // Bytes between fluents are not written.
    std::string state(static_cast<std::size_t>(simulator.problem->state_size), '\0');
    if (simulator.initial_state(&simulator, state.data()) != RDDL_OK) return 0;
    return checksum(state);
}

// Simulators that were compiled by an earlier header of the same version end before it.
std::uint64_t dynamics_of(const rddl_problem& problem) {
    const std::size_t end = offsetof(rddl_problem, fingerprint) + sizeof problem.fingerprint;
    return problem.struct_size >= end ? problem.fingerprint : 0;
}

void add_part(std::string& parts, const std::string& part) {
    parts += (parts.empty() ? "" : ", ") + part;
}

}  // namespace

std::uint64_t spaces_of(const rddl_simulator& simulator) {
    const rddl_problem& problem = *simulator.problem;
    const rddl_role observed = problem.partially_observed ? RDDL_OBSERVATION : RDDL_STATE;
    TextHash hash;
    hash.add(problem.domain);
    add_number(hash, problem.max_nondef_actions);
    for (std::int32_t f = 0; f < problem.fluent_count; ++f) {
        const rddl_fluent& fluent = *rddl_fluent_at(&problem, f);
        if (fluent.role == observed || fluent.role == RDDL_ACTION)
            add_fluent(hash, problem, fluent);
    }
    return hash.value();
}

Fingerprint fingerprint(const rddl_simulator& simulator) {
    const rddl_problem& problem = *simulator.problem;
    return {.domain = problem.domain,
            .instance = problem.instance,
            .spaces = spaces_of(simulator),
            .horizon = problem.horizon,
            .discount = problem.discount,
            .initial_state = initial_state_of(simulator),
            .dynamics = dynamics_of(problem)};
}

std::string difference(const Fingerprint& other, const Fingerprint& own) {
    if (other.domain != own.domain || other.instance != own.instance)
        return fmt::format("it is of the problem {} ({}), not of {} ({})", other.instance,
                           other.domain, own.instance, own.domain);
    if (other.spaces != own.spaces)
        return "it is of another version of the problem: observations or actions have changed";
    std::string parts;
    if (other.horizon != own.horizon)
        add_part(parts, fmt::format("the horizon was {} and is {}", other.horizon, own.horizon));
    if (other.discount != own.discount)
        add_part(parts,
                 fmt::format("the discount was {:g} and is {:g}", other.discount, own.discount));
    if (other.initial_state != own.initial_state) add_part(parts, "the initial state has changed");
    if (parts.empty() && other.dynamics != own.dynamics)
        parts = "a CPF, the reward, a condition, a non-fluent or an initial draw has changed";
    return parts.empty() ? "" : "it is of another version of the problem: " + parts;
}

std::uint64_t checksum(std::string_view bytes) {
    TextHash hash;
    hash.add(bytes);
    return hash.value();
}

}  // namespace rddlc::solvers
