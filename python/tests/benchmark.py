"""Steps a second of rddlc from Python, beside pyRDDLGym and the C++ engine, in one run:

    python python/tests/benchmark.py [PROBLEM INSTANCE]    default: a problem of one action, and one of 50
    python python/tests/benchmark.py --dictionaries [--engine interpreter] [PROBLEM...]

The second form steps the first instance of each problem of rddlrepository by dictionaries with all keys, as
action_space.sample() gives them, beside pyRDDLGym, and ends with status 1 where it is below 100 times; with the
interpreter, where the geometric mean is below 20 times, or a problem is slower than pyRDDLGym's. The last columns are
of flat observations and simplified actions. Problems that pyRDDLGym cannot step by that action are named; the
status is also 1 if they are others than NOT_STEPPED.

Environments step by one action of their space. Seconds are those of the processor, which a busy
machine does not change much. Batches have one thread, and take turns. The C++ batch is the engine
alone, with records that stay as they are.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
import time
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np

import rddlc

SECONDS, PARTS = 2.0, 10
SECONDS_OF_MANY = 0.4  # where all problems are measured
ENVIRONMENTS = 1024
LEAST_RATIOS = {"compiled": (100, 100), "interpreter": (20, 1)}  # to pyRDDLGym: in the mean, and everywhere
NOT_STEPPED = {"ComplexSysAdmin_rddlsim"}  # by pyRDDLGym: a draw has impossible probabilities
PROBLEMS = [["MountainCar_ippc2023", "1"], ["SysAdmin_MDP_ippc2011", "10"]]


def rates_of(steppers: dict[str, Callable[[], int]], seconds: float = SECONDS) -> dict[str, float]:
    """Returns steps a second of each, by the best of the parts of its time, for which they take
    turns; a stepper returns how many steps it made."""
    best = dict.fromkeys(steppers, 0.0)
    for _ in range(PARTS):
        for name, step in steppers.items():
            begin, steps = time.process_time(), 0
            while (elapsed := time.process_time() - begin) < seconds / PARTS:
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


class TheirsFailed(Exception):
    """pyRDDLGym cannot make or step a problem."""


def of_pyrddlgym(problem: rddlc.Problem, action: Any) -> Callable[[], int]:
    import pyRDDLGym

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            env = pyRDDLGym.make(*problem.files)
        # pyRDDLGym refuses the arrays of one number that its own space draws.
        unguarded = stepper(env, {name: value.reshape(()) if isinstance(value, np.ndarray) else value
                                  for name, value in action.items()})
    except Exception as error:
        raise TheirsFailed from error

    def step() -> int:
        try:
            return unguarded()
        except Exception as error:
            raise TheirsFailed from error

    return step


def of_batch(problem: rddlc.Problem, count: int = ENVIRONMENTS, **options: Any) -> Callable[[], int]:
    envs = rddlc.make_vec(problem, num_envs=count, threads=1, **options)
    envs.action_space.seed(1)
    actions = envs.action_space.sample()
    envs.reset(seed=1)

    def step() -> int:
        envs.step(actions)
        return count

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
        rddlc.make(*words, engine="compiled")
        times.append(time.process_time() - begin)
    return min(times)


def compare_dictionaries(names: list[str], engine: str) -> int:
    ratios: dict[str, float] = {}
    not_stepped: set[str] = set()
    measured = {each.name for each in rddlc.problems() if not names or each.name in names}
    for listed in rddlc.problems():
        if listed.name not in measured:
            continue
        problem = rddlc.Problem(listed.name, listed.instances[0], engine=engine)
        env = rddlc.make(problem)
        env.reset(seed=1)
        env.action_space.seed(1)
        action = env.action_space.sample()
        try:
            rates = rates_of(
                {
                    "pyRDDLGym": of_pyrddlgym(problem, action),
                    "rddlc": stepper(env, action),
                    "flat": of_single(problem, observations="flat", actions="simplified"),
                },
                SECONDS_OF_MANY,
            )
        except TheirsFailed as failed:
            print(f"{listed.name:40} pyRDDLGym: {type(failed.__cause__).__name__}", flush=True)
            not_stepped.add(listed.name)
            continue
        theirs, ours, flat = rates.values()
        ratios[listed.name] = ours / theirs
        numbers = f"{ours:12,.0f} {theirs:10,.0f} {ours / theirs:8.0f} {flat:12,.0f} {flat / theirs:8.0f}"
        print(f"{listed.name:40} {numbers}", flush=True)
    unexpected = not_stepped ^ (NOT_STEPPED & measured)
    if unexpected:
        print(f"NOT_STEPPED is wrong about {', '.join(sorted(unexpected))}")
    if not ratios:
        return 1 if unexpected else 0
    mean = math.exp(sum(map(math.log, ratios.values())) / len(ratios))
    least_mean, least = LEAST_RATIOS[engine]
    slow = [name for name, ratio in ratios.items() if ratio < least]
    print(
        f"{len(ratios)} problems: {mean:.0f} times pyRDDLGym in the geometric mean, at least "
        f"{min(ratios.values()):.1f} times; below {least}: {', '.join(slow) or '-'}"
    )
    return 1 if unexpected or slow or mean < least_mean else 0


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problem", nargs="*")
    parser.add_argument("--dictionaries", action="store_true")
    parser.add_argument("--engine", choices=LEAST_RATIOS, default="compiled")
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    if options.dictionaries:
        return compare_dictionaries(options.problem, options.engine)
    for words in [options.problem] if options.problem else PROBLEMS:
        compare(words, options.json)
    return 0


def compare(words: list[str], as_json: bool) -> None:
    problem = rddlc.Problem(*words, engine="compiled")
    env = rddlc.make(problem)
    env.reset(seed=1)
    env.action_space.seed(1)
    action = env.action_space.sample()  # all keys
    learning = {"observations": "flat", "actions": "simplified"}
    rates = rates_of(
        {
            "pyRDDLGym": of_pyrddlgym(problem, action),
            "rddlc.make": stepper(env, action),
            "rddlc.make, vectorized": of_single(problem, vectorized=True),
            "rddlc.make, flat": of_single(problem, **learning),
            "rddlc.make_vec of 1": of_batch(problem, 1),
        }
    ) | rates_of(
        {
            "C++ batch": of_engine(problem),
            "rddlc.make_vec": of_batch(problem),
            "rddlc.make_vec, copy=False": of_batch(problem, copy=False),
        }
    )
    make_seconds = seconds_of_make(words)
    if as_json:
        print(json.dumps({"steps_per_second": rates, "make_seconds": make_seconds}))
        return
    print(f"{problem.name}, {len(action)} action values; make from the cache: {make_seconds * 1e3:.0f} ms")
    for name, each in rates.items():
        base = "C++ batch" if "vec," in name or name.endswith("vec") else "pyRDDLGym"
        share = "" if name == base else f"{each / rates[base]:10.2f} of {base}"
        print(f"{name:28}{each:16,.0f} steps/s{share}")


if __name__ == "__main__":
    sys.exit(main())
