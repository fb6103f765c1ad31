"""Stable-Baselines3's PPO on one environment of pyRDDLGym, on one of rddlc, and on as many as PPO steps
at once, end to end, with the same settings, in one thread:

    python python/tests/benchmark_sb3.py [STEPS]

Seconds are those of the processor. Needs stable-baselines3 and pyRDDLGym.
"""

from __future__ import annotations

import sys
import time
import warnings
from typing import Any

import gymnasium
import numpy as np
import pyRDDLGym
import torch
from stable_baselines3 import PPO
from stable_baselines3.common.vec_env import DummyVecEnv

import rddlc
from rddlc.sb3 import VecEnv

NAME, INSTANCE, ENVIRONMENTS = "MountainCar_ippc2023", "1", 8


class FlatPyRDDLGym(gymnasium.Env[Any, Any]):
    """Wraps a pyRDDLGym environment with numbers alone for a learner."""

    def __init__(self) -> None:
        problem = rddlc.Problem(NAME, INSTANCE, engine="compiled")
        self.env = pyRDDLGym.make(*problem.files)
        flat = rddlc.make(problem, observations="flat", actions="simplified")
        self.observation_space, self.action_space = flat.observation_space, flat.action_space

    def reset(self, *, seed: int | None = None, options: Any = None) -> Any:
        state, _ = self.env.reset(seed=seed)
        return self.row(state), {}

    def step(self, action: Any) -> Any:
        (name,) = self.env.action_space
        state, reward, terminated, truncated, _ = self.env.step({name: float(action[0])})
        return self.row(state), float(reward), terminated, truncated, {}

    @staticmethod
    def row(state: Any) -> Any:
        return np.array(list(state.values()), np.float32)


def seconds_of(envs: Any, steps: int) -> float:
    begin = time.process_time()
    PPO("MlpPolicy", envs, n_steps=256, batch_size=512, seed=1, device="cpu").learn(steps)
    return time.process_time() - begin


def main() -> None:
    warnings.simplefilter("ignore")
    torch.set_num_threads(1)
    steps = int(sys.argv[1]) if len(sys.argv) > 1 else 100_000
    problem = rddlc.Problem(NAME, INSTANCE, engine="compiled")
    forms = {"observations": "flat", "actions": "simplified"}
    kinds = {
        "pyRDDLGym": lambda: DummyVecEnv([FlatPyRDDLGym] * ENVIRONMENTS),
        "rddlc.make": lambda: DummyVecEnv([lambda: rddlc.make(problem, **forms)] * ENVIRONMENTS),
        "rddlc.make_vec": lambda: VecEnv(
            rddlc.make_vec(problem, num_envs=ENVIRONMENTS, threads=1, autoreset_mode="SameStep")
        ),
    }
    base = None
    for name, make in kinds.items():
        seconds = seconds_of(make(), steps)
        base = base or seconds
        print(f"{name:16}{seconds:8.1f} s  {base / seconds:5.2f} times as fast", flush=True)


if __name__ == "__main__":
    main()
