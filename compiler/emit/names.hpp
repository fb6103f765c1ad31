// The C++ names of everything in a program that lives as long as the emitted file.
#pragma once

#include "emit/identifiers.hpp"
#include "ir/ir.hpp"

#include <string>
#include <vector>

namespace rddlc::cpp {

struct Names {
    std::string space;                   // the namespace: domain_instance
    std::string entry;                   // the extern "C" function
    std::vector<std::string> counts;     // by type: how many objects it has
    std::vector<std::string> buffers;    // by BufferId: a table, or a member of a record
    std::vector<std::string> initial;    // by BufferId: the table of its first values, or empty
    std::vector<std::string> functions;  // by index into Program::step: what fills its buffer
    std::vector<std::string> policy_functions;                         // by index into Policy::act
    std::vector<std::string> preconditions, invariants, terminations;  // one function each
    Scope file;  // what local names must differ from
};

Names names_of(const ir::Program& program);

}  // namespace rddlc::cpp
