"""Steps per second of the real pyRDDLGym and of our compiled simulator, side by side.

    .venv/bin/python benchmarks/compare.py                    the problems of the conformance tests
    .venv/bin/python benchmarks/compare.py --require 100      and fail below that ratio
    .venv/bin/python benchmarks/compare.py --json out.json    the figures for other programs
    .venv/bin/python benchmarks/compare.py --write            and docs/benchmarks.md

Both sides step one environment in one thread under uniformly random actions, of which as many
entries differ from the default as max-nondef-actions allows. The actions are drawn beforehand;
resets, where an episode ends, are part of the time. The two take turns, so that whatever else the
machine does hits both; the ratio is that of the medians.
"""

import argparse
import json
import logging
import platform
import statistics
import subprocess
import sys
import time
import warnings
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

import numpy as np
import pyRDDLGym

from document import ROOT, machine_text, markdown_table, write_section

sys.path.insert(0, str(ROOT / "tests/conformance"))

from problems import CORE, Case, repository_cases, smallest_median_largest  # noqa: E402

PREPARED_ACTIONS = 64


class ReferenceRunner:
    """pyRDDLGym in its quicker, vectorised form."""

    def __init__(self, case: Case):
        warnings.simplefilter("ignore")
        logging.disable(logging.WARNING)
        np.seterr(all="ignore")
        domain, instance = str(case.domain_path), str(case.instance_path)
        self.env = pyRDDLGym.make(domain, instance, vectorized=True)
        self.shapes = {name: np.shape(v) for name, v in self.env.sampler.noop_actions.items()}
        self.defaults = self.env.sampler.noop_actions
        self.env.action_space.seed(1)
        self.random = np.random.default_rng(1)
        self.env.reset(seed=1)

        self.actions = [self._random_action() for _ in range(PREPARED_ACTIONS)]

    def steps_per_second(self, seconds: float) -> float:
        steps, begin = 0, time.perf_counter()
        while (elapsed := time.perf_counter() - begin) < seconds:
            _, _, terminated, truncated, _ = self.env.step(self.actions[steps % PREPARED_ACTIONS])
            if terminated or truncated:
                self.env.reset()
            steps += 1
        return steps / elapsed

    def _random_action(self) -> dict:
        # A parameterless real is sampled with shape (1,), which step() refuses.
        sample = self.env.action_space.sample()
        action = {name: np.reshape(value, self.shapes[name]) for name, value in sample.items()}
        return self._limited(action)

    def _limited(self, action: dict) -> dict:
        changed = [
            (name, index)
            for name, value in action.items()
            for index in zip(*np.nonzero(np.atleast_1d(value != self.defaults[name])))
        ]
        excess = len(changed) - int(self.env.max_allowed_actions)
        if excess > 0:
            action = {name: np.atleast_1d(value).copy() for name, value in action.items()}
            for place in self.random.choice(len(changed), size=excess, replace=False):
                name, index = changed[place]
                action[name][index] = np.atleast_1d(self.defaults[name])[index]
            action = {name: value.reshape(self.shapes[name]) for name, value in action.items()}
        return action


def our_steps_per_second(rddl: Path, case: Case, seconds: float) -> float:
    command = [rddl, "bench", case.domain_path, case.instance_path, "--engine=compiled", "--json"]
    command += ["--seconds", seconds, "--batch", 1, "--threads", 1]
    result = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"{case.label}: rddl bench failed: {result.stderr.strip()}")
    return json.loads(result.stdout)["measurements"][0]["steps_per_second"]


@dataclass
class Comparison:
    case: Case
    reference: list[float]  # steps per second, one a round
    ours: list[float]

    @property
    def ratio(self) -> float:
        return statistics.median(self.ours) / statistics.median(self.reference)

    def as_json(self) -> dict:
        return {
            "problem": self.case.problem,
            "instance": self.case.instance,
            "pyrddlgym_steps_per_second": self.reference,
            "rddlc_steps_per_second": self.ours,
            "ratio": self.ratio,
        }


def compare(case: Case, options: argparse.Namespace) -> Comparison:
    reference = ReferenceRunner(case)
    our_steps_per_second(options.rddl, case, 0.01)  # compiles
    comparison = Comparison(case, [], [])
    for _ in range(options.rounds):
        comparison.reference.append(reference.steps_per_second(options.seconds))
        comparison.ours.append(our_steps_per_second(options.rddl, case, options.seconds))
    return comparison


def row_text(comparison: Comparison) -> str:
    def spread(rates: list[float]) -> str:
        low, median, high = min(rates), statistics.median(rates), max(rates)
        return f"{low:>11,.0f} {median:>11,.0f} {high:>11,.0f}"

    name = comparison.case.label.ljust(30)
    return f"{name} {spread(comparison.reference)} {spread(comparison.ours)} {comparison.ratio:>8,.0f}"


def table_head() -> str:
    columns = " ".join(f"{word:>11}" for word in ("min", "median", "max"))
    width = len(columns)
    titles = f"{'steps/s':30} {'pyRDDLGym':^{width}} {'rddlc, one thread':^{width}}"
    return f"{titles}\n{'':30} {columns} {columns} {'ratio':>8}"


def markdown(comparisons: list[Comparison]) -> str:
    rows = [("instance", "pyRDDLGym", "rddlc", "ratio")]
    for comparison in comparisons:
        medians = (statistics.median(comparison.reference), statistics.median(comparison.ours))
        figures = (*medians, comparison.ratio)
        rows.append((comparison.case.label, *(f"{figure:,.0f}" for figure in figures)))
    return markdown_table(rows)


def versions_text() -> str:
    packages = ", ".join(f"{name} {version(name)}" for name in ("pyRDDLGym", "numpy"))
    return f"{machine_text()}; Python {platform.python_version()}, {packages}"


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problems", nargs="*", help="names of problems of rddlrepository")
    parser.add_argument("--all-instances", action="store_true", help="not only the median one")
    parser.add_argument("--rddl", type=Path, default=ROOT / "build/bin/rddl", help="our program")
    parser.add_argument("--seconds", type=float, default=1.0, help="of each measurement")
    parser.add_argument("--rounds", type=int, default=5, help="turns of each side")
    parser.add_argument("--require", type=float, help="fail below this ratio")
    parser.add_argument("--json", type=Path, help="write the figures to this file")
    parser.add_argument("--write", action="store_true", help="write docs/benchmarks.md")
    return parser.parse_args()


def chosen_cases(options: argparse.Namespace) -> list[Case]:
    cases = []
    for problem in options.problems or CORE:
        of_problem = repository_cases(problem)
        picked = smallest_median_largest(of_problem)
        cases += of_problem if options.all_instances else [picked[len(picked) // 2]]
    return cases


def main() -> int:
    options = parse_arguments()
    rounds = f"{options.rounds} rounds of {options.seconds:g} s"
    print(f"{versions_text()}; {rounds}\n")
    print(table_head())
    comparisons = []
    for case in chosen_cases(options):
        comparisons.append(compare(case, options))
        print(row_text(comparisons[-1]), flush=True)
    if options.json:
        figures = [comparison.as_json() for comparison in comparisons]
        options.json.write_text(json.dumps(figures, indent=2) + "\n")
    if options.write:
        write_section("comparison", f"{versions_text()}; {rounds}:\n\n{markdown(comparisons)}")
    slow = [c for c in comparisons if options.require and c.ratio < options.require]
    for comparison in slow:
        print(f"{comparison.case.label}: ratio {comparison.ratio:.0f} is below {options.require:g}")
    return 1 if slow else 0


if __name__ == "__main__":
    sys.exit(main())
