"""Steps for a second of processor time of the real pyRDDLGym and of our compiled simulators, side by side.

    .venv/bin/python benchmarks/compare.py                       all problems; half an hour
    .venv/bin/python benchmarks/compare.py SysAdmin_MDP_ippc2011 some problems
    .venv/bin/python benchmarks/compare.py --require             and fail below the limits
    .venv/bin/python benchmarks/compare.py --write               and docs/benchmarks.md

Measures the smallest and the largest instance of each problem of rddlrepository, by the size of their
text. All play random legal actions that are drawn beforehand; resets, where an episode ends, are part of
the time. pyRDDLGym steps one environment in its vectorised form, its quicker one; ours is `rddl bench`
with one thread: a single environment, and a batch. They take turns; processor time is not inflated by
other programs on the machine. The ratios are those of the medians.

Measurements are kept in a file (--results), a line for each instance, so that an interrupted run continues
where it was; --fresh measures everything again. Simulators are compiled before anything is measured.

Limits: geometric means of the ratios of at least 3,000 in a batch and 1,000 for a single environment,
and no instance below 50 in a batch.
"""

import argparse
import contextlib
import gc
import logging
import os
import platform
import statistics
import sys
import warnings
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

import numpy as np

from bench import Results, bench, geometric_mean
from document import ROOT, machine_text, markdown_table, write_section

sys.path.append(str(ROOT / "tests/conformance"))
sys.path.insert(0, str(ROOT / "benchmarks/peers"))

from problems import Case, all_problems, repository_cases, spread_by_size  # noqa: E402
from vectorized_environment import VectorizedEnvironment  # noqa: E402

BATCH_MEAN, SINGLE_MEAN, LEAST = 3000.0, 1000.0, 50.0


@dataclass
class Comparison:
    """The figures of one instance: steps for a second of processor time, one figure a round."""

    problem: str
    instance: str
    pyrddlgym: list[float]
    single: list[float]
    batch: list[float]

    @property
    def label(self) -> str:
        return f"{self.problem} {self.instance}"

    @property
    def single_ratio(self) -> float:
        return statistics.median(self.single) / statistics.median(self.pyrddlgym)

    @property
    def batch_ratio(self) -> float:
        return statistics.median(self.batch) / statistics.median(self.pyrddlgym)


def speed(measurement: dict) -> float:
    return measurement["steps"] / measurement["processor_seconds"]


def our_speeds(rddl: Path, case: Case, seconds: float) -> tuple[float, float]:
    """The speeds of a single environment and of a batch."""
    figures = bench(rddl, case.domain_path, case.instance_path, "--threads", 1, "--seconds", seconds)
    single, *batches = map(speed, figures["measurements"])
    return single, max(batches)


def compare(case: Case, options: argparse.Namespace) -> Comparison:
    reference = VectorizedEnvironment(str(case.domain_path), str(case.instance_path), options.seconds)
    comparison = Comparison(case.problem, case.instance, [], [], [])
    for _ in range(options.rounds):
        comparison.pyrddlgym.append(speed(reference.measure(options.seconds)))
        single, batch = our_speeds(options.rddl, case, options.seconds)
        comparison.single.append(single)
        comparison.batch.append(batch)
    return comparison


def columns(comparison: Comparison) -> tuple[str, ...]:
    """The columns of the table in the document."""
    speeds = (comparison.pyrddlgym, comparison.single, comparison.batch)
    numbers = [*map(statistics.median, speeds), comparison.single_ratio, comparison.batch_ratio]
    return (comparison.label, *(f"{number:,.0f}" for number in numbers))


TITLES = ("instance", "pyRDDLGym", "one environment", "batch", "ratio, one", "ratio, batch")


def row_text(row: tuple[str, ...]) -> str:
    return row[0].ljust(38) + "".join(f"  {cell:>15}" for cell in row[1:])


def summary_rows(comparisons: list[Comparison]) -> list[tuple[str, ...]]:
    rows = [("ratio", "geometric mean", "median", "least", "of")]
    for name, ratio in (("one environment", "single_ratio"), ("batch", "batch_ratio")):
        ordered = sorted(comparisons, key=lambda comparison: getattr(comparison, ratio))
        ratios = [getattr(comparison, ratio) for comparison in ordered]
        figures = (geometric_mean(ratios), statistics.median(ratios), ratios[0])
        rows.append((name, *(f"{figure:,.0f}" for figure in figures), ordered[0].label))
    return rows


def shortfalls(comparisons: list[Comparison]) -> list[str]:
    """Returns the figures below their limit, a line each."""
    lines = []
    for name, ratio, limit in (("batch", "batch_ratio", BATCH_MEAN), ("one environment", "single_ratio", SINGLE_MEAN)):
        mean = geometric_mean([getattr(comparison, ratio) for comparison in comparisons])
        if mean < limit:
            lines.append(f"{name}: the geometric mean {mean:,.0f} is below {limit:,.0f}")
    below = [comparison for comparison in comparisons if comparison.batch_ratio < LEAST]
    return lines + [f"{c.label}: the ratio {c.batch_ratio:.0f} is below {LEAST:.0f}" for c in below]


def versions_text() -> str:
    packages = ", ".join(f"{name} {version(name)}" for name in ("pyRDDLGym", "numpy"))
    return f"{machine_text()}; Python {platform.python_version()}, {packages}"


def write_document(comparisons: list[Comparison], about: str) -> None:
    summary = markdown_table(summary_rows(comparisons))
    write_section("comparison", f"{about}; {len(comparisons)} instances:\n\n{summary}")
    write_section("comparison by problem", markdown_table([TITLES, *map(columns, comparisons)]))


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problems", nargs="*", help="names of problems of rddlrepository (all)")
    parser.add_argument("--rddl", type=Path, default=ROOT / "build/bin/rddl", help="our program")
    parser.add_argument("--seconds", type=float, default=0.3, help="of each measurement")
    parser.add_argument("--rounds", type=int, default=3, help="turns of each side")
    default = ROOT / "build/benchmarks/compare.jsonl"
    parser.add_argument("--results", type=Path, default=default, help="file that keeps the figures")
    parser.add_argument("--fresh", action="store_true", help="measure again what the file has")
    parser.add_argument("--require", action="store_true", help="fail below the limits")
    parser.add_argument("--write", action="store_true", help="write docs/benchmarks.md")
    return parser.parse_args()


def compile_ahead(cases: list[Case], options: argparse.Namespace) -> None:
    """Compiles into rddl's cache, on all cores; a failure is repeated when it is measured."""

    def compile_one(case: Case) -> None:
        with contextlib.suppress(RuntimeError, OSError):
            our_speeds(options.rddl, case, 0.01)

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(compile_one, cases))


def measure_missing(cases: list[Case], results: Results, options: argparse.Namespace) -> list[str]:
    """Returns the measurements that failed, a line each."""
    failures = []
    for case in cases:
        if case.label not in results.entries:
            try:
                results.add(compare(case, options))
            except Exception as error:  # of ours or of theirs: the others are measured nevertheless
                failures.append(f"{case.label}: {type(error).__name__}: {error}")
                print(failures[-1], flush=True)
                continue
            gc.collect()
        print(row_text(columns(results.entries[case.label])), flush=True)
    return failures


def main() -> int:
    options = parse_arguments()
    warnings.simplefilter("ignore")
    logging.disable(logging.WARNING)
    np.seterr(all="ignore")
    about = f"{versions_text()}; {options.rounds} rounds of {options.seconds:g} s"
    print(f"{about}\n\n{row_text(TITLES)}")
    problems = options.problems or all_problems()
    cases = [case for problem in problems for case in spread_by_size(repository_cases(problem), 2)]
    results = Results(options.results, options.fresh, Comparison, lambda c: c.label)
    compile_ahead([case for case in cases if case.label not in results.entries], options)
    failures = measure_missing(cases, results, options)
    comparisons = [results.entries[case.label] for case in cases if case.label in results.entries]
    if not comparisons:
        return 1
    print("", *map(row_text, summary_rows(comparisons)), sep="\n")
    short = shortfalls(comparisons)
    print(*short, sep="\n")
    if options.write:
        write_document(comparisons, about)
    return 1 if failures or (options.require and short) else 0


if __name__ == "__main__":
    sys.exit(main())
