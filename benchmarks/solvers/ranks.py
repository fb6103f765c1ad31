"""PPO by one process and by two (mpirun -np 2): by how much two are faster, in turn in one run.

    benchmarks/solvers/ranks.py [--steps 1000000] [--repetitions 3]

Two ranks make twice the steps. The time of short runs (start, loading the simulator, MPI's own start) is subtracted, and
each number is the least of the repetitions. Prints the ratio of steps per second of wall time, which is meaningful only
on a quiet machine with two free cores, and what the second rank costs in user time (waiting for the other one is system
time).
"""

import argparse
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CAR = [ROOT / "examples/mountain_car/domain.rddl", ROOT / "examples/mountain_car/instance.rddl"]
FEW = 8192


def measured(words):
    before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    subprocess.run([str(word) for word in words], check=True, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.monotonic() - begin, after.ru_utime - before.ru_utime


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--rddl", default=ROOT / "build/bin/rddl")
    parser.add_argument("--mpirun", default="mpirun --allow-run-as-root --oversubscribe --bind-to none")
    parser.add_argument("--steps", type=int, default=1_000_000)
    parser.add_argument("--repetitions", type=int, default=3)
    arguments = parser.parse_args()

    def run(ranks, steps):
        with tempfile.TemporaryDirectory() as folder:
            start = [*arguments.mpirun.split(), "-np", ranks] if ranks > 1 else []
            return measured([*start, arguments.rddl, "train", "ppo", *CAR, "--steps", steps * ranks, "--out",
                             f"{folder}/run", "--quiet", "--evaluations", 1])
    run(1, FEW)  # compiles the simulator
    least = {}
    for _ in range(arguments.repetitions):
        for ranks in (1, 2):
            for steps in (FEW, arguments.steps):
                found = run(ranks, steps)
                least[ranks, steps] = tuple(map(min, found, least.get((ranks, steps), found)))
    wall, user = ([least[ranks, arguments.steps][k] - least[ranks, FEW][k] for ranks in (1, 2)] for k in (0, 1))
    print(f"wall: {wall[0]:.2f} s by one, {wall[1]:.2f} s by two for twice the steps: {2 * wall[0] / wall[1]:.2f} times")
    # Each has half of what both took together, and they run at the same time.
    print(f"user time: {user[0]:.2f} s by one, {user[1]:.2f} s by both: {4 * user[0] / user[1]:.2f} times, if neither waits")
    return 0


if __name__ == "__main__":
    sys.exit(main())
