"""The forms that learners take: flat observations, simplified actions, one box for everything."""

from __future__ import annotations

import unittest

import numpy as np
from gymnasium import spaces
from support import TEXTS, example, problem_of, problem_of_text, written

import rddlc
from rddlc.translation.action_plan import Squash, plan_of
from rddlc.model import Model
from rddlc.translation.readers import FlatReader
from rddlc.versions import HAS_VECTORS


EXTREME = """
domain extreme {
    pvariables {
        tiny : { state-fluent, real, default = 0.0 };
        huge : { state-fluent, real, default = 0.0 };
        fixed : { state-fluent, real, default = 3.0 };
        move : { action-fluent, bool, default = false };
    };
    cpfs { tiny' = tiny; huge' = huge; fixed' = fixed; };
    reward = 0;
    state-invariants {
        tiny >= 0; tiny <= TINY; huge >= -HUGE; huge <= HUGE; fixed >= 3; fixed <= 3;
    };
}
non-fluents nothing { domain = extreme; }
instance extreme_1 {
    domain = extreme; non-fluents = nothing;
    max-nondef-actions = pos-inf; horizon = 5; discount = 1.0;
}
""".replace("TINY", f"0.{'0' * 60}1").replace("HUGE", f"1{'0' * 60}.0")  # RDDL's numbers have no exponent


def features_of(model: Model, values: dict[str, np.ndarray], *, normalize: bool) -> np.ndarray:
    """(features,) by the definition in docs/python.md, of a vectorized dictionary."""
    features: list[float] = []
    for fluent in model.observed:
        for place, value in enumerate(np.ravel(values[fluent.name]).tolist()):
            count = len(fluent.objects or ())
            entries = [float(value == each) for each in range(count)] or [value]
            lower, upper = 0.0, 1.0
            if not count and fluent.scalar != "bool":
                bounds = [np.ravel(each)[place] for each in (fluent.lower, fluent.upper) if each is not None]
                lower, upper = bounds or (-np.inf, np.inf)
            if normalize and np.isfinite([lower, upper]).all() and lower < upper:
                entries = [(each - (lower + upper) / 2) / ((upper - lower) / 2) for each in entries]
            features += entries
    return np.array(features, np.float32)


class FlatObservations(unittest.TestCase):
    def test_objects_are_a_feature_each(self) -> None:
        env = written("counters", observations="flat")
        env.reset(seed=1)
        self.assertEqual(env.observation_space.shape, (6,))
        self.assertEqual(env.observation_space.dtype, np.float32)
        observation = env.step({"paint": "blue", "add___b": 2, "push": 0.5})[0]
        np.testing.assert_array_equal(observation, [0, 2, 0, 0, 1, 0.5])

    def test_names_tell_the_features(self) -> None:
        problem = written("counters").problem
        values = np.zeros((1, 4), np.float32)
        reader = FlatReader(problem.model.observed, values, values, normalize=False)
        colors = ["shade=red", "shade=green", "shade=blue"]
        self.assertEqual(reader.names, ["count___a", "count___b", *colors, "filled"])

    def test_features_are_those_of_the_dictionary(self) -> None:
        problems = [problem_of(name) for name in TEXTS if name != "mistake"]
        for problem in [*problems, *(example(name).problem for name in ("delivery", "reservoir", "robot"))]:
            for normalize in (False, True):
                with self.subTest(problem=problem.name, normalize=normalize):
                    flat = rddlc.make(problem, observations="flat", normalize=normalize)
                    twin = rddlc.make(problem, vectorized=True)
                    twin.action_space.seed(1)
                    shown, values = flat.reset(seed=1)[0], twin.reset(seed=1)[0]
                    for _ in range(4):
                        expected = features_of(problem.model, values, normalize=normalize)
                        np.testing.assert_allclose(shown, expected, rtol=1e-6, atol=1e-6)
                        self.assertTrue(shown.dtype == np.float32 and flat.observation_space.contains(shown))
                        action = twin.action_space.sample()
                        shown, _, terminated, truncated, _ = flat.step(action)
                        values = twin.step(action)[0]
                        if terminated or truncated:
                            break

    def test_ranges_that_no_float_has_are_not_normalized(self) -> None:
        env = rddlc.make(problem_of_text(EXTREME), observations="flat", normalize=True)
        shown, _ = env.reset(seed=1)
        self.assertEqual(shown.tolist(), [0, 0, 3])
        self.assertTrue(env.observation_space.contains(shown))

    @unittest.skipUnless(HAS_VECTORS, "vectors need gymnasium 1.0")
    def test_rows_and_last_rows_are_those_of_single_environments(self) -> None:
        for actions in ("simplified", "dict"):
            with self.subTest(actions=actions):
                forms = {"normalize": True, "horizon": 2}
                envs = rddlc.make_vec(
                    problem_of("counters"), num_envs=3, actions=actions, autoreset_mode="SameStep", **forms
                )
                single = written("counters", observations="flat", **forms)
                first, _ = envs.reset(seed=1)
                envs.action_space.seed(1)
                action = envs.action_space.sample()
                envs.step(action)
                again, *_, infos = envs.step(action)
                self.assertEqual(first[0].tolist(), single.reset(seed=1)[0].tolist())
                np.testing.assert_array_equal(again, first)
                self.assertEqual(infos["final_obs"].shape, first.shape)
                shades = infos["final_obs"][:, 2:5]
                np.testing.assert_array_equal(np.sort(shades), [[-1, -1, 1]] * 3)

    def test_normalized_bounds_are_minus_one_and_one(self) -> None:
        env = written("refuses", observations="flat", normalize=True)  # a glass from 0 to 4
        self.assertEqual(env.observation_space, spaces.Box(-1, 1, (1,), np.float32))
        self.assertEqual(env.reset(seed=1)[0], [-1])
        self.assertEqual(env.step({"pour": 1.0})[0], [-0.5])

    def test_normalized_values_at_bounds_lie_in_the_space(self) -> None:
        text = """
            domain tank {
                pvariables {
                    height : { state-fluent, real, default = 0.3 };
                    wait : { action-fluent, bool, default = false };
                };
                cpfs { height' = height; };
                reward = 0;
                state-invariants { height >= 0.1; height <= 0.3; };
            }
            non-fluents nothing { domain = tank; }
            instance tank_1 {
                domain = tank; non-fluents = nothing; max-nondef-actions = 1; horizon = 5; discount = 1.0;
            }
        """
        env = rddlc.make(problem_of_text(text), observations="flat", normalize=True)
        self.assertIn(env.reset(seed=1)[0], env.observation_space)


class DictionariesForLearners(unittest.TestCase):
    def test_numbers_are_float32_rows_and_ints_begin_at_zero(self) -> None:
        for actions in ("simplified", "box"):
            env = example("mountain_car", actions=actions)
            self.assertEqual(env.observation_space["velocity"], spaces.Box(-np.inf, np.inf, (1,), np.float32))
            observation, _ = env.reset(seed=1)
            self.assertTrue(env.observation_space.contains(observation))
            twin = example("mountain_car")
            self.assertAlmostEqual(observation["velocity"].item(), float(twin.reset(seed=1)[0]["velocity"]))
        env = written("counters", actions="box", vectorized=True)
        self.assertEqual(env.observation_space["count"].shape, (2,))
        self.assertTrue(env.observation_space.contains(env.reset(seed=1)[0]))

    def test_learners_act_by_them(self) -> None:
        env = example("mountain_car", actions="box")
        model = rddlc.CGP(env, seed=1).learn(2, evaluations=0)
        observation, _ = env.reset(seed=1)
        other = {name: value + np.float32(0.01) for name, value in observation.items()}
        self.assertEqual(model.predict(observation)[0].shape, (1,))
        self.assertEqual(model.predict(other)[0].shape, (1,))


class SimplifiedActions(unittest.TestCase):
    def test_one_change_of_bools_is_discrete(self) -> None:
        env = example("network", actions="simplified")
        count = len(env.model.types["computer"].objects)
        self.assertEqual(env.action_space, spaces.Discrete(count + 1))
        twin = example("network")
        for choice in (0, 3, count):
            env.reset(seed=1)
            twin.reset(seed=1)
            names = env.model.fluents["reboot"].groundings
            action = {names[choice]: True} if choice < count else {}
            np.testing.assert_equal(env.step(choice), twin.step(action))

    def test_categories_and_numbers_are_a_dictionary(self) -> None:
        env = written("counters", actions="simplified")
        self.assertEqual(env.action_space["discrete"], spaces.MultiDiscrete([3, 4, 4]))
        self.assertEqual(env.action_space["continuous"].low.tolist(), [-np.inf, 0])
        env.reset(seed=1)
        action = {"discrete": [2, 3, 0], "continuous": [0.5, 0.25]}
        observation = env.step(action)[0]
        self.assertEqual(observation["shade"], 2)
        self.assertEqual([observation["count___a"], observation["count___b"]], [2, -1])
        self.assertAlmostEqual(observation["filled"].item(), 0.25)

    def test_few_changes_are_chosen_one_after_the_other(self) -> None:
        env = written("counters_two", actions="simplified")
        # Two other colours, three other counts of each counter, push and pull, nothing.
        self.assertEqual(env.action_space["discrete"], spaces.MultiDiscrete([11, 11]))
        env.reset(seed=1)
        numbers = [0.5, 0.25]
        for changes, color, counts, filled in (
            ([10, 10], 1, [0, 0], 0),
            ([1, 4], 2, [2, 0], 0),
            ([8, 10], 1, [0, 0], 0.5),
            ([9, 7], 1, [0, 2], -0.25),
        ):
            env.reset(seed=1)
            shown = env.step({"discrete": changes, "continuous": numbers})[0]
            self.assertEqual(shown["shade"], color)
            self.assertEqual([shown["count___a"], shown["count___b"]], counts)
            self.assertAlmostEqual(shown["filled"].item(), filled)

    def test_refused_actions_change_nothing(self) -> None:
        env = written("counters", actions="simplified")
        env.reset(seed=1)
        before = env.get_state()
        good = {"discrete": [0, 0, 0], "continuous": [0, 0]}
        for bad in (
            {"discrete": [3, 0, 0]},
            {"discrete": [0, 0]},
            {"discrete": [0.5, 0, 0]},
            {"continuous": [0, -1]},
            {"continuous": [np.nan, 0]},
        ):
            with self.subTest(bad=bad), self.assertRaises(rddlc.ActionError):
                env.step(good | bad)
        self.assertEqual(env.get_state(), before)


class Boxes(unittest.TestCase):
    def test_everything_is_one_box(self) -> None:
        env = written("counters", actions="box")
        self.assertEqual(env.action_space, spaces.Box(-1, 1, (5,), np.float32))
        env.reset(seed=1)
        shown = env.step(np.array([1, -1, 1, 0, -1], np.float32))[0]
        self.assertEqual(shown["shade"], 2)
        self.assertEqual([shown["count___a"], shown["count___b"]], [-1, 2])
        self.assertEqual(shown["filled"].item(), 0)

    def test_squashed_numbers_keep_bounds_and_order(self) -> None:
        plan = plan_of(written("counters").problem)
        rows = np.repeat(np.linspace(-1, 1, 101)[:, np.newaxis], 2, axis=1)
        values = Squash(plan).values(rows)
        self.assertTrue((np.diff(values, axis=0) > 0).all())
        self.assertEqual(values[0, 1], 0)  # of pull, which is not negative
        self.assertEqual(values[50, 0], 0)  # of push: the default
        self.assertTrue(np.isfinite(values).all())


if __name__ == "__main__":
    unittest.main()
