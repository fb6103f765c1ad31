#include "parsed.hpp"

namespace rddlc {

const std::string sample_domain = R"(
// Everything that a domain may hold; it need not make sense.
domain sample_mdp {
    requirements = { reward-deterministic, concurrent };

    types {
        place : object;
        tier : { @low, @2-high, @x_y };
        none : { };
    };

    pvariables {
        LINK(place, place) : { non-fluent, bool, default = false };
        RATE : { non-fluent, real, default = -0.5 };
        LIMIT(tier) : { non-fluent, int, default = -3 };
        HUGE : { non-fluent, real, default = pos-inf };
        sum(place) : { state-fluent, real, default = .25 };
        at(place) : { state-fluent, tier, default = @low };
        near : { state-fluent, place };
        mid-1 : { interm-fluent, int, level = 1 };
        der(place) : { derived-fluent, bool };
        seen(place) : { observ-fluent, bool };
        go(place) : { action-fluent, bool, default = false };
    };

    cpfs {
        mid-1 = 1 + 2 * 3 - -4 / 2;
        der(?p) = ~go(?p) ^ go(?p) & true | false => seen(?p) <=> at(?p) == @low;
        sum'(?p) = sum_{?q : place, ?r : tier} [LINK(?p, ?q) * sum(?q)] + LIMIT(?r);
        at'(?p) = if (go(?p)) then @2-high else if (at(?p) ~= @x_y) then at(?p) else low;
        near' = argmax_{?p : place} sum(argmin_{?q : place} sum(?q));
        x'(?p) = switch (at(?p)) { case @low : 1, case mid(?p) : 2.50, default : abs[-3] };
        y' = Discrete(tier, @low : 0.5, high : max[0.1, RATE], @x_y : 0.2);
        z' = sum(Discrete_{?q : place} sum(?q)) + Normal(0, 1.0) + Bernoulli(0.5);
        d' = det_{?i : place, ?j : place} LINK(?i, ?j);
        i'(?p, ?q) = inverse[row = ?p, col = ?q][LINK(?p, ?q) + 1];
        e' = $call[?p, @low, _](sum(?p, _), RATE) + $nothing[];
        v'(?p) = MultivariateNormal[?p](mean(_), cov(_, @low));
        q() = +forall_{?p : place} exists_{?q : place} ~LINK(?p, ?q) ^ (1 < 2) ^ 3 <= 4 > 5 >= 6;
    };

    reward = -sum_{?p : place} sum(?p) + 10.0;

    termination { sum(?p) > 3; };
    action-preconditions { go(?p) => ~go(?p); };
    state-action-constraints { };
    state-invariants { RATE < 0; 1 == 1; };
}
)";

const std::string sample_instance = R"(
non-fluents nf_sample {
    domain = sample_mdp;
    objects {
        place : { a, b-2, c_3 };
    };
    non-fluents {
        LINK(a, b-2);
        ~LINK(c_3, a);
        RATE = -1.5;
        LIMIT(@low) = -7;
    };
}

instance inst_sample {
    domain = sample_mdp;
    non-fluents = nf_sample;
    objects { place : { z }; };
    init-state {
        sum(a) = 3;
        at(a) = @low;
        near = b-2;
        flag;
    };
    max-nondef-actions = pos-inf;
    max-nondef-actions = 2;
    horizon = 40;
    horizon = pos-inf;
    horizon = terminate-when (sum(a) > 3)
    discount = 0.95;
};

policy sample_policy {
    domain = sample_mdp;
    cpfs { go(?p) = true; };
}
)";

}  // namespace rddlc
