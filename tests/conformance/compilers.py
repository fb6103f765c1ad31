"""Emitted text and compilers: no warning from any, and the same bits from all.

    .venv/bin/python tests/conformance/compilers.py --examples                  those of examples/
    .venv/bin/python tests/conformance/compilers.py --repository --only-check   the smallest instance of each problem
    .venv/bin/python tests/conformance/compilers.py --repository --all          all instances: hours
    .venv/bin/python tests/conformance/compilers.py SysAdmin_MDP_ippc2011       the smallest instance of one

The text of each instance is checked with -Wall -Wextra -Werror; then it is compiled as rddl does, and plays
some episodes under random actions, whose traces are the same, byte for byte. Exit status: 0 if so; 77 if a
compiler is not there.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from problems import ROOT, Case, all_problems, cases_of, example_cases, spread_by_size

SKIPPED = 77
CHECK = ["-std=c++20", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "-DRDDL_LINKS_BATCHES"]
HEADER = "#include <rddl/simulator.hpp>\n"


@dataclass
class Programs:
    options: argparse.Namespace
    folder: Path

    def precompile(self):
        """Compiles the headers, which are most of what a check reads; this must also give no
        warning."""
        for compiler in self.options.compilers:
            folder = self.folder_of(compiler)
            folder.mkdir()
            (folder / "simulator.hpp").write_text(HEADER)
            flags = [flag for flag in CHECK if flag != "-fsyntax-only"]
            command = [*compiler.split(), *flags, f"-I{ROOT / 'runtime'}", "-x", "c++-header"]
            command += ["-o", folder / "simulator.hpp.gch", folder / "simulator.hpp"]
            if failure := failure_of(command):
                raise SystemExit(f"{compiler}: the runtime: {failure}")

    def folder_of(self, compiler: str) -> Path:
        return self.folder / f"compiler-{self.options.compilers.index(compiler)}"

    def check(self, case: Case) -> str:
        source = self.folder / f"{case.problem}-{case.instance}.cpp"
        externs = ["--extern", case.header] if case.header else []
        command = [self.options.rddlc, case.domain_path, case.instance_path, *externs, "-o", source]
        if failure := failure_of(command):
            return f"rddlc: {failure}"
        for compiler in self.options.compilers:
            include = [] if externs else ["-include", self.folder_of(compiler) / "simulator.hpp"]
            command = [*compiler.split(), *CHECK, *include, f"-I{ROOT / 'runtime'}", source]
            if failure := failure_of(command):
                return f"{compiler}: {failure}"
        source.unlink()
        return ""

    def step(self, case: Case) -> str:
        externs = ["--extern", case.header] if case.header else []
        command = [self.options.rddl, "run", case.domain_path, case.instance_path, *externs]
        command += ["--episodes", "20", "--threads", "1", "--quiet", "--trace", "-"]
        traces = []
        for compiler in self.options.compilers:
            environment = os.environ | {"CXX": compiler, "XDG_CACHE_HOME": str(self.options.cache)}
            result = subprocess.run(list(map(str, command)), capture_output=True, env=environment)
            if result.returncode != 0:
                return f"{compiler}: {result.stderr.decode()}"
            traces.append(result.stdout)
        if traces[0].count(b"\n") < 20:
            return "no steps"
        return "" if len(set(traces)) == 1 else "the traces differ"

    def judge(self, case: Case) -> tuple[Case, str]:
        failure = self.check(case)
        if not failure and not self.options.only_check:
            failure = self.step(case)
        return case, failure


def failure_of(command: list) -> str:
    """Returns the command's errors if it fails."""
    result = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    return "" if result.returncode == 0 else result.stderr[:3000] or f"status {result.returncode}"


def picked(options: argparse.Namespace) -> list[Case]:
    cases = example_cases() if options.examples else []
    for problem in options.problems + (all_problems() if options.repository else []):
        instances = cases_of([problem])
        cases += instances if options.all else spread_by_size(instances, 1)
    return cases


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("problems", nargs="*", metavar="PROBLEM")
    parser.add_argument("--examples", action="store_true")
    parser.add_argument("--repository", action="store_true")
    parser.add_argument("--all", action="store_true", help="instances of a problem")
    parser.add_argument("--only-check", action="store_true", help="compile without code, and do not step")
    parser.add_argument("--compilers", nargs="+", default=["g++", "clang++"])
    parser.add_argument("--rddlc", type=Path, default=ROOT / "build/bin/rddlc")
    parser.add_argument("--rddl", type=Path, default=ROOT / "build/bin/rddl")
    parser.add_argument("--cache", type=Path, default=ROOT / "build/compilers")
    parser.add_argument("--workers", type=int, default=1)
    options = parser.parse_args()
    missing = [compiler for compiler in options.compilers if not shutil.which(compiler.split()[0])]
    if missing:
        print(f"skipped: this machine has no {', '.join(missing)}")
        return SKIPPED
    options.cache = options.cache.resolve()
    options.cache.mkdir(parents=True, exist_ok=True)
    failures = 0
    cases = picked(options)
    with tempfile.TemporaryDirectory(prefix="compilers-") as folder:
        programs = Programs(options, Path(folder))
        programs.precompile()
        with ThreadPoolExecutor(options.workers) as workers:
            for case, failure in workers.map(programs.judge, cases):
                failures += bool(failure)
                print(f"{case.label}: {failure or 'ok'}", flush=True)
    print(f"{len(cases)} instances, {len(options.compilers)} compilers: {failures} failures")
    return 1 if failures or not cases else 0


if __name__ == "__main__":
    sys.exit(main())
