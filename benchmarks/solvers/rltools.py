#!/usr/bin/env python3
"""PPO beside RLtools, and beside the matrix products alone: steps a second of processor time, in turn in one run.

    benchmarks/solvers/rltools.py --packages SITE-PACKAGES [--rddl build/bin/rddl] [--repetitions 5]

SITE-PACKAGES holds `rltools` of PyPI (2.2.1), whose headers are compiled by the flags of its own package
(-O3 -march=native -ffast-math), with OpenBLAS (Debian: libopenblas-dev). All learn Pendulum, with 4 environments x 1,024
steps, 2 epochs of minibatches of 256, and networks of 64-64 units, tanh or relu; each number is the least of the repetitions, without
what a short run takes.
"""

import argparse
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
STEPS, FEW, MANY = 4 * 1024, 2, 77
OURS = ["--quiet", "--evaluations", 1, "--envs", 4, "--rollout", 1024, "--epochs", 2, "--minibatch", 256, "--gamma", 0.9,
        "--lr", "1e-3"]


def processor_seconds(words):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([str(w) for w in words], check=True, capture_output=True,
                   env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def compiled(compiler, source, program, *options):
    subprocess.run([compiler, "-std=c++17", "-O3", "-march=native", "-ffast-math", *options, HERE / source, "-o", program,
                    "-lopenblas"], check=True, capture_output=True)
    return lambda updates: [program, updates]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--packages", type=Path, required=True)
    parser.add_argument("--rddl", default=HERE.parents[1] / "build/bin/rddl")
    parser.add_argument("--cxx", default="c++")
    parser.add_argument("--repetitions", type=int, default=5)
    arguments = parser.parse_args()
    headers = arguments.packages / "rltools/external/rl_tools/include"
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)

        def ours(activation):
            def words(updates):
                run = folder / f"run{len(list(folder.iterdir()))}"
                return [arguments.rddl, "train", "ppo", "Pendulum_gym", 0, "--out", run, *OURS, "--activation", activation,
                        "--steps", updates * STEPS]
            return words

        def theirs(activation):
            return compiled(arguments.cxx, "rltools.cpp", folder / activation, f"-I{headers}",
                            "-DRL_TOOLS_BACKEND_ENABLE_OPENBLAS", f"-DACTIVATION={activation}")

        programs = {"rddl, tanh": ours("tanh"), "RLtools, tanh": theirs("TANH"),
                    "rddl, relu": ours("relu"), "RLtools, relu": theirs("RELU"),
                    "products alone": compiled(arguments.cxx, "products.cpp", folder / "products")}
        processor_seconds(ours("tanh")(1))  # compiles the simulator
        least = {}
        for _ in range(arguments.repetitions):
            for program, words in programs.items():
                for updates in (FEW, MANY):
                    seconds = processor_seconds(words(updates))
                    least[program, updates] = min(seconds, least.get((program, updates), seconds))
        rates = {program: STEPS * (MANY - FEW) / (least[program, MANY] - least[program, FEW]) for program in programs}
        for program, rate in rates.items():
            ratios = ", ".join(f"{own} has {rates[own] / rate:.2f} of it" for own in ("rddl, tanh", "rddl, relu"))
            print(f"{program}: {rate / 1e3:.0f} k steps/s; {ratios}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
