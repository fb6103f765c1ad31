#pragma once

namespace rddlc {

// Of the compiler, such as "0.2.0".
extern const char* const version;

}  // namespace rddlc
