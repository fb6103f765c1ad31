// Inputs of fuzzing without clang, which stay behind in a file where one of them does not come
// back.
#pragma once

#include <sys/time.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace rddlc::fuzzing {

// Ends the program when this time is over; 0: never. The time that other programs take is not
// counted.
inline void limit_processor_time(time_t seconds) {
    const itimerval limit{.it_interval = {}, .it_value = {.tv_sec = seconds, .tv_usec = 0}};
    setitimer(ITIMER_PROF, &limit, nullptr);
}

// The result of `exercise()`. The input is in `file` meanwhile.
template <class Exercise>
auto guarded(const char* file, const std::string& input, Exercise&& exercise) {
    constexpr time_t longest = 20;  // seconds of the processor
    std::ofstream(file, std::ios::binary) << input;
    limit_processor_time(longest);
    const auto outcome = exercise();
    limit_processor_time(0);
    std::filesystem::remove(file);
    return outcome;
}

}  // namespace rddlc::fuzzing
