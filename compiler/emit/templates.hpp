// The skeletons in the folder templates/, built into the program.
#pragma once

#include <string_view>

namespace rddlc::cpp::templates {

extern const std::string_view source;       // a .cpp: the simulator and the exported C function
extern const std::string_view header;       // a .hpp: the simulator alone
extern const std::string_view simulator;    // what both contain
extern const std::string_view policy;       // the struct Policy, where there is a policy block
extern const std::string_view declaration;  // a .h for C: the exported function
extern const std::string_view details;      // the namespace details, with --details
extern const std::string_view moderate;     // the namespace moderate, where there is such a step

}  // namespace rddlc::cpp::templates
