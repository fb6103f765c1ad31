"""pyRDDLGym's own example scripts, as they are installed, with rddlc.backend.make in place of
pyRDDLGym.make. Prints a table, and ends with 1 unless all pass.

    PYTHONPATH=build/python SDL_VIDEODRIVER=dummy python python/tests/pyrddlgym_examples.py
"""

from __future__ import annotations

import contextlib
import io
import os
import runpy
import sys
import tempfile
import time
import warnings
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


def outcome(script: str, *arguments: str) -> str:
    """ "passes", or the error."""
    made = []
    its_own = pyRDDLGym.make

    def make(*given: Any, **options: Any) -> pyRDDLGym.RDDLEnv:
        with mock.patch.object(pyRDDLGym, "make", its_own):  # which ours calls
            made.append(backend.make(*given, **options))
        return made[-1]

    printed = io.StringIO()
    try:
        with (
            mock.patch.object(pyRDDLGym, "make", make),
            mock.patch.object(sys, "argv", [script, *arguments]),
            contextlib.redirect_stdout(printed),
        ):
            runpy.run_path(str(FOLDER / f"{script}.py"), run_name="__main__")
    except Exception as error:
        return f"{type(error).__name__}: {str(error).splitlines()[0][:100]}"
    if len(made) != 1 or not isinstance(made[0].sampler, backend.RDDLSimulator):
        return "made no environment of ours"
    return "passes" if printed.getvalue() else "printed nothing"


def main() -> int:
    warnings.simplefilter("ignore")
    os.chdir(tempfile.mkdtemp())
    failed = 0
    for script, *arguments in RUNS:
        begin = time.perf_counter()
        found = outcome(script, *arguments)
        failed += found != "passes"
        seconds = time.perf_counter() - begin
        print(f"{script:14} {' '.join(arguments):40} {seconds:6.1f} s  {found}", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
