"""The best mean return of Wildfire_MDP_ippc2014, exactly, by dynamic programming over all states and steps.

    PYTHON benchmarks/solvers/wildfire_optimum.py [--instance 1] [--check 2000]

PYTHON is one that has numpy, rddlc and rddlrepository. A state is two bits of each cell (out of fuel, burning), so an
instance of nine cells has 2^18 of them; larger ones do not fit. The model of the problem stands below, in numpy. Before
anything is computed it is compared with the problem's RDDL: rddlc.transitions gives the exact distribution of what follows
some states and actions, and all probabilities and rewards must be the same.
"""

import argparse
import re
import sys
from pathlib import Path

import numpy as np

MOST_CELLS = 9
CUT, PUT, TARGET, OTHER = -5.0, -10.0, -100.0, -5.0  # rewards, as the domain has them


class Forest:
    """Cells by number; a state is out_of_fuel + 2^cells * burning, a bit for each cell."""

    def __init__(self, text):
        text = re.sub(r"//[^\n]*", "", text)
        objects = {kind: re.search(rf"{kind}\s*:\s*{{([^}}]*)}}", text).group(1).replace(" ", "").split(",")
                   for kind in ("x_pos", "y_pos")}
        self.names = [f"{x}__{y}" for x in objects["x_pos"] for y in objects["y_pos"]]
        self.cells = len(self.names)
        if self.cells > MOST_CELLS:
            sys.exit(f"the instance has {self.cells} cells, and at most {MOST_CELLS} fit into the tables")
        number = {tuple(name.split("__")): cell for cell, name in enumerate(self.names)}
        self.neighbours = np.zeros((self.cells, self.cells), bool)
        for a, b, c, d in re.findall(r"NEIGHBOR\((\w+),\s*(\w+),\s*(\w+),\s*(\w+)\)\s*;", text):
            self.neighbours[number[a, b], number[c, d]] = True
        self.targets = np.array([bool(re.search(rf"TARGET\({x},\s*{y}\)", text)) for x, y in number])
        burning = re.findall(r"burning\((\w+),\s*(\w+)\)\s*;", text)
        self.start = sum(1 << number[cell] + self.cells for cell in burning)
        self.horizon = int(re.search(r"horizon\s*=\s*(\d+)", text).group(1))
        states = np.arange(1 << 2 * self.cells)
        self.fuelless = (states[:, None] >> np.arange(self.cells) & 1).astype(bool)
        self.burning = (states[:, None] >> self.cells + np.arange(self.cells) & 1).astype(bool)
        # The probability of each cell to begin to burn, without actions.
        count = self.burning @ self.neighbours.T.astype(int)
        fresh = ~self.fuelless & ~self.burning
        self.ignition = np.where(fresh & ~(self.targets & (count == 0)), 1 / (1 + np.exp(4.5 - count)), 0.0)
        self.penalty = (np.where(self.targets, TARGET * (self.burning | self.fuelless), OTHER * self.burning)).sum(1)
        self.actions = [("noop", -1)] + [(kind, c) for kind in ("put-out", "cut-out") for c in range(self.cells)]

    def reward(self, action):
        return self.penalty + {"noop": 0.0, "put-out": PUT, "cut-out": CUT}[action[0]]

    def branches(self, action):
        """(from, to, probability) of all that may follow each state."""
        kind, cell = action
        ignition, burning = self.ignition.copy(), self.burning.copy()
        fuelless = self.fuelless | self.burning
        if kind == "put-out":
            ignition[:, cell] = 0
            burning[:, cell] = False
        if kind == "cut-out" and not self.targets[cell]:
            fuelless = fuelless.copy()
            fuelless[:, cell] = True
        bits = 1 << np.arange(self.cells)
        source = np.arange(len(burning))
        to = fuelless @ bits + ((burning @ bits) << self.cells)
        probability = np.ones(len(burning))
        for c in range(self.cells):
            odds = ignition[source, c]
            burns = odds > 0
            source = np.concatenate([source, source[burns]])
            to = np.concatenate([to, to[burns] + (1 << c + self.cells)])
            probability = np.concatenate([np.where(burns, probability * (1 - odds), probability),
                                          probability[burns] * odds[burns]])
        return source, to, probability


class Steps:
    """Mean of a function of the next state, for all states at once."""

    def __init__(self, branches):
        source, to, probability = branches
        order = np.argsort(source, kind="stable")
        self.to, self.probability = to[order].astype(np.int32), probability[order]
        self.begins = np.searchsorted(source[order], np.arange(source.max() + 1))

    def mean(self, values):
        return np.add.reduceat(self.probability * values[self.to], self.begins)


def check(forest, instance, pairs):
    """Compares the model with the problem's RDDL in `pairs` states and actions, reached by random actions."""
    import rddlc
    from rddlc.records import grounded_view
    from rddlc.transitions import Transitions

    problem = rddlc.make("Wildfire_MDP_ippc2014", instance).unwrapped.problem
    transitions = Transitions(problem, most_outcomes=1 << MOST_CELLS)
    names = [f"{fluent}___{cell}" for fluent in ("out-of-fuel", "burning") for cell in forest.names]
    groundings = [name for fluent in problem.model.states for name in fluent.groundings]
    places = [groundings.index(name) for name in names]

    def number_of(state):
        record = np.frombuffer(state.record, np.uint8)[None]
        row = grounded_view(record, problem.model.states)[0]
        return sum(1 << bit for bit, place in enumerate(places) if row[place])

    def action_of(number):
        changed = [name for name, value in transitions.action(number).items() if value]
        if not changed:
            return "noop", -1
        kind, cell = changed[0].split("___")
        return kind, forest.names.index(cell)

    branches = {action: forest.branches(action) for action in forest.actions}
    random = np.random.default_rng(0)
    state, looked, most, seen = transitions.start(), 0, 0.0, set()
    assert number_of(state) == forest.start
    for _ in range(pairs):
        number = int(random.integers(transitions.action_count))
        action, here = action_of(number), number_of(state)
        outcomes = transitions.outcomes(state, number)
        source, to, probability = branches[action]
        mine = dict(zip(to[source == here].tolist(), probability[source == here].tolist()))
        theirs = {number_of(o.state): o.probability for o in outcomes}
        assert mine.keys() == theirs.keys(), (here, action)
        errors = [abs(mine[to] - theirs[to]) for to in mine]
        errors += [abs(o.reward - forest.reward(action)[here]) for o in outcomes]
        most, looked = max(most, *errors), looked + len(mine)
        seen.add(here)
        state = outcomes[int(random.integers(len(outcomes)))].state
        if state.causes:
            state = transitions.start()
    print(f"model and RDDL agree in {pairs} pairs of a state and an action ({len(seen)} states), "
          f"{looked} next states: largest difference {most:.1e}")
    if most > 1e-9:
        sys.exit("the model is not the problem")


def optimum(forest):
    """Values of the start: the best mean return, and those of doing nothing and of random actions."""
    steps = [Steps(forest.branches(action)) for action in forest.actions]
    rewards = [forest.reward(action) for action in forest.actions]
    best = nothing = random = np.zeros(len(forest.penalty))
    first = None
    for _ in range(forest.horizon):
        each = [reward + step.mean(best) for step, reward in zip(steps, rewards)]
        random = np.mean([reward + step.mean(random) for step, reward in zip(steps, rewards)], 0)
        nothing = rewards[0] + steps[0].mean(nothing)
        first = int(np.argmax([values[forest.start] for values in each]))
        best = np.max(each, 0)
    return best[forest.start], forest.actions[first], nothing[forest.start], random[forest.start]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--instance", default="1")
    parser.add_argument("--check", type=int, default=2000, help="pairs of states and actions that are compared with RDDL")
    arguments = parser.parse_args()
    import rddlrepository

    folder = Path(rddlrepository.__file__).parent / "archive/competitions/IPPC2014/Wildfire/MDP"
    forest = Forest((folder / f"instance{arguments.instance}.rddl").read_text())
    if arguments.check:
        check(forest, arguments.instance, arguments.check)
    best, (kind, cell), nothing, random = optimum(forest)
    print(f"best mean return of {forest.horizon} steps: {best:.4f}, which begins with {kind} {forest.names[cell]}")
    print(f"doing nothing: {nothing:.4f}; actions at random: {random:.4f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
