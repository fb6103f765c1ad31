"""Derivatives from Python: those of differences, in the documented shapes."""

from __future__ import annotations

import importlib.util
import unittest

import numpy as np

import rddlc
from rddlc.gradients import Derivatives
from support import FOLDER

RESERVOIR = (FOLDER / "reservoir/domain.rddl", FOLDER / "reservoir/instance.rddl")
NETWORK = (FOLDER / "network/domain.rddl", FOLDER / "network/instance.rddl")
CAR = (FOLDER / "mountain_car/domain.rddl", FOLDER / "mountain_car/instance.rddl")


class Gradients(unittest.TestCase):
    def test_jacobian_is_that_of_differences(self) -> None:
        env = rddlc.make(*CAR)
        env.reset(seed=0)
        state = env.state_from({"position": -0.43, "velocity": 0.01})
        action = {name: 0.25 for name in env.action_space.spaces}
        found = env.jacobian(state, action)
        step = Derivatives(env)
        values = {"position": -0.43, "velocity": 0.01}
        base = np.array([[values[name] for name in found.state_names]])
        push = np.full((1, len(found.action_names)), 0.25)

        def differences(by_state: np.ndarray, by_action: np.ndarray) -> tuple[np.ndarray, float]:
            (above, gain), (below, loss) = (
                step.step(base + sign * by_state, push + sign * by_action) for sign in (1, -1)
            )
            return (above - below)[0] / 2e-6, (gain - loss)[0] / 2e-6

        pairs = (
            (found.next_by_state, found.reward_by_state, 1e-6, 0),
            (found.next_by_action, found.reward_by_action, 0, 1e-6),
        )
        for by_next, by_reward, of_state, of_action in pairs:
            count = len(by_reward)
            self.assertEqual(by_next.shape, (len(found.state_names), count))
            self.assertGreater(count, 0)
            for column in range(count):
                unit = np.zeros((1, count))
                unit[0, column] = 1
                of_next, of_reward = differences(
                    of_state * unit if of_state else np.zeros_like(base),
                    of_action * unit if of_action else np.zeros_like(push),
                )
                np.testing.assert_allclose(by_next[:, column], of_next, atol=1e-6)
                self.assertAlmostEqual(by_reward[column], of_reward, places=6)
        self.assertTrue(found.next_by_action.any())
        self.assertTrue(found.reward_by_action.any())

    def test_values_are_those_of_the_environment(self) -> None:
        env = rddlc.make(*RESERVOIR)
        env.reset(seed=5)
        before = env.get_state()
        found = env.jacobian(None, {}, seed=5)
        _, reward, *_ = env.step({})
        after = np.array([float(each) for each in env.state.values()])
        self.assertEqual(found.reward, reward)
        np.testing.assert_array_equal(found.next_state, after)
        self.assertEqual(env.jacobian(before, {}, seed=5).reward, reward)

    def test_many_steps_at_once(self) -> None:
        step = Derivatives(rddlc.make(*NETWORK), relax="straight")
        states = np.random.default_rng(0).integers(0, 2, (11, len(step.state_names))).astype(float)
        actions = np.zeros((11, len(step.action_names)))
        seeds = np.arange(11)
        next_states, rewards = step.step(states, actions, seeds=seeds)
        for row in range(11):
            one = step.step(states[row, None], actions[row, None], seeds=row)
            np.testing.assert_array_equal(one[0][0], next_states[row])
            self.assertEqual(one[1][0], rewards[row])

    def test_refusals(self) -> None:
        step = Derivatives(rddlc.make(*NETWORK))
        with self.assertRaisesRegex(rddlc.ArgumentError, "the shape is"):
            step.step(np.zeros((1, 2)), np.zeros((1, 1)))
        with self.assertRaisesRegex(rddlc.ArgumentError, "states: rows of .* numbers, not a NoneType"):
            step.step(None, None)
        with self.assertRaisesRegex(rddlc.ArgumentError, "actions: the shape is"):
            step.step(np.zeros((1, len(step.state_names))), None)
        with self.assertRaisesRegex(rddlc.ArgumentError, "relax"):
            Derivatives(rddlc.make(*NETWORK), relax="no")
        with self.assertRaisesRegex(rddlc.ArgumentError, "sharpness"):
            Derivatives(rddlc.make(*NETWORK), sharpness=0)
        rows = np.zeros((2, len(step.state_names))), np.zeros((2, len(step.action_names)))
        for seeds in (1.5, [1.0, 2.0], -1, np.array([3, -1]), 2**64, [1, 2, 3], "a", True):
            with self.subTest(seeds=seeds), self.assertRaisesRegex(rddlc.ArgumentError, "seeds are"):
                step.step(*rows, seeds=seeds)
        step.step(*rows, seeds=2**64 - 1)
        step.step(*rows, seeds=[2**63, 1])
        with self.assertRaises(rddlc.ActionError):
            step.jacobian({}, {"nothing": 1})

    def test_an_action_is_not_none(self) -> None:
        env = rddlc.make(*RESERVOIR)
        env.reset(seed=0)
        with self.assertRaisesRegex(rddlc.ArgumentError, "{} is the default action"):
            env.jacobian(None, None)

    def test_torch(self) -> None:
        step = Derivatives(rddlc.make(*CAR))
        states = np.zeros((3, len(step.state_names)))
        actions = np.full((3, len(step.action_names)), 0.1)
        if importlib.util.find_spec("torch") is None:
            with self.assertRaisesRegex(rddlc.Error, "pip install torch"):
                step.torch(states, actions)
            return
        import torch

        given = torch.tensor(actions, requires_grad=True)
        next_states, _ = step.torch(torch.tensor(states), given)
        next_states.sum().backward()
        _, expected = step.pull_back(states, actions, np.ones_like(states), np.zeros(3))
        np.testing.assert_allclose(given.grad.numpy(), expected)

    def test_planner(self) -> None:
        env = rddlc.make(*RESERVOIR)
        planner = rddlc.plan.Gradient(env, iterations=2, horizon=5)
        env.reset(seed=0)
        env.step(planner.act())


if __name__ == "__main__":
    unittest.main()
