"""Whatever is asked for, nothing crashes: a sentence says what is wrong, and nothing is changed."""

from __future__ import annotations

import unittest
from collections.abc import Callable
from typing import Any

import numpy as np
from support import FOLDER, example, problem_of

import rddlc
from rddlc.transitions import Transitions

CAR = FOLDER / "mountain_car"
Case = tuple[Callable[[], Any], type[BaseException], str]


def vector(**options: Any) -> rddlc.RDDLVectorEnv:
    return rddlc.make_vec(CAR, 1, **{"num_envs": 4, "engine": "interpreter", **options})


class Refusals(unittest.TestCase):
    def check(self, cases: list[Case]) -> None:
        for number, (call, error, pattern) in enumerate(cases):
            with self.subTest(number=number, pattern=pattern), self.assertRaisesRegex(error, pattern):
                call()

    def test_of_what_is_made(self) -> None:
        self.check(
            [
                (lambda: vector(num_envs=0), rddlc.Error, "num_envs is 0"),
                (lambda: vector(num_envs=-1), rddlc.Error, "num_envs is -1"),
                (lambda: vector(num_envs=1 << 40), rddlc.Error, "GiB|memory"),
                (lambda: vector(num_envs="4"), TypeError, ""),
                (lambda: vector(observations="none"), ValueError, "'flat' nor 'dict'"),
                (lambda: vector(autoreset_mode="none"), ValueError, ""),
                (lambda: example("mountain_car", observations="none"), ValueError, "none of"),
                (lambda: example("mountain_car", no_option=1), TypeError, "no_option"),
                (lambda: example("mountain_car", render_mode="ansi", render_size=(0, 9)), rddlc.Error, "16 to 8192"),
                (lambda: example("mountain_car", render_mode="ansi", visualizer="x"), rddlc.Error, "no visualizer"),
                (lambda: rddlc.make("/etc/passwd", engine="interpreter"), rddlc.CompileError, "E0"),
                (lambda: rddlc.make("/no/such/file", engine="interpreter"), rddlc.Error, "no/such"),
                (lambda: rddlc.make(CAR, 1, engine="none"), ValueError, "none of"),
                (lambda: Transitions(example("mountain_car").problem, levels=-1), rddlc.Error, "2 or more"),
            ]
        )

    def test_of_episodes(self) -> None:
        env = example("mountain_car")
        env.reset(seed=1)
        env.step({"throttle": 0.5})
        before = env.get_state()
        other = example("network")
        other.reset(seed=1)
        self.check(
            [
                (lambda: env.reset(options=[1]), TypeError, "a dictionary, not a list"),
                (lambda: env.reset(seed=2, options={"state": 3}), TypeError, "rddlc.State, not a int"),
                (lambda: env.reset(seed=-1), Exception, "greater or equal to zero"),
                (lambda: env.set_state(None), TypeError, "rddlc.State"),
                (lambda: env.set_state(other.get_state()), rddlc.Error, "bytes, not"),
                (lambda: env.step({"throttle": 10**400}), rddlc.ActionError, "throttle"),
                (lambda: env.step({"throttle": 1j}), rddlc.ActionError, "throttle"),
                (lambda: env.step({1: 2}), rddlc.ActionError, "no action '1'"),
            ]
        )
        self.assertEqual(env.get_state(), before)

    def test_of_many_environments(self) -> None:
        envs = vector()
        envs.reset(seed=1)
        envs.step(np.full((4, 1), 0.5, np.float32))
        before = [envs._batch.progress(place) for place in range(4)]
        two = np.zeros((4, 1), np.float32)
        two[3] = 2
        self.check(
            [
                (lambda: envs.step(two), rddlc.ActionError, "throttle"),
                (lambda: envs.step(np.full_like(two, np.nan)), rddlc.ActionError, "throttle"),
                (lambda: envs.step(two[:3]), rddlc.ActionError, "shape"),
                (lambda: envs.step("abcd"), Exception, ""),
                (lambda: envs.reset(seed=[1, 2]), ValueError, "2 seeds for 4"),
                (lambda: envs.reset(options={"reset_mask": np.ones(2, bool)}), ValueError, "shape"),
            ]
        )
        self.assertEqual([envs._batch.progress(place) for place in range(4)], before)

    def test_of_discrete_actions(self) -> None:
        env = example("network", actions="simplified")
        env.reset(seed=1)
        before = env.get_state()
        for action in (-1, 9, 10**30, 1.5, "x", None, [1, 2], np.nan, {}):
            with self.subTest(action=action), self.assertRaises((rddlc.ActionError, TypeError, OverflowError)):
                env.step(action)
        self.assertEqual(env.get_state(), before)

    def test_of_learners(self) -> None:
        problem = example("mountain_car").problem
        model = rddlc.CGP(problem).learn(1)
        self.check(
            [
                (lambda: model.evaluate(0), rddlc.Error, "one episode or more, not 0"),
                (lambda: model.evaluate(-1), rddlc.Error, "one episode or more, not -1"),
                (lambda: model.learn(-1), ValueError, "one or more"),
                (lambda: rddlc.PPO(problem, environments=-1), rddlc.Error, ""),
                (lambda: rddlc.PPO(problem, seed=-1), rddlc.Error, "seed"),
                (lambda: rddlc.CGP.load("/etc/passwd", problem), rddlc.Error, ""),
                (lambda: model.save("/no/such/folder/x"), rddlc.Error, "no/such"),
            ]
        )

    def test_of_transitions(self) -> None:
        transitions = Transitions(problem_of("refuses_some"))
        foreign = Transitions(example("mountain_car").problem).start()
        self.check(
            [
                (lambda: transitions.sample(foreign, 0), rddlc.Error, "bytes"),
                (lambda: transitions.sample(transitions.start(), 99), IndexError, ""),
            ]
        )


if __name__ == "__main__":
    unittest.main()
