// The C++ names of everything in a program that lives as long as the emitted file.
#pragma once

#include "emit/names/identifiers.hpp"
#include "ir/ir.hpp"

#include <string>
#include <vector>

namespace rddlc::cpp {

// The type of a record in emitted functions, and the parameter of that type.
struct RecordWords {
    std::string type, parameter;
};
RecordWords words_of(ir::Storage storage);

// The name of a lane type in a function: "Bool" for L::Bool.
std::string lane_type(ir::Scalar scalar);
// The type of a table's elements: "double", "float", "std::int64_t", "bool".
std::string table_type(ir::Scalar scalar, RealType real = RealType::Double);

// The names that a function declares besides variables and values.
std::vector<std::string> function_words();

// The description of the problem.
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
    std::string space;                 // the namespace in rddl_simulators: domain_instance
    std::string entry;                 // the extern "C" function
    std::vector<std::string> counts;   // by type: how many objects it has
    std::vector<std::string> buffers;  // by BufferId: a table, or a member of a record
    std::vector<std::string> initial;  // by BufferId: the table of its first values, or empty
    // By BufferId: the member of a record of the state that is the sliding buffer of one
    // of its tables (rddl/values/sliding_tables.hpp), or empty.
    std::vector<std::string> sliding_buffers;
    std::vector<std::string> functions;  // by index into Program::step: what fills its buffer
    std::vector<std::string> policy_functions;  // by index into Policy::act
    Scope file;                                 // what local names must differ from
};

Names names_of(const ir::Program& program);

}  // namespace rddlc::cpp
