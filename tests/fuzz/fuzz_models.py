"""Random problems, the same in every engine and before and after every pass: docs/fuzzing.md.

    .venv/bin/python tests/fuzz/fuzz_models.py passes --models 100000 --state build/fuzz-state
        every pass held to its contract, by the plain interpreter; continues where it was stopped
    .venv/bin/python tests/fuzz/fuzz_models.py compiled --models 3000
        compiled simulators, single and in packs, against the interpreter
    .venv/bin/python tests/fuzz/fuzz_models.py reference --models 5000
        against pyRDDLGym
    .venv/bin/python tests/fuzz/fuzz_models.py sample
        a little of each, with new seeds: what every test run does
    .venv/bin/python tests/fuzz/fuzz_models.py passes --first 1234 --models 1
        one of them again
    .venv/bin/python tests/fuzz/fuzz_models.py passes --generator domains --models 20000
        whole little domains (domains/) instead of random expressions; in each mode

What differs is reduced and written to --failures, as a folder for tests/cases. Exit status: 0 if
nothing differs, else 1.
"""

import argparse
import json
import multiprocessing
import random
import shutil
import signal
import sys
import tempfile
import time
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

from differential import ROOT, compare_with_reference
from generate import GENERATORS
from passes_check import Finding, PassChecker
from rddl_problem import Problem
from reduce import reduce

FLAVOURS = ("plain", "random", "wild", "finite", "wild")  # by seed
ONE_IN = 5  # problems that pass through all stages, printing and emitting included
BATCHES = {"passes": 100, "compiled": 12, "reference": 10}
OUTCOMES = "accepted", "too large", "contradictory", "rejected", "crashed"
KEPT = 3  # failures of one kind that are reduced


@dataclass(frozen=True)
class Task:
    mode: str
    seeds: range
    options: argparse.Namespace
    known: tuple[str, ...]  # kinds of which there are enough


@dataclass
class Result:
    counts: Counter = field(default_factory=Counter)
    failures: list[dict] = field(default_factory=list)

    def add(self, other: "Result") -> None:
        self.counts += other.counts
        self.failures += other.failures


def problem_of(mode: str, seed: int, generator: str) -> Problem:
    flavour = "plain" if mode == "reference" else FLAVOURS[seed % len(FLAVOURS)]
    return GENERATORS[generator](seed, flavour)


# ------------------------------------------------------------------------------------- workers


def check_passes(task: Task, result: Result) -> None:
    checker = PassChecker(task.options.passes, tuple(task.options.without))
    for seed in task.seeds:
        problem = problem_of(task.mode, seed, task.options.generator)
        answer = checker.check(problem, seed, seed % ONE_IN == 0)
        result.counts.update([answer.outcome, f"flavour {problem.flavour}"])
        result.counts.update(f"changed {name}" for name in answer.changed)
        for finding in answer.findings:

            def fails(smaller: Problem) -> bool:
                kinds = [f.kind for f in checker.check(smaller, seed, True).findings]
                return finding.kind in kinds  # noqa: B023

            keep(task, result, seed, problem, finding, fails)
    checker.close()


def check_reference(task: Task, result: Result) -> None:
    def look(problem: Problem):
        with tempfile.TemporaryDirectory(prefix="fuzz-") as folder:
            return compare_with_reference(problem, Path(folder), task.options.rddl, seed, task.options.steps)

    for seed in task.seeds:
        problem = problem_of(task.mode, seed, task.options.generator)
        verdict = look(problem)
        result.counts.update(accepted=1, steps=verdict.steps, values=verdict.values, refused=verdict.refused_steps)
        if verdict.refused:
            result.counts[f"refused: {verdict.refused[:80]}"] += 1
        if verdict.kind:
            finding = Finding(verdict.kind, verdict.text)
            keep(task, result, seed, problem, finding, lambda p: look(p).kind == finding.kind)  # noqa: B023


def check_compiled(task: Task, result: Result) -> None:
    from compiled_check import CompiledChecker

    checker = CompiledChecker(task.options, task.seeds[0])
    problems = {seed: problem_of(task.mode, seed, task.options.generator) for seed in task.seeds}
    for seed, finding in checker.check(problems, result.counts).items():
        one = CompiledChecker(task.options, task.seeds[0])
        fails = lambda p: finding.kind in [f.kind for f in one.check({seed: p}, Counter()).values()]  # noqa: B023, E731
        keep(task, result, seed, problems[seed], finding, fails)


CHECKS = {"passes": check_passes, "compiled": check_compiled, "reference": check_reference}


def keep(task: Task, result: Result, seed: int, problem: Problem, finding: Finding, fails) -> None:
    """Reduced, unless there are enough of the kind."""
    enough = (*task.known, *(f["kind"] for f in result.failures)).count(finding.kind) >= KEPT
    if not enough and task.options.reduce_seconds > 0 and finding.kind != "rejected":
        problem = reduce(problem, fails, task.options.reduce_seconds)
    result.failures.append({"seed": seed, "flavour": problem.flavour, "kind": finding.kind, "text": finding.text})
    if enough:
        return
    kind = finding.kind.split(":")[0].replace(" ", "-")
    folder = task.options.failures / f"{task.mode}-{task.options.generator}-{kind}-{seed}"
    write(problem, folder)
    (folder / "difference.txt").write_text(f"seed {seed} ({problem.flavour})\n{finding.kind}\n{finding.text}\n")


def write(problem: Problem, folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "domain.rddl").write_text(problem.domain_text())
    (folder / "instance.rddl").write_text(problem.instance_text() + problem.policy_text())


def work(task: Task) -> Result:
    result = Result()
    CHECKS[task.mode](task, result)
    return result


# --------------------------------------------------------------------------------------- a run


class Run:
    """Counts, failures and the next seed; kept in a file, so that a run can be interrupted."""

    def __init__(self, mode: str, options: argparse.Namespace):
        self.mode, self.options = mode, options
        self.result = Result()
        self.next = self.first = options.first
        self.seconds = 0.0
        self.file = options.state / f"{mode}-{options.generator}.json" if options.state else None
        if self.file and self.file.exists():
            saved = json.loads(self.file.read_text())
            self.first, self.next, self.seconds = saved["first"], saved["next"], saved["seconds"]
            self.result = Result(Counter(saved["counts"]), saved["failures"])

    def save(self) -> None:
        if not self.file:
            return
        self.file.parent.mkdir(parents=True, exist_ok=True)
        saved = {"first": self.first, "next": self.next, "seconds": self.seconds}
        saved |= {"counts": self.result.counts, "failures": self.result.failures}
        fresh = self.file.with_suffix(".new")
        fresh.write_text(json.dumps(saved, indent=1))
        fresh.rename(self.file)

    def tasks(self):
        end = self.first + self.options.models
        while self.next < end:
            yield self.tasks_of_round(end)

    def tasks_of_round(self, end: int) -> list[Task]:
        size = BATCHES[self.mode]
        known = tuple(f["kind"] for f in self.result.failures)
        starts = range(self.next, min(end, self.next + 2 * size * self.options.workers), size)
        return [Task(self.mode, range(start, min(start + size, end)), self.options, known) for start in starts]

    def run(self, pool) -> None:
        for tasks in self.tasks():
            begin = time.perf_counter()
            for task, result in zip(tasks, pool.imap(work, tasks)):
                self.result.add(result)
                self.next = task.seeds[-1] + 1
                for failure in result.failures:
                    text = failure["text"][:300].replace("\n", " ")
                    print(f"seed {failure['seed']} ({failure['flavour']}): {failure['kind']}: {text}", flush=True)
            self.seconds += time.perf_counter() - begin
            self.save()

    def summary(self) -> str:
        counts, models = self.result.counts, self.next - self.first
        text = f"{self.mode}, {self.options.generator}: {models} models, seeds {self.first} to {self.next - 1}, {self.seconds:.0f} s; "
        if self.mode == "reference":
            text += f"{counts['steps']} steps, {counts['values']} values, {counts['refused']} steps refused; "
        else:
            text += ", ".join(f"{counts[o]} {o}" for o in OUTCOMES if counts[o]) + "; "
        return text + f"{len(self.result.failures)} differ" + self.table()

    def table(self) -> str:
        """How many models of a hundred each pass changed."""
        changed = {k.removeprefix("changed "): n for k, n in self.result.counts.items() if k.startswith("changed ")}
        if not changed:
            return ""
        models = sum(n for k, n in self.result.counts.items() if k.startswith("flavour "))
        rows = [f"\n    {name:28}{100 * n / models:6.2f} %" for name, n in sorted(changed.items(), key=lambda x: -x[1])]
        return "\n  models that a pass changed:" + "".join(rows)


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("mode", choices=[*CHECKS, "sample"])
    parser.add_argument("--generator", choices=GENERATORS, default="expressions", help="(sample: both)")
    parser.add_argument("--first", type=int, help="seed of the first problem (sample: a new one, which is printed)")
    parser.add_argument("--models", type=int, default=1000, help="how many problems")
    parser.add_argument("--state", type=Path, help="folder in which a run is kept, and from which it goes on")
    parser.add_argument("--steps", type=int, default=40, help="compared with pyRDDLGym, a problem")
    parser.add_argument("--without", action="append", default=[], help="leave out a pass")
    parser.add_argument("--bin", type=Path, default=ROOT / "build/bin", help="where our programs are")
    parser.add_argument("--failures", type=Path, default=ROOT / "build/fuzz-failures")
    parser.add_argument("--reduce-seconds", type=float, default=60, help="for each failure")
    parser.add_argument("--workers", type=int, default=2)
    options = parser.parse_args()
    options.rddl, options.rddlc = options.bin / "rddl", options.bin / "rddlc"
    options.passes, options.engines = options.bin / "fuzz_passes", options.bin / "fuzz_engines"
    for program in (options.rddl, options.passes):
        if shutil.which(program) is None:
            parser.error(f"{program} is not there: build it, or give its place by --bin")
    if options.mode in ("compiled", "sample") and shutil.which(options.engines) is None:
        parser.error(f"{options.engines} is not there: build it with -DRDDLC_ALL_TESTS=ON")
    if options.first is None:
        options.first = random.SystemRandom().randrange(10**9) * 1000 if options.mode == "sample" else 0
    return options


SAMPLE = {"passes": 600, "compiled": 12, "reference": 20}  # of each generator


def runs_of(options: argparse.Namespace) -> list[Run]:
    if options.mode != "sample":
        return [Run(options.mode, options)]
    print(f"seed {options.first}", flush=True)
    return [
        Run(mode, argparse.Namespace(**{**vars(options), "generator": generator, "models": models, "state": None}))
        for mode, models in SAMPLE.items()
        for generator in GENERATORS
    ]


def main() -> int:
    options = parse_arguments()
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    failures = 0
    with multiprocessing.get_context("spawn").Pool(options.workers) as pool:
        for run in runs_of(options):
            try:
                run.run(pool)
            finally:
                print(run.summary(), flush=True)
            failures += len(run.result.failures)
    if failures:
        print(f"see {options.failures}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
