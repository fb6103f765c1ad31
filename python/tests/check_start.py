"""engine="auto" on every problem of rddlrepository, with an empty cache:

    python python/tests/check_start.py [--instance last] [PROBLEM ...]

A line for each problem: milliseconds from `make` to the end of the first step, the longest of the steps
around the change of engines, and how many steps were compared with the interpreter's, bit for bit. Ends
with status 1 where a bit differs, where a problem is not compiled, and where times are above their
limits: 300 ms, and 2 ms for a step that changes the engine beyond the longest of those before it. The
first time includes the reset; other work of the machine counts, so run it on an idle one, or with
--processor-time, which counts what this thread has computed.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
import time
from collections.abc import Callable

import rddlc
from start import Courses

FIRST_STEP, CHANGE = 0.3, 0.002  # seconds
STEPS_BEFORE, STEPS_AFTER = 20, 60


def first_step(name: str, instance: str, clock: Callable[[], float]) -> tuple[rddlc.Problem, float]:
    begin = clock()
    env = rddlc.make(name, instance)
    env.reset(seed=1)
    env.step({})
    return env.problem, clock() - begin


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problems", nargs="*", help="names; default: all")
    parser.add_argument("--instance", default="first", choices=("first", "last"))
    parser.add_argument("--first-step-only", action="store_true", help="compile nothing")
    parser.add_argument("--processor-time", action="store_true")
    options = parser.parse_args()
    clock = time.thread_time if options.processor_time else time.perf_counter
    failed = passed = 0
    with tempfile.TemporaryDirectory() as cache:
        os.environ["XDG_CACHE_HOME"] = cache
        for listed in rddlc.problems():
            if options.problems and listed.name not in options.problems:
                continue
            instance = listed.instances[0 if options.instance == "first" else -1]
            problem, first = first_step(listed.name, instance, clock)
            complaints = [] if first < FIRST_STEP else ["slow start"]
            line = f"{listed.name:40} {first * 1e3:7.1f} ms"
            if options.first_step_only:
                problem.simulator.stop_building()
            else:
                line += check_change(problem, complaints, clock)
            print(line, *complaints, flush=True)
            failed, passed = failed + bool(complaints), passed + (not complaints)
    print(f"{passed} passed, {failed} failed")
    return failed > 0


def check_change(problem: rddlc.Problem, complaints: list[str], clock: Callable[[], float]) -> str:
    courses = Courses(problem, rddlc.make, clock)
    try:
        courses.run(STEPS_BEFORE)
        courses.run_until_compiled()
        if not problem.is_compiled:
            complaints.append("is not compiled")
        before = courses.steps
        courses.run(STEPS_AFTER)
    except AssertionError as error:
        complaints.append(str(error)[:200])
        return ""
    change, usual = courses.seconds[before], sorted(courses.seconds[:before])[before * 9 // 10]
    if change - usual > CHANGE:
        complaints.append("slow change")
    return f" {change * 1e3:7.2f} ms {usual * 1e3:7.2f} ms {courses.steps:8} steps"


if __name__ == "__main__":
    sys.exit(main())
