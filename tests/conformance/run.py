"""Compares our simulators with the real pyRDDLGym, instance by instance.

    .venv/bin/python tests/conformance/run.py                          the problems of every test run
    .venv/bin/python tests/conformance/run.py --all                    all of rddlrepository
    .venv/bin/python tests/conformance/run.py Wildfire_MDP_ippc2014    some problems
    .venv/bin/python tests/conformance/run.py --write                  and docs/results/conformance.md
    .venv/bin/python tests/conformance/run.py --all --without-each     with each optimisation left out

docs/conformance.md says what is compared and how. Exit status: 0 if all agree, else 1.
"""

import argparse
import multiprocessing
import os
import sys
import time
from dataclasses import dataclass, field, replace
from pathlib import Path

from compare import Findings, compare_draws, compare_transitions, describe_start, judge_draws
from ours import Replayed, ReplayFailure, faults, replay, trace
from model import DrawPoint
from passes import cases_without_each
from problems import CORE, ROOT, Case, all_problems, example_cases, probe_cases
from problems import repository_cases, spread_by_size
from recordings import recording_of, refusals_of
from reference import Plan, Recording
from refusals import RefusalPlan, Refusals
from report import failure_text, row_text, table_head, write_document

FALSE_ALARM_RATE = 1e-6  # of the whole run
ENGINES = ("interpreter", "compiled")
TRACED_EPISODES = 3


@dataclass
class Report:
    """One instance: what every engine gave, and what went wrong."""

    case: Case
    transitions: int = 0
    draw_points: int = 0
    draws: int = 0  # at each point
    refusals: int = 0  # states and actions at which the reference stops with an error
    findings: dict[str, Findings] = field(default_factory=dict)  # by engine
    failures: list[str] = field(default_factory=list)
    seconds: float = 0.0


def compare_case(task: tuple[Case, argparse.Namespace, float]) -> Report:
    case, options, false_alarm_rate = task
    report = Report(case)
    begin = time.perf_counter()
    try:
        compare_engines(report, options, false_alarm_rate)
    except Exception as error:  # one instance must not end the others
        report.failures.append(f"{type(error).__name__}: {error}")
    report.seconds = time.perf_counter() - begin
    return report


def compare_engines(report: Report, options, false_alarm_rate: float) -> None:
    plan = Plan(draws=options.draws, draw_points=options.draw_points, seconds=options.seconds)
    recording = recording_of(report.case, plan, options.cache)
    refusals = refusals_of(report.case, RefusalPlan(), options.cache)
    problem, walk = recording.problem, recording.walk
    points = affordable_points(report.case, options, recording)
    report.transitions = len(walk)
    report.draws = max((point.count() for point in points), default=0)
    report.draw_points = sum(point.count() == report.draws for point in points)
    report.refusals = len(refusals.refused)
    replayed: dict[str, Replayed] = {}
    for engine in options.engine:
        try:
            found = replay(options.rddl, report.case, problem, walk, points, engine)
            heedless = replay_heedless(report, options, refusals, engine)
        except ReplayFailure as failure:
            report.failures.append(f"{engine}: {failure}")
            continue
        findings = report.findings[engine] = Findings()
        compare_transitions(problem, walk, found.transitions, findings)
        if heedless:
            compare_transitions(problem, refusals.walk, heedless.transitions, findings)
        for point, draws in zip(points, found.draws):
            compare_draws(problem, point, draws, findings)
        judge_draws(findings, false_alarm_rate)
        report.failures += [f"{engine}: {text}" for text in findings.disagreements]
        replayed[engine] = found
    if len(replayed) == len(ENGINES):
        compare_bit_for_bit(report, replayed, problem.horizon, options)


def affordable_points(case: Case, options, recording: Recording) -> list[DrawPoint]:
    """The draws, or as many as the interpreter makes in ten times the reference's seconds."""
    problem, walk = recording.problem, recording.walk
    if not recording.points or "interpreter" not in options.engine:
        return recording.points
    seconds_a_step = replay(options.rddl, case, problem, walk, [], "interpreter").seconds_a_step
    left = int(10 * options.seconds / seconds_a_step)
    points = []
    for point in recording.points:
        outcomes = {name: rows[:left] for name, rows in point.outcomes.items()}
        points.append(DrawPoint(point.state, point.action, outcomes))
        left -= points[-1].count()
        if left == 0:
            break
    return points


def replay_heedless(report: Report, options, refusals: Refusals, engine: str) -> Replayed | None:
    """The steps of the walk that heeds no precondition; where it was refused, ours must fault."""
    starts = [(refused.state, refused.action) for refused in refusals.refused]
    found = faults(options.rddl, report.case, refusals.problem, starts, engine) if starts else []
    for refused, fault in zip(refusals.refused, found):
        if fault is None:
            start = describe_start(refused.state, refused.action)
            report.failures.append(f"{engine}: no fault, but pyRDDLGym: {refused.message}; {start}")
    if refusals.walk is None:
        return None
    return replay(options.rddl, report.case, refusals.problem, refusals.walk, [], engine)


def compare_bit_for_bit(
    report: Report, replayed: dict[str, Replayed], horizon: int, options
) -> None:
    """Both engines, the same seed and actions: the same text, here and over whole episodes; over the
    beginning of one where a step takes long."""
    outputs = [replayed[engine].text.decode().splitlines() for engine in ENGINES]
    affordable = options.seconds / max(found.seconds_a_step for found in replayed.values())
    episodes = TRACED_EPISODES if affordable > TRACED_EPISODES * horizon else 1
    horizon = max(1, min(horizon, int(affordable)))
    traces = [trace(options.rddl, report.case, engine, episodes, horizon) for engine in ENGINES]
    for what, (first, second) in {"replay": outputs, "run": traces}.items():
        different = [number for number, pair in enumerate(zip(first, second)) if len(set(pair)) > 1]
        if different or len(first) != len(second):
            place = f"from line {different[0] + 1}" if different else "in length"
            report.failures.append(f"interpreter and compiled differ bit for bit: {what}, {place}")


def chosen_cases(options) -> list[Case]:
    """Yields each with the options with which it is compiled."""
    if options.without_each:
        rddlc = options.rddl.with_name("rddlc")
        return cases_without_each(rddlc, named_cases(options), options.cases_each)
    words = [f"--without={name}" for name in options.without]
    words += ["--fast-math"] if options.fast_math else []
    return [replace(case, options=tuple(words)) for case in named_cases(options)]


def named_cases(options) -> list[Case]:
    if options.examples:
        return example_cases()
    if options.probes:
        return probe_cases()
    problems = options.problems or (all_problems() if options.all else CORE)
    by_problem = [repository_cases(problem) for problem in problems]
    if options.without_each:
        by_problem = [spread_by_size(cases, 1) for cases in by_problem]
    else:
        by_problem = [spread_by_size(cases, options.instances_each) for cases in by_problem]
    return [case for cases in by_problem for case in cases]


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problems", nargs="*", help="names of problems of rddlrepository")
    parser.add_argument("--all", action="store_true", help="all problems of rddlrepository")
    parser.add_argument("--examples", action="store_true", help="the problems of examples/")
    parser.add_argument("--probes", action="store_true", help="the problems of probes/ and tests/cases/meaning-*")
    parser.add_argument(
        "--instances-each", type=int, help="of a problem: 2 are the smallest and the largest, 3 also the median (all)"
    )
    parser.add_argument("--without", action="append", default=[], help="leave out an optimisation")
    parser.add_argument("--fast-math", action="store_true")
    parser.add_argument(
        "--without-each",
        action="store_true",
        help="leave out each optimisation in turn, in the smallest instances of the problems in"
        " which it saves most; and take in --fast-math",
    )
    parser.add_argument("--cases-each", type=int, default=3, help="of --without-each (3)")
    parser.add_argument("--rddl", type=Path, default=ROOT / "build/bin/rddl", help="our program")
    parser.add_argument("--engine", action="append", choices=ENGINES, help="default: both")
    parser.add_argument("--draws", type=int, default=Plan.draws, help="of each state and action")
    parser.add_argument("--draw-points", type=int, default=Plan.draw_points, help="an instance")
    parser.add_argument(
        "--seconds", type=float, default=Plan.seconds, help="of the reference, an instance"
    )
    parser.add_argument("--workers", type=int, default=os.cpu_count())
    parser.add_argument(
        "--cache", type=Path, default=ROOT / "build/conformance", help="recordings of the reference"
    )
    parser.add_argument(
        "--write", action="store_true", help="write the table into docs/results/conformance.md"
    )
    options = parser.parse_args()
    options.engine = tuple(options.engine or ENGINES)
    if options.instances_each is not None and options.instances_each < 1:
        parser.error("--instances-each is at least 1")
    if options.write and (options.without or options.fast_math or options.without_each):
        parser.error("--write tells of all optimisations together")
    if not options.rddl.exists():
        parser.error(f"{options.rddl} is not there: build it, or give its place by --rddl")
    return options


def main() -> int:
    options = parse_arguments()
    cases = chosen_cases(options)
    rate = FALSE_ALARM_RATE / (len(cases) * len(options.engine))
    begin = time.perf_counter()
    print(table_head())
    reports = []
    compiled_with: tuple[str, ...] = ()
    with multiprocessing.get_context("spawn").Pool(options.workers) as pool:
        for report in pool.imap(compare_case, [(case, options, rate) for case in cases]):
            reports.append(report)
            if report.case.options != compiled_with:
                compiled_with = report.case.options
                print(" ".join(compiled_with))
            print(row_text(report), flush=True)
            print(failure_text(report), end="", flush=True)
    failed = [report for report in reports if report.failures]
    seconds = time.perf_counter() - begin
    print(f"\n{len(cases)} instances, {len(failed)} of them disagree; {seconds:.0f} s")
    if options.write:
        write_document(reports)
    return 1 if failed or not cases else 0


if __name__ == "__main__":
    sys.exit(main())
