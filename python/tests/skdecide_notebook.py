"""The cells of scikit-decide's RDDL notebook, with one import changed: `rddlc.skdecide` in place of
`skdecide.hub.domain.rddl`.

    python -m venv .venv-skdecide
    .venv-skdecide/bin/pip install -r python/tests/requirements_skdecide.txt
    PYTHONPATH=build/python .venv-skdecide/bin/python python/tests/skdecide_notebook.py 16_rddl_tuto.ipynb

The notebook is notebooks/16_rddl_tuto.ipynb of https://github.com/airbus/scikit-decide, in which the
tutorial of ICAPS 2024 lives on: RayRLlib, StableBaseline and CGP on the mountain car. Cells that install
packages are left out, and so are those below the heading of pyRDDLGym's own planners, which plan by
pyRDDLGym's model. Prints a line for each cell, and ends with status 1 where one fails.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import tempfile
import time
import traceback
from pathlib import Path
from typing import Any

import rddlc

THEIRS, OURS = "skdecide.hub.domain.rddl", "rddlc.skdecide"
END = "pyRDDLGym solvers wrapped"


def cells_of(notebook: Path) -> list[str]:
    """The code up to the heading."""
    cells = []
    for cell in json.loads(notebook.read_text())["cells"]:
        text = "".join(cell["source"])
        if cell["cell_type"] != "code":
            if END in text:
                break
        elif "!pip" not in text and "! pip" not in text:
            cells.append("\n".join(line for line in text.split("\n") if not line.startswith("%")))
    return cells


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("notebook", type=Path)
    options = parser.parse_args()
    os.environ.setdefault("SDL_VIDEODRIVER", "dummy")
    os.environ["PYTHONPATH"] = str(Path(rddlc.__file__).absolute().parents[1])  # for the processes of Ray
    cells = cells_of(options.notebook.resolve())
    changed = sum(THEIRS in cell for cell in cells)
    if changed != 1:
        print(f"{changed} cells import {THEIRS}, not one")
        return 1
    names: dict[str, Any] = {"__name__": "__main__"}
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for number, cell in enumerate(cells):
            begin = time.monotonic()
            try:
                exec(cell.replace(THEIRS, OURS), names)
            except Exception:
                traceback.print_exc()
                print(f"cell {number} fails:\n{cell}")
                return 1
            first = next((line for line in cell.split("\n") if line.strip()), "")
            print(f"cell {number}: {time.monotonic() - begin:6.1f} s: {first[:70]}", flush=True)
        movies = sorted(str(each) for each in Path("rddl_movies").rglob("*.gif"))
        print(f"{len(cells)} cells run; {len(movies)} movies: {', '.join(movies)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
