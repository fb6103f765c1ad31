"""Where pyRDDLGym itself stops with an error, ours must report a fault: in the same state, under the
same action.

That happens under actions that the preconditions forbid, which pyRDDLGym executes unless told
otherwise. So these walks take any action within the bounds and max-nondef-actions.
"""

from dataclasses import dataclass

import numpy as np

from model import TERMINATED, TRUNCATED, Problem, Transitions, Values
from problems import Case
from reference import Reference, transitions_of

MOST_REFUSALS = 4
ATTEMPTS = 20  # draws of a refused step, of which all must be refused for it to count
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
    """A walk under any actions: what was refused, and some of the steps between."""

    problem: Problem
    walk: Transitions | None  # none where everything was refused
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


def record_refusals(case: Case, plan: RefusalPlan) -> Refusals:
    reference = HeedlessReference(case)
    steps: list[tuple[Values, Values, Values]] = []
    refused: list[Refused] = []
    state, age = reference.initial_state(), 0
    for _ in range(int(np.clip(plan.seconds / reference.seconds_a_step(), 20, plan.steps))):
        action = reference.any_action()
        try:
            outcome = reference.step(state, action)
        except REFUSED as error:
            if len(refused) < MOST_REFUSALS and reference.always_refuses(state, action):
                refused.append(Refused(state, action, str(error)))
            state, age = reference.initial_state(), 0
            continue
        steps.append((state, action, outcome))
        state, age = {f.name: outcome[f.name] for f in reference.problem.states}, age + 1
        if outcome[TERMINATED][0] or outcome[TRUNCATED][0] or age == reference.problem.horizon:
            state, age = reference.initial_state(), 0
    kept = np.unique(np.linspace(0, len(steps) - 1, min(plan.kept, len(steps))).astype(int))
    walk = transitions_of([steps[index] for index in kept]) if steps else None
    return Refusals(reference.problem, walk, refused)
