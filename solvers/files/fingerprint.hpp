// Numbers that distinguish problems, or files.
#pragma once

#include <rddl/simulator.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::solvers {

// The fingerprint of a policy's observations and actions: their fluents with types, objects and
// bounds. A policy acts in every simulator of the same spaces.
std::uint64_t spaces_of(const rddl_simulator& simulator);

// The fingerprint of everything that a trajectory depends on, in parts, so that a message can say
// which one has changed.
struct Fingerprint {
    std::string domain, instance;
    std::uint64_t spaces = 0;
    std::int64_t horizon = 0;
    double discount = 1;
    std::uint64_t initial_state = 0;
    std::uint64_t dynamics = 0;  // of all; 0: a simulator that does not say it

    template <class Archive>
    void archive(Archive& archive) {
        archive(domain);
        archive(instance);
        archive(spaces);
        archive(horizon);
        archive(discount);
        archive(initial_state);
        archive(dynamics);
    }
};

Fingerprint fingerprint(const rddl_simulator& simulator);

// The difference in a sentence about `other`: "it is of the problem ..."; "" if they are equal.
std::string difference(const Fingerprint& other, const Fingerprint& own);

// Changes with any single byte. Against bad luck, not bad will.
std::uint64_t checksum(std::string_view bytes);

}  // namespace rddlc::solvers
