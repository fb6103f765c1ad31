"""Batches that plan: states of many environments, independent draws, copies and pickles, states by name."""

from __future__ import annotations

import pickle
import unittest
from copy import deepcopy
from typing import Any

import numpy as np
from support import example, problem_of

import rddlc

COUNT = 6


def vector(name: str = "network", **options: Any) -> rddlc.RDDLVectorEnv:
    return rddlc.make_vec(example(name).problem, num_envs=COUNT, **options)


def steps(envs: rddlc.RDDLVectorEnv, count: int = 5) -> list[Any]:
    return [envs.step(envs.action_space.sample()) for _ in range(count)]


class States(unittest.TestCase):
    def test_states_are_those_of_single_environments(self) -> None:
        envs, single = vector(), example("network")
        envs.reset(seed=7)
        single.reset(seed=7 + 2)
        for _ in range(3):
            envs.step(np.full(COUNT, 8))
            single.step({})
        self.assertEqual(envs.get_states()[2], single.get_state())
        self.assertEqual(envs.timesteps.tolist(), [3] * COUNT)
        np.testing.assert_equal({k: v[2] for k, v in envs.state.items()},
                                example_state(single, vectorized=True))

    def test_all_go_to_one_state(self) -> None:
        envs = vector()
        envs.reset(seed=1)
        steps(envs)
        state = envs.get_states()[3]
        observations = envs.set_states(state)
        self.assertEqual(envs.get_states(), [state] * COUNT)
        np.testing.assert_array_equal(observations, np.tile(observations[3], (COUNT, 1)))

    def test_some_go_to_states_of_their_own(self) -> None:
        envs = vector()
        envs.reset(seed=1)
        before = envs.get_states()
        steps(envs)
        after = envs.get_states()
        envs.set_states([before[0], None, before[2], *[None] * (COUNT - 3)])
        expected = [before[0], after[1], before[2], *after[3:]]
        self.assertEqual(envs.get_states(), expected)

    def test_environments_draw_independently(self) -> None:
        envs = rddlc.make_vec(example("network").problem, num_envs=40)
        envs.reset(seed=1)
        state = envs.get_states()[0]
        nothing = np.full(40, 8)
        draws = []
        for seed in (5, 5, 6, None, None):
            envs.set_states(state, seed=seed)
            envs.step(nothing)
            draws.append(envs.get_states())
        self.assertGreater(len(set(draws[0])), 1)
        self.assertEqual(draws[0], draws[1])
        for other in draws[2:]:
            self.assertNotEqual(draws[0], other)
        self.assertNotEqual(draws[3], draws[4])
        envs.set_states(state, seed=range(5, 45))
        envs.step(nothing)
        self.assertEqual(envs.get_states(), draws[0])

    def test_replay_draws_what_was_drawn(self) -> None:
        envs = vector()
        envs.reset(seed=1)
        before = envs.get_states()
        after = []
        for _ in range(2):
            envs.set_states(before, replay=True)
            envs.step(np.full(COUNT, 8))
            after.append(envs.get_states())
        self.assertEqual(after[0], after[1])

    def test_episodes_that_ended_run_again(self) -> None:
        for mode in ("Disabled", "NextStep", "SameStep"):
            envs = vector(autoreset_mode=mode, horizon=3)
            envs.reset(seed=1)
            start = envs.get_states()[0]
            steps(envs, 3)
            envs.set_states(start)
            truncated = [bool(step[3].any()) for step in steps(envs, 3)]
            self.assertEqual(truncated, [False, False, True], mode)

    def test_what_cannot_be_is_refused_and_changes_nothing(self) -> None:
        envs = vector(horizon=2)
        envs.reset(seed=1)
        before = envs.get_states()
        over = example("network", horizon=1)
        over.reset(seed=1)
        over.step({})
        other = problem_of("counters")
        for states, options, pattern in (
            (before[:2], {}, "there are 2 states for 6"),
            ([before[0]] * 5 + [rddlc.make(other).state_from({})], {}, "another problem"),
            (over.get_state(), {}, "over"),
            ("state", {}, "rddlc.State"),
            (before, {"seed": 1, "replay": True}, "not both"),
            (before, {"seed": -1}, "seed is -1"),
        ):
            with self.subTest(pattern=pattern), self.assertRaisesRegex(rddlc.Error, pattern):
                envs.set_states(states, **options)
        self.assertEqual(envs.get_states(), before)


def example_state(env: rddlc.RDDLEnv, **options: Any) -> Any:
    twin = rddlc.RDDLEnv(env.problem, **options)
    twin.reset(seed=1)
    twin.set_state(env.get_state())
    return twin.state


class Copies(unittest.TestCase):
    def test_copies_and_pickles_go_on_alike(self) -> None:
        for mode in ("NextStep", "SameStep"):
            for form in ({}, {"actions": "dict", "observations": "dict"}):
                envs = vector(horizon=3, autoreset_mode=mode, **form)
                envs.reset(seed=3)
                envs.action_space.seed(4)
                steps(envs)
                copies = [deepcopy(envs), pickle.loads(pickle.dumps(envs))]
                expected = steps(envs)
                for copy in copies:
                    with self.subTest(mode=mode, form=form):
                        np.testing.assert_equal(steps(copy), expected)
                        np.testing.assert_equal(copy.reset(), envs.reset() if copy is copies[0] else copy.reset())

    def test_a_copy_is_another(self) -> None:
        envs = vector()
        envs.reset(seed=3)
        before = envs.get_states()
        copy = deepcopy(envs)
        steps(copy)
        self.assertEqual(envs.get_states(), before)
        envs.set_states(before[0])
        copy.set_states(before[0])
        nothing = np.full(COUNT, 8)
        np.testing.assert_equal(envs.step(nothing), copy.step(nothing))  # seeds of equal generators

    def test_one_that_has_not_begun(self) -> None:
        copy = pickle.loads(pickle.dumps(vector()))
        with self.assertRaises(rddlc.EpisodeOver):
            copy.step(np.zeros(COUNT, int))


class StatesByName(unittest.TestCase):
    def test_names_are_grounded_or_lifted(self) -> None:
        env = rddlc.make(problem_of("counters"))
        env.reset(seed=1)
        state = env.state_from({"count___b": 3, "shade": "@blue", "filled": 0.5}, steps=2)
        env.set_state(state)
        shown = {name: float(value) for name, value in env.state.items()}
        self.assertEqual(shown, {"count___a": 0, "count___b": 3, "shade": 2, "filled": 0.5})
        self.assertEqual(env.timestep, 2)
        self.assertEqual(env.state_from({"count": [0, 3], "shade": 2, "filled": 0.5}, steps=2), state)

    def test_what_env_state_says_is_the_state(self) -> None:
        for vectorized in (False, True):
            env = example("network", vectorized=vectorized)
            env.reset(seed=1)
            env.step({})
            self.assertEqual(env.state_from(env.state, steps=1), env.get_state())

    def test_what_cannot_be_is_refused(self) -> None:
        env = rddlc.make(problem_of("counters"))
        for values, pattern in (
            ({"no_such": 1}, "no state-fluent 'no_such'"),
            ({"count___a": 0.5}, "state-fluent 'count___a' is 0.5"),
            ({"shade": "@pink"}, "one of"),
            ({"count": [1]}, "shape"),
            ([1], "dictionary"),
        ):
            with self.subTest(values=values), self.assertRaisesRegex(rddlc.ArgumentError, pattern):
                env.state_from(values)


class Attributes(unittest.TestCase):
    def test_what_the_problem_says(self) -> None:
        envs = vector(horizon=9)
        self.assertEqual((envs.horizon, envs.discount), (9, envs.model.discount))
        self.assertEqual(envs.get_attr("horizon"), (9,) * COUNT)
        self.assertEqual(envs.get_attr("action_space"), (envs.single_action_space,) * COUNT)
        envs.reset(seed=1)
        self.assertEqual(list(envs.call("get_state")), envs.get_states())
        self.assertEqual(len(envs.call("state")), COUNT)
        with self.assertRaisesRegex(rddlc.ArgumentError, "set_states"):
            envs.call("set_states", envs.get_states()[0])
        with self.assertRaises(AttributeError):
            envs.get_attr("no_such")

    def test_pictures(self) -> None:
        envs = vector("mountain_car", render_mode="rgb_array", render_size=(60, 40))
        self.assertEqual(envs.render_mode, "rgb_array")
        with self.assertRaisesRegex(rddlc.EpisodeOver, r"reset\(\) before render"):
            envs.render()
        envs.reset(seed=1)
        start = envs.render()
        steps(envs, 30)
        pictures = envs.render()
        self.assertEqual([each.shape for each in pictures], [(40, 60, 3)] * COUNT)
        self.assertTrue((start[0] == start[1]).all())
        self.assertTrue((start[0] != pictures[0]).any())
        texts = vector("mountain_car", render_mode="ansi")
        texts.reset(seed=1)
        self.assertIn("velocity", texts.render()[0])

    def test_masks(self) -> None:
        envs = rddlc.make_vec(problem_of("refuses_some"), num_envs=COUNT, action_mask=True)
        _, infos = envs.reset(seed=1)
        expected = [[True, False, True]] * COUNT  # the second door is locked
        self.assertEqual(infos["action_mask"].tolist(), expected)
        *_, infos = envs.step(np.zeros(COUNT, int))
        self.assertEqual(infos["action_mask"].tolist(), expected)

    def test_violations_are_refused(self) -> None:
        problem = problem_of("refuses_some")
        for actions, good in (("simplified", np.zeros(COUNT, int)),
                              ("dict", {"open": np.zeros((COUNT, 2), bool)})):
            envs = rddlc.make_vec(
                problem, num_envs=COUNT, actions=actions, enforce_action_constraints=True
            )
            envs.reset(seed=1)
            before = envs.get_states()
            bad = deepcopy(good)
            (bad if actions == "simplified" else bad["open"][:, 1])[4] = 1
            with self.assertRaisesRegex(rddlc.ActionError, "environment 4: .*d2"):
                envs.step(bad)
            self.assertEqual(envs.get_states(), before)
            envs.step(good)


if __name__ == "__main__":
    unittest.main()
