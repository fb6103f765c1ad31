"""Steps a second of rddlc from Python, beside pyRDDLGym and the C++ engine, in one run:

    python python/tests/benchmark.py [PROBLEM INSTANCE]

Environments step by one action of their space. Seconds are those of the processor, which a busy
machine does not change much. Batches have one thread, and take turns. The C++ batch is the engine
alone, with records that stay as they are.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
import warnings
from collections.abc import Callable
from typing import Any


import rddlc

SECONDS, PARTS = 2.0, 10
ENVIRONMENTS = 1024


def rates_of(steppers: dict[str, Callable[[], int]]) -> dict[str, float]:
    """Returns steps a second of each, by the best of the parts of its time, for which they take
    turns; a stepper returns how many steps it made."""
    best = dict.fromkeys(steppers, 0.0)
    for _ in range(PARTS):
        for name, step in steppers.items():
            begin, steps = time.process_time(), 0
            while (elapsed := time.process_time() - begin) < SECONDS / PARTS:
                for _ in range(20):
                    steps += step()
            best[name] = max(best[name], steps / elapsed)
    return best


def stepper(env: Any, action: Any) -> Callable[[], int]:
    env.reset(seed=1)

    def step() -> int:
        _, _, terminated, truncated, _ = env.step(action)
        if terminated or truncated:
            env.reset()
        return 1

    return step


def of_single(problem: rddlc.Problem, **options: Any) -> Callable[[], int]:
    env = rddlc.make(problem, **options)
    env.action_space.seed(1)
    return stepper(env, env.action_space.sample())


def of_pyrddlgym(problem: rddlc.Problem) -> Callable[[], int]:
    import pyRDDLGym

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        env = pyRDDLGym.make(*problem.files)
    return stepper(env, {})


def of_batch(problem: rddlc.Problem, **options: Any) -> Callable[[], int]:
    envs = rddlc.make_vec(problem, num_envs=ENVIRONMENTS, threads=1, **options)
    envs.action_space.seed(1)
    actions = envs.action_space.sample()
    envs.reset(seed=1)

    def step() -> int:
        envs.step(actions)
        return ENVIRONMENTS

    return step


def of_engine(problem: rddlc.Problem) -> Callable[[], int]:
    """The batch engine without Python's spaces: records that stay as they are."""
    batch = rddlc._native.EnvPool(
        problem.simulator, environments=ENVIRONMENTS, threads=1, autoreset=1, values=False
    )

    def step() -> int:
        batch.step()
        return ENVIRONMENTS

    return step


def seconds_of_make(words: list[str]) -> float:
    """The time of loading from the cache, in this process, the best of five."""
    times = []
    for _ in range(5):
        begin = time.process_time()
        rddlc.make(*words)
        times.append(time.process_time() - begin)
    return min(times)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problem", nargs="*", default=["MountainCar_ippc2023", "1"])
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    problem = rddlc.Problem(*options.problem)
    learning = {"observations": "flat", "actions": "simplified"}
    rates = rates_of(
        {
            "pyRDDLGym": of_pyrddlgym(problem),
            "rddlc.make": of_single(problem),
            "rddlc.make, vectorized": of_single(problem, vectorized=True),
            "rddlc.make, flat": of_single(problem, **learning),
        }
    ) | rates_of(
        {
            "C++ batch": of_engine(problem),
            "rddlc.make_vec": of_batch(problem),
            "rddlc.make_vec, copy=False": of_batch(problem, copy=False),
        }
    )
    make_seconds = seconds_of_make(options.problem)
    if options.json:
        print(json.dumps({"steps_per_second": rates, "make_seconds": make_seconds}))
        return 0
    print(f"{problem.name}; make from the cache: {make_seconds * 1e3:.0f} ms")
    for name, each in rates.items():
        base = "C++ batch" if "vec," in name or name.endswith("vec") else "pyRDDLGym"
        share = "" if name == base else f"{each / rates[base]:10.2f} of {base}"
        print(f"{name:28}{each:16,.0f} steps/s{share}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
