"""Returns of PPO in partially observed problems: with the present observation, with the last four
observations, and with a memory.

    benchmarks/solvers/memory.py --out memory.jsonl [--seeds 5] [--only Navigation] [--jobs 2]
    benchmarks/solvers/memory.py --out memory.jsonl --table

Can be interrupted; results that are in the file are not computed again.
"""

import argparse
import json
import statistics
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from returns import ROOT, solve

MAZE = ROOT / "examples/t_maze"
# A name, and the words that name the problem.
PROBLEMS = {
    "t_maze 1": (MAZE / "domain.rddl", MAZE / "instance.rddl"),
    "t_maze 2": (MAZE / "domain.rddl", MAZE / "instance2.rddl"),
    **{f"{name} 1": (name, "1") for name in (
        "SkillTeaching_POMDP_ippc2011", "Navigation_POMDP_ippc2011", "CrossingTraffic_POMDP_ippc2011",
        "Elevators_POMDP_ippc2011", "Tamarisk_POMDP_ippc2014")},
}
KINDS = {"one observation": [], "`--stack 4`": ["--stack", 4], "`--recurrent 32`": ["--recurrent", 32]}
EPISODES = 200  # of each evaluation


def print_table(results, seeds):
    print(f"| problem | {' | '.join(KINDS)} |\n|---|{'---|' * len(KINDS)}")
    for problem in PROBLEMS:
        cells = []
        for kind in KINDS:
            found = [results[k]["return"] for seed in range(seeds) if (k := f"{problem} {kind} {seed}") in results]
            spread = statistics.stdev(found) if len(found) > 1 else 0
            cells.append(f"{statistics.mean(found):.4g} ± {spread:.2g}" if found else "")
        if any(cells):
            print(f"| {problem} | {' | '.join(cells)} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--rddl", default=ROOT / "build/bin/rddl")
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--only", default="")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--table", action="store_true")
    arguments = parser.parse_args()
    results = {}
    if arguments.out.exists():
        results = {result["key"]: result for result in map(json.loads, arguments.out.read_text().splitlines())}
    if arguments.table:
        print_table(results, arguments.seeds)
        return 0

    def measure(problem, kind, seed):
        result = {"key": f"{problem} {kind} {seed}",
                  **solve(arguments.rddl, *PROBLEMS[problem], "ppo", KINDS[kind], seed, EPISODES)}
        with arguments.out.open("a") as file:
            file.write(json.dumps(result) + "\n")
        print(json.dumps(result), flush=True)

    left = [(problem, kind, seed) for seed in range(arguments.seeds) for problem in PROBLEMS for kind in KINDS
            if arguments.only in problem and f"{problem} {kind} {seed}" not in results]
    with ThreadPoolExecutor(arguments.jobs) as pool:
        list(pool.map(lambda each: measure(*each), left))
    return 0


if __name__ == "__main__":
    sys.exit(main())
