"""Emitted simulators against C++ written by hand for the same instances, with the same random numbers.

    .venv/bin/python benchmarks/handwritten.py             some minutes
    .venv/bin/python benchmarks/handwritten.py --require   and fail below the limit
    .venv/bin/python benchmarks/handwritten.py --write     and docs/benchmarks.md

benchmarks/handwritten/ holds the references; both sides are compiled with the same options. They
first play the same course and must agree; then they take turns, with one thread, a single environment
and a batch of 1,024. The ratios are those of the medians, of steps for a second of processor time.

The references round as they like: with reciprocals, in another order. So ours is measured as it is by
default, all bits as without optimisation, and with --fast-math, like with like.

Limit: ours with --fast-math has at least 0.9 of the speed of each.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from document import ROOT, machine_text, markdown_table, write_section

sys.path.append(str(ROOT / "tests/conformance"))

from problems import repository_cases  # noqa: E402

FOLDER = ROOT / "benchmarks/handwritten"
PROBLEMS = {
    "MountainCar_ippc2023": "1",
    "CartPole_Continuous_gym": "0",
    "Pendulum_gym": "0",
    "SysAdmin_MDP_ippc2011": "10",
    "Wildfire_MDP_ippc2014": "10",
    "Reservoir_ippc2023": "5",
}
LEAST_RATIO = 0.9
GREATEST_DIFFERENCE = 1e-9  # of reals, relative; the order of sums is not the same


@dataclass
class Comparison:
    """The figures of one instance and size of batch."""

    label: str
    environments: int
    difference: float
    emitted: float  # steps per second
    handwritten: float
    ratio: float
    fast_ratio: float  # with --fast-math


# GCC would put halves of one environment's polynomials into registers together, and lose half of its speed;
# and keep coefficients that are used twice in registers, and numbers elsewhere. GCC 12 makes wrong copies of
# constants (rddl/values/tables.hpp).
NO_PASSES = ["-fno-tree-slp-vectorize", "-fno-gcse", "-fno-tree-loop-distribute-patterns"]
# The flags of rddl (compiler/driver/shared_object.cpp).
INLINE_MORE = ["--param", "max-inline-insns-single=400"]
FLAGS = ["-std=c++20", "-O3", "-march=native", "-ffp-contract=off", *NO_PASSES, *INLINE_MORE]
# Each reference as if it were alone in its program.
INLINING = ["--param", "inline-unit-growth=1000"]


def run(command: list) -> str:
    result = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    if result.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))}\n{result.stdout}{result.stderr}")
    return result.stdout


def build_references(options: argparse.Namespace) -> Path:
    """The program that compares: the references, the emitted simulators' runtime and what measures in rddl."""
    options.folder.mkdir(parents=True, exist_ok=True)
    (options.folder / "tables.hpp").write_text(run([sys.executable, FOLDER / "tables.py"]))
    program = options.folder / "handwritten"
    measuring = ("terminal/interrupt", "measure/measurement", "measure/random_course", "formats/records_json")
    sources = [FOLDER / "main.cpp", *(ROOT / f"workbench/{name}.cpp" for name in measuring)]
    folders = [options.folder, ROOT / "runtime", ROOT / "workbench", ROOT]
    libraries = [options.build / "solvers/librddl_solvers.a", options.build / "support/librddlc_support.a",
                 "-lfmt", "-lutf8proc", "-ldl", "-pthread"]
    run([options.cxx, *FLAGS, *INLINING, *(f"-I{folder}" for folder in folders), *sources, *libraries, "-o", program])
    return program


def build_simulator(problem: str, rddlc_options: list[str], options: argparse.Namespace) -> Path:
    (case,) = [c for c in repository_cases(problem) if c.instance == PROBLEMS[problem]]
    source = options.folder / f"{problem}.cpp"
    simulator = source.with_suffix(".so")
    run([options.build / "bin/rddlc", *rddlc_options, case.domain_path, case.instance_path, "-o", source])
    linking = ["-shared", "-fPIC", "-fvisibility=hidden", "-DRDDL_ENTRY=rddl_simulator_entry"]
    run([options.cxx, *FLAGS, *linking, f"-I{ROOT / 'runtime'}", source, "-o", simulator])
    return simulator


def measure(problem: str, rddlc_options: list[str], program: Path, options: argparse.Namespace) -> list[dict]:
    """By size of batch: differences, and the median speeds of both sides."""
    simulator = build_simulator(problem, rddlc_options, options)
    sizes = json.loads(run([program, problem, simulator, options.seconds, options.rounds]))["sizes"]
    for size in sizes:
        size["difference"] = float("inf") if size["difference"] is None else size["difference"]
        size["emitted"] = statistics.median(size["emitted"])
        size["handwritten"] = statistics.median(size["handwritten"])
        size["ratio"] = size["emitted"] / size["handwritten"]
    return sizes


def compare(problem: str, program: Path, options: argparse.Namespace) -> list[Comparison]:
    exact = measure(problem, [], program, options)
    fast = measure(problem, ["--fast-math"], program, options)
    return [
        Comparison(
            f"{problem} {PROBLEMS[problem]}",
            e["environments"],
            max(e["difference"], f["difference"]),
            e["emitted"],
            e["handwritten"],
            e["ratio"],
            f["ratio"],
        )
        for e, f in zip(exact, fast, strict=True)
    ]


TITLES = ("instance", "environments", "emitted", "by hand", "ratio", "with --fast-math")


def columns(c: Comparison) -> tuple[str, ...]:
    speeds = (f"{c.emitted:,.0f}", f"{c.handwritten:,.0f}", f"{c.ratio:.2f}", f"{c.fast_ratio:.2f}")
    return (c.label, f"{c.environments:,}", *speeds)


def row_text(row: tuple[str, ...]) -> str:
    return row[0].ljust(28) + "".join(f"  {cell:>16}" for cell in row[1:])


def disagreements(comparisons: list[Comparison]) -> list[str]:
    return [
        f"{c.label}, {c.environments} environments: the results differ by {c.difference:.2g}"
        for c in comparisons
        if not c.difference <= GREATEST_DIFFERENCE
    ]


def shortfalls(comparisons: list[Comparison]) -> list[str]:
    return [
        f"{c.label}, {c.environments} environments: the ratio {c.fast_ratio:.2f} is below {LEAST_RATIO:g}"
        for c in comparisons
        if c.fast_ratio < LEAST_RATIO
    ]


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problems", nargs="*", help="some of the six")
    parser.add_argument("--build", type=Path, default=ROOT / "build", help="our build")
    parser.add_argument("--cxx", default=os.environ.get("CXX", "c++"), help="the C++ compiler")
    parser.add_argument("--folder", type=Path, default=ROOT / "build/benchmarks/handwritten", help="to work in")
    parser.add_argument("--seconds", type=float, default=0.5, help="of each measurement")
    parser.add_argument("--rounds", type=int, default=5, help="turns of each side")
    parser.add_argument("--require", action="store_true", help="fail below the limit")
    parser.add_argument("--write", action="store_true", help="write docs/benchmarks.md")
    return parser.parse_args()


def main() -> int:
    options = parse_arguments()
    program = build_references(options)
    print(row_text(TITLES))
    comparisons: list[Comparison] = []
    for problem in options.problems or PROBLEMS:
        comparisons += compare(problem, program, options)
        print(*(row_text(columns(c)) for c in comparisons[-2:]), sep="\n", flush=True)
    different, slow = disagreements(comparisons), shortfalls(comparisons)
    print("", *different, *slow, sep="\n")
    if options.write:
        write_section("handwritten", f"{machine_text()}:\n\n{markdown_table([TITLES, *map(columns, comparisons)])}")
    return 1 if different or (options.require and slow) else 0


if __name__ == "__main__":
    sys.exit(main())
