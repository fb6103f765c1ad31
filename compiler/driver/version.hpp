#pragma once

namespace rddlc {

// The version of the compiler, such as "0.2.0".
extern const char* const version;

}  // namespace rddlc
