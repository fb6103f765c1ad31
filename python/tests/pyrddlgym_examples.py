"""pyRDDLGym's own example scripts, as they are installed, with rddlc.backend.make in place of
pyRDDLGym.make. Prints a table, and ends with 1 unless all pass.

    PYTHONPATH=build/python SDL_VIDEODRIVER=dummy python python/tests/pyrddlgym_examples.py [FILE ...]

FILEs of a clone of its repository are also run: notebooks (they need IPython, and what they import),
and unit tests (with pytest).
"""

from __future__ import annotations

import contextlib
import io
import json
import os
import runpy
import sys
import tempfile
import time
import warnings
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any
from unittest import mock

import pyRDDLGym

from rddlc import backend

FOLDER = Path(pyRDDLGym.__file__).parent / "examples"
RUNS = [
    ("run_gym", "MountainCar_ippc2023", "1"),
    ("run_gym", "Wildfire_MDP_ippc2014", "1"),
    ("run_gym2", "MountainCar_ippc2023", "1"),
    ("run_gym2", "SysAdmin_POMDP_ippc2011", "1"),
    ("run_ground", "Wildfire_MDP_ippc2014", "1"),
    ("run_intervals", "MountainCar_ippc2023", "1", "random", "support"),
    ("run_intervals", "HVAC_ippc2023", "1", "noop", "mean"),
]


def outcome(run: Callable[[], object]) -> str:
    """ "passes", or the error."""
    made: list[pyRDDLGym.RDDLEnv] = []
    its_own = pyRDDLGym.make

    def make(*given: Any, **options: Any) -> pyRDDLGym.RDDLEnv:
        with mock.patch.object(pyRDDLGym, "make", its_own):  # which ours calls
            made.append(backend.make(*given, **options))
        return made[-1]

    printed = io.StringIO()
    try:
        with (
            mock.patch.object(pyRDDLGym, "make", make),
            contextlib.redirect_stdout(printed),
        ):
            result = run()
    except Exception as error:
        return f"{type(error).__name__}: {(str(error).splitlines() or [''])[0][:100]}"
    if not made or not all(isinstance(env.sampler, backend.RDDLSimulator) for env in made):
        return "made no environment of ours"
    return str(result or "passes")


def run_script(script: str, *arguments: str) -> None:
    with mock.patch.object(sys, "argv", [script, *arguments]):
        runpy.run_path(str(FOLDER / f"{script}.py"), run_name="__main__")


def run_notebook(file: Path) -> None:
    cells = json.loads(file.read_text())["cells"]
    code = ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]
    lines = [line for line in "\n".join(code).split("\n") if not line.startswith(("%", "pip ", "!"))]
    exec(compile("\n".join(lines), file.name, "exec"), {"__name__": "__main__"})


def run_tests(file: Path) -> str:
    import pytest

    return "passes" if pytest.main(["-q", str(file)]) == 0 else "fails"


def main() -> int:
    warnings.simplefilter("ignore")
    os.environ["MPLBACKEND"] = "Agg"
    files = [Path(each).resolve() for each in sys.argv[1:]]
    os.chdir(tempfile.mkdtemp())
    runs = [(" ".join(each), partial(run_script, *each)) for each in RUNS]
    for file in files:
        runs.append((file.stem, partial(run_notebook if file.suffix == ".ipynb" else run_tests, file)))
    failed = 0
    for name, run in runs:
        begin = time.perf_counter()
        found = outcome(run)
        failed += found != "passes"
        seconds = time.perf_counter() - begin
        print(f"{name:54} {seconds:6.1f} s  {found}", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
