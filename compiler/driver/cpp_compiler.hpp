// The machine's C++ compiler: who it is, and which options it knows.
#pragma once

#include <string>
#include <vector>

namespace rddlc {

// $CXX, split at blanks, or c++.
std::vector<std::string> cpp_compiler();

// Of the flags of cmake/RddlSimulatorFlags.cmake those that the compiler takes without a word of
// complaint. Others than GCC and clang are not known by name: each compiler is asked, once in a
// process. All of them if it cannot be asked, so that it says itself what is wrong with it.
std::vector<std::string> simulator_flags(const std::vector<std::string>& compiler);

}  // namespace rddlc
