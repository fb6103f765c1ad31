// The machine's C++ compiler: its name, and the options that it knows.
#pragma once

#include <stop_token>
#include <string>
#include <vector>

namespace rddlc {

// $CXX, split at blanks, or c++.
std::vector<std::string> cpp_compiler();

// The flags of cmake/RddlSimulatorFlags.cmake that the compiler takes without a complaint.
// Compilers other than GCC and clang are not known by name: each compiler is asked, once in a
// process. Returns all flags if it cannot be asked, so that it reports itself what is wrong, and
// when a stop is requested meanwhile.
std::vector<std::string> simulator_flags(const std::vector<std::string>& compiler,
                                         const std::stop_token& stop = {});

}  // namespace rddlc
