"""The cost of compiling the problems of rddlrepository: to C++, and on to a shared object.

    .venv/bin/python benchmarks/compile_cost.py                     all 586 instances; half an hour
    .venv/bin/python benchmarks/compile_cost.py --instances-each 2  the smallest and the largest of each problem
    .venv/bin/python benchmarks/compile_cost.py RecSim_ippc2023     some problems
    .venv/bin/python benchmarks/compile_cost.py --no-build          only to C++
    .venv/bin/python benchmarks/compile_cost.py --require           and fail above the limits

A shared object is made in two ways: by `rddlc -o sim.so`, for the processor of this machine, and by
the C++ compiler at -O2, for any x86-64 processor, as someone does who adds sim.cpp to a program. The
code of batches, the same for all problems, is compiled once, before, and linked.

Limits: rddlc to C++ within 1 s and 500 MB on each instance; each way to a shared object within 10 s
on each and within 3 s in the median. All are single-threaded, so what counts is their processor
time, user and system. On a machine whose processors share cores, --workers tells how many are busy:
two threads of one core take a third more time each.
"""

import argparse
import json
import multiprocessing
import os
import re
import statistics
import subprocess
import sys
import tempfile
from dataclasses import asdict, dataclass
from pathlib import Path

from document import ROOT, machine_text, markdown_table, write_section

sys.path.append(str(ROOT / "tests/conformance"))

from problems import Case, all_problems, repository_cases, spread_by_size  # noqa: E402

COMPILE_SECONDS, COMPILE_MEGABYTES = 1.0, 500.0
BUILD_SECONDS, MEDIAN_BUILD_SECONDS = 10.0, 3.0
CXX_FLAGS = ["-std=c++20", "-O2", "-ffp-contract=off", "-fPIC", f"-I{ROOT / 'runtime'}"]


@dataclass
class Cost:
    """The cost of one instance."""

    problem: str
    instance: str
    compile_seconds: float
    compile_megabytes: float  # largest resident size of rddlc
    lines: int  # of the emitted file
    code_lines: int  # without what stands in the initialisers of tables and lists of objects
    # The two ways to a shared object are not measured with --no-build.
    object_seconds: float | None = None  # rddlc -o sim.so
    build_seconds: float | None = None  # the C++ compiler, from sim.cpp

    @property
    def label(self) -> str:
        return f"{self.problem} {self.instance}"


def run_measured(command: list[str]) -> tuple[float, float]:
    """Processor seconds and the largest resident size in MB; RuntimeError if it fails."""
    with tempfile.TemporaryFile() as messages:
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=messages)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            messages.seek(0)
            text = messages.read().decode(errors="replace")
            raise RuntimeError(f"{' '.join(command)}\n{text}")
    # The C++ compiler's work is done by children that it has waited for, and so counts.
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def code_line_count(text: str) -> int:
    """Lines of the emitted text, not counting those within initialisers in braces."""
    return re.sub(r"= \{.*?\};", "", text, flags=re.DOTALL).count("\n")


def cost_of(task: tuple[Case, argparse.Namespace]) -> Cost:
    with tempfile.TemporaryDirectory() as folder:
        return cost_in(Path(folder), *task)


def cost_in(folder: Path, case: Case, options: argparse.Namespace) -> Cost:
    emitted, library = folder / "sim.cpp", folder / "sim.so"
    files = [str(case.domain_path), str(case.instance_path)]
    seconds, megabytes = run_measured([str(options.rddlc), *files, "-o", str(emitted)])
    text = emitted.read_text()
    cost = Cost(case.problem, case.instance, seconds, megabytes, text.count("\n"), code_line_count(text))
    if options.build:
        cost.object_seconds, _ = run_measured([str(options.rddlc), *files, "-o", str(library)])
        links = ["-shared", "-DRDDL_LINKS_BATCHES", str(options.batches)]
        command = [options.cxx, *CXX_FLAGS, *links, str(emitted), "-o", str(library)]
        cost.build_seconds, _ = run_measured(command)
    return cost


def build_batches(case: Case, options: argparse.Namespace) -> None:
    """Compiles what all problems share, for both ways."""
    source = ROOT / "runtime/rddl/batches.cpp"
    seconds, _ = run_measured([options.cxx, *CXX_FLAGS, "-c", str(source), "-o", str(options.batches)])
    print(f"code of batches, once: {seconds:.2f} s")
    first = cost_of((case, options))
    print(f"rddlc -o sim.so the first time, with that code and prepared headers: {first.object_seconds:.2f} s")


def row_text(cost: Cost) -> str:
    sizes = f"{cost.compile_megabytes:>7.0f} {cost.lines:>8} {cost.code_lines:>8}"
    builds = ["-" if each is None else f"{each:.2f}" for each in (cost.object_seconds, cost.build_seconds)]
    return f"{cost.label:38} {cost.compile_seconds:>8.3f} {sizes} {builds[0]:>8} {builds[1]:>8}"


def distribution(name: str, costs: list[Cost], value) -> tuple[str, ...]:
    """Median, 95 of 100, and the largest with its instance."""
    ordered = sorted(costs, key=value)
    values = [value(cost) for cost in ordered]
    return (
        name,
        f"{statistics.median(values):.2f}",
        f"{values[int(0.95 * (len(values) - 1))]:.2f}",
        f"{values[-1]:.2f}",
        ordered[-1].label,
    )


def summary_rows(costs: list[Cost]) -> list[tuple[str, ...]]:
    rows = [("", "median", "95 %", "largest", "of")]
    rows.append(distribution("rddlc -o sim.cpp, seconds", costs, lambda cost: cost.compile_seconds))
    rows.append(distribution("rddlc -o sim.cpp, MB", costs, lambda cost: cost.compile_megabytes))
    rows.append(distribution("emitted lines without tables", costs, lambda cost: cost.code_lines))
    built = [cost for cost in costs if cost.build_seconds is not None]
    if built:
        rows.append(distribution("rddlc -o sim.so, seconds", built, lambda cost: cost.object_seconds))
        rows.append(distribution("C++ compiler at -O2, seconds", built, lambda cost: cost.build_seconds))
    return rows


def excesses(costs: list[Cost]) -> list[str]:
    """Returns the costs over their limit, a line each."""
    lines = []
    for cost in costs:
        if cost.compile_seconds > COMPILE_SECONDS:
            lines.append(f"{cost.label}: rddlc took {cost.compile_seconds:.2f} s")
        if cost.compile_megabytes > COMPILE_MEGABYTES:
            lines.append(f"{cost.label}: rddlc took {cost.compile_megabytes:.0f} MB")
    built = [cost for cost in costs if cost.build_seconds is not None]
    for name, value in (
        ("rddlc -o sim.so", lambda cost: cost.object_seconds),
        ("the C++ compiler", lambda cost: cost.build_seconds),
    ):
        lines += [f"{cost.label}: {name} took {value(cost):.1f} s" for cost in built if value(cost) > BUILD_SECONDS]
        if built and (median := statistics.median(map(value, built))) > MEDIAN_BUILD_SECONDS:
            lines.append(f"{name} took {median:.2f} s in the median")
    return lines


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problems", nargs="*", help="names of problems of rddlrepository")
    parser.add_argument("--instances-each", type=int, help="of a problem, spread by size (all)")
    parser.add_argument("--rddlc", type=Path, default=ROOT / "build/bin/rddlc", help="our compiler")
    parser.add_argument("--cxx", default=os.environ.get("CXX", "c++"), help="the C++ compiler")
    parser.add_argument("--workers", type=int, default=os.cpu_count())
    parser.add_argument("--no-build", dest="build", action="store_false", help="run only rddlc")
    parser.add_argument("--require", action="store_true", help="fail above the limits")
    parser.add_argument("--json", type=Path, help="write the figures to this file")
    parser.add_argument("--write", action="store_true", help="write docs/benchmarks.md")
    return parser.parse_args()


def main() -> int:
    options = parse_arguments()
    by_problem = map(repository_cases, options.problems or all_problems())
    cases = [case for cases in by_problem for case in spread_by_size(cases, options.instances_each)]
    print(f"{'':38} {'rddlc s':>8} {'MB':>7} {'lines':>8} {'code':>8} {'.so s':>8} {'C++ s':>8}")
    costs = []
    processes = multiprocessing.get_context("spawn")
    with tempfile.TemporaryDirectory() as folder:
        os.environ["XDG_CACHE_HOME"] = folder  # for what rddlc prepares
        options.batches = Path(folder) / "batches.o"
        if options.build:
            build_batches(cases[0], options)
        with processes.Pool(options.workers) as pool:
            for cost in pool.imap(cost_of, [(case, options) for case in cases]):
                costs.append(cost)
                print(row_text(cost), flush=True)
    table = markdown_table(summary_rows(costs))
    over = excesses(costs)
    verdict = f"{len(costs)} instances, {len(over)} over a limit"
    print(f"\n{table}\n\n{verdict}", *over, sep="\n")
    if options.json:
        options.json.write_text(json.dumps([asdict(cost) for cost in costs], indent=2) + "\n")
    if options.write:
        write_section("compile cost", f"{machine_text()}; {verdict}:\n\n{table}")
    return 1 if options.require and over else 0


if __name__ == "__main__":
    sys.exit(main())
