#!/usr/bin/env python3
"""How fast the solvers are, in steps a second of one core: processor time counts, so that a busy machine says much the same.

    benchmarks/solvers/speed.py [--rddl PROGRAM] [--repetitions 3] [--only "64 x 128"]

The best of some repetitions, less what a run of nearly no steps takes (start, loading the simulator).
"""

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PENDULUM, CAR = ("Pendulum_gym", "0"), ("MountainCar_ippc2023", "1")
RLTOOLS = ["--envs", 4, "--rollout", 1024, "--epochs", 2, "--minibatch", 256, "--gamma", 0.9, "--lr", "1e-3"]
# The measured cases, and how many steps or evaluations each makes beyond the short run beside it.
CASES = [
    ("PPO, Pendulum, 4 x 1,024 steps, 2 epochs of 256", PENDULUM, "ppo", [*RLTOOLS, "--steps"], 8192, 614400, 1),
    ("PPO, Pendulum, 64 x 128 steps, 4 epochs of 1,024", PENDULUM, "ppo", ["--steps"], 8192, 614400, 1),
    ("PPO, Pendulum, 64 x 128 steps, 4 epochs of 1,024, a memory of 32 units", PENDULUM, "ppo",
     ["--recurrent", 32, "--steps"], 8192, 614400, 1),
    ("PPO, Pendulum, 64 x 128 steps, 4 epochs of 1,024, a memory of 64 units", PENDULUM, "ppo",
     ["--recurrent", 64, "--steps"], 8192, 614400, 1),
    ("PPO, MountainCar, as SB3: 10 epochs of 64", CAR, "ppo", ["--preset", "sb3", "--steps"], 2048, 104448, 1),
    ("CGP, MountainCar, evaluations", CAR, "cgp", ["--tune", 0, "--restart", 0, "--gens"], 10, 2010, 32),
]


def processor_seconds(words, environment=None):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([str(w) for w in words], check=True, capture_output=True, env={**os.environ, **(environment or {})})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def learning_rates(rddl, repetitions, only):
    for name, problem, solver, options, few, many, factor in CASES:
        if only not in name:
            continue

        def run(count):
            with tempfile.TemporaryDirectory() as folder:
                return processor_seconds([rddl, "train", solver, *problem, "--out", f"{folder}/run", "--quiet",
                                          "--evaluations", 1, *options, count])
        run(few)  # compiles the simulator
        least = {count: min(run(count) for _ in range(repetitions)) for count in (few, many)}
        rate = (many - few) * factor / (least[many] - least[few])
        print(f"{name}: {rate / 1e3:.0f} k/s", flush=True)


def rollout_rate(rddl, repetitions):
    """Steps of a network of 64-64 units that is no longer trained."""
    with tempfile.TemporaryDirectory() as folder:
        processor_seconds([rddl, "train", "ppo", *PENDULUM, "--out", f"{folder}/run", "--quiet", "--steps", 8192])

        def run(episodes):
            return processor_seconds([rddl, "evaluate", *PENDULUM, "--policy", f"{folder}/run", "--episodes", episodes,
                                      "--threads", 1])
        few, many, steps = 1024, 21504, 200
        least = {count: min(run(count) for _ in range(repetitions)) for count in (few, many)}
    rate = (many - few) * steps / (least[many] - least[few])
    print(f"roll-out of a network 64-64 on Pendulum, without learning: {rate / 1e3:.0f} k/s", flush=True)


def first_policy(rddl, solver, *options):
    """The time from two RDDL files to a policy that reaches the goal, with nothing compiled before."""
    with tempfile.TemporaryDirectory() as folder:
        begin = time.monotonic()
        seconds = processor_seconds([rddl, "train", solver, *CAR, "--out", f"{folder}/run", "--quiet", "--stop-return", 100,
                                     *options], {"XDG_CACHE_HOME": folder})
        wall = time.monotonic() - begin
        out = subprocess.run([rddl, "evaluate", *CAR, "--policy", f"{folder}/run", "--engine", "interpreter", "--json"],
                             check=True, capture_output=True, text=True).stdout
    reached = json.loads(out)["policies"][0]["return"]["mean"]
    print(f"{' '.join([solver, *options])}, MountainCar from RDDL files with an empty cache to a return of {reached:g}: "
          f"{wall:.1f} s, {seconds:.1f} s of processor time", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--rddl", default=ROOT / "build/bin/rddl")
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--only", default="", help="learners whose names hold this, and nothing else")
    arguments = parser.parse_args()
    learning_rates(arguments.rddl, arguments.repetitions, arguments.only)
    if arguments.only:
        return 0
    rollout_rate(arguments.rddl, arguments.repetitions)
    for options in ([], ["--engine", "interpreter"]):
        for solver in ("cgp", "ppo"):
            first_policy(arguments.rddl, solver, *options)
    return 0


if __name__ == "__main__":
    sys.exit(main())
