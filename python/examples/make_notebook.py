"""Writes mountain_car.ipynb: mountain_car.py as a notebook, without outputs.

    python python/examples/make_notebook.py
"""

from __future__ import annotations

import json
from pathlib import Path

CELLS = [
    (
        "markdown",
        "# RDDL problems in Python\n"
        "\n"
        "From the list of problems to movies of learned policies. Install the package and what the\n"
        "learners need, and start Jupyter in this folder:\n"
        "\n"
        "    pip install . -r python/examples/requirements.txt jupyterlab",
    ),
    (
        "code",
        "import rddlc\n"
        "\n"
        "problems = rddlc.problems()\n"
        "print(len(problems), 'problems')\n"
        "[problem.name for problem in problems][:10]",
    ),
    ("markdown", "## An environment\n\nIt shows itself as a picture."),
    (
        "code",
        "env = rddlc.make('MountainCar_ippc2023', 1, render_mode='rgb_array')\n"
        "env.reset(seed=7)\n"
        "env",
    ),
    ("code", "env.observation_space, env.action_space, env.horizon"),
    ("markdown", "## A formula\n\nCartesian genetic programming finds one that drives the car."),
    ("code", "cgp = rddlc.CGP(env, seed=7).learn(25)\ncgp"),
    ("code", "print(cgp.evaluate(episodes=10, seed=5))"),
    (
        "markdown",
        "## All learners\n\nThose whose package is not installed are left out. Movies go into the\n"
        "folder `mountain_car`.",
    ),
    (
        "code",
        "import time\n"
        "from pathlib import Path\n"
        "\n"
        "from learners import LEARNERS\n"
        "from mountain_car import play\n"
        "\n"
        "folder = Path('mountain_car')\n"
        "folder.mkdir(exist_ok=True)\n"
        "movies = {}\n"
        "for name, learn in LEARNERS.items():\n"
        "    begin = time.perf_counter()\n"
        "    try:\n"
        "        policy = learn(env.problem)\n"
        "    except ImportError as missing:\n"
        "        print(f'{name:24} left out: {missing}')\n"
        "        continue\n"
        "    seconds = time.perf_counter() - begin\n"
        "    movies[name] = folder / f'{name}.gif'\n"
        "    total, steps, cause = play(env, policy, movies[name])\n"
        "    print(f'{name:24} return {total:7.2f} in {steps} steps, learned in {seconds:.1f} s')",
    ),
    ("code", "from IPython.display import Image\n\nImage(filename=movies['rddlc CGP'])"),
]


def cell(number: int, kind: str, text: str) -> dict[str, object]:
    written: dict[str, object] = {
        "cell_type": kind,
        "id": f"cell-{number}",
        "metadata": {},
        "source": text.splitlines(keepends=True),
    }
    return written if kind == "markdown" else {**written, "execution_count": None, "outputs": []}


def main() -> None:
    notebook = {
        "cells": [cell(number, *each) for number, each in enumerate(CELLS)],
        "metadata": {
            "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
            "language_info": {"name": "python"},
        },
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    file = Path(__file__).with_name("mountain_car.ipynb")
    file.write_text(json.dumps(notebook, indent=1) + "\n")


if __name__ == "__main__":
    main()
