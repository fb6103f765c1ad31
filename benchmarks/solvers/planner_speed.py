#!/usr/bin/env python3
"""Simulated steps a second inside each planner, beside those of the engine's batch: processor time counts, on one core.

    benchmarks/solvers/planner_speed.py [--rddl PROGRAM] [--repetitions 3] [--only uct] [--prost FOLDER]

Steps are those that the planner reports (--explain-decisions). The time is that of decisions with many steps less that of decisions
with few; the best of some repetitions counts. --prost FOLDER, which is PROST after its build.py, compares trials of plan:uct with
those of PROST instead, also by processor time.
"""

import argparse
import json
import re
import resource
import subprocess
import tempfile
from pathlib import Path

from compare_all import prost_session

ROOT = Path(__file__).resolve().parents[2]
DISCRETE = ["Elevators_MDP_ippc2011", "GameOfLife_MDP_ippc2011", "SysAdmin_MDP_ippc2011"]
REAL = ["HVAC_ippc2023", "UAV_ippc2023", "Reservoir_ippc2023"]
PLANNERS = [
    ("plan:cem", DISCRETE + REAL),
    ("plan:rollout,policy=noop", DISCRETE + REAL),
    ("plan:rollout,policy=random", DISCRETE + REAL),
    ("plan:uct", DISCRETE),
    ("plan:gradient", REAL),
]
PROST_PROBLEMS = ["CrossingTraffic_MDP_ippc2011", "Elevators_MDP_ippc2011", "GameOfLife_MDP_ippc2011", "Navigation_MDP_ippc2011",
                  "SysAdmin_MDP_ippc2011"]
PROST_SECONDS = 0.05, 0.25  # of a decision
HORIZON = 40
FEW, MANY = 5_000, 105_000


def processor_seconds(words):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([str(w) for w in words], check=True, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def engine_rate(rddl, problem):
    """Steps of the fastest batch."""
    words = [rddl, "bench", problem, "1", "--threads", "1", "--seconds", "0.3", "--json"]
    found = json.loads(subprocess.run([str(w) for w in words], check=True, capture_output=True, text=True).stdout)
    return max(each["steps"] / each["processor_seconds"] for each in found["measurements"])


def planner_rate(rddl, problem, planner, repetitions, counted="steps"):
    def run(steps):
        with tempfile.TemporaryDirectory() as folder:
            thoughts = Path(folder) / "thoughts.jsonl"
            seconds = processor_seconds([rddl, "evaluate", problem, "1", "--policy", f"{planner},steps={steps}", "--episodes", "1",
                                         "--horizon", HORIZON, "--threads", "1", "--engine", "compiled",
                                         "--explain-decisions", thoughts])
            return seconds, sum(json.loads(line)[counted] for line in thoughts.read_text().splitlines())

    few, many = (min(run(steps) for _ in range(repetitions)) for steps in (FEW, MANY))
    return (many[1] - few[1]) / (many[0] - few[0])


def prost_rate(arguments, problem):
    """Trials a second of processor time; None where PROST ends its searches early, so that more time has no more trials."""
    described = subprocess.run([str(arguments.rddl), "info", problem, "1", "--json"], check=True, capture_output=True, text=True).stdout
    name = json.loads(described)["instance"]

    def run(seconds):
        _, printed, used = prost_session(arguments, (problem, "1"), name, 1, 2 * HORIZON * seconds, f"IPC2014 -t {seconds}")
        return used, sum(int(count) for count in re.findall(r"Performed trials: (\d+)", printed))

    few, many = (run(seconds) for seconds in PROST_SECONDS)
    return (many[1] - few[1]) / (many[0] - few[0]) if many[1] > 1.5 * few[1] else None


def compare_trials(arguments):
    print(f"{'problem':30} {'plan:uct':>10} {'PROST':>10}  trials a second")
    for problem in PROST_PROBLEMS:
        ours = planner_rate(arguments.rddl, problem, "plan:uct", arguments.repetitions, "iterations")
        theirs = prost_rate(arguments, problem)
        compared = f"{theirs:10.0f} {ours / theirs:8.1f} times" if theirs else f"{'-':>10}"
        print(f"{problem:30} {ours:10.0f} {compared}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rddl", type=Path, default=ROOT / "build/bin/rddl")
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--only", default="", help="a part of the planner's name")
    parser.add_argument("--prost", type=Path, help="folder of PROST, after its build.py")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    if options.prost:
        return compare_trials(options)
    print(f"{'problem':26} {'planner':28} {'M steps/s':>10} {'of the engine':>14}")
    rates = {}
    for planner, problems in PLANNERS:
        if options.only not in planner:
            continue
        for problem in problems:
            rates.setdefault(problem, engine_rate(options.rddl, problem))
            rate = planner_rate(options.rddl, problem, planner, options.repetitions)
            print(f"{problem:26} {planner:28} {rate / 1e6:10.2f} {100 * rate / rates[problem]:12.1f} %", flush=True)


if __name__ == "__main__":
    main()
