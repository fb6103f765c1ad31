#!/usr/bin/env python3
"""Trains PPO and CGP on the problems of rddlrepository and compares them with no-op and random actions.

    benchmarks/solvers/train_all.py --out results.jsonl                     all problems, smallest instance
    benchmarks/solvers/train_all.py --out ippc2023.jsonl --context ippc2023 --without 0 --instances 5
    benchmarks/solvers/train_all.py --out results.jsonl --table             the table of what is there

--jobs N trains on so many problems at the same time; each learner has one thread. It can be
interrupted at any time: what is in the file already is not done again. --seconds is the time that
each solver may train, after the problem was compiled.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import time
from functools import partial
from pathlib import Path

from sweep import add_options, add_results, chosen_instances, exceeds, interval_text, read_results


def run(words, seconds):
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True, timeout=seconds)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip().splitlines()[-1] if done.stderr.strip() else "failed")
    return done.stdout


def train(rddl, problem, instance, solver, folder, arguments):
    begin = time.time()
    run([rddl, "train", solver, problem, instance, "--out", folder / solver, "--seed", arguments.seed,
         "--time", arguments.seconds, "--memory-limit", arguments.memory_limit, "--quiet", *(["--steps", "1e12"] if arguments.long and solver == "ppo" else []),
         *(["--gens", "100000000"] if solver == "cgp" else [])], 10 * arguments.seconds + 600)
    return time.time() - begin


def solve(rddl, problem, instance, arguments):
    result = {"problem": problem, "instance": instance, "seconds": arguments.seconds, "seed": arguments.seed}
    with tempfile.TemporaryDirectory() as name:
        folder, policies = Path(name), ["noop", "random"]
        for solver in "ppo", "cgp":
            try:
                result[solver + "_seconds"] = train(rddl, problem, instance, solver, folder, arguments)
                policies.append(folder / solver)
            except (RuntimeError, subprocess.TimeoutExpired) as failure:
                result[solver + "_failure"] = str(failure)
        compared = json.loads(run([rddl, "compare", problem, instance, "--json", "--policies",
                                   ",".join(map(str, policies)), "--seed", arguments.seed + 1000,
                                   "--episodes", arguments.episodes], 3600))
        for policy in compared["policies"]:
            key = Path(policy["policy"]).name
            result[key] = [policy["return"]["mean"], policy["return"]["half_width_95"], policy["length"]["mean"]]
            result[key + "_illegal"] = policy["illegal_actions"]
    return result


def is_better(learned, floors):
    """Whether a return exceeds all of these by more than chance: half of the width of both intervals together. A policy
    that is equal to no-op has learned nothing."""
    if learned is None or not isinstance(learned[0], (int, float)):
        return False
    return exceeds(learned[0], learned[1], [(mean, half_width) for mean, half_width, _ in floors])


def table(results):
    def cell(result, key):
        return interval_text(*result[key][:2]) if key in result else "-"

    def seconds(result):
        return " and ".join(f"{result[key]:.0f}" if key in result else "-" for key in ("ppo_seconds", "cgp_seconds"))

    lines = ["| problem | | no-op | random | PPO | CGP | seconds of both |", "|---|---|---|---|---|---|---|"]
    good = dict.fromkeys(("PPO", "CGP", "the better of both"), 0)
    for result in results:
        if "failure" in result:
            lines.append(f"| {result['problem']} | {result['instance']} | {result['failure']} | | | | |")
            continue
        lines.append(f"| {result['problem']} | {result['instance']} | " + " | ".join(
            cell(result, key) for key in ("noop", "random", "ppo", "cgp")) + f" | {seconds(result)} |")
        floors = [result[key] for key in ("noop", "random") if isinstance(result[key][0], (int, float))]
        passed = {name: is_better(result.get(name.lower()), floors) for name in ("PPO", "CGP")}
        passed["the better of both"] = any(passed.values())
        for name, is_good in passed.items():
            good[name] += is_good
    lines.append("\nBetter than no-op and random, by more than a thousandth and more than chance: " + ", ".join(
        f"{name} on {count}" for name, count in good.items()) + f" of {len(results)}.")
    return "\n".join(lines)


def jobs_of(problems, done, arguments):
    """The instances that are to be done, as (problem, instance)."""
    for problem, instance in chosen_instances(problems, arguments):
        if (problem["name"], instance) not in done:
            yield problem["name"], instance


def solve_or_failure(arguments, job):
    problem, instance = job
    try:
        return solve(arguments.rddl, problem, instance, arguments)
    except (RuntimeError, subprocess.TimeoutExpired) as failure:
        return {"problem": problem, "instance": instance, "failure": str(failure)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    add_options(parser)
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--episodes", type=int, default=50)
    parser.add_argument("--memory-limit", default="8G", help="what a learner may take")
    parser.add_argument("--long", action="store_true", help="PPO uses all of the time, with a constant plan")
    arguments = parser.parse_args()
    results = sorted(read_results(arguments), key=lambda result: (result["problem"], int(result["instance"])))
    if arguments.table:
        print(table(results))
        return 0
    done = {(result["problem"], result["instance"]) for result in results}
    problems = json.loads(run([arguments.rddl, "list", "--json"], 600))
    add_results(partial(solve_or_failure, arguments), jobs_of(problems, done, arguments), arguments)
    return 0


if __name__ == "__main__":
    sys.exit(main())
