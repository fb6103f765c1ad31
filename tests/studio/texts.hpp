// A problem with a random state, a precondition, a limit of actions and a policy that remembers.
#pragma once

#include "studio/edited_problem.hpp"

#include <string>

namespace rddlc::studio {

inline const std::string tanks_domain = R"(domain tanks {
    types { tank : object; };
    pvariables {
        water(tank) : { state-fluent, real, default = 10.0 };
        release(tank) : { action-fluent, real, default = 0.0 };
        alarm : { action-fluent, bool, default = false };
    };
    cpfs {
        water'(?t) = max[0.0, water(?t) - release(?t) + Exponential(2.0)];
    };
    reward = -(sum_{?t : tank} [abs[water(?t) - 10.0]]) - alarm;
    action-preconditions {
        forall_{?t : tank} [release(?t) >= 0 ^ release(?t) <= water(?t)];
    };
    termination { exists_{?t : tank} [water(?t) > 1000.0]; };
}
policy counting {
    domain = tanks;
    pvariables { count : { state-fluent, int, default = 0 }; };
    cpfs {
        count' = count + 1;
        alarm = (count >= 3);
        release(?t) = 0.0;
    };
}
)";
inline const std::string tanks_instance =
    R"(non-fluents n { domain = tanks; objects { tank : {a, b}; }; }
instance i {
    domain = tanks; non-fluents = n; init-state { water(a) = 12.0; };
    max-nondef-actions = 2; horizon = 20; discount = 0.9;
}
)";

inline OpenedProblem tanks() {
    OpenedProblem problem = first_problem();
    problem.domain = tanks_domain;
    problem.instance = tanks_instance;
    return problem;
}

}  // namespace rddlc::studio
