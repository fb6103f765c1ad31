"""The cost model beside measured time: the cost of a step (compiler/ir/cost_model.hpp) and its nanoseconds, for one
environment of each of N problems.

    .venv/bin/python benchmarks/cost_model.py                     40 problems of rddlrepository, a minute if they are compiled
    .venv/bin/python benchmarks/cost_model.py --require --write   and docs/benchmarks.md; status 1 if the model is far off

The model is right if the time of a unit of cost is the same for all problems. So each problem has the quotient of time and
cost, divided by the median of all quotients: 2 means that a step takes twice the time that the model says.
"""

import argparse
import json
import statistics
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from bench import bench, print_row
from document import ROOT, machine_text, markdown_table, write_section

sys.path.append(str(ROOT / "tests/conformance"))
from problems import Case, cases_of  # noqa: E402

MOST_OFF = 2.0  # times
MOST_OUTSIDE = 0.1  # of the problems


@dataclass
class Step:
    problem: str
    instance: str
    cost: float
    nanoseconds: float


def sample(count: int) -> list[Case]:
    """A middle instance of each of `count` problems, evenly spread over their names."""
    of_problem: dict[str, list[Case]] = {}
    for case in cases_of([]):
        of_problem.setdefault(case.problem, []).append(case)
    names = sorted(of_problem)
    count = min(count, len(names))
    chosen = [names[(2 * i + 1) * len(names) // (2 * count)] for i in range(count)]
    return [of_problem[name][len(of_problem[name]) // 2] for name in chosen]


def measure(case: Case, options: argparse.Namespace) -> Step:
    command = [options.rddlc, case.domain_path, case.instance_path]
    stats = subprocess.check_output([*command, "--stats=json", "--stop-after=optimise", "-w"])
    arguments = ["--threads", 1, "--batch", 1, "--seconds", options.seconds]
    alone, *_ = bench(options.rddl, case.problem, case.instance, *arguments)["measurements"]
    cost = json.loads(stats)[-1]["operations"]["after"]
    return Step(case.problem, case.instance, cost, 1e9 / alone["steps_per_second"])


TITLES = ("problem", "cost", "ns", "time by cost")


def parse_options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rddl", type=Path, default=ROOT / "build/bin/rddl", help="our program")
    parser.add_argument("--rddlc", type=Path, default=ROOT / "build/bin/rddlc", help="our compiler")
    parser.add_argument("--problems", type=int, default=40, metavar="N", help="how many")
    parser.add_argument("--seconds", type=float, default=0.15, help="of each measurement")
    parser.add_argument("--require", action="store_true", help=f"fail if more than a tenth are off by {MOST_OFF:g} times")
    parser.add_argument("--write", action="store_true", help="write docs/benchmarks.md")
    return parser.parse_args()


def main() -> int:
    options = parse_options()
    steps = [measure(case, options) for case in sample(options.problems)]
    unit = statistics.median(step.nanoseconds / step.cost for step in steps)
    rows = {f"{step.problem} {step.instance}": step.nanoseconds / step.cost / unit for step in steps}
    table = [TITLES]
    for step in sorted(steps, key=lambda step: step.nanoseconds / step.cost):
        name = f"{step.problem} {step.instance}"
        table.append((name, f"{step.cost:,.0f}", f"{step.nanoseconds:,.0f}", f"{rows[name]:.2f}"))
    for row in table:
        print_row(row)
    outside = sum(not 1 / MOST_OFF <= off <= MOST_OFF for off in rows.values())
    summary = f"A unit of cost takes {unit:.2f} ns; {outside} of {len(steps)} steps are off by more than {MOST_OFF:g} times."
    print(summary)
    if options.write:
        write_section("cost model", f"{machine_text()}. {summary}\n\n{markdown_table(table)}")
    return int(options.require and outside > MOST_OUTSIDE * len(steps))


if __name__ == "__main__":
    sys.exit(main())
