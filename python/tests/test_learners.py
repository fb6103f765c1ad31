"""rddlc.PPO and rddlc.CGP."""

from __future__ import annotations

import tempfile
import threading
import time
import unittest
from pathlib import Path

from support import example

import rddlc


def played(model: rddlc.Learner, env: rddlc.RDDLEnv, seed: int) -> float:
    env.reset(seed=seed)
    total, over = 0.0, False
    while not over:
        _, reward, terminated, truncated, _ = env.step(model.predict(env)[0])
        total, over = total + reward, terminated or truncated
    return total


class Learners(unittest.TestCase):
    def models(self) -> list[rddlc.Learner]:
        problem = example("mountain_car").problem
        ppo = rddlc.PPO(problem, environments=4, rollout=16, minibatch=64, seed=1)
        return [ppo.learn(200), rddlc.CGP(problem, children=4, nodes=20, seed=1).learn(5)]

    def recurrent(self) -> rddlc.Learner:
        maze = example("t_maze").problem
        options = {"environments": 4, "rollout": 16, "minibatch": 64, "seed": 1}
        return rddlc.PPO(maze, recurrent=6, segment=8, **options).learn(2000)

    def test_what_is_saved_acts_alike(self) -> None:
        for model in (*self.models(), self.recurrent()):
            with tempfile.TemporaryDirectory() as folder:
                file = model.save(Path(folder) / "policy")
                self.assertEqual(file.suffix, model.extension)
                again = type(model).load(file, model.problem)
            self.assertEqual(again.evaluate(3, seed=5), model.evaluate(3, seed=5))

    def test_predictions_earn_what_evaluations_tell(self) -> None:
        for model in (*self.models(), self.recurrent()):
            for vectorized in (False, True):
                env = rddlc.make(model.problem, vectorized=vectorized)
                expected = model.evaluate(1, seed=3).returns.mean
                self.assertAlmostEqual(played(model, env, 3), expected)
                self.assertAlmostEqual(played(model, env, 3), expected)

    def test_each_environment_has_a_memory_of_its_own(self) -> None:
        maze = example("t_maze").problem
        # It solves the maze, so what it does at the junction depends on what each has seen before.
        model = rddlc.PPO(maze, environments=16, minibatch=256, epochs=10, learning_rate=1e-3,
                          hidden=[32, 32], recurrent=16, seed=1)  # fmt: skip
        model.learn(80_000)
        envs = rddlc.make_vec(maze, num_envs=8, observations="dict", actions="dict")
        envs.reset(seed=3)
        rewards = [envs.step(model.predict(envs)[0])[1] for _ in range(40)]
        paid = [reward for step in rewards for reward in step if reward > 0]
        self.assertGreater(len(paid), 16)
        self.assertTrue(all(reward >= 0 for step in rewards for reward in step))

    def test_predictions_of_many_environments(self) -> None:
        for model in self.models():
            envs = rddlc.make_vec(model.problem, num_envs=3, observations="dict", actions="dict")
            envs.reset(seed=1)
            actions, _ = model.predict(envs)
            self.assertIn(actions, envs.action_space)
            envs.step(actions)

    def test_learning_goes_on(self) -> None:
        ppo, cgp = self.models()
        before = ppo.steps, cgp.steps
        ppo.learn(200)
        cgp.learn(5)
        self.assertEqual((before[0] * 2, before[1] * 2), (ppo.steps, cgp.steps))
        self.assertIn("train/approx_kl", ppo.progress)

    def test_callbacks_end_it(self) -> None:
        seen: list[int] = []
        model = rddlc.PPO(example("network"), environments=4, rollout=16, minibatch=64)
        model.learn(10_000, callback=lambda learner: seen.append(learner.steps) or len(seen) < 3)
        self.assertEqual(seen, [64, 128, 192])

    def test_formulas_are_told(self) -> None:
        formula = str(self.models()[1])
        self.assertTrue(formula.startswith("throttle = "), formula)
        self.assertIn("throttle", self.models()[1]._repr_html_())

    def test_options_that_cannot_be(self) -> None:
        problem = example("network").problem
        for options in ({"step": 1}, {"rollout": "x"}, {"schedule": "x"}, {"preset": "x"}):
            with self.assertRaises(rddlc.Error):
                rddlc.PPO(problem, **options)
        with self.assertRaisesRegex(rddlc.Error, "learn"):
            rddlc.PPO(problem).evaluate()

    def test_other_threads_run_meanwhile(self) -> None:
        model = rddlc.PPO(example("network"), environments=64, rollout=128, epochs=10)
        learning = threading.Thread(target=lambda: model.learn(1))
        learning.start()
        ticks = 0
        while learning.is_alive():
            time.sleep(0.001)
            ticks += 1
        self.assertGreater(ticks, 3)


if __name__ == "__main__":
    unittest.main()
