// Pattern matching over std::variant: a forgotten alternative does not compile.
//
//     match(node, [](const Integer& n) { ... },
//                 [](const Real& r) { ... });
#pragma once

#include <utility>
#include <variant>

namespace rddlc {

template <class... Cases>
struct Overloaded : Cases... {
    using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

template <class Variant, class... Cases>
decltype(auto) match(Variant&& variant, Cases&&... cases) {
    return std::visit(Overloaded{std::forward<Cases>(cases)...}, std::forward<Variant>(variant));
}

}  // namespace rddlc
