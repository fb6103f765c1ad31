// How fast a simulator steps, and what room it takes.
#pragma once

#include "measure/random_course.hpp"

#include <rddl/simulator.h>

#include <cstdint>
#include <optional>

namespace rddlc::workbench {

struct Measurement {
    std::int64_t environments = 0;
    int lanes = 0;  // environments that a processor's registers step together; 0: unknown
    int threads = 0;
    std::int64_t steps = 0;  // of all environments
    double seconds = 0;
    double processor_seconds = 0;  // of all threads; 0: unknown

    double steps_per_second() const { return static_cast<double>(steps) / seconds; }
};

// How a batch is stepped, which changes nothing about its results.
struct Stepping {
    int lanes = 1;
    int threads = 1;
};

// Steps new batches along the course, with resets where episodes end, again and again until the
// time is over. Neither making a batch nor its first step, which wakes threads and fills
// caches, is part of the time.
Measurement measure(const rddl_simulator& simulator, const RandomCourse& course,
                    const Stepping& stepping, double seconds);

// The bytes that a batch of this size takes for each environment; nothing if the C library cannot
// report it.
std::optional<double> memory_per_environment(const rddl_simulator& simulator,
                                             std::int64_t environments);

}  // namespace rddlc::workbench
