"""The questions of planners: steps from any state, applicable actions, next states."""

from __future__ import annotations

import math
import pickle
import unittest
from typing import Any

import numpy as np
from support import example, problem_of, problem_of_text

import rddlc
from rddlc.transitions import Transitions

COINS = """
domain coins {
    types { coin : object; };
    pvariables {
        heads(coin) : { state-fluent, bool, default = false };
        toss(coin) : { action-fluent, bool, default = false };
    };
    cpfs { heads'(?c) = if (toss(?c)) then Bernoulli(0.25) else heads(?c); };
    reward = sum_{?c : coin} heads(?c);
}
non-fluents two { domain = coins; objects { coin : {a, b}; }; }
instance coins_1 { domain = coins; non-fluents = two; max-nondef-actions = 2; horizon = 3; discount = 1.0; }
"""


def number_of(transitions: Transitions, **changes: Any) -> int:
    """The action that sets these values, and leaves the others at 0."""
    for number in range(transitions.action_count):
        action = transitions.action(number)
        if {name: value for name, value in action.items() if value} == changes:
            return number
    raise AssertionError(f"no action sets {changes}")


class TransitionsTest(unittest.TestCase):
    def test_steps_are_those_of_an_environment(self) -> None:
        env = example("mountain_car")
        transitions = Transitions(env.problem, levels=5)
        self.assertEqual(transitions.action_count, 5)
        env.reset(seed=0)
        state = transitions.start()
        self.assertEqual(state, env.get_state())
        over = False
        while not over:
            number = 4 if env.state["velocity"] > 0 else 0
            (outcome,) = transitions.outcomes(state, number)
            _, reward, terminated, truncated, _ = env.step(transitions.action(number))
            self.assertEqual(outcome.reward, reward)
            self.assertEqual(outcome.state, env.get_state())
            state, over = outcome.state, terminated or truncated
        self.assertEqual(transitions.applicable(state), ())
        with self.assertRaisesRegex(rddlc.EpisodeOver, "terminated"):
            transitions.sample(state, 0)

    def test_earlier_states_can_be_asked_about_again(self) -> None:
        transitions = Transitions(example("mountain_car").problem)
        state = transitions.start()
        first = transitions.sample(state, 2)
        for _ in range(10):
            transitions.sample(transitions.sample(first.state, 0).state, 1)
        self.assertEqual(transitions.sample(state, 2), first)

    def test_actions_that_break_preconditions_are_not_applicable(self) -> None:
        transitions = Transitions(problem_of("refuses_some"))  # d2 is locked
        allowed = [transitions.action(each) for each in transitions.applicable(transitions.start())]
        self.assertEqual(allowed, [{"open___d1": 1, "open___d2": 0}, {"open___d1": 0, "open___d2": 0}])

    def test_applicable_actions_depend_on_the_state(self) -> None:
        env = rddlc.make(problem_of_text(GATE))
        transitions = Transitions(env.problem)
        start = transitions.start()
        go = number_of(transitions, go=1)
        self.assertIn(go, transitions.applicable(start))
        gone = transitions.sample(start, go).state
        self.assertNotIn(go, transitions.applicable(gone))
        self.assertIn(number_of(transitions), transitions.applicable(gone))

    def test_a_changed_action_is_counted_once(self) -> None:
        """Two sub-actions of three changes are nine pairs, but three sets and the empty one."""
        transitions = Transitions(problem_of_text(COINS))
        self.assertEqual(transitions.action_count, 4)

    def test_draws_have_the_problems_law(self) -> None:
        transitions = Transitions(problem_of_text(COINS), samples=20_000)
        start, both = transitions.start(), number_of(transitions, toss___a=1, toss___b=1)
        outcomes = transitions.outcomes(start, both)
        self.assertAlmostEqual(sum(each.probability for each in outcomes), 1)
        expected = [9 / 16, 3 / 16, 3 / 16, 1 / 16]
        np.testing.assert_allclose([each.probability for each in outcomes], expected, atol=0.015)
        drawn = [transitions.sample(start, both).state for _ in range(2000)]
        share = np.mean([each == outcomes[0].state for each in drawn])
        self.assertAlmostEqual(share, 9 / 16, delta=0.05)

    def test_distributions_are_exact(self) -> None:
        transitions = Transitions(problem_of_text(COINS))
        self.assertTrue(transitions.is_exact)
        start, both = transitions.start(), number_of(transitions, toss___a=1, toss___b=1)
        outcomes = transitions.outcomes(start, both)
        self.assertEqual([each.probability for each in outcomes], [9 / 16, 3 / 16, 3 / 16, 1 / 16])
        (certain,) = transitions.outcomes(start, number_of(transitions))
        self.assertEqual(certain.probability, 1)

    def test_exact_distributions_are_those_of_draws(self) -> None:
        """Bernoulli, Discrete and a draw that two fluents share, up to the last step."""
        draws = 4000
        transitions = Transitions(problem_of_text(WEATHER))
        state = transitions.start()
        for _ in range(3):
            outcomes = transitions.outcomes(state, number_of(transitions, umbrella=1))
            self.assertAlmostEqual(sum(each.probability for each in outcomes), 1)
            sampled = Transitions(transitions.problem, samples=draws)
            known = {each.state: each for each in outcomes}
            for each in sampled.outcomes(state, number_of(transitions, umbrella=1)):
                self.assertIn(each.state, known)  # with steps and causes
                p = known[each.state].probability
                self.assertAlmostEqual(
                    each.probability, p, delta=5 * (p * (1 - p) / draws) ** 0.5 + 1e-9
                )
                self.assertAlmostEqual(each.reward, known[each.state].reward, delta=0.1)
            state = outcomes[0].state
        self.assertEqual(rddlc.causes.text_of(state.causes), "horizon")

    def test_counts_of_trials_are_exact(self) -> None:
        """Binomial, Multinomial, and draws whose parameters leave one result."""
        transitions = Transitions(problem_of_text(URN))
        view = rddlc.make(transitions.problem)
        outcomes = transitions.outcomes(transitions.start(), 0)
        found: dict[tuple[int, ...], float] = {}
        for each in outcomes:
            view.reset(seed=0, options={"state": each.state})
            state = {name: int(value) for name, value in view.state.items()}
            self.assertEqual(state.pop("never"), 0)
            self.assertEqual(state.pop("certain"), 5)
            self.assertNotIn(tuple(state.values()), found)
            found[tuple(state.values())] = each.probability
        expected = {}
        for hits in range(4):
            p_hits = math.comb(3, hits) * 0.25**hits * 0.75 ** (3 - hits)
            for red in range(3):
                blue = 2 - red
                p_urn = math.comb(2, red) * 0.4**red * 0.6**blue
                expected[hits, red, 0, blue] = p_hits * p_urn
        self.assertEqual(set(found), set(expected))
        for key, probability in expected.items():
            self.assertAlmostEqual(found[key], probability, places=12)

    def test_rounded_probabilities_are_zero_and_one(self) -> None:
        """p is 1 + 9e-16: an outcome that only rounding makes possible is left out."""
        rounded = URN.replace("hits' = Binomial(3, 0.25);", "hits' = Binomial(3, p) + Bernoulli(p) + Bernoulli(1.0 - p);")
        rounded = rounded.replace("cpfs {", "cpfs { p = never + 0.1 / (0.3 + 0.4 + 0.1 - 0.3 - 0.4);")
        rounded = rounded.replace("pvariables {", "pvariables { p : { interm-fluent, real };")
        rounded = rounded.replace("P(@red) = 0.4; P(@blue) = 0.6;", "P(@red) = 1.0000000001; P(@blue) = -0.0000000001;")
        transitions = Transitions(problem_of_text(rounded))
        (only,) = transitions.outcomes(transitions.start(), 0)
        self.assertEqual(only.probability, 1)
        view = rddlc.make(transitions.problem)
        view.reset(seed=0, options={"state": only.state})
        self.assertEqual(view.state["hits"], 4)
        self.assertEqual(view.state["count___red"], 2)

    def test_no_distribution_is_made_up(self) -> None:
        normal = COINS.replace("Bernoulli(0.25)", "(Normal(0.0, 1.0) > 0.5)")
        transitions = Transitions(problem_of_text(normal))
        toss = number_of(transitions, toss___a=1)
        with self.assertRaisesRegex(rddlc.Error, "outcomes of Normal are not listed"):
            transitions.outcomes(transitions.start(), toss)
        few = Transitions(problem_of_text(COINS), most_outcomes=3)
        both = number_of(few, toss___a=1, toss___b=1)
        with self.assertRaisesRegex(rddlc.Error, "more than 3 combinations.*samples=1000"):
            few.outcomes(few.start(), both)

    def test_what_cannot_be_planned_is_refused(self) -> None:
        with self.assertRaisesRegex(rddlc.Error, "'push' has no two bounds"):
            Transitions(problem_of("counters"))
        with self.assertRaisesRegex(rddlc.Error, "2 or more"):
            Transitions(example("mountain_car").problem, levels=1)
        with self.assertRaisesRegex(rddlc.Error, "no more than 10000"):
            Transitions(example("mountain_car").problem, levels=10_001)

    def test_the_horizon_ends_episodes(self) -> None:
        transitions = Transitions(example("mountain_car").problem, horizon=2)
        state = transitions.start()
        for steps in (1, 2):
            state = transitions.sample(state, 0).state
            self.assertEqual(state.steps, steps)
        self.assertEqual(rddlc.causes.text_of(state.causes), "horizon")

    def test_draws_are_new_and_those_of_the_seed(self) -> None:
        def drawn(seed: int) -> list[rddlc.State]:
            transitions = Transitions(problem_of_text(COINS), seed=seed)
            both = number_of(transitions, toss___a=1, toss___b=1)
            start = transitions.start()
            return [transitions.sample(start, both).state for _ in range(200)]

        self.assertEqual(len(set(drawn(1))), 4)
        self.assertEqual(drawn(1), drawn(1))
        self.assertNotEqual(drawn(1)[1:], drawn(2)[:-1])  # seeds in a row share no draws

    def test_it_can_be_pickled(self) -> None:
        transitions = Transitions(example("mountain_car").problem, levels=5)
        again = pickle.loads(pickle.dumps(transitions))
        self.assertEqual(again.action_count, 5)
        self.assertEqual(again.sample(again.start(), 0), transitions.sample(transitions.start(), 0))


WEATHER = """
domain weather {
    types { sky : { @clear, @clouds, @rain }; };
    pvariables {
        now : { state-fluent, sky, default = @clear };
        wet : { state-fluent, bool, default = false };
        warned : { state-fluent, bool, default = false };
        siren : { interm-fluent, bool };
        umbrella : { action-fluent, bool, default = false };
    };
    cpfs {
        siren = Bernoulli(0.3);
        now' = if (siren) then Discrete(sky, @clear : 0.1, @clouds : 0.2, @rain : 0.7)
               else Discrete(sky, @clear : 0.5, @clouds : 0.5, @rain : 0.0);
        wet' = if (now == @rain) then Bernoulli(if (umbrella) then 0.125 else 1.0) else false;
        warned' = siren;
    };
    reward = siren - wet;
}
non-fluents none { domain = weather; }
instance weather_1 {
    domain = weather; non-fluents = none; max-nondef-actions = 1; horizon = 3; discount = 1.0;
}
"""

URN = """
domain urn {
    types { color : { @red, @green, @blue }; };
    pvariables {
        P(color) : { non-fluent, real, default = 0.0 };
        BALLS : { non-fluent, int, default = 2 };
        hits : { state-fluent, int, default = 0 };
        count(color) : { state-fluent, int, default = 0 };
        never : { state-fluent, int, default = 0 };
        certain : { state-fluent, real, default = 0.0 };
        wait : { action-fluent, bool, default = false };
    };
    cpfs {
        hits' = Binomial(3, 0.25);
        count'(?c) = Multinomial[?c](BALLS, P(_));
        never' = Poisson(0.0);
        certain' = Normal(5.0, 0.0);
    };
    reward = hits;
}
non-fluents balls {
    domain = urn;
    non-fluents { P(@red) = 0.4; P(@blue) = 0.6; };
}
instance urn_1 { domain = urn; non-fluents = balls; max-nondef-actions = 1; horizon = 3; discount = 1.0; }
"""

GATE = """
domain gate {
    pvariables {
        gone : { state-fluent, bool, default = false };
        go : { action-fluent, bool, default = false };
    };
    cpfs { gone' = gone | go; };
    reward = gone;
    action-preconditions { go => ~gone; };
}
non-fluents none { domain = gate; }
instance gate_1 { domain = gate; non-fluents = none; max-nondef-actions = 1; horizon = 5; discount = 1.0; }
"""


if __name__ == "__main__":
    unittest.main()
