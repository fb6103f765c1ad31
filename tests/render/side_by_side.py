#!/usr/bin/env python3
"""Sheets for visual comparison: a state as rddl draws it, and beside it as pyRDDLGym does.

    .venv/bin/python tests/render/side_by_side.py FOLDER [--rddl build/bin/rddl] [PROBLEM...]

Writes FOLDER/PROBLEM.png for each problem for which both have a visualizer of its own. Both draw the same states: those of an
episode of random actions, which rddl makes. pyRDDLGym's pictures have the size that they have there.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import warnings
from pathlib import Path

os.environ.update(SDL_VIDEODRIVER="dummy", PYGAME_HIDE_SUPPORT_PROMPT="1", MPLBACKEND="Agg")
warnings.filterwarnings("ignore")

from PIL import Image  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import gallery  # noqa: E402

STEP = 20
GAP = 10


def trace_of(problem: str, instance: str, rddl: str, folder: Path) -> list[dict]:
    """Returns the steps of an episode of random actions, which are also kept in the folder."""
    environment = {"RDDL_REPOSITORY": gallery.repository(), **os.environ}
    trace = folder / "trace.jsonl"
    subprocess.run([rddl, "run", problem, instance, "--engine=interpreter", "--quiet", f"--horizon={STEP}",
                    f"--trace={trace}"], env=environment)  # a fault ends an episode; what was before counts
    return [json.loads(line) for line in trace.read_text().splitlines()[1:]]


def our_picture(step: int, rddl: str, folder: Path) -> Image.Image:
    subprocess.run([rddl, "render", folder / "trace.jsonl", "--quiet", f"--png={folder}/ours.png",
                    f"--step={step}"], check=True)
    return Image.open(folder / "ours.png").convert("RGB")


def their_picture(problem: str, instance: str, steps: list[dict]) -> Image.Image:
    """After all states before: some draw what was."""
    import pyRDDLGym
    environment = pyRDDLGym.make(problem, instance)
    visualizer = environment._visualizer
    if hasattr(visualizer, "_wait_time"):
        visualizer._wait_time = 0
    for step in steps:
        picture = visualizer.render(step["state"])
    return picture.convert("RGB")


def sheet_of(pictures: list[Image.Image]) -> Image.Image:
    width = sum(picture.width for picture in pictures) + GAP * (len(pictures) - 1)
    sheet = Image.new("RGB", (width, max(picture.height for picture in pictures)), "black")
    left = 0
    for picture in pictures:
        sheet.paste(picture, (left, 0))
        left += picture.width + GAP
    return sheet


def problems_of_both(rddl: str) -> dict[str, str]:
    """Names and first instances."""
    from rddlrepository.core.manager import RDDLRepoManager
    manager = RDDLRepoManager()
    found = {}
    for name in sorted(manager.list_problems()):
        problem = manager.get_problem(name)
        if problem.viz and problem.viz != "None":
            found[name] = problem.list_instances()[0]
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("problems", nargs="*", help="all if there is none")
    parser.add_argument("--rddl", default=str(ROOT / "build/bin/rddl"))
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    for problem, instance in problems_of_both(arguments.rddl).items():
        if arguments.problems and problem not in arguments.problems:
            continue
        with tempfile.TemporaryDirectory() as folder:
            steps = trace_of(problem, instance, arguments.rddl, Path(folder))
            ours = our_picture(steps[-1]["step"], arguments.rddl, Path(folder))
        sheet_of([ours, their_picture(problem, instance, steps)]).save(arguments.folder / f"{problem}.png")
        print(f"{problem} {instance}, step {steps[-1]['step']}", flush=True)


if __name__ == "__main__":
    main()
