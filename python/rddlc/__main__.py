"""`python -m rddlc` is the program `rddl`."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

from rddlc_programs import become


def main() -> None:
    beside = Path(__file__).parent / "bin" / "rddl"
    program = str(beside) if beside.exists() else shutil.which("rddl")
    if program is None:
        sys.exit(f"there is no program rddl at {beside}, nor in the folders of PATH")
    become(program, "rddl")


main()
