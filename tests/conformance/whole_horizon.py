"""Runs instances of rddlrepository to their horizon under legal random actions, with both engines.

    .venv/bin/python tests/conformance/whole_horizon.py                    all 586; an hour
    .venv/bin/python tests/conformance/whole_horizon.py RecSim_ippc2023    some problems

An instance passes if both engines end its episode properly (at the horizon, by a termination or by
an invariant, and not by a fault) and give the same trace byte for byte. Exit status: 0 if all pass.
"""

import argparse
import json
import multiprocessing
import os
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

from ours import ReplayFailure, trace
from problems import ROOT, Case, cases_of

ENGINES = ("compiled", "interpreter")

# Problems whose own text leads to a fault under any action. pyRDDLGym also stops there (run.py).
FAULTY = {"ComplexSysAdmin_rddlsim": "Discrete's weights must not be negative"}


@dataclass
class Episode:
    case: Case
    steps: int = 0
    causes: tuple[str, ...] = ()  # of its end
    seconds: dict[str, float] = field(default_factory=dict)  # by engine, compiling included
    failures: list[str] = field(default_factory=list)


def run_case(task: tuple[Case, Path]) -> Episode:
    case, rddl = task
    episode = Episode(case)
    traces = {}
    for engine in ENGINES:
        begin = time.perf_counter()
        try:
            traces[engine] = trace(rddl, case, engine, episodes=1)
        except ReplayFailure as failure:
            episode.failures.append(f"{engine}: {failure}")
        episode.seconds[engine] = time.perf_counter() - begin
    for engine, lines in traces.items():
        judge_end(episode, engine, lines)
    if len(traces) == len(ENGINES) and traces["compiled"] != traces["interpreter"]:
        episode.failures.append("the traces of interpreter and compiled differ")
    return episode


def judge_end(episode: Episode, engine: str, lines: list[str]) -> None:
    if not lines:
        episode.failures.append(f"{engine}: no step")
        return
    last = json.loads(lines[-1])
    episode.steps, episode.causes = len(lines), tuple(last.get("causes", ()))
    if "fault" in last:
        known = FAULTY.get(episode.case.problem)
        if known is not None and known in last["fault"]:
            return
        episode.failures.append(f"{engine}: fault after {len(lines)} steps: {last['fault']}")
    elif not episode.causes:
        episode.failures.append(f"{engine}: the episode has no end")


def row_text(episode: Episode) -> str:
    seconds = " ".join(f"{episode.seconds.get(engine, 0.0):>11.1f}" for engine in ENGINES)
    verdict = "FAILED" if episode.failures else "passed"
    causes = ", ".join(episode.causes)
    row = f"{episode.case.label:38} {episode.steps:>6} {causes:22} {seconds}  {verdict}"
    return "\n    ".join([row, *episode.failures])


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problems", nargs="*", help="names of problems of rddlrepository")
    parser.add_argument("--rddl", type=Path, default=ROOT / "build/bin/rddl", help="our program")
    parser.add_argument("--workers", type=int, default=os.cpu_count())
    return parser.parse_args()


def main() -> int:
    options = parse_arguments()
    cases = cases_of(options.problems)
    heads = " ".join(f"{engine + ' s':>11}" for engine in ENGINES)
    print(f"{'instance':38} {'steps':>6} {'end':22} {heads}  result")
    failed = 0
    with multiprocessing.get_context("spawn").Pool(options.workers) as pool:
        for episode in pool.imap(run_case, [(case, options.rddl) for case in cases]):
            print(row_text(episode), flush=True)
            failed += bool(episode.failures)
    print(f"\n{len(cases)} instances, {failed} of them failed")
    return 1 if failed or not cases else 0


if __name__ == "__main__":
    sys.exit(main())
