"""Random actions: those that an action space draws satisfy the preconditions."""

from __future__ import annotations

import copy
import pickle
import unittest
from typing import Any

import numpy as np
from gymnasium import spaces
from support import example, problem_of, problem_of_text

import rddlc
from rddlc.versions import HAS_VECTORS

# One road has to be taken, so the default action is illegal.
TRUCKS = """
domain trucks {
    types { road : object; };
    pvariables {
        CLOSED(road) : { non-fluent, bool, default = false };
        full : { state-fluent, bool, default = true };
        take(road) : { action-fluent, bool, default = false };
        weight(road) : { action-fluent, real, default = 0.0 };
        speed : { action-fluent, int, default = 0 };
    };
    cpfs { full' = ~full; };
    reward = full;
    action-preconditions {
        (sum_{?r : road} take(?r)) == 1;
        forall_{?r : road} [take(?r) => ~CLOSED(?r)];
        forall_{?r : road} [weight(?r) >= 0 ^ weight(?r) <= 1];
        (sum_{?r : road} weight(?r)) <= 1;
        speed >= 0; speed <= 3;
        speed > 0 => full;
    };
}
non-fluents three {
    domain = trucks; objects { road : {r1, r2, r3}; }; non-fluents { CLOSED(r3); };
}
instance trucks_1 {
    domain = trucks; non-fluents = three; max-nondef-actions = pos-inf; horizon = 5; discount = 1.0;
}
"""

NOTHING_LEGAL = """
domain stuck {
    pvariables {
        still : { state-fluent, bool, default = true };
        go : { action-fluent, bool, default = false };
    };
    cpfs { still' = still; };
    reward = 0;
    action-preconditions { go ^ ~go; };
}
non-fluents none { domain = stuck; }
instance stuck_1 { domain = stuck; non-fluents = none; max-nondef-actions = 1; horizon = 5; discount = 1.0; }
"""

FORMS: list[dict[str, Any]] = [
    {},
    {"vectorized": True},
    {"actions": "simplified"},
    {"actions": "simplified", "normalize": True},
    {"actions": "box"},
]
VECTOR_FORMS: list[dict[str, Any]] = [{}, {"actions": "box"}, {"actions": "dict"}]


class LegalActions(unittest.TestCase):
    def test_random_actions_satisfy_preconditions_in_all_forms(self) -> None:
        for problem in (
            problem_of("refuses"),
            problem_of("refuses_some"),
            problem_of_text(TRUCKS),
        ):
            for form in FORMS:
                with self.subTest(problem=problem.name, form=form):
                    env = rddlc.make(problem, enforce_action_constraints=True, **form)
                    env.action_space.seed(1)
                    for seed in range(10):
                        env.reset(seed=seed)
                        over = False
                        while not over:
                            action = env.action_space.sample()
                            self.assertIn(action, env.action_space)
                            _, _, terminated, truncated, _ = env.step(action)  # refuses others
                            over = terminated or truncated

    def test_one_of_many_has_to_be_taken(self) -> None:
        roads = ", ".join(f"r{place}" for place in range(1, 41))
        problem = problem_of_text(TRUCKS.replace("r1, r2, r3", roads))
        for form in FORMS:
            env = rddlc.make(problem, enforce_action_constraints=True, **form)
            env.reset(seed=1)
            env.action_space.seed(1)
            for _ in range(5):
                env.step(env.action_space.sample())  # refuses others

    def test_they_differ(self) -> None:
        """Nothing legal is left out."""
        env = rddlc.make(problem_of_text(TRUCKS))
        env.reset(seed=1)
        env.action_space.seed(1)
        drawn = [env.action_space.sample() for _ in range(100)]
        for name, legal in {
            "take___r1": {0, 1},
            "take___r2": {0, 1},
            "take___r3": {0},
            "speed": {0, 1, 2, 3},
        }.items():
            self.assertEqual({int(each[name]) for each in drawn}, legal)
        self.assertGreater(len({each["weight___r1"].item() for each in drawn}), 10)

    @unittest.skipUnless(HAS_VECTORS, "vectors need gymnasium 1.0")
    def test_vectors_draw_for_each_environments_state(self) -> None:
        for problem in (problem_of("refuses"), problem_of_text(TRUCKS)):
            for form in VECTOR_FORMS:
                with self.subTest(problem=problem.name, form=form):
                    envs = rddlc.make_vec(problem, num_envs=9, **form)
                    envs.reset(seed=1)
                    envs.action_space.seed(1)
                    for _ in range(8):
                        actions = envs.action_space.sample()
                        self.assertIn(actions, envs.action_space)
                        self.assertFalse(envs._writer.violated(actions).any())
                        envs.step(actions)

    def test_they_are_those_of_the_seed(self) -> None:
        for form in FORMS:
            env = rddlc.make(problem_of_text(TRUCKS), **form)
            env.reset(seed=1)
            drawn = []
            for _ in range(2):
                env.action_space.seed(7)
                drawn.append([env.action_space.sample() for _ in range(3)])
            np.testing.assert_equal(drawn[0], drawn[1])

    def test_copies_of_an_environment_draw_what_it_draws(self) -> None:
        for name in ("refuses", "counters"):
            for form in FORMS:
                env = rddlc.make(problem_of(name), **form)
                env.reset(seed=1)
                env.action_space.seed(3)
                env.action_space.sample()
                twins = [copy.deepcopy(env), pickle.loads(pickle.dumps(env))]
                drawn = env.action_space.sample()
                for twin in twins:
                    np.testing.assert_equal(twin.action_space.sample(), drawn)

    def test_copies_of_a_space_are_plain_and_equal(self) -> None:
        for form in FORMS:
            space = rddlc.make(problem_of("refuses_some"), **form).action_space
            for again in (copy.deepcopy(space), pickle.loads(pickle.dumps(space))):
                self.assertEqual(again, space)
                self.assertEqual(space, again)
                self.assertIn(again.sample(), space)
                self.assertNotIn("_sampler", vars(again))
        self.assertIs(type(pickle.loads(pickle.dumps(space))), spaces.Box)

    def test_illegal_actions_are_still_in_the_space(self) -> None:
        env = rddlc.make(problem_of("refuses_some"), actions="simplified")
        env.reset(seed=1)
        self.assertEqual(env.action_space, spaces.Discrete(3))
        self.assertIn(1, env.action_space)  # opens the locked door
        self.assertNotIn(1, {int(env.action_space.sample()) for _ in range(50)})
        locked = np.array([0, 1, 0], np.int8)
        self.assertEqual(env.action_space.sample(locked), 1)  # who has a mask knows

    def test_where_nothing_is_legal_something_is_drawn(self) -> None:
        env = rddlc.make(problem_of_text(NOTHING_LEGAL))
        env.reset(seed=1)
        self.assertIn(env.action_space.sample(), env.action_space)

    def test_drawing_changes_no_episode(self) -> None:
        for form in FORMS:
            env = rddlc.make(problem_of("refuses_some"), observations="flat", **form)
            env.action_space.sample()  # also before the first episode
            env.reset(seed=1)
            action = env.action_space.sample()
            twin = copy.deepcopy(env)
            for _ in range(5):
                env.action_space.sample()
            np.testing.assert_equal(env.step(action), twin.step(action))

    def test_without_preconditions_spaces_are_gymnasiums(self) -> None:
        env = example("network", actions="simplified")
        if not env.model.preconditions:
            self.assertIs(type(env.action_space), spaces.Discrete)


if __name__ == "__main__":
    unittest.main()
