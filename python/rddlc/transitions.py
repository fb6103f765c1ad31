"""Steps from any state, for planners that ask what an action would do. Needs no scikit-decide."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _native
from .arguments import seed_of, shown, whole, whole_or_none
from .errors import ActionError, Error
from .problems import Problem, batch_horizon
from .records import columns_of, records_of
from .states import State
from .translation.action_plan import ActionPlan, plan_of

MOST_ACTIONS = 10_000
MOST_REMEMBERED = 100_000
"""States, and pairs of a state and an action."""


@dataclass(frozen=True)
class Outcome:
    """A possible successor of an action. `reward` is the mean of all ways there."""

    state: State
    probability: float
    reward: float


class Transitions:
    """A problem with finitely many actions, which are numbers from 0 on, stepped from any state. Each
    draw has new random numbers; the same `seed` and the same calls give the same ones.

    A state is over if its `causes` are not 0. It knows the steps made, so the horizon ends episodes,
    and the same fluents at another step are another state.
    """

    def __init__(
        self,
        problem: Problem,
        *,
        levels: int = 3,
        samples: int = 0,
        horizon: int | None = None,
        seed: int = 0,
        most_outcomes: int = 10_000,
    ) -> None:
        """levels: values of each number of an action, evenly between its bounds.
        samples: draws from which next states of a stochastic problem are estimated; 0: they are exact,
            by all combinations of what a step draws, as long as these are finitely many.
        most_outcomes: the largest number of these combinations.
        horizon: steps; None: the instance's; 0: no horizon.

        Raises Error for a partially observed problem, and where actions are too many or have no
        bounds.
        """
        if problem.model.partially_observed:
            raise Error("the problem is partially observed: planners would see what is hidden")
        self._options: dict[str, Any] = {
            "levels": whole("levels", levels, 2, MOST_ACTIONS),
            "samples": whole("samples", samples, 0),
            "horizon": whole_or_none("horizon", horizon, 0),
            "seed": seed_of(seed),
            "most_outcomes": whole("most_outcomes", most_outcomes, 1),
        }
        self.problem = problem
        given = self._options["horizon"]
        self.horizon: int = problem.model.horizon if given is None else given
        self._values = _action_values(problem, self._options["levels"])
        self._records = records_of(
            problem.model.actions, problem.model.action_size, self._values
        )
        self._single = self._new_batch(1)
        # Seeds in a row would also be those of the next `seed`.
        self._seeds = np.random.default_rng(self._options["seed"])
        self._outcomes = lru_cache(MOST_REMEMBERED)(self._new_outcomes)
        self._applicable = lru_cache(MOST_REMEMBERED)(self._new_applicable)

    def _new_batch(self, environments: int) -> _native.EnvPool:
        return _native.EnvPool(
            self.problem.simulator,
            environments=environments,
            horizon=batch_horizon(self.horizon),
            records=False,
            values=False,
        )

    def _number_of(self, action: Any) -> int:
        count = self.action_count
        if isinstance(action, (bool, np.bool_)) or not isinstance(action, (int, np.integer)):
            raise ActionError(f"an action is a number from 0 to {count - 1}, not {shown(action)}")
        if not 0 <= action < count:
            raise ActionError(f"action {shown(action)} is not from 0 to {count - 1}")
        return int(action)

    def _refuse_end(self, state: Any) -> None:
        self.problem.state_form.record_of(state)
        state.refuse_end()

    @property
    def action_count(self) -> int:
        return len(self._values)

    @property
    def is_exact(self) -> bool:
        """Whether `outcomes` are the true ones, and not estimated."""
        return not (self.problem.model.stochastic and self._options["samples"])

    def action(self, number: int) -> dict[str, Any]:
        """The action as environments with actions="dict" take it."""
        number = self._number_of(number)
        columns = columns_of(self.problem.model.actions)
        return {
            column.name: value if column.fluent.scalar == "real" else round(value)
            for column, value in zip(columns, self._values[number].tolist())
        }

    def start(self) -> State:
        """Returns the initial state of the first episode of `seed`."""
        self._single.set_seed(self._options["seed"])
        self._single.reset()
        return self._state_of(self._single, 0, self._single.causes_of(0))

    def sample(self, state: State, action: int) -> Outcome:
        """One draw of what the action leads to."""
        action = self._number_of(action)
        self._refuse_end(state)
        batch = self._single
        batch.set_seed(int(self._seeds.integers(1 << 63)))
        self._step(batch, state, self._records[action])
        return Outcome(self._state_of(batch, 0, int(batch.causes[0])), 1.0, float(batch.rewards[0]))

    def outcomes(self, state: State, action: int) -> tuple[Outcome, ...]:
        """All that the action may lead to, the likeliest first; with `samples` what so many draws have
        led to, the same ones each time. Raises Error where something is drawn from infinitely many
        values, or there are too many combinations."""
        action = self._number_of(action)
        self._refuse_end(state)
        return self._outcomes(state, action)

    def _new_outcomes(self, state: State, action: int) -> tuple[Outcome, ...]:
        if not self.problem.model.stochastic:
            return (self.sample(state, action),)
        if self.is_exact:
            return self._exact_outcomes(state, action)
        batch = self._many
        batch.set_seed(self._options["seed"])
        self._step(batch, state, self._records[action])
        rewards: defaultdict[State, list[float]] = defaultdict(list)
        for place, (cause, reward) in enumerate(zip(batch.causes.tolist(), batch.rewards.tolist())):
            rewards[self._state_of(batch, place, cause)].append(reward)
        found = [
            Outcome(to, len(earned) / len(batch.rewards), sum(earned) / len(earned))
            for to, earned in rewards.items()
        ]
        return tuple(sorted(found, key=lambda each: -each.probability))

    def _exact_outcomes(self, state: State, action: int) -> tuple[Outcome, ...]:
        found = self._enumeration.next_states(
            self.problem.state_form.record_of(state).tobytes(),
            state.steps,
            self._records[action].tobytes(),
            self.horizon,
            self._options["most_outcomes"],
        )
        outcomes = (
            Outcome(State(record, state.steps + 1, ended, state.problem), probability, reward)
            for record, ended, probability, reward in found
        )
        return tuple(sorted(outcomes, key=lambda each: -each.probability))

    @cached_property
    def _enumeration(self) -> _native.Enumeration:
        return _native.enumeration(self.problem.simulator, list(self.problem.externs))

    def applicable(self, state: State) -> tuple[int, ...]:
        """Returns the actions that satisfy the preconditions; empty after the end."""
        self.problem.state_form.record_of(state)
        return self._applicable(state)

    def _new_applicable(self, state: State) -> tuple[int, ...]:
        if state.causes:
            return ()
        if not self.problem.model.preconditions:
            return tuple(range(self.action_count))
        batch = self._all_actions
        self._enter(batch, state)
        violated = batch.violated_preconditions(self._records)
        return tuple(action for action, which in enumerate(violated) if which < 0)

    @property
    def _many(self) -> _native.EnvPool:
        return self._kept("samples", self._options["samples"])

    @property
    def _all_actions(self) -> _native.EnvPool:
        return self._kept("actions", self.action_count)

    def _kept(self, name: str, environments: int) -> _native.EnvPool:
        batches: dict[str, _native.EnvPool] = self.__dict__.setdefault("_batches", {})
        if name not in batches:
            batches[name] = self._new_batch(environments)
            batches[name].set_seed(self._options["seed"])
            batches[name].reset()
        return batches[name]

    def _step(self, batch: _native.EnvPool, state: State, action: NDArray[np.uint8]) -> None:
        self._enter(batch, state)
        batch.actions[:] = action
        batch.step()

    def _enter(self, batch: _native.EnvPool, state: State) -> None:
        record = self.problem.state_form.record_of(state)
        count = len(batch.rewards)
        batch.write_states(
            np.arange(count), np.tile(record, (count, 1)), np.full(count, state.steps)
        )

    def _state_of(self, batch: _native.EnvPool, place: int, cause: int) -> State:
        record = np.zeros(self.problem.model.state_size, np.uint8)
        batch.read_state(place, record)
        steps = batch.progress(place)[0]
        return State(record.tobytes(), steps, cause, self.problem.state_form.problem)

    def __reduce__(self) -> tuple[Any, ...]:
        return _again, (self.problem, self._options)


def _again(problem: Problem, options: dict[str, Any]) -> Transitions:
    return Transitions(problem, **options)


def _action_values(problem: Problem, levels: int) -> NDArray[np.float64]:
    """(actions, columns), each of which is another."""
    plan = plan_of(problem)
    choices: list[Sequence[float]] = [range(count) for count in plan.category_counts]
    choices += _levels_of(plan, levels)
    count = int(np.prod([len(each) for each in choices], dtype=float))
    if count > MOST_ACTIONS:
        raise Error(f"there are {count} actions, and planners take no more than {MOST_ACTIONS}")
    rows = np.array(list(product(*choices)), np.float64)
    categories, numbers = np.split(rows, [len(plan.category_counts)], axis=1)
    values = np.tile(plan.defaults, (count, 1))
    plan.write(categories.astype(np.int64), numbers, values)
    _, first = np.unique(values, axis=0, return_index=True)
    return values[np.sort(first)]


def _levels_of(plan: ActionPlan, levels: int) -> list[Sequence[float]]:
    if plan.numbers and levels < 2:
        raise Error(f"levels is {levels}, but an action has numbers: 2 or more are needed")
    for column in plan.numbers:
        if not np.isfinite(column.bounds).all():
            raise Error(f"action '{column.name}' has no two bounds, so there are no levels between them")
    return [np.linspace(*column.bounds, levels).tolist() for column in plan.numbers]
