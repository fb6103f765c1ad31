"""The evidence for each pass: how often it changes something, and what it is worth in measured time.

    .venv/bin/python benchmarks/pass_evidence.py              counts over all instances of rddlrepository, minutes
    .venv/bin/python benchmarks/pass_evidence.py --time 5     and times 5 problems of each pass with and without it
    .venv/bin/python benchmarks/pass_evidence.py --write      and docs/benchmarks.md

A pass fires where `rddlc --stats=json` says that it did something. Its worth is the time of a step without the pass
divided by the time with it, by `rddl bench`: the geometric mean over the problems that it fires on, one instance of
each, those where it fires most. Both times are measured alternately, `--rounds` times, and the least of each counts. A pass that always runs is not timed.
"""

import argparse
import json
import os
import subprocess
import sys
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path

from bench import Results, bench, geometric_mean, print_row
from document import ROOT, machine_text, markdown_table, merged_rows, write_section

sys.path.append(str(ROOT / "tests/conformance"))
from problems import Case, cases_of  # noqa: E402


@dataclass
class Firing:
    """A pass that did something to an instance. Operations are those of a step, by the cost model."""

    name: str
    problem: str
    instance: str
    times: int
    operations_before: float
    operations_after: float


@dataclass
class Worth:
    """Seconds of a step of one environment, and of an environment in a batch, with and without a pass."""

    name: str
    problem: str
    instance: str
    alone: float
    alone_without: float
    in_batch: float
    in_batch_without: float


def stats_of(rddlc: Path, case: Case, *more: str) -> list[dict]:
    command = [rddlc, case.domain_path, case.instance_path, *more]
    return json.loads(subprocess.check_output([*command, "--stats=json", "--stop-after=optimise", "-w"]))


def left_out(rddlc: Path, names: list[str]) -> set[str]:
    """Returns the passes that --without leaves out: emitted code needs the others."""
    runs = stats_of(rddlc, cases_of([])[0], f"--without={','.join(names)}")
    return set(names) - {run["pass"] for run in runs}


def firings_of(rddlc: Path, case: Case) -> tuple[list[str], list[Firing]]:
    """The names of all passes in their order, and what those did that fired. A pass that runs twice counts once."""
    runs = defaultdict(list)
    for run in stats_of(rddlc, case):
        runs[run["pass"]].append(run)
    fired = []
    for name, of_pass in runs.items():
        times = sum(sum(run["did"].values()) for run in of_pass)
        change = sum(run["operations"]["after"] - run["operations"]["before"] for run in of_pass)
        before = of_pass[0]["operations"]["before"]
        if times > 0:
            fired.append(Firing(name, case.problem, case.instance, times, before, before + change))
    return list(runs), fired


def count(options: argparse.Namespace) -> tuple[list[str], list[Firing], int]:
    cases = cases_of([])
    names: list[str] = []
    firings: list[Firing] = []
    with ThreadPoolExecutor(options.jobs) as pool:
        for names, fired in pool.map(lambda case: firings_of(options.rddlc, case), cases):
            firings += fired
    return names, firings, len(cases)


def sample(firings: list[Firing], most: int) -> list[Firing]:
    """Picks for each problem the instance where the pass fires most; then as many problems as
    wanted, evenly spread."""
    of_problem: dict[str, Firing] = {}
    for firing in firings:
        known = of_problem.get(firing.problem)
        if known is None or firing.times > known.times:
            of_problem[firing.problem] = firing
    ordered = sorted(of_problem.values(), key=lambda firing: firing.operations_before)
    chosen = min(most, len(ordered))
    return [ordered[(2 * i + 1) * len(ordered) // (2 * chosen)] for i in range(chosen)]


def times_of(firing: Firing, options: argparse.Namespace, *more: str) -> tuple[float, float]:
    arguments = ["--threads", 1, "--batch", 1024, "--seconds", options.seconds, *more]
    alone, *batches = bench(options.rddl, firing.problem, firing.instance, *arguments)["measurements"]
    fastest = max(batch["steps_per_second"] for batch in batches)
    return 1 / alone["steps_per_second"], 1 / fastest


def measure(firing: Firing, options: argparse.Namespace) -> Worth:
    with_pass, without = [], []
    for _ in range(options.rounds):
        with_pass.append(times_of(firing, options))
        without.append(times_of(firing, options, f"--without={firing.name}"))
    alone, in_batch = map(min, zip(*with_pass))
    alone_without, in_batch_without = map(min, zip(*without))
    return Worth(
        firing.name, firing.problem, firing.instance, alone, alone_without, in_batch, in_batch_without
    )


TITLES = ("pass", "instances", "problems", "costs more", "timed", "one environment", "in a batch")


def row(name: str, firings: list[Firing], worths: list[Worth]) -> tuple[str, ...]:
    problems = len({firing.problem for firing in firings})
    worse = sum(firing.operations_after > firing.operations_before for firing in firings)
    counts = (f"`{name}`", str(len(firings)), str(problems), str(worse))
    if not worths:
        return counts
    alone = geometric_mean([worth.alone_without / worth.alone for worth in worths])
    in_batch = geometric_mean([worth.in_batch_without / worth.in_batch for worth in worths])
    return (*counts, str(len(worths)), f"{alone:.2f}", f"{in_batch:.2f}")


def parse_options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rddl", type=Path, default=ROOT / "build/bin/rddl", help="our program")
    parser.add_argument("--rddlc", type=Path, default=ROOT / "build/bin/rddlc", help="our compiler")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="compilations at once, for the counts")
    parser.add_argument("--time", type=int, default=0, metavar="N", help="problems that are timed for each pass")
    parser.add_argument("--only", nargs="+", default=[], metavar="PASS", help="time these passes only")
    parser.add_argument("--seconds", type=float, default=0.3, help="of each measurement")
    parser.add_argument("--rounds", type=int, default=3, help="measurements with and without a pass")
    default = ROOT / "build/benchmarks/pass_evidence.jsonl"
    parser.add_argument("--results", type=Path, default=default, help="file for the times, which are kept")
    parser.add_argument("--fresh", action="store_true", help="measure all times again")
    parser.add_argument("--json", type=Path, help="file for what fired where")
    parser.add_argument("--write", action="store_true", help="write docs/benchmarks.md, whose other times stay")
    return parser.parse_args()


def main() -> int:
    options = parse_options()
    names, firings, instances = count(options)
    if options.json:
        options.json.write_text(json.dumps([asdict(firing) for firing in firings], indent=1) + "\n")
    of_pass = {name: [firing for firing in firings if firing.name == name] for name in names}
    results = Results(
        options.results, options.fresh, Worth, lambda one: (one.name, one.problem, one.instance)
    )
    optional = left_out(options.rddlc, names)
    print_row(TITLES)
    table = [TITLES]
    for name, fired in of_pass.items():
        timed = sample(fired, options.time) if name in optional else []
        keys = [(name, firing.problem, firing.instance) for firing in timed]
        for key, firing in zip(keys, timed):
            if key not in results.entries and (not options.only or name in options.only):
                results.add(measure(firing, options))
        # A mean of a part of the sample would say something else than the row of before.
        worths = [results.entries[key] for key in keys] if all(key in results.entries for key in keys) else []
        table.append(row(name, fired, worths))
        print_row(table[-1])
    if options.write:
        head, *rows = merged_rows("evidence", table)  # with the times of passes that were not timed
        order = [cells[0] for cells in table]
        shown = [head, *sorted((cells for cells in rows if cells[0] in order), key=lambda cells: order.index(cells[0]))]
        write_section("evidence", f"{instances} instances; {machine_text()}:\n\n{markdown_table(shown)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
