"""Random problems, the same in every engine: docs/fuzzing.md says what is compared.

    .venv/bin/python tests/fuzz/fuzz_models.py --models 120               a fixed set of problems
    .venv/bin/python tests/fuzz/fuzz_models.py --hours 8 --first 1000000  until the time is over
    .venv/bin/python tests/fuzz/fuzz_models.py --first 1234 --models 1    one of them again

What differs is reduced and written to --failures, as a folder for tests/cases. Exit status: 0 if
nothing differs, else 1.
"""

import argparse
import itertools
import multiprocessing
import os
import shutil
import sys
import tempfile
import time
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from differential import ROOT, Programs, Verdict, compare, compare_with_reference, write
from generate import generate
from rddl_problem import Problem
from reduce import reduce

STOCHASTIC_SHARE = 4  # one of so many problems draws; it is not compared with pyRDDLGym
BATCH = 200


@dataclass(frozen=True)
class Task:
    seed: int
    options: argparse.Namespace

    def is_stochastic(self) -> bool:
        return self.seed % STOCHASTIC_SHARE == STOCHASTIC_SHARE - 1

    def engines(self) -> list[str]:
        """In turn: every problem takes the interpreter, few the C++ compiler."""
        every = self.options.compiled_every
        compiled = every > 0 and (self.seed + self.seed // every) % every == 0
        return ["interpreter", "compiled"] if compiled else ["interpreter"]


def judge(task: Task, problem: Problem, folder: Path, engines: list[str]) -> Verdict:
    options = task.options
    programs = Programs(options.rddl, options.exercise)
    verdict = compare(problem, folder, programs, engines)
    if verdict.kind or task.is_stochastic():
        return verdict
    engine = engines[-1]
    found = compare_with_reference(problem, folder, programs, engine, task.seed, options.steps)
    found.steps += verdict.steps
    return found


def run(task: Task) -> tuple[int, Verdict]:
    problem = generate(task.seed, task.is_stochastic())
    with tempfile.TemporaryDirectory(prefix="fuzz-") as folder:
        verdict = judge(task, problem, Path(folder), task.engines())
        if verdict.kind and task.options.reduce_seconds > 0:
            problem, verdict = reduced(task, problem, verdict, Path(folder))
    if verdict.kind:
        keep(task, problem, verdict)
    return task.seed, verdict


def reduced(task: Task, problem: Problem, verdict: Verdict, folder: Path):
    engines = task.engines() if verdict.kind in ("bit for bit", "compiled fails") else ["interpreter"]

    def fails(smaller: Problem) -> bool:
        return judge(task, smaller, folder, engines).kind == verdict.kind

    smaller = reduce(problem, fails, task.options.reduce_seconds)
    again = judge(task, smaller, folder, task.engines())
    return (smaller, again) if again.kind == verdict.kind else (problem, verdict)


def keep(task: Task, problem: Problem, verdict: Verdict) -> None:
    folder = task.options.failures / f"fuzz-{task.seed}"
    write(problem, folder)
    (folder / "difference.txt").write_text(f"{verdict.kind}\n{verdict.text}\n")


def verdicts(options: argparse.Namespace):
    """Seed and verdict of each problem. In batches, since a pool takes all tasks at once."""
    end = time.monotonic() + 3600 * options.hours
    seeds = itertools.count(options.first) if options.hours > 0 else iter(
        range(options.first, options.first + options.models)
    )
    with multiprocessing.get_context("spawn").Pool(options.workers) as pool:
        while options.hours <= 0 or time.monotonic() < end:
            batch = [Task(seed, options) for seed in itertools.islice(seeds, BATCH)]
            if not batch:
                return
            yield from pool.imap_unordered(run, batch)


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--first", type=int, default=0, help="seed of the first problem")
    parser.add_argument("--models", type=int, default=120, help="how many problems")
    parser.add_argument("--hours", type=float, default=0, help="instead of --models")
    parser.add_argument("--steps", type=int, default=40, help="compared with pyRDDLGym, a problem")
    parser.add_argument(
        "--compiled-every", type=int, default=12, help="problems for one that is compiled; 0: none"
    )
    parser.add_argument("--rddl", type=Path, default=ROOT / "build/bin/rddl", help="our program")
    parser.add_argument("--exercise", type=Path, default=ROOT / "build/bin/fuzz_mutations")
    parser.add_argument("--failures", type=Path, default=ROOT / "build/fuzz-failures")
    parser.add_argument("--reduce-seconds", type=float, default=60, help="for each failure")
    parser.add_argument("--workers", type=int, default=os.cpu_count())
    options = parser.parse_args()
    for program in (options.rddl, options.exercise):
        if shutil.which(program) is None:
            parser.error(f"{program} is not there: build it, or give its place")
    return options


def main() -> int:
    options = parse_arguments()
    begin = time.perf_counter()
    totals, refusals, failed = Counter(), Counter(), 0
    for seed, verdict in verdicts(options):
        totals.update(problems=1, steps=verdict.steps, values=verdict.values)
        totals.update(refused=verdict.refused_steps)
        if verdict.refused:
            refusals[verdict.refused[:100]] += 1
        if verdict.kind:
            failed += 1
            print(f"seed {seed}: {verdict.kind}: {verdict.text[:1000]}", flush=True)
    print(
        f"{totals['problems']} problems, {totals['steps']} steps, {totals['values']} values equal to"
        f" pyRDDLGym's, which refused {totals['refused']} steps and {refusals.total()} problems;"
        f" {failed} problems differ; {time.perf_counter() - begin:.0f} s"
    )
    for reason, count in refusals.most_common(10):
        print(f"    {count} x {reason}")
    if failed:
        print(f"see {options.failures}")
    return 1 if failed or not totals["values"] else 0


if __name__ == "__main__":
    sys.exit(main())
