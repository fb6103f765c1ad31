// Epidemic 0: three groups of people.
#pragma once

#include "reference.hpp"
#include "registers.hpp"
#include "tables.hpp"

namespace handwritten {

struct Epidemic : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 120;
    static constexpr bool stochastic = false;
    static constexpr std::size_t groups = 3;

    template <class L>
    struct Compartments {
        typename L::Real of[groups];
    };
    template <class L>
    struct State {
        Compartments<L> susceptible, exposed, infected, recovered, hospital, dead;
        std::array<Compartments<L>*, 6> all() {
            return {&susceptible, &exposed, &infected, &recovered, &hospital, &dead};
        }
    };
    template <class L>
    struct Actions {
        typename L::Real vaccinate[groups], distancing;
        typename L::Bool closes_schools;
    };

    static void start(State<rddl::Scalar>& state) {
        std::size_t k = 0;
        for (auto* const part : state.all()) {
            for (std::size_t g = 0; g < groups; ++g) part->of[g] = epidemic::start[k][g];
            ++k;
        }
    }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        std::size_t k = 0;
        for (auto* const part : state.all()) {
            for (std::size_t g = 0; g < groups; ++g)
                part->of[g] = select(where, epidemic::start[k][g], part->of[g]);
            ++k;
        }
    }

    static constexpr std::size_t record_size = (groups + 2) * sizeof(double);
    static void load(Actions<rddl::Scalar>& actions, const std::byte* record) {
        std::memcpy(actions.vaccinate, record, sizeof actions.vaccinate);
        std::memcpy(&actions.distancing, record + groups * sizeof(double), sizeof(double));
        actions.closes_schools = record[record_size - sizeof(double)] != std::byte{0};
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        const auto* const values = reinterpret_cast<const double*>(records);
        const typename L::Int rows = row_starts<L>(record_size / sizeof(double));
        std::uint64_t closes = 0;
        for (int lane = 0; lane < L::width; ++lane) {
            const std::byte* const record = records + static_cast<std::size_t>(lane) * record_size;
            closes |= std::to_integer<std::uint64_t>(record[record_size - sizeof(double)]) << lane;
        }
        for (std::size_t g = 0; g < groups; ++g) actions.vaccinate[g] = gather(values + g, rows);
        actions.distancing = gather(values + groups, rows);
        actions.closes_schools = L::Bool::of_bits(closes);
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws&) {
        using Real = typename L::Real;
        const Real far = 1.0 - epidemic::distancing * actions.distancing;
        Real dead{0.0}, vaccinated{0.0}, patients{0.0}, rate[groups];
        for (std::size_t g = 0; g < groups; ++g) {
            dead = dead + s.dead.of[g];
            vaccinated = vaccinated + actions.vaccinate[g];
            patients = patients + s.hospital.of[g];
            Real contacts{0.0};
            for (std::size_t h = 0; h < groups; ++h) {
                const double open = epidemic::contact[g][h];
                const double closed = epidemic::at_school[g] || epidemic::at_school[h]
                                          ? open * epidemic::closing
                                          : open;
                contacts = contacts + select(actions.closes_schools, Real{closed}, Real{open}) *
                                          s.infected.of[h];
            }
            rate[g] = far * contacts;
        }
        const auto share = [](const Real& value) {
            return larger(smaller(value, 1.0), 0.0);
        };
        for (std::size_t g = 0; g < groups; ++g) {
            const Real ill = s.infected.of[g], caught = rate[g] * s.susceptible.of[g];
            s.dead.of[g] = smaller(s.dead.of[g] + epidemic::death_rate[g] * s.hospital.of[g], 1.0);
            s.hospital.of[g] = share((1.0 - epidemic::discharge) * s.hospital.of[g] +
                                     epidemic::hospital_rate[g] * ill);
            s.recovered.of[g] =
                share(s.recovered.of[g] + epidemic::recover * ill + actions.vaccinate[g]);
            s.infected.of[g] =
                share((1.0 - epidemic::recover) * ill + epidemic::incubation * s.exposed.of[g]);
            s.exposed.of[g] = share((1.0 - epidemic::incubation) * s.exposed.of[g] + caught);
            s.susceptible.of[g] = larger(s.susceptible.of[g] - caught - actions.vaccinate[g], 0.0);
        }
        return -1000.0 * dead - 0.05 * vaccinated - 0.5 * actions.distancing -
               select(actions.closes_schools, Real{1.0}, Real{0.0}) -
               500.0 * larger(patients - 0.05, 0.0);
    }

    // The step keeps all within 0 and 1.
    template <class L>
    static void store(const State<L>& state, std::int64_t lane, std::byte* record) {
        State<L> copy = state;
        double values[6 * groups];
        double* next = values;
        for (const auto* const part : copy.all())
            for (const auto& value : part->of) *next++ = lane_of(value, lane);
        std::memcpy(record, values, sizeof values);
    }
};

}  // namespace handwritten
