#!/usr/bin/env python3
"""Returns that solvers reach on problems whose best returns are known, with several seeds.

    benchmarks/solvers/returns.py --out returns.jsonl [--seeds 5] [--only MountainCar]
    benchmarks/solvers/returns.py --out returns.jsonl --table

Can be interrupted; what is in the file already is not done again.
"""

import argparse
import json
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SMALL = ["--envs", 16, "--minibatch", 128, "--epochs", 10, "--lr", "1e-3"]
# Problem, instance, solver, its options, and what a correct solver reaches (docs/solvers.md names sources).
RUNS = [
    ("MountainCar_ippc2023", "1", "cgp", ["--gens", 3000], "100, near 82 steps"),
    ("MountainCar_ippc2023", "2", "cgp", ["--gens", 3000], "100, near 117 steps"),
    ("MountainCar_ippc2023", "3", "cgp", ["--gens", 3000], "100, near 147 steps"),
    ("MountainCar_ippc2023", "4", "cgp", ["--gens", 3000], "100, near 154 steps"),
    ("MountainCar_ippc2023", "5", "cgp", ["--gens", 4000], "100, near 185 steps"),
    ("CartPole_Continuous_gym", "0", "ppo", ["--steps", 100000, *SMALL], "200"),
    ("CartPole_Discrete_gym", "0", "ppo", ["--steps", 100000, *SMALL], "200"),
    ("Pendulum_gym", "0", "ppo", ["--steps", 300000, "--envs", 16, "--rollout", 256, "--minibatch", 256, "--epochs", 10,
                                  "--gamma", 0.95, "--lr", "1e-3"], "report"),
    ("MountainCar_ippc2023", "1", "ppo", ["--steps", 1000000], "100"),
    ("MountainCar_ippc2023", "2", "ppo", ["--steps", 1000000], "100"),
    ("Reservoir_ippc2023", "1", "ppo", ["--steps", 500000, *SMALL, "--gamma", 0.9, "--noise", "white", "--log-std", -1],
     "better than -700"),
    ("Wildfire_MDP_ippc2014", "1", "ppo", ["--steps", 1000000, "--envs", 128, "--rollout", 40, "--minibatch", 512,
                                           "--epochs", 8, "--lr", "2e-3", "--entropy", 0.01, "--hidden", "128,128",
                                           "--evaluation-episodes", 100], "-333 at best (exact)"),
    ("MountainCar_ippc2023", "3", "ppo", ["--steps", 1000000], "100"),
    ("MountainCar_ippc2023", "4", "ppo", ["--steps", 1000000], "100"),
    ("Reservoir_ippc2023", "1", "cgp", ["--gens", 200], ""),
    ("Wildfire_MDP_ippc2014", "1", "cgp", ["--gens", 200], ""),
]


def solve(rddl, problem, instance, solver, options, seed, episodes=50):
    with tempfile.TemporaryDirectory() as folder:
        begin = time.time()
        subprocess.run([str(w) for w in (rddl, "train", solver, problem, instance, "--out", f"{folder}/run", "--seed",
                                         seed, "--quiet", *options)], check=True, capture_output=True)
        seconds = time.time() - begin
        out = subprocess.run([rddl, "evaluate", problem, instance, "--policy", f"{folder}/run", "--episodes",
                              str(episodes), "--seed", str(1000 + seed), "--json"], check=True, capture_output=True, text=True).stdout
    policy = json.loads(out)["policies"][0]
    return {"return": policy["return"]["mean"], "length": policy["length"]["mean"], "seconds": seconds}


def key(problem, instance, solver, options, seed):
    return f"{problem} {instance} {solver} {' '.join(map(str, options))} {seed}"


def print_table(results, seeds):
    print("| problem | command's options | returns of the seeds | mean ± std | steps | must reach |\n|---|---|---|---|---|---|")
    for problem, instance, solver, options, target in RUNS:
        found = [results[k] for s in range(seeds) if (k := key(problem, instance, solver, options, s)) in results]
        if not found:
            continue
        returns, lengths = [f["return"] for f in found], [f["length"] for f in found]
        spread = statistics.stdev(returns) if len(returns) > 1 else 0
        print(f"| {problem} {instance} | `{solver} {' '.join(map(str, options))}` | "
              f"{', '.join(f'{r:.4g}' for r in returns)} | {statistics.mean(returns):.4g} ± {spread:.2g} | "
              f"{', '.join(f'{length:.3g}' for length in lengths)} | {target} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--rddl", default=ROOT / "build/bin/rddl")
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--only", default="")
    parser.add_argument("--table", action="store_true")
    arguments = parser.parse_args()
    results = {}
    if arguments.out.exists():
        for line in arguments.out.read_text().splitlines():
            result = json.loads(line)
            results[result["key"]] = result
    if arguments.table:
        print_table(results, arguments.seeds)
        return 0
    for seed in range(arguments.seeds):
        for problem, instance, solver, options, _ in RUNS:
            name = key(problem, instance, solver, options, seed)
            if arguments.only not in problem or name in results:
                continue
            result = {"key": name, **solve(arguments.rddl, problem, instance, solver, options, seed)}
            with arguments.out.open("a") as file:
                file.write(json.dumps(result) + "\n")
            print(json.dumps(result), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
