"""Common uses of environments in Python: Gymnasium's wrappers, threads, processes, Ctrl-C, arrays
of other libraries."""

from __future__ import annotations

import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
from gymnasium import wrappers
from gymnasium.vector import AsyncVectorEnv, AutoresetMode, SyncVectorEnv
from gymnasium.wrappers import vector as vector_wrappers
from support import example

import rddlc

LONG = """
import signal, sys, time
import numpy as np
from support import example
import rddlc

def told(number, frame):
    raise KeyboardInterrupt

signal.signal(signal.SIGINT, told)
envs = rddlc.make_vec(example("mountain_car").problem, num_envs=200_000, threads=1)
envs.reset(seed=1)
push = np.ones((200_000, 1), np.float32)
print("steps", flush=True)
try:
    while True:
        envs.step(push)
except KeyboardInterrupt:
    envs.step(push)
    observations, _ = envs.reset(seed=1)
    print("stopped", observations.shape, flush=True)
"""


def episode(env: gymnasium.Env[Any, Any], seed: int) -> tuple[float, int, dict[str, Any]]:
    """Return, steps and the last info of full throttle in the direction of travel."""
    observation, _ = env.reset(seed=seed)
    total, steps, over, info = 0.0, 0, False, {}
    while not over:
        push = 1.0 if observation["velocity"] > 0 else -1.0
        observation, reward, terminated, truncated, info = env.step({"throttle": push})
        total, steps, over = total + reward, steps + 1, terminated or truncated
    return total, steps, info


def car(seed: int) -> tuple[float, int]:
    return episode(example("mountain_car"), seed)[:2]


def goes_on(env: rddlc.RDDLEnv) -> float:
    return env.step({"throttle": 1.0})[1]


class Wrappers(unittest.TestCase):
    def test_record_video_records_every_episode(self) -> None:
        try:
            import moviepy  # noqa: F401
        except ImportError:
            self.skipTest("RecordVideo writes with moviepy, which is not installed")
        with tempfile.TemporaryDirectory() as folder:
            env = example("mountain_car", render_mode="rgb_array", horizon=5)
            recorded = wrappers.RecordVideo(env, folder, episode_trigger=lambda _: True)
            for seed in (1, 2):
                episode(recorded, seed)
            recorded.close()
            self.assertEqual(len(list(Path(folder).glob("*.mp4"))), 2)

    def test_render_collection_has_a_frame_for_each_step(self) -> None:
        env = wrappers.RenderCollection(example("mountain_car", render_mode="rgb_array", horizon=5))
        episode(env, 1)
        frames = env.render()
        self.assertEqual(len(frames), 6)
        self.assertTrue((frames[0] != frames[-1]).any())

    def test_episode_statistics_are_the_episodes(self) -> None:
        env = wrappers.RecordEpisodeStatistics(example("mountain_car"))
        total, steps, info = episode(env, 1)
        self.assertAlmostEqual(info["episode"]["r"], total)
        self.assertEqual(info["episode"]["l"], steps)
        self.assertEqual(info["cause"], "terminated")

    def test_time_limit_cuts_off(self) -> None:
        env = wrappers.TimeLimit(example("mountain_car"), max_episode_steps=7)
        _, steps, info = episode(env, 1)
        self.assertEqual(steps, 7)
        self.assertNotIn("cause", info)  # the problem itself continues

    def test_flat_forms_can_be_wrapped(self) -> None:
        env = example("mountain_car", observations="flat", actions="box")
        for wrapper in (
            wrappers.NormalizeObservation,
            wrappers.ClipAction,
            partial(wrappers.FrameStackObservation, stack_size=3),
            partial(wrappers.TransformReward, func=lambda reward: reward / 100),
        ):
            env = wrapper(env)
        observation, _ = env.reset(seed=1)
        self.assertEqual(observation.shape, (3, 2))
        self.assertTrue(np.isfinite(env.step(env.action_space.sample())[0]).all())

    def test_vector_wrappers_work_on_ours(self) -> None:
        envs = rddlc.make_vec(
            example("mountain_car").problem, num_envs=3, autoreset_mode="SameStep", horizon=4
        )
        wrapped = vector_wrappers.RecordEpisodeStatistics(envs)
        wrapped.reset(seed=1)
        rewards = np.zeros(3)
        for _ in range(4):
            _, reward, _, truncated, infos = wrapped.step(np.ones((3, 1), np.float32))
            rewards += reward
        self.assertTrue(truncated.all())
        np.testing.assert_allclose(infos["episode"]["r"], rewards)
        np.testing.assert_array_equal(infos["episode"]["l"], 4)
        normal = vector_wrappers.NormalizeObservation(
            rddlc.make_vec(example("mountain_car").problem, num_envs=3)
        )
        self.assertEqual(normal.reset(seed=1)[0].shape, (3, 2))

    def test_gymnasiums_vectors_work_on_ours(self) -> None:
        make = partial(example, "mountain_car", observations="flat", actions="box", horizon=4)
        results = []
        for envs in (
            SyncVectorEnv([make, make]),
            AsyncVectorEnv([make, make], context="spawn"),
            rddlc.make_vec(example("mountain_car").problem, num_envs=2, actions="box", horizon=4),
        ):
            self.assertEqual(envs.metadata["autoreset_mode"], AutoresetMode.NEXT_STEP)
            rows = [envs.reset(seed=1)[0]]
            rows += [envs.step(np.full((2, 1), 0.5, np.float32))[0] for _ in range(6)]
            results.append(np.array(rows))
            envs.close()
        np.testing.assert_array_equal(results[0], results[1])
        np.testing.assert_allclose(results[0], results[2], rtol=1e-5)


class Processes(unittest.TestCase):
    def test_threads_step_environments_of_their_own(self) -> None:
        with ThreadPoolExecutor(4) as pool:
            found = list(pool.map(car, range(8)))
        self.assertEqual(found, [car(seed) for seed in range(8)])

    def test_forks_and_spawned_processes_step(self) -> None:
        expected = [car(seed) for seed in (1, 2)]
        for method in ("fork", "spawn"):
            context = multiprocessing.get_context(method)
            with ProcessPoolExecutor(2, mp_context=context) as pool:
                self.assertEqual(list(pool.map(car, (1, 2))), expected, method)

    def test_environments_go_on_where_they_are_sent(self) -> None:
        env = example("mountain_car")
        env.reset(seed=1)
        env.step({"throttle": 1.0})
        expected = goes_on(pickle.loads(pickle.dumps(env)))
        for method in ("fork", "spawn"):
            context = multiprocessing.get_context(method)
            with ProcessPoolExecutor(1, mp_context=context) as pool:
                self.assertEqual(pool.submit(goes_on, env).result(), expected, method)
        self.assertEqual(goes_on(env), expected)

    @unittest.skipUnless(hasattr(os, "fork"), "there is no fork")
    def test_batches_with_threads_step_in_forks(self) -> None:
        envs = rddlc.make_vec(example("mountain_car").problem, num_envs=64, threads=2)
        envs.reset(seed=1)
        push = np.ones((64, 1), np.float32)
        envs.step(push)
        child = os.fork()
        if child == 0:
            envs.step(push)
            os._exit(7)
        deadline = time.monotonic() + 60
        done, status = os.waitpid(child, os.WNOHANG)
        while not done and time.monotonic() < deadline:
            time.sleep(0.01)
            done, status = os.waitpid(child, os.WNOHANG)
        if not done:
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, 0)
        self.assertEqual((done, os.waitstatus_to_exitcode(status)), (child, 7))
        envs.step(push)

    def test_ctrl_c_stops_between_steps(self) -> None:
        child = subprocess.Popen(
            [sys.executable, "-c", LONG], stdout=subprocess.PIPE, text=True, cwd=Path(__file__).parent
        )
        assert child.stdout is not None
        self.assertEqual(child.stdout.readline(), "steps\n")
        time.sleep(0.2)
        child.send_signal(signal.SIGINT)
        begin = time.monotonic()
        output, _ = child.communicate(timeout=60)
        self.assertEqual(output, "stopped (200000, 2)\n")
        self.assertLess(time.monotonic() - begin, 30)


class Arrays(unittest.TestCase):
    def test_dlpack_shares_the_engines_memory(self) -> None:
        envs = rddlc.make_vec(
            example("mountain_car").problem, num_envs=4, copy=False, autoreset_mode="SameStep"
        )
        observations, _ = envs.reset(seed=1)
        shared = np.from_dlpack(observations)
        self.assertTrue(np.shares_memory(shared, observations))
        before = shared.copy()
        stepped, *_ = envs.step(np.ones((4, 1), np.float32))
        self.assertTrue(np.shares_memory(stepped, shared))
        self.assertTrue((shared != before).any())
        np.testing.assert_array_equal(shared, stepped)

    def test_copies_share_nothing(self) -> None:
        envs = rddlc.make_vec(example("mountain_car").problem, num_envs=4)
        observations, _ = envs.reset(seed=1)
        shared = np.from_dlpack(observations)
        before = shared.copy()
        envs.step(np.ones((4, 1), np.float32))
        np.testing.assert_array_equal(shared, before)

    def test_torch_tensors_share_the_engines_memory(self) -> None:
        try:
            import torch
        except ImportError:
            self.skipTest("torch is not installed")
        envs = rddlc.make_vec(example("mountain_car").problem, num_envs=4, copy=False)
        tensor = torch.from_dlpack(envs.reset(seed=1)[0])
        observations, *_ = envs.step(np.ones((4, 1), np.float32))
        np.testing.assert_array_equal(tensor.numpy(), observations)


if __name__ == "__main__":
    unittest.main()
