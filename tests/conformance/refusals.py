"""Ours must report a fault where pyRDDLGym itself stops with an error: in the same state, under the
same action.

That happens under actions that the preconditions forbid, which pyRDDLGym executes by default. So
these walks take any action within the bounds and max-nondef-actions.

One kind of error we do not share: pyRDDLGym evaluates both branches of an `if` for all objects as
soon as some take the one and some the other, and so stops at a probability of 1.3 in a branch that
no object with that probability takes. Ours evaluates only the branch taken (docs/decisions.md).
Such a step is found by making it twice, with each improper Bernoulli false and then true: if that
changes nothing, no object took its branch, and the step is compared like any other.
"""

from dataclasses import dataclass

import numpy as np

from model import TERMINATED, TRUNCATED, Problem, Transitions, Values
from problems import Case
from reference import Reference, transitions_of

MOST_REFUSALS = 4
ATTEMPTS = 20  # draws of a refused step, of which all must be refused for it to count
ROUNDING = 1e-9  # of probabilities: ours takes such for 0 or 1 (docs/distributions.md)
REFUSED = (ValueError, ArithmeticError, TypeError)


@dataclass(frozen=True)
class RefusalPlan:
    """How far the walk goes."""

    steps: int = 1000
    kept: int = 50  # steps compared of those that were not refused
    seconds: float = 10.0


@dataclass
class Refused:
    state: Values
    action: Values
    message: str  # the reference's


@dataclass
class Refusals:
    """A walk under any actions: what was refused with good reason, and some of the other steps."""

    problem: Problem
    walk: Transitions | None  # None if everything was refused
    refused: list[Refused]


class HeedlessReference(Reference):
    """Takes actions that the preconditions forbid."""

    def any_action(self) -> Values:
        wild = {f.name: self._random_values(f) for f in self.problem.actions}
        return self._thin(wild, self.default_action(), 1.0)

    def always_refuses(self, state: Values, action: Values) -> bool:
        """Whatever is drawn?"""
        for _ in range(ATTEMPTS):
            try:
                self.step(state, action)
            except REFUSED:
                continue
            return False
        return True

    def step_without_untaken_branches(self, state: Values, action: Values) -> Values | None:
        """Returns the outcome of a refused step if the refusal was about a branch that no object
        takes."""
        try:
            first, second = (self._step_with(value, state, action) for value in (False, True))
        except REFUSED:
            return None
        same = all(np.array_equal(first[name], second[name], equal_nan=True) for name in first)
        return first if same else None

    def _step_with(self, value: bool, state: Values, action: Values) -> Values:
        """A step in which every Bernoulli of an improper probability has the given value."""
        simulator = self.simulator

        def bernoulli(expression, table):
            probability = np.asarray(simulator._sample(expression.args[0], table))
            valid = (probability >= -ROUNDING) & (probability <= 1 + ROUNDING)
            drawn = simulator.rng.uniform(size=probability.shape) <= probability
            return np.where(valid, drawn, value)

        simulator.seed(self.seed)
        simulator._sample_bernoulli = bernoulli
        try:
            return self.step(state, action)
        finally:
            del simulator._sample_bernoulli


def record_refusals(case: Case, plan: RefusalPlan) -> Refusals:
    reference = HeedlessReference(case)
    steps: list[tuple[Values, Values, Values]] = []
    excused: list[tuple[Values, Values, Values]] = []
    refused: list[Refused] = []
    state, age = reference.initial_state(), 0
    for _ in range(int(np.clip(plan.seconds / reference.seconds_a_step(), 20, plan.steps))):
        action = reference.any_action()
        try:
            outcome = reference.step(state, action)
        except REFUSED as error:
            enough = min(len(refused), len(excused)) >= MOST_REFUSALS
            if not enough and reference.always_refuses(state, action):
                outcome = reference.step_without_untaken_branches(state, action)
                if outcome is None:
                    refused.append(Refused(state, action, str(error)))
                else:
                    excused.append((state, action, outcome))
            state, age = reference.initial_state(), 0
            continue
        steps.append((state, action, outcome))
        state, age = {f.name: outcome[f.name] for f in reference.problem.states}, age + 1
        if outcome[TERMINATED][0] or outcome[TRUNCATED][0] or age == reference.problem.horizon:
            state, age = reference.initial_state(), 0
    kept = np.unique(np.linspace(0, len(steps) - 1, min(plan.kept, len(steps))).astype(int))
    compared = [steps[index] for index in kept] + excused[:MOST_REFUSALS]
    walk = transitions_of(compared) if compared else None
    return Refusals(reference.problem, walk, refused[:MOST_REFUSALS])
