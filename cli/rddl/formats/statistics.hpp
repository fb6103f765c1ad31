// Means and the like of a sample, and numbers as people read them.
#pragma once

#include <string>
#include <vector>

namespace rddlc::cli {

struct Statistics {
    double mean = 0;
    double deviation = 0;  // of the sample: divided by n - 1; 0 for a single value
    double minimum = 0;
    double maximum = 0;
};

// Zeros for no values; nan if a value is nan.
Statistics statistics_of(const std::vector<double>& values);

// Six significant digits: "-12.345", "1.5e+20".
std::string number_text(double value);
// "812", "3.42 k", "5.1 M" steps a second.
std::string rate_text(double per_second);
// "3.1 ms", "2.40 s".
std::string seconds_text(double seconds);

}  // namespace rddlc::cli
