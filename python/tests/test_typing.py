"""mypy on the package and on a program that uses it, strictly; mypy is not among what scripts/test.sh
installs:

    pip install mypy && PYTHONPATH=build/python python python/tests/test_typing.py
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import unittest
from importlib.util import find_spec
from pathlib import Path

import rddlc

if find_spec("mypy") is None:
    raise unittest.SkipTest("mypy is not installed")

PACKAGE = Path(rddlc.__file__).parent
SETTINGS = Path(__file__).resolve().parents[2] / "pyproject.toml"

PROGRAM = """
import rddlc

env = rddlc.make("examples/mountain_car", 1, render_mode="rgb_array")
reveal_type(env)
observation, info = env.reset(seed=1)
reveal_type(env.step({})[1])
reveal_type(env.get_state())
reveal_type(env.model.fluents["position"].groundings)
envs = rddlc.make_vec("examples/mountain_car", 1, num_envs=4)
reveal_type(envs.action_masks())
reveal_type(rddlc.CGP(env).learn(3))
reveal_type(rddlc.PPO(envs).evaluate(episodes=3).returns.mean)
rddlc.make(3)
rddlc.PPO("no environment")
"""

REVEALED = [
    "RDDLEnv",
    "float",
    "State",
    "tuple[str, ...]",
    "numpy.bool",
    "CGP",
    "float",
]


def mypy(*arguments: str) -> str:
    with tempfile.TemporaryDirectory() as cache:
        found = subprocess.run(
            [sys.executable, "-m", "mypy", "--config-file", str(SETTINGS), "--cache-dir", cache, *arguments],
            capture_output=True,
            text=True,
        )
    return found.stdout + found.stderr


class Types(unittest.TestCase):
    def test_the_package_is_typed_strictly(self) -> None:
        self.assertIn("Success: no issues found", mypy(str(PACKAGE)))

    def test_programs_are_told_types_and_mistakes(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            program = Path(folder) / "program.py"
            program.write_text(PROGRAM)
            lines = mypy(str(program)).splitlines()
        notes = [line.split("Revealed type is ")[1] for line in lines if "Revealed type" in line]
        self.assertEqual(len(notes), len(REVEALED), lines)
        for note, expected in zip(notes, REVEALED):
            self.assertIn(expected, note)
        mistakes = [line for line in lines if "error:" in line]
        self.assertEqual(len(mistakes), 2, mistakes)


if __name__ == "__main__":
    unittest.main()
