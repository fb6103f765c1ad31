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
        count, width = len(found.state_names), 1e-6
        self.assertEqual(found.next_by_state.shape, (count, count))
        self.assertEqual(found.next_by_action.shape, (count, len(found.action_names)))
        self.assertEqual(found.reward_by_state.shape, (count,))
        step = Derivatives(env)
        base = np.array([[-0.43, 0.01]]) if found.state_names[0] == "position" else np.array([[0.01, -0.43]])
        push = np.full((1, len(found.action_names)), 0.25)
        for column in range(count):
            shift = np.zeros_like(base)
            shift[0, column] = width
            above, below = (step.step(base + sign * shift, push)[0] for sign in (1, -1))
            np.testing.assert_allclose(
                found.next_by_state[:, column], (above - below)[0] / (2 * width), atol=1e-6
            )

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
        with self.assertRaisesRegex(rddlc.ArgumentError, "relax"):
            Derivatives(rddlc.make(*NETWORK), relax="no")
        with self.assertRaisesRegex(rddlc.ArgumentError, "sharpness"):
            Derivatives(rddlc.make(*NETWORK), sharpness=0)
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
