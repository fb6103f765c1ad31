"""Steps a second of EnvPool's classic-control environments and of the same systems in RDDL, in one run,
in one thread, with 1,024 environments each:

    PYTHONPATH=build/python python python/tests/benchmark_envpool.py [--clock]

Needs envpool and rddlrepository. Actions are drawn once; both begin episodes anew where they end (EnvPool
in the next step, so ours also do). Seconds are those of the processor, all threads together: EnvPool's worker,
and the caller that waits for it. With --clock they are those of the clock, on which other programs count. The best
of parts that take turns.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from typing import Any

import envpool
import numpy as np

import rddlc

ENVIRONMENTS = 1024
PARTS, SECONDS = 7, 0.4  # of each
SYSTEMS = [
    ("CartPole-v1", "CartPole_Discrete_gym"),
    ("MountainCar-v0", "MountainCar_Discrete_gym"),
    ("MountainCarContinuous-v0", "MountainCar_Continuous_gym"),
    ("Pendulum-v1", "Pendulum_gym"),
    ("Acrobot-v1", "Acrobot_gym"),
]


def of_envpool(name: str) -> Any:
    return envpool.make_gymnasium(
        name, num_envs=ENVIRONMENTS, batch_size=ENVIRONMENTS, num_threads=1, seed=1
    )


def of_rddlc(name: str) -> Any:
    return rddlc.make_vec(name, 0, num_envs=ENVIRONMENTS, threads=1, engine="compiled")


def actions_of(envs: Any) -> Any:
    """A row for each environment."""
    envs.action_space.seed(1)
    if isinstance(envs, rddlc.RDDLVectorEnv):
        return envs.action_space.sample()
    return np.stack([envs.action_space.sample() for _ in range(ENVIRONMENTS)])


def rate(envs: Any, actions: Any, now: Callable[[], float]) -> float:
    begin, steps = now(), 0
    while (elapsed := now() - begin) < SECONDS:
        for _ in range(10):
            envs.step(actions)
        steps += 10 * ENVIRONMENTS
    return steps / elapsed


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--clock", action="store_true")
    now = time.perf_counter if parser.parse_args().clock else time.process_time
    print(f"{'EnvPool':26}{'steps/s':>12}   {'rddlc':28}{'steps/s':>12}  times as fast")
    for theirs, ours in SYSTEMS:
        pair = [of_envpool(theirs), of_rddlc(ours)]
        actions = [actions_of(envs) for envs in pair]
        for envs in pair:
            envs.reset()
        best = [0.0, 0.0]
        for _ in range(PARTS):
            best = [max(best[i], rate(envs, actions[i], now)) for i, envs in enumerate(pair)]
        print(f"{theirs:26}{best[0]:12,.0f}   {ours:28}{best[1]:12,.0f}  {best[1] / best[0]:6.1f}", flush=True)


if __name__ == "__main__":
    main()
