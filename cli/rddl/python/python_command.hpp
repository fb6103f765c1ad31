// Which Python runs programs of ours.
#pragma once

#include <string>

namespace rddlc::cli {

// `named` if it is not empty, else that of $VIRTUAL_ENV, else python3.
std::string python_command(const std::string& named);

}  // namespace rddlc::cli
