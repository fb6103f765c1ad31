"""Writes skdecide_programs.json: random programs of scikit-decide's CGP, and what they answer.

    pip install scikit-decide gymnasium==1.2.2 joblib && python record_skdecide_programs.py

The test Skdecide.AnswersAsScikitDecideDoes reads the same programs and asks them the same. Most have one row; some have
several, where mutations let nodes read others of their own row and behind them. Of 1,000 programs some are kept: those
that show anything which the others do not (traits_of), in 60 kB.
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
MOST_BYTES = 55_000  # of the programs that are kept
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


def traits_of(program):
    """The traits that a test of this program covers: which functions read what (an input, a node
    before, itself or one behind), at which edges of [-1, 1], in which shape of program, and
    whether its answers change."""
    inputs, outputs, columns, rows = map(int, program["lines"][0].split())
    genes = list(map(int, program["lines"][1].split()))
    nodes = [genes[3 * n:3 * n + 3] for n in range(columns * rows)]
    waiting, seen = genes[3 * len(nodes):], set()
    traits = {("outputs", outputs, rows, min(waiting) < inputs), ("moves", program["outputs"][0] != program["outputs"][-1])}
    while waiting:
        address = waiting.pop()
        if address < inputs or address in seen:
            continue
        seen.add(address)
        function, *arguments = nodes[address - inputs]
        for place, argument in enumerate(arguments):
            kind = "input" if argument < inputs else "before" if argument < address else "behind"
            traits.add((function, place, kind))
            if argument < inputs:
                traits |= {(function, place, row[argument]) for row in program["inputs"]
                           if row[argument] in (-1.0, 0.0, 1.0)}
        traits |= {("edge", edge) for row in program["outputs"] for edge in row if edge in (-1.0, 0.0, 1.0)}
        waiting += arguments
    return traits


def representative(programs):
    """The first, and then those that add the most traits for their bytes; the file has the order of `programs`."""
    size = {id(p): len(json.dumps(p, separators=(",", ":"))) for p in programs}
    traits = {id(p): traits_of(p) for p in programs}
    kept, covered, left = [programs[0]], set(traits[id(programs[0])]), list(programs[1:])
    while left:
        best = max(left, key=lambda p: (len(traits[id(p)] - covered) / size[id(p)], -size[id(p)]))
        if not traits[id(best)] - covered:
            break
        left.remove(best)
        kept.append(best)
        covered |= traits[id(best)]
    for program in left:  # and as many others as there is room for
        if sum(size[id(p)] for p in kept) + size[id(program)] < MOST_BYTES:
            kept.append(program)
    chosen = {id(p) for p in kept}
    return [p for p in programs if id(p) in chosen]


def mappings():
    """Mappings of observations by spaces with and without bounds, and of outputs by spaces of
    actions."""
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
    recording = {"example": example, "functions": [f.name for f in library], "programs": representative(programs),
                 "inputs": inputs, "outputs": outputs}
    Path(__file__).with_name("skdecide_programs.json").write_text(json.dumps(recording, separators=(",", ":")) + "\n")
