"""Our batches against the compiled, vmapped rollouts of pyRDDLGym-jax, on the same processor.

    python3 -m venv .jaxvenv && .jaxvenv/bin/pip install -r benchmarks/requirements-jax.txt
    .venv/bin/python benchmarks/compare_jax.py             some minutes
    .venv/bin/python benchmarks/compare_jax.py --require   and fail below the limits
    .venv/bin/python benchmarks/compare_jax.py --write     and docs/benchmarks.md
    .venv/bin/python benchmarks/compare_jax.py --real=float    ours in 32 bits, as jax

Each problem is one run of `rddl bench --against=jax`: both sides with one thread and with as many as
there are cores, each at its best batch size, jax after its compilation. jax computes in 32 bits, its
default, and checks neither ends of episodes nor preconditions; ours ends episodes, and computes in 64 bits
unless told otherwise, which the summary says. The time to the first step is that of a program that is
given the files: for jax to import it (told apart in the table), to read the files and to compile a single
step; for us to compile, twice. What all simulators link is compiled before, as pyRDDLGym-jax is installed
before.

Limits: geometric means of the ratios, with as many threads, of at least 10; and a first step that is
sooner.
"""

import argparse
import math
import statistics
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from bench import bench
from document import ROOT, machine_text, markdown_table, write_section

sys.path.insert(0, str(ROOT / "tests/conformance"))

from problems import CORE, Case, repository_cases, smallest_median_largest  # noqa: E402

LEAST_RATIO = 10.0
OUR_BATCHES = "64,256,1024,4096"


@dataclass
class Comparison:
    """Of one instance."""

    label: str
    jax_version: str
    ours: dict[int, float]  # best steps per second, by the number of threads
    jax: dict[int, float]
    our_first_step: float  # seconds
    jax_first_step: float  # once it is imported
    jax_import: float

    @property
    def is_sooner(self) -> bool:
        return self.our_first_step < self.jax_import + self.jax_first_step

    def ratio(self, threads: int) -> float:
        return self.ours[threads] / self.jax[threads]


def best_by_threads(measurements: list[dict]) -> dict[int, float]:
    best: dict[int, float] = {}
    for m in measurements:
        best[m["threads"]] = max(best.get(m["threads"], 0.0), m["steps_per_second"])
    return best


def compare(case: Case, options: argparse.Namespace) -> Comparison:
    arguments = ["--against=jax", "--python", options.jax_python, "--batch", OUR_BATCHES]
    arguments += ["--seconds", options.seconds, "--threads", options.threads, f"--real={options.real}"]
    figures = bench(options.rddl, case.domain_path, case.instance_path, *arguments)
    (peer,) = figures["peers"]
    return Comparison(
        case.label,
        peer["version"],
        best_by_threads(figures["measurements"]),
        best_by_threads(peer["measurements"]),
        figures["first_step_seconds"],
        peer["first_step_seconds"],
        peer["import_seconds"],
    )


def prepare(case: Case, options: argparse.Namespace) -> None:
    """The first use of rddl on a machine compiles what all simulators link."""
    command = [options.rddl, "run", case.domain_path, case.instance_path, "--no-cache", "--horizon", "1"]
    subprocess.run(list(map(str, command)), stdout=subprocess.DEVNULL, check=True)


def median_case(problem: str) -> Case:
    cases = smallest_median_largest(repository_cases(problem))
    return cases[len(cases) // 2]


def rows_of(comparisons: list[Comparison]) -> list[tuple[str, ...]]:
    threads = sorted(comparisons[0].jax)
    head = ["instance"]
    for count in threads:
        head += [f"jax, {count} threads", "rddlc", "ratio"]
    rows = [(*head, "jax's import", "its first step", "rddlc's")]
    for c in comparisons:
        cells = [c.label]
        for count in threads:
            cells += [f"{c.jax[count]:,.0f}", f"{c.ours[count]:,.0f}", f"{c.ratio(count):.1f}"]
        seconds = (c.jax_import, c.jax_first_step, c.our_first_step)
        rows.append((*cells, *(f"{value:.2f} s" for value in seconds)))
    return rows


def mean_ratio(comparisons: list[Comparison], threads: int) -> float:
    return math.exp(statistics.fmean(math.log(c.ratio(threads)) for c in comparisons))


def summary_text(comparisons: list[Comparison], real: str) -> str:
    parts = []
    for threads in sorted(comparisons[0].jax):
        least = min(c.ratio(threads) for c in comparisons)
        mean = mean_ratio(comparisons, threads)
        parts.append(f"with {threads} threads {mean:.1f} times the throughput (least {least:.1f})")
    sooner = sum(c.is_sooner for c in comparisons)
    means = f"rddlc computes in {real}s; geometric means: {', '.join(parts)}"
    return f"{means}; first step sooner in {sooner} of {len(comparisons)}"


def shortfalls(comparisons: list[Comparison]) -> list[str]:
    """What is below its limit, a line each."""
    lines = []
    for threads in sorted(comparisons[0].jax):
        mean = mean_ratio(comparisons, threads)
        if mean < LEAST_RATIO:
            lines.append(f"with {threads} threads: the geometric mean {mean:.1f} is below {LEAST_RATIO:g}")
    late = [c.label for c in comparisons if not c.is_sooner]
    return lines + [f"{label}: the first step is not sooner" for label in late]


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problems", nargs="*", help="names of problems of rddlrepository")
    parser.add_argument("--rddl", type=Path, default=ROOT / "build/bin/rddl", help="our program")
    default = ROOT / ".jaxvenv/bin/python"
    parser.add_argument("--jax-python", type=Path, default=default, help="Python with pyRDDLGym-jax")
    parser.add_argument("--seconds", type=float, default=0.5, help="of each measurement")
    parser.add_argument("--threads", type=int, default=2, help="the most threads, besides one")
    parser.add_argument("--real", choices=("double", "float"), default="double", help="what ours computes in")
    parser.add_argument("--require", action="store_true", help="fail below the limits")
    parser.add_argument("--write", action="store_true", help="write docs/benchmarks.md")
    return parser.parse_args()


def main() -> int:
    options = parse_arguments()
    comparisons, failures = [], []
    prepare(median_case(CORE[0]), options)
    for problem in options.problems or CORE:
        case = median_case(problem)
        try:
            comparisons.append(compare(case, options))
        except RuntimeError as error:
            failures.append(f"{case.label}: {error}")
            print(failures[-1], flush=True)
            continue
        print("  ".join(rows_of(comparisons[-1:])[-1]), flush=True)
    if not comparisons:
        return 1
    print(f"\n{summary_text(comparisons, options.real)}")
    short = shortfalls(comparisons)
    print(*short, sep="\n")
    if options.write:
        summary = summary_text(comparisons, options.real)
        about = f"{machine_text()}; pyRDDLGym-jax {comparisons[0].jax_version}; {summary}"
        write_section("jax", f"{about}:\n\n{markdown_table(rows_of(comparisons))}")
    return 1 if failures or (options.require and short) else 0


if __name__ == "__main__":
    sys.exit(main())
