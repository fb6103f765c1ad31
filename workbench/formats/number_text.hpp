// Numbers as text for readers.
#pragma once

#include <string>

namespace rddlc::workbench {

// Six significant digits: "-12.345", "1.5e+20".
std::string number_text(double value);
// "812", "3.42 k", "5.1 M" steps a second.
std::string rate_text(double per_second);
// "3.1 ms", "2.40 s".
std::string seconds_text(double seconds);

}  // namespace rddlc::workbench
