"""Finds which optimisations change which problems: each is left out where it counts."""

import json
import subprocess
from dataclasses import replace
from pathlib import Path

from ours import ReplayFailure, last_lines, problem_words
from problems import Case

# Done only if asked for, so they are not left out but taken in.
FAST_MATH = ("fast_math", "prove_invariants", "straighten_rows")


def cases_without_each(rddlc: Path, cases: list[Case], most: int) -> list[Case]:
    """For each optimisation: the cases, `most` at most, in which it saves most, compiled without
    it; with all of FAST_MATH for each of these."""
    savings: dict[str, list[tuple[float, Case]]] = {}
    for case in cases:
        for name, left in operations_left(rddlc, case).items():
            savings.setdefault(name, []).append((left, case))
    return [
        replace(case, options=("--fast-math",) if name in FAST_MATH else (f"--without={name}",))
        for name, found in savings.items()
        for _, case in sorted(found, key=lambda pair: pair[0])[:most]
    ]


def operations_left(rddlc: Path, case: Case) -> dict[str, float]:
    """For each optimisation that does something: the part of the operations that it leaves."""
    command = [rddlc, *problem_words(case), "-w", "--fast-math"]
    command += ["--stats=json", "--stop-after=optimise"]
    result = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    if result.returncode != 0:
        raise ReplayFailure(f"{case.label}: {last_lines(result.stderr)}")
    left: dict[str, float] = {}
    for entry in json.loads(result.stdout):  # some run twice
        if entry["did"]:
            operations = entry["operations"]
            part = operations["after"] / max(operations["before"], 1.0)
            left[entry["pass"]] = left.get(entry["pass"], 1.0) * part
    return left
