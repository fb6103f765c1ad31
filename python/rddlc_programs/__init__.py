"""The programs `rddlc` and `rddl` that lie in the package `rddlc`, which is not imported: they start
at once."""

from __future__ import annotations

import os
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import NoReturn


def rddlc() -> NoReturn:
    """The compiler."""
    _become("rddlc")


def rddl() -> NoReturn:
    """Everything else: `rddl help`."""
    _become("rddl")


def _become(name: str) -> NoReturn:
    package = find_spec("rddlc")
    if package is None or package.origin is None:
        sys.exit(f"{name}: the package rddlc is not installed")
    become(str(Path(package.origin).parent / "bin" / name), name)


def become(program: str, name: str) -> NoReturn:
    """Runs it in place of this process. It looks for rddlrepository and pyRDDLGym in the virtual environment of this
    Python, whether that is activated or not."""
    if sys.prefix != sys.base_prefix:
        os.environ["VIRTUAL_ENV"] = sys.prefix
    os.execv(program, [name, *sys.argv[1:]])
