"""rddlc.sb3 with Stable-Baselines3 itself, which is large and not among what scripts/test.sh installs:

    pip install stable-baselines3 && PYTHONPATH=build/python python python/tests/test_sb3.py
"""

from __future__ import annotations

import unittest
from importlib.util import find_spec

import numpy as np
from gymnasium import spaces
from support import example, problem_of

import rddlc

if find_spec("stable_baselines3") is None:
    raise unittest.SkipTest("Stable-Baselines3 is not installed")

from stable_baselines3 import A2C, PPO
from stable_baselines3.common.env_checker import check_env
from stable_baselines3.common.evaluation import evaluate_policy

from rddlc import sb3
from rddlc.sb3 import VecEnv


def vector(name: str, num_envs: int = 4, **options: object) -> VecEnv:
    problem = example(name).problem
    return VecEnv(
        rddlc.make_vec(problem, num_envs=num_envs, autoreset_mode="SameStep", **options)
    )


class StableBaselines(unittest.TestCase):
    def test_its_checker_accepts_learning_forms(self) -> None:
        for name in ("network", "mountain_car", "reservoir", "cart_pole"):
            for actions in ("simplified", "box"):
                env = example(name, observations="flat", actions=actions, normalize=True)
                check_env(env, warn=False)

    def test_what_it_cannot_take_is_a_box(self) -> None:
        for name, is_box in (("counters", True), ("refuses", True), ("refuses_some", False)):
            problem = problem_of(name)
            env = sb3.make(problem)
            self.assertEqual(isinstance(env.action_space, spaces.Box), is_box, name)
            if name != "refuses":  # whose end may lie outside its bounds
                check_env(env, warn=False)
            envs = sb3.make_vec(problem, num_envs=2)
            self.assertEqual(envs.action_space, env.action_space)
            PPO("MlpPolicy", envs, n_steps=8, batch_size=8, device="cpu").learn(16)

    def test_ends_are_told_as_it_wants_them(self) -> None:
        envs = vector("network", horizon=3)
        envs.seed(1)
        envs.reset()
        for _ in range(3):
            observations, rewards, dones, infos = envs.step(np.zeros(4, int))
        self.assertTrue(dones.all())
        self.assertEqual(rewards.dtype, np.float32)
        single = example("network", horizon=3, observations="flat", actions="simplified")
        single.reset(seed=1)
        for _ in range(3):
            last = single.step(0)[0]
        np.testing.assert_array_equal(infos[0]["terminal_observation"], last)
        self.assertTrue(infos[0]["TimeLimit.truncated"])
        self.assertFalse((observations[0] == last).all())

    def test_its_learners_learn(self) -> None:
        for learner, name, actions in ((PPO, "mountain_car", "box"), (A2C, "network", "simplified")):
            envs = vector(name, actions=actions)
            model = learner("MlpPolicy", envs, n_steps=32, seed=1, device="cpu")
            model.learn(256)
            mean, _ = evaluate_policy(model, envs, n_eval_episodes=2, warn=False)
            self.assertTrue(np.isfinite(mean))

    def test_learners_log_returns_and_lengths(self) -> None:
        envs = sb3.make_vec(example("network").problem, num_envs=2, horizon=4)
        self.assertEqual(envs.get_attr("horizon"), [4, 4])
        model = PPO("MlpPolicy", envs, n_steps=8, batch_size=8, device="cpu").learn(16)
        self.assertEqual([each["l"] for each in model.ep_info_buffer], [4] * 4)

    def test_dictionaries_of_observations(self) -> None:
        for name in ("mountain_car", "network", "delivery", "reservoir"):
            problem = example(name).problem
            env = sb3.make(problem, observations="dict", horizon=4)
            check_env(env, warn=False)
            for given in (env, sb3.make_vec(problem, num_envs=2, observations="dict", horizon=4)):
                PPO("MultiInputPolicy", given, n_steps=8, batch_size=8, device="cpu").learn(16)
        env = sb3.make(problem_of("counters"), observations="dict")
        check_env(env, warn=False)
        self.assertEqual(env.observation_space["filled"].shape, (1,))

    def test_pictures_of_all_are_one(self) -> None:
        envs = sb3.make_vec(
            example("mountain_car").problem, num_envs=4, render_mode="rgb_array", render_size=(60, 40)
        )
        with self.assertRaisesRegex(rddlc.Error, "reset"):
            envs.render()
        envs.reset()
        self.assertEqual(envs.render().shape, (80, 120, 3))

    def test_masks_are_each_environments_own(self) -> None:
        envs = VecEnv(
            rddlc.make_vec(problem_of("refuses_some"), num_envs=2, autoreset_mode="SameStep")
        )
        envs.reset()
        masks = envs.env_method("action_masks")
        self.assertEqual([mask.tolist() for mask in masks], [[True, False, True]] * 2)

    @unittest.skipIf(find_spec("sb3_contrib") is None, "sb3-contrib is not installed")
    def test_maskable_ppo_chooses_what_is_legal(self) -> None:
        from sb3_contrib import MaskablePPO

        problem = problem_of("refuses_some")  # opening the second door is not allowed
        envs = sb3.make_vec(problem, num_envs=2)
        model = MaskablePPO("MlpPolicy", envs, n_steps=16, batch_size=16, seed=1, device="cpu")
        model.learn(64)
        env = sb3.make(problem, enforce_action_constraints=True)
        for seed in range(5):
            seen, _ = env.reset(seed=seed)
            chosen, _ = model.predict(seen, action_masks=env.action_masks(), deterministic=False)
            env.step(chosen)  # raises for what is not allowed

    def test_options_of_reset_are_taken_or_refused(self) -> None:
        env = example("network")
        env.reset(seed=1)
        env.step({})
        envs = vector("network", num_envs=3)
        envs.seed(4)
        envs.set_options([{"state": env.get_state()}, {}, {"state": env.get_state()}])
        envs.reset()
        self.assertEqual([envs.env._batch.progress(place)[0] for place in range(3)], [1, 0, 1])
        envs.reset()  # options are for one reset
        self.assertEqual([envs.env._batch.progress(place)[0] for place in range(3)], [0, 0, 0])
        envs.set_options({"stat": env.get_state()})
        with self.assertRaisesRegex(rddlc.Error, "'stat'; did you mean 'state'"):
            envs.reset()
        with self.assertRaisesRegex(rddlc.Error, "'horizn'; did you mean 'horizon'"):
            sb3.make("network", 1, horizn=3)

    def test_other_autoreset_modes_are_refused(self) -> None:
        with self.assertRaisesRegex(rddlc.Error, "SameStep"):
            VecEnv(rddlc.make_vec(example("network").problem, num_envs=2))


if __name__ == "__main__":
    unittest.main()
