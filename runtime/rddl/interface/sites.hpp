// The places of a program where a draw or a fault may happen.
#pragma once

#include <rddl/simulator.h>

#include <span>

namespace rddl {

struct SiteVariable {
    const char* name;  // without "?"
    const rddl_type* type;
};

// Place::site is an index into the table of sites; Place::index is row-major over `scope`.
struct Site {
    rddl_source source;
    const char* what;  // "Bernoulli", "pow", ...; for Type and Undefined, the whole message
    std::span<const SiteVariable> scope;
};

}  // namespace rddl
