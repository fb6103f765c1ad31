"""CleanRL's ppo.py and ppo_continuous_action.py, with three lines changed, on problems of rddlrepository:

    python -m venv .venv-cleanrl
    .venv-cleanrl/bin/pip install -r python/tests/requirements_cleanrl.txt
    PYTHONPATH=build/python .venv-cleanrl/bin/python python/tests/cleanrl.py [CLONE]

CLONE is a clone of https://github.com/vwxyzjn/cleanrl; without one, git fetches the commit that is named below
into a temporary folder. Prints the changed lines and the last return of each, and ends with status 1 where
a line to be changed is not there, where the program fails, or where it finishes no episode.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import rddlc

REPOSITORY, COMMIT = "https://github.com/vwxyzjn/cleanrl", "fe8d8a03c41a7ef5b523e2e354bd01c363e786bb"
# Program, actions, problem, and how many steps are enough for an episode.
RUNS = [("ppo", "simplified", "rddlc/CartPole_Discrete_gym-0-v0", 2048),
        ("ppo_continuous_action", "box", "rddlc/MountainCar_Continuous_gym-0-v0", 4096)]


def changes(actions: str) -> list[tuple[str, str]]:
    """Lines, and what takes their place."""
    forms = f'observations="flat", actions="{actions}"'
    return [
        ("import gymnasium as gym\n", "import gymnasium as gym, rddlc\n"),
        ('gym.make(env_id, render_mode="rgb_array")\n', f'gym.make(env_id, render_mode="rgb_array", {forms})\n'),
        ("gym.make(env_id)\n", f"gym.make(env_id, {forms})\n"),
    ]


def changed(program: str, actions: str) -> str:
    for old, new in changes(actions):
        if program.count(old) != 1:
            raise ValueError(f"there is not one line {old!r}")
        program = program.replace(old, new)
        print("   ", new, end="")
    return program


def clone(folder: str) -> Path:
    for command in (["init", "--quiet"], ["fetch", "--quiet", "--depth=1", REPOSITORY, COMMIT],
                    ["checkout", "--quiet", "FETCH_HEAD"]):
        subprocess.run(["git", "-C", folder, *command], check=True)
    return Path(folder)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("clone", type=Path, nargs="?")
    given = parser.parse_args().clone
    packages = {"PYTHONPATH": os.path.dirname(os.path.dirname(os.path.abspath(rddlc.__file__)))}
    with tempfile.TemporaryDirectory() as fetched, tempfile.TemporaryDirectory() as folder:
        sources = (given or clone(fetched)) / "cleanrl"
        for name, actions, problem, steps in RUNS:
            print(f"{name}.py")
            file = Path(folder, f"{name}.py")
            file.write_text(changed((sources / file.name).read_text(), actions))
            command = [sys.executable, file, "--env-id", problem, "--total-timesteps", str(steps), "--no-cuda"]
            run = subprocess.run(command, cwd=folder, env=os.environ | packages, capture_output=True, text=True)
            episodes = [line for line in run.stdout.splitlines() if "episodic_return" in line]
            if run.returncode != 0 or not episodes:
                print(run.stdout[-2000:], run.stderr[-4000:], "FAILED", sep="\n")
                return 1
            print(f"{problem}: {len(episodes)} episodes, the last: {episodes[-1]}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
