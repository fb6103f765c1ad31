"""The programs `rddlc` and `rddl` that lie in the package."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import NoReturn


def rddlc() -> NoReturn:
    """The compiler."""
    _become("rddlc")


def rddl() -> NoReturn:
    """Everything else: `rddl help`."""
    _become("rddl")


def _become(name: str) -> NoReturn:
    program = Path(__file__).parent / "bin" / name
    os.execv(program, [name, *sys.argv[1:]])
