"""Steps the same environments one by one and in packs, and compares all bits of their outputs.

    .venv/bin/python tests/conformance/lanes.py                     the smallest instance of each problem
    .venv/bin/python tests/conformance/lanes.py --all               all 586 instances
    .venv/bin/python tests/conformance/lanes.py RecSim_ippc2023     some problems
    .venv/bin/python tests/conformance/lanes.py --lanes 8 --lanes 32 --march x86-64-v3
    .venv/bin/python tests/conformance/lanes.py --without=hoist_aggregations --fast-math
    .venv/bin/python tests/conformance/lanes.py --examples --real float

Each instance is compiled for packs and stepped by compare_lanes.cpp: 70 environments, 60 steps,
with resets and faults, one by one, in packs, and in packs by two threads. States, observations,
rewards, ends and their causes must be the same byte for byte. Exit status: 0 if all agree.
"""

import argparse
import multiprocessing
import os
import shlex
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from ours import last_lines, problem_words
from problems import ROOT, Case, all_problems, example_cases, repository_cases
from problems import spread_by_size


@dataclass
class Comparison:
    case: Case
    lanes: int
    agrees: bool
    text: str
    seconds: float


def compare(task: tuple[Case, int, argparse.Namespace]) -> Comparison:
    case, lanes, options = task
    begin = time.perf_counter()
    agrees, text = compare_built(case, lanes, options)
    return Comparison(case, lanes, agrees, text, time.perf_counter() - begin)


def compare_built(case: Case, lanes: int, options) -> tuple[bool, str]:
    with tempfile.TemporaryDirectory(prefix="lanes-") as folder:
        source, simulator = Path(folder, "simulator.cpp"), Path(folder, "simulator.so")
        emit = [options.rddlc, *problem_words(case), "-w", f"--lanes={lanes}", "-o", source]
        emit += [f"--without={name}" for name in options.without]
        emit += ["--fast-math"] if options.fast_math else []
        emit += [f"--real={options.real}"]
        steps = [options.program, simulator, options.steps, options.environments]
        for command in (emit, compile_command(case, source, simulator, options), steps):
            result = subprocess.run(list(map(str, command)), capture_output=True, text=True)
            if result.returncode != 0:
                return False, last_lines(result.stdout + result.stderr)
        return True, result.stdout.strip()


def compile_command(case: Case, source: Path, simulator: Path, options) -> list:
    """-O1, because compiling takes nearly all the time; no bit may depend on it."""
    command = [*shlex.split(os.environ.get("CXX", "c++")), f"-O{options.optimise}"]
    command += ["-std=c++20", "-shared", "-fPIC", "-ffp-contract=off", f"-march={options.march}"]
    command += ["-DRDDL_ENTRY=rddl_simulator_entry", f"-I{ROOT / 'runtime'}"]
    command += [f"-I{case.header.parent}"] if case.header else []
    return [*command, "-o", simulator, source]


def chosen_cases(options) -> list[Case]:
    if options.examples:
        return example_cases()
    by_problem = [repository_cases(name) for name in options.problems or all_problems()]
    if not options.all:
        by_problem = [spread_by_size(cases, 1) for cases in by_problem]
    return [case for cases in by_problem for case in cases]


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problems", nargs="*", help="names of problems of rddlrepository")
    parser.add_argument("--all", action="store_true", help="all instances, not only the smallest")
    parser.add_argument("--examples", action="store_true", help="the problems of examples/")
    parser.add_argument("--lanes", type=int, action="append", help="in a pack; default: 16")
    parser.add_argument("--march", default="native", help="the processor to compile for")
    parser.add_argument("--optimise", default="1", help="-O of the C++ compiler")
    parser.add_argument("--without", action="append", default=[], help="leave out a pass")
    parser.add_argument("--fast-math", action="store_true")
    parser.add_argument("--real", default="double", choices=["double", "float"])
    parser.add_argument("--environments", type=int, default=70)
    parser.add_argument("--steps", type=int, default=60)
    parser.add_argument("--rddlc", type=Path, default=ROOT / "build/bin/rddlc", help="our compiler")
    parser.add_argument("--program", type=Path, default=ROOT / "build/bin/compare_lanes")
    parser.add_argument("--workers", type=int, default=os.cpu_count())
    options = parser.parse_args()
    for program in (options.rddlc, options.program):
        if not program.exists():
            parser.error(f"{program} is not there: build it, or give its place")
    return options


def main() -> int:
    options = parse_arguments()
    cases = chosen_cases(options)
    tasks = [(case, lanes, options) for case in cases for lanes in options.lanes or [16]]
    differ = 0
    with multiprocessing.get_context("spawn").Pool(options.workers) as pool:
        for found in pool.imap(compare, tasks):
            verdict = "agrees" if found.agrees else "DIFFERS"
            row = f"{found.case.label:38} {found.seconds:5.1f} s  {verdict}  {found.text}"
            print(row, flush=True)
            differ += not found.agrees
    print(f"\n{len(tasks)} comparisons, {differ} of them differ")
    return 1 if differ or not tasks else 0


if __name__ == "__main__":
    sys.exit(main())
