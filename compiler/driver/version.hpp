#pragma once

namespace rddlc {

// Of the compiler, such as "0.1.0".
extern const char* const version;

}  // namespace rddlc
