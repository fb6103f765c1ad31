"""Planners from Python: the same actions as on the command line."""

from __future__ import annotations

import unittest

import gymnasium
import rddlc
from support import FOLDER

CAR = (FOLDER / "mountain_car/domain.rddl", FOLDER / "mountain_car/instance.rddl")
NETWORK = (FOLDER / "network/domain.rddl", FOLDER / "network/instance.rddl")
MAZE = (FOLDER / "t_maze/domain.rddl", FOLDER / "t_maze/instance.rddl")


def episode(env: rddlc.RDDLEnv, planner: rddlc.plan.Planner, seed: int) -> float:
    observation, _ = env.reset(seed=seed)
    total, over = 0.0, False
    while not over:
        observation, reward, terminated, truncated, _ = env.step(planner.act(observation))
        total += reward
        over = terminated or truncated
    return total


class Planners(unittest.TestCase):
    def test_acts_as_the_command_does(self) -> None:
        env = rddlc.make(*CAR)
        planner = rddlc.plan.CEM(env, iterations=8)
        total = episode(env, planner, seed=0)
        self.assertGreater(total, 80)
        self.assertEqual(planner.evaluate(1, seed=0).returns.mean, total)

    def test_same_steps_give_the_same_actions(self) -> None:
        for planner in (
            lambda env: rddlc.plan.CEM(env, steps=2000),
            lambda env: rddlc.plan.UCT(env, steps=2000),
            lambda env: rddlc.plan.Rollout(env, policy="random", steps=2000),
        ):
            first, second = (rddlc.make(*NETWORK) for _ in range(2))
            self.assertEqual(
                episode(first, planner(first), seed=3), episode(second, planner(second), seed=3)
            )

    def test_acts_in_many_environments(self) -> None:
        env = rddlc.make_vec(*NETWORK, num_envs=3, observations="dict", actions="dict")
        env.reset(seed=1)
        planner = rddlc.plan.UCT(env, steps=500)
        for _ in range(3):
            env.step(planner.act())

    def test_acts_in_the_environment_of_the_first_place(self) -> None:
        own, other = (rddlc.make(*NETWORK) for _ in range(2))
        own.reset(seed=1)
        other.reset(seed=1)
        other.set_state(other.state_from({"running___c3": True, "running___c6": False}))
        planner = rddlc.plan.UCT(own, iterations=300)
        of_own, of_other = planner.act(), planner.act(env=other)
        self.assertNotEqual(of_own, of_other)
        for given in (other, gymnasium.wrappers.TimeLimit(other, 9)):
            self.assertEqual(planner.act(given), of_other)
        self.assertEqual(planner.act(own.reset(seed=1)[0]), of_own)

    def test_other_things_than_its_environments_are_refused(self) -> None:
        env, car = rddlc.make(*NETWORK), rddlc.make(*CAR)
        env.reset(seed=1)
        car.reset(seed=1)
        planner = rddlc.plan.UCT(env, iterations=3)
        with self.assertRaisesRegex(rddlc.ArgumentError, "two envs"):
            planner.act(env, rddlc.make(*NETWORK))
        for given, pattern in (
            (car, "the env is of .*car.*, and the planner of .*network"),
            ("anything", "'anything' is neither"),
            (env.problem, "neither"),
            (gymnasium.Env(), "neither"),
        ):
            with self.subTest(given=given), self.assertRaisesRegex(rddlc.ArgumentError, pattern):
                planner.act(given)
            with self.subTest(env=given), self.assertRaisesRegex(rddlc.ArgumentError, pattern):
                planner.act(env=given)

    def test_options_that_cannot_be(self) -> None:
        problem = rddlc.Problem(*NETWORK)
        with self.assertRaisesRegex(rddlc.Error, "there is no option 'second'; did you mean 'seconds'"):
            rddlc.plan.CEM(problem, second=1)
        with self.assertRaisesRegex(rddlc.Error, "steps: '0' is not an int from 1"):
            rddlc.plan.UCT(problem, steps=0)
        with self.assertRaisesRegex(rddlc.Error, "say which one"):
            rddlc.plan.Rollout(problem)
        for policy in (rddlc.PPO(problem), rddlc.plan.CEM(problem, steps=1)):
            with self.assertRaisesRegex(rddlc.Error, "policy is a .*, not a text: give the name of a"):
                rddlc.plan.Rollout(problem, policy=policy)
        with self.assertRaisesRegex(rddlc.Error, "in which env it acts"):
            rddlc.plan.CEM(problem, steps=1).act()
        with self.assertRaisesRegex(rddlc.Error, r"(?s)hides from policies.*in Python, with cheat=True"):
            rddlc.plan.Gradient(rddlc.Problem(*MAZE))
        self.assertIn("t_maze", repr(rddlc.plan.CEM(rddlc.Problem(*MAZE), cheat=True)))

    def test_a_hidden_state_is_found_by_particles(self) -> None:
        env = rddlc.make(*MAZE)
        planner = rddlc.plan.UCT(env, steps=2000)
        for seed in (1, 2, 3):
            self.assertAlmostEqual(episode(env, planner, seed), 4)

    def test_documentation_lists_all_options(self) -> None:
        for planner in (rddlc.plan.CEM, rddlc.plan.UCT, rddlc.plan.Rollout):
            for option in ("seconds", "steps", "iterations", "horizon", "policy", "cheat", "seed"):
                self.assertIn(f"\n    {option}: ", planner.__doc__ or "")


if __name__ == "__main__":
    unittest.main()
