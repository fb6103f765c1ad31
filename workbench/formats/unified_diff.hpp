// The difference of two texts, by the program `diff`, in the form that `patch` reads.
#pragma once

#include <string>

namespace rddlc::workbench {

// The diff that turns the file `name` from the text `before` into `after`. Empty if they are equal.
std::string unified_diff(const std::string& name, const std::string& before,
                         const std::string& after);

}  // namespace rddlc::workbench
