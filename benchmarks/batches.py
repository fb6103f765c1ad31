"""How speed grows with the size of the batch and the number of threads.

    .venv/bin/python benchmarks/batches.py   a few minutes; plots.py draws what it measured

`rddl bench` of a few problems of different kinds, with batches of 1 to 16,384 environments.
"""

import argparse
import json
import sys
from pathlib import Path

from bench import bench
from document import ROOT

PROBLEMS = (
    ("MountainCar_ippc2023", "1"),
    ("CartPole_Continuous_gym", "0"),
    ("SysAdmin_MDP_ippc2011", "10"),
    ("Wildfire_MDP_ippc2014", "10"),
    ("Reservoir_ippc2023", "5"),
    ("Elevators_POMDP_ippc2011", "5"),
)
SIZES = "1,4,16,64,256,1024,4096,16384"


def measure(problem: str, instance: str, options: argparse.Namespace) -> dict:
    arguments = ["--batch", options.sizes, "--seconds", options.seconds]
    try:
        return bench(options.rddl, problem, instance, *arguments)
    except RuntimeError as error:
        sys.exit(f"{problem} {instance}: {error}")


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rddl", type=Path, default=ROOT / "build/bin/rddl", help="our program")
    parser.add_argument("--sizes", default=SIZES, help="of the batches")
    parser.add_argument("--seconds", type=float, default=0.3, help="of each measurement")
    default = ROOT / "build/benchmarks/batches.json"
    parser.add_argument("--results", type=Path, default=default, help="file for the figures")
    return parser.parse_args()


def main() -> int:
    options = parse_arguments()
    figures = []
    for problem, instance in PROBLEMS:
        figures.append(measure(problem, instance, options))
        best = max(m["steps_per_second"] for m in figures[-1]["measurements"])
        print(f"{problem} {instance}: at most {best / 1e6:.1f} million steps a second", flush=True)
    options.results.parent.mkdir(parents=True, exist_ok=True)
    options.results.write_text(json.dumps(figures, indent=2) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
