// probes/: small changes to the same problem, one a line.
#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace rddlc::testing {

struct Probe {
    std::string text;      // "x' = 1 + 2;" or "old ==> new"
    std::string expected;  // "ok" or codes: "E0307", "W0301 W0301"
    int line;

    friend std::ostream& operator<<(std::ostream& out, const Probe& probe) {
        return out << probe.text;
    }
};

// The probes of a file: "text  // expected ...".
std::vector<Probe> read_probes(const std::string& file);

// probes/problem.rddl with the definition in the place of the one of the same name, or with the
// first "old" replaced by "new".
std::string problem_with(const std::string& probe);

}  // namespace rddlc::testing
