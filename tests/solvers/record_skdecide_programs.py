"""Writes skdecide_programs.json: random programs of scikit-decide's CGP, and what they answer.

    pip install scikit-decide gymnasium==1.2.2 joblib && python record_skdecide_programs.py

The test Cgp.AnswersAsScikitDecideDoes reads the same programs and asks them the same. Most have one row; some have
several, where mutations let nodes read others of their own row and behind them.
"""

import json
import random
import tempfile
import warnings
from pathlib import Path

import gymnasium as gym
import numpy as np

warnings.simplefilter("ignore")
from skdecide.hub.solver.cgp.cgp import CGPWrapper, denorm, norm_and_flatten  # noqa: E402
from skdecide.hub.solver.cgp.pycgp.cgp import CGP  # noqa: E402

PROGRAMS, STEPS = 1000, 5
SIZES = [(2, 1, 60, 1), (4, 2, 30, 1), (1, 1, 8, 1), (6, 3, 8, 3)]  # inputs, outputs, columns, rows


def recorded(library):
    programs, example = [], None
    for number in range(PROGRAMS):
        sizes = SIZES[number % len(SIZES)]
        program = CGP.random(*sizes, library, 1.0)
        for _ in range(number % 5):
            program.mutate_per_gene(0.1, 0.3)
        with tempfile.NamedTemporaryFile("r") as file:
            program.save(file.name)
            text = file.read()
        example = example or text
        program = program.clone()
        inputs = [[random.choice([-1.0, 0.0, 1.0]) if random.random() < 0.2 else round(random.uniform(-1, 1), 2)
                   for _ in range(sizes[0])] for _ in range(STEPS)]
        programs.append({"lines": text.split("\n")[:2], "inputs": inputs,
                         "outputs": [[float(f"{x:.12g}") for x in program.run(row)] for row in inputs]})
    return programs, example


def mappings():
    """Of observations by spaces with and without bounds, and of outputs by spaces of actions."""
    observed = gym.spaces.Tuple([
        gym.spaces.Box(np.array([-2.5]), np.array([4.0]), dtype=np.float64), gym.spaces.Discrete(2),
        gym.spaces.Discrete(5), gym.spaces.Box(-np.inf, np.inf, (1,), np.float64),
        gym.spaces.Box(np.array([0.0]), np.array([np.inf]), dtype=np.float64)])
    inputs = []
    for x in (-7.3, -2.5, -0.4, 0.0, 0.3, 1.75, 4.0, 7.3):
        row = [x, int(x > 0), min(4, max(0, round(x))), x, x]
        inputs.append({"observed": row, "inputs": [float(v) for v in norm_and_flatten(list(row), observed)]})
    acted = gym.spaces.Tuple([gym.spaces.Box(np.array([-3.0]), np.array([5.0]), dtype=np.float64),
                              gym.spaces.Discrete(2), gym.spaces.Discrete(7)])
    outputs = []
    for x in (-1.0, -0.75, -2 / 7, -1e-9, 0.0, 1e-9, 1 / 3, 0.999999, 1.0):
        outputs.append({"output": x, "action": [float(v) for v in denorm([x, x, x], acted)]})
    return inputs, outputs


if __name__ == "__main__":
    random.seed(1)
    library = CGPWrapper._get_default_function_lib(None)
    inputs, outputs = mappings()
    programs, example = recorded(library)
    recording = {"example": example, "functions": [f.name for f in library], "programs": programs, "inputs": inputs,
                 "outputs": outputs}
    Path(__file__).with_name("skdecide_programs.json").write_text(json.dumps(recording, separators=(",", ":")) + "\n")
