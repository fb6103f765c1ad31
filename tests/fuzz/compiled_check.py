"""Compiles problems, several in one object, and compares them with the interpreter (fuzz_engines)."""

import json
import os
import shlex
import subprocess
import tempfile
from collections import Counter
from pathlib import Path

from passes_check import Finding, is_contradictory
from rddl_problem import Problem

# Each with a flag of processors that have it.
LEVELS = {
    "-march=x86-64": "sse2",
    "-march=x86-64-v3": "avx2",
    "-march=x86-64-v4": "avx512vl",
    "-march=x86-64-v4 -mavx512vbmi -mavx512vpopcntdq -mgfni": "avx512vbmi",
}
LANES = ([], ["--lanes=16"], ["--lanes=8"], ["--lanes=32"], ["--lanes=64"], ["--lanes=1"])
STEPS = 12


def levels_here() -> list[str]:
    flags = Path("/proc/cpuinfo").read_text().split()
    return [level for level, flag in LEVELS.items() if flag in flags]


class CompiledChecker:
    """Registers, of those that this processor has, and lanes by seed: together all of them. -O1 takes most of the time already, and no
    bit may depend on it."""

    def __init__(self, options, seed: int):
        self.options = options
        levels = levels_here()
        self.level = levels[seed // 12 % len(levels)]
        self.optimise = "-O0" if seed // 12 // len(levels) % 2 else "-O1"

    def check(self, problems: dict[int, Problem], counts: Counter) -> dict[int, Finding]:
        """The differences, by seed."""
        with tempfile.TemporaryDirectory(prefix="fuzz-") as name:
            folder, found, good = Path(name), {}, []
            for seed, problem in problems.items():
                text = self.emit(seed, problem, folder)
                if is_contradictory(text):
                    counts["contradictory"] += 1
                elif text:
                    found[seed] = Finding("emission fails", text)
                else:
                    good.append(seed)
            errors = self.compile(good, folder)
            if errors and len(good) == 1:
                found[good[0]] = Finding("compilation fails", errors)
            elif errors:  # find out which one
                for seed in good:
                    found |= self.check({seed: problems[seed]}, counts)
            elif good:
                found |= self.compare({seed: problems[seed] for seed in good}, folder, counts)
            return found

    def emit(self, seed: int, problem: Problem, folder: Path) -> str:
        problem.name = f"i{seed}"
        source, file = folder / f"{seed}.cpp", folder / f"{seed}.rddl"
        file.write_text(problem.text())
        command = [self.options.rddlc, file, "--std=rddlc", "-w", "-o", source, *LANES[seed % len(LANES)]]
        command += ["--fast-math"] if problem.flavour == "finite" else []
        command += [f"--without={name}" for name in self.options.without]
        result = subprocess.run(command, capture_output=True, text=True)
        return "" if result.returncode == 0 else result.stdout + result.stderr

    def compile(self, seeds: list[int], folder: Path) -> str:
        text = "".join(f'#include "{seed}.cpp"\n#undef RDDL_ENTRY\n' for seed in seeds)
        (folder / "all.cpp").write_text(text)
        root = Path(__file__).resolve().parents[2]
        command = [*shlex.split(os.environ.get("CXX", "c++")), self.optimise, *self.level.split(), "-std=c++20"]
        command += ["-shared", "-fPIC", "-ffp-contract=off", f"-I{root / 'runtime'}"]
        result = subprocess.run([*command, "-o", folder / "all.so", folder / "all.cpp"], capture_output=True, text=True)
        return "" if result.returncode == 0 else result.stderr[-3000:]

    def compare(self, problems: dict[int, Problem], folder: Path, counts: Counter) -> dict[int, Finding]:
        requests = [
            {
                "file": str(folder / f"{seed}.rddl"),
                "entry": f"rddl_simulator_fuzz_i{seed}",
                "fast_math": problem.flavour == "finite",
                "wild": problem.flavour == "wild",
                "without": self.options.without,
                "steps": STEPS,
            }
            for seed, problem in problems.items()
        ]
        text = "".join(json.dumps(request) + "\n" for request in requests)
        result = subprocess.run([self.options.engines, folder / "all.so"], input=text, capture_output=True, text=True)
        answers = [json.loads(line) for line in result.stdout.splitlines()]
        found = {}
        for seed, answer in zip(problems, answers):
            if answer.get("too_large"):
                counts["too large"] += 1
                continue
            counts["accepted"] += 1
            counts[f"{answer.get('lanes')} lanes"] += 1
            counts[f"{answer.get('instruction_set')}"] += 1
            if answer["difference"]:
                about = f"{answer.get('lanes')} lanes, {self.level}, {self.optimise}"
                found[seed] = Finding("compiled differs", f"{answer['difference']} ({about})")
        for seed in list(problems)[len(answers) :][:1]:
            found[seed] = Finding("compiled crashes", f"exit status {result.returncode}: {result.stderr[-1000:]}")
        return found
