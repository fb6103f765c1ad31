// probes/: definitions, one a line, that are put into the same small problem.
#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace rddlc::testing {

struct Probe {
    std::string text;      // "x' = 1 + 2;"
    std::string expected;  // "ok" or codes: "E0307", "W0301 W0301"
    int line;

    friend std::ostream& operator<<(std::ostream& out, const Probe& probe) {
        return out << probe.text;
    }
};

// The probes of a file: "definition;  // expected ...".
std::vector<Probe> read_probes(const std::string& file);

// probes/problem.rddl with the definition in the place of the one of the same name.
std::string problem_with(const std::string& definition);

}  // namespace rddlc::testing
