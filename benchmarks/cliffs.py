"""A batch is never slower than environments stepped one by one: batch against single, for all instances.

    .venv/bin/python benchmarks/cliffs.py                        all 586 instances; hours
    .venv/bin/python benchmarks/cliffs.py RecSim_ippc2023        some problems
    .venv/bin/python benchmarks/cliffs.py --instances-each 3
    .venv/bin/python benchmarks/cliffs.py --require --write      fail below the limit; docs/benchmarks.md

`rddl bench` with one thread: steps of a single environment for a second of processor time, and those of a
batch. A ratio below the limit is measured again, for longer, before it counts. Measurements are kept in a
file (--results), a line for each instance, so that an interrupted run continues; --fresh measures everything
again.
"""

import argparse
import statistics
import sys
from dataclasses import dataclass
from pathlib import Path

from bench import Results, bench, geometric_mean
from document import ROOT, machine_text, markdown_table, write_section

sys.path.append(str(ROOT / "tests/conformance"))
from problems import Case, all_problems, repository_cases, spread_by_size

LEAST_RATIO = 0.9  # 1, with a margin for caches and for the noise between measurements of one program
LONGER = 10


@dataclass
class Entry:
    """Steps for a second of processor time."""

    problem: str
    instance: str
    lanes: int
    alone: float
    in_batch: float

    @property
    def ratio(self) -> float:
        return self.in_batch / self.alone


def measure_once(case: Case, options: argparse.Namespace, seconds: float) -> Entry:
    files = [case.domain_path, case.instance_path]
    figures = bench(options.rddl, *files, "--threads", 1, "--seconds", seconds)
    rates = [m["steps"] / m["processor_seconds"] for m in figures["measurements"]]
    return Entry(case.problem, case.instance, figures["lanes"], rates[0], rates[-1])


def measure(case: Case, options: argparse.Namespace) -> Entry:
    entry = measure_once(case, options, options.seconds)
    if entry.ratio < LEAST_RATIO:
        entry = measure_once(case, options, LONGER * options.seconds)
    return entry


def cases_of(options: argparse.Namespace) -> list[Case]:
    problems = options.problems or all_problems()
    return [case for name in problems for case in spread_by_size(repository_cases(name), options.instances_each)]


def text_of(entries: list[Entry]) -> str:
    ratios = [entry.ratio for entry in entries]
    slower = sorted((e for e in entries if e.ratio < LEAST_RATIO), key=lambda e: e.ratio)
    least = min(entries, key=lambda entry: entry.ratio)
    head = ("instances", "geometric mean", "median", "least", "of", f"below {LEAST_RATIO}")
    row = (
        f"{len(entries)}",
        f"{geometric_mean(ratios):.2f}",
        f"{statistics.median(ratios):.2f}",
        f"{least.ratio:.2f}",
        f"{least.problem} {least.instance}",
        f"{len(slower)}",
    )
    lines = [f"* {e.problem} {e.instance}: {e.ratio:.2f}, {e.lanes} lanes" for e in slower]
    return "\n".join([f"{machine_text()}:\n\n{markdown_table([head, row])}", *([""] if lines else []), *lines])


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problems", nargs="*", help="names of problems of rddlrepository")
    parser.add_argument("--instances-each", type=int, help="3: the smallest, the median and the largest (all)")
    parser.add_argument("--rddl", type=Path, default=ROOT / "build/bin/rddl", help="our program")
    parser.add_argument("--seconds", type=float, default=0.1, help="of each measurement")
    default = ROOT / "build/benchmarks/cliffs.jsonl"
    parser.add_argument("--results", type=Path, default=default, help="file for the figures")
    parser.add_argument("--fresh", action="store_true", help="measure again what is measured already")
    parser.add_argument("--require", action="store_true", help="fail below the limit")
    parser.add_argument("--write", action="store_true", help="write docs/benchmarks.md")
    return parser.parse_args()


def main() -> int:
    options = parse_arguments()
    results = Results(options.results, options.fresh, Entry, lambda entry: (entry.problem, entry.instance))
    cases = cases_of(options)
    for number, case in enumerate(cases, 1):
        key = (case.problem, case.instance)
        if key not in results.entries:
            results.add(measure(case, options))
        entry = results.entries[key]
        mark = "  slower in a batch" if entry.ratio < LEAST_RATIO else ""
        print(f"{number:3}/{len(cases)}  {entry.ratio:6.2f}  {case.label}{mark}", flush=True)
    entries = [results.entries[case.problem, case.instance] for case in cases]
    print(text_of(entries))
    if options.write:
        write_section("cliffs", text_of(entries))
    return 1 if options.require and any(entry.ratio < LEAST_RATIO for entry in entries) else 0


if __name__ == "__main__":
    sys.exit(main())
