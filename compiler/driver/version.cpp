#include "driver/version.hpp"

namespace rddlc {

const char* const version = RDDLC_VERSION;

}  // namespace rddlc
