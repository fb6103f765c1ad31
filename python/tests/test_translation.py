"""Native writers of actions: what they take gives the same step as the writers of Python, which take anything."""

from __future__ import annotations

import unittest
from typing import Any

import numpy as np
from support import TEXTS, example, problem_of, problem_of_text

import rddlc
from rddlc.versions import HAS_VECTORS

FORMS = (
    {},
    {"vectorized": True},
    {"actions": "simplified"},
    {"actions": "simplified", "observations": "flat"},
    {"actions": "simplified", "normalize": True},
    {"actions": "box"},
)
PROBLEMS = [problem_of(name) for name in TEXTS if name != "mistake"] + [
    example(name).problem for name in ("delivery", "mountain_car", "network", "reservoir", "robot")
]

WIDE = problem_of_text("""
domain wide {
    pvariables {
        n : { state-fluent, int, default = 0 };
        set : { action-fluent, int, default = 0 };
    };
    cpfs { n' = set; };
    reward = 0;
}
non-fluents nothing { domain = wide; }
instance wide_1 {
    domain = wide; non-fluents = nothing;
    max-nondef-actions = pos-inf; horizon = 5; discount = 1.0;
}
""")


class Refuser:
    """A native writer that takes nothing."""

    def write(self, actions: Any) -> bool:
        return False

    def step(self, actions: Any, into: Any) -> None:
        return None


def slow(env: Any) -> Any:
    env._stepper = None
    env._writer.native = env._writer._native_asked = env._writer._stepper = Refuser()
    return env


class NativeWriters(unittest.TestCase):
    def test_single_environments_step_alike(self) -> None:
        for problem in PROBLEMS:
            for form in FORMS:
                with self.subTest(problem=problem.name, form=form):
                    quick, plain = rddlc.RDDLEnv(problem, **form), slow(rddlc.RDDLEnv(problem, **form))
                    quick.action_space.seed(1)
                    for env in (quick, plain):
                        env.reset(seed=1)
                    for _ in range(4):
                        action = quick.action_space.sample()
                        np.testing.assert_equal(quick.step(action), plain.step(action))
                        if quick.get_state().causes:
                            break

    @unittest.skipUnless(HAS_VECTORS, "vectors need gymnasium 1.0")
    def test_batches_step_alike(self) -> None:
        for problem in PROBLEMS:
            for form in ({"actions": "dict"}, {}, {"normalize": True}, {"actions": "box"}):
                with self.subTest(problem=problem.name, form=form):
                    quick = rddlc.RDDLVectorEnv(problem, 3, **form)
                    plain = slow(rddlc.RDDLVectorEnv(problem, 3, **form))
                    quick.action_space.seed(1)
                    for envs in (quick, plain):
                        envs.reset(seed=1)
                    for _ in range(4):
                        action = quick.action_space.sample()
                        np.testing.assert_equal(quick.step(action), plain.step(action))

    def test_samples_are_taken_natively(self) -> None:
        for problem in PROBLEMS:
            for vectorized in (False, True):
                with self.subTest(problem=problem.name, vectorized=vectorized):
                    env = rddlc.RDDLEnv(problem, vectorized=vectorized)
                    env.reset(seed=1)
                    self.assertTrue(env._writer.native.write(env.action_space.sample()))

    def test_choices_are_taken_natively(self) -> None:
        for problem in PROBLEMS:
            for form in ({"actions": "simplified"}, {"actions": "simplified", "normalize": True}, {"actions": "box"}):
                with self.subTest(problem=problem.name, form=form):
                    env = rddlc.RDDLEnv(problem, **form)
                    env.reset(seed=1)
                    self.assertIsNotNone(env._writer._stepper.step(env.action_space.sample(), None))

    def test_choices_outside_of_the_space_are_refused_natively(self) -> None:
        env = rddlc.make(problem_of("counters"), actions="simplified", observations="flat", normalize=True)
        env.reset(seed=1)
        before = env.get_state()
        step, zeros = env._writer._stepper.step, np.zeros(2, np.float32)
        good = {"discrete": np.zeros(3, np.int64), "continuous": zeros}
        for change in (
            {"discrete": np.array([3, 0, 0])},
            {"discrete": np.array([0, -1, 0])},
            {"discrete": np.zeros(3)},
            {"discrete": np.zeros(4, np.int64)},
            {"continuous": np.array([0, 1.1])},
            {"continuous": np.array([np.nan, 0])},
            {"continuous": np.zeros(3)},
            {"continuous": None},
            {"action": 0},
        ):
            self.assertIsNone(step(good | change, None), change)
        for other in (None, 0, zeros, {"discrete": good["discrete"]}):
            self.assertIsNone(step(other, None))
        self.assertEqual(env.get_state(), before)

    def test_a_box_cuts_categories_and_refuses_numbers(self) -> None:
        quick = rddlc.make(problem_of("counters"), actions="box")
        plain = slow(rddlc.make(problem_of("counters"), actions="box"))
        for wide in (7.0, -7.0, np.inf, -np.inf):
            action = np.array([wide, wide, wide, 0, 0], np.float32)
            for env in (quick, plain):
                env.reset(seed=1)
            np.testing.assert_equal(quick.step(action), plain.step(action))
        for wrong in ([np.nan, 0, 0, 0, 0], [0, 0, 0, 1.5, 0]):
            for env in (quick, plain):
                with self.assertRaises(rddlc.ActionError):
                    env.step(np.array(wrong, np.float32))

    def test_common_forms_of_values_are_one_value(self) -> None:
        env = rddlc.make(problem_of("counters"))
        env.reset(seed=1)
        before, after = env.get_state(), set()
        for two in (2, 2.0, np.int64(2), np.int32(2), np.float32(2), np.array(2), np.array([2.0])):
            self.assertTrue(env._writer.native.write({"add___b": two}), repr(two))
            env.set_state(before)
            env.step({"add___b": two})
            after.add(env.get_state())
        for two in ([2], (2.0,), [np.array([2])]):
            env.set_state(before)
            env.step({"add___b": two})
            after.add(env.get_state())
        self.assertEqual(len(after), 1)
        with self.assertRaises(rddlc.ActionError):
            env.step({"add___b": [2, 2]})

    def test_ints_that_no_double_is_arrive_as_they_are(self) -> None:
        for env in (rddlc.make(WIDE), rddlc.make(WIDE, vectorized=True)):
            for number in (2**53 - 1, 2**53, 2**53 + 1, -(2**53) - 1, 2**62 + 1):
                for form in (int, np.int64, np.array, lambda n: np.array([n])):
                    env.reset(seed=1)
                    observation = env.step({"set": form(number)})[0]
                    self.assertEqual(int(np.squeeze(observation["n"])), number)

    def test_the_rest_is_left_to_python(self) -> None:
        env = rddlc.make(problem_of("counters_two"))
        env.reset(seed=1)
        write = env._writer.native.write
        for action in (
            None,
            [],
            {"no_such": 1},
            {1: 1},
            {"add___b": 3},
            {"add___b": 0.5},
            {"add___b": float("nan")},
            {"add___b": 1 << 70},
            {"add": np.zeros((2, 1))},
            {"add": np.zeros(3)},
            {"add": [1, 2]},
            {"paint": "blue"},
            {"add___a": 1, "add___b": 1, "push": 1.0},  # max-nondef-actions is 2
        ):
            self.assertFalse(write(action), repr(action))
        before = env._batch.actions.copy()
        self.assertTrue(write({"add": np.array([1, 2], np.int8)}))
        self.assertTrue(write({}))
        np.testing.assert_array_equal(env._batch.actions, before)


if __name__ == "__main__":
    unittest.main()
