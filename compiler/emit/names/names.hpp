// The C++ names of everything in a program that lives as long as the emitted file.
#pragma once

#include "emit/names/identifiers.hpp"
#include "ir/ir.hpp"

#include <string>
#include <vector>

namespace rddlc::cpp {

// What emitted functions call a record: its type, and their parameter.
struct RecordWords {
    std::string type, parameter;
};
RecordWords words_of(ir::Storage storage);

// What a function calls a type of the lanes: "Bool" for L::Bool.
std::string lane_type(ir::Scalar scalar);
// What a table holds: "double", "float", "std::int64_t", "bool".
std::string table_type(ir::Scalar scalar, RealType real = RealType::Double);

// What a function declares besides variables and values.
std::vector<std::string> function_words();

// What is told about the problem.
namespace marks {
inline constexpr Mark objects{"", "_objects"};
inline constexpr Mark lower{"", "_lower"};
inline constexpr Mark upper{"", "_upper"};
inline constexpr Mark values{"", "_values"};
inline constexpr Mark places{"", "_places"};
inline constexpr Mark parameter_types{"of_", ""};
inline constexpr Mark scope{"scope_", ""};
}  // namespace marks

struct Names {
    std::string space;                   // the namespace in rddl_simulators: domain_instance
    std::string entry;                   // the extern "C" function
    std::vector<std::string> counts;     // by type: how many objects it has
    std::vector<std::string> buffers;    // by BufferId: a table, or a member of a record
    std::vector<std::string> initial;    // by BufferId: the table of its first values, or empty
    std::vector<std::string> functions;  // by index into Program::step: what fills its buffer
    std::vector<std::string> policy_functions;  // by index into Policy::act
    Scope file;                                 // what local names must differ from
};

Names names_of(const ir::Program& program);

}  // namespace rddlc::cpp
