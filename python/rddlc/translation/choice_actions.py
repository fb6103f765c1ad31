"""Actions as categories and numbers: what learners choose."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from .. import _native
from ..arguments import numbers_in
from ..errors import ActionError
from ..problems import Problem
from ..records import records_of, values_of
from .action_plan import ActionPlan, Squash, plan_of

Array = NDArray[Any]


class ChoiceActions:
    """Writes categories and numbers into the rows of a batch's action values.

    The space is Discrete or MultiDiscrete of categories, Box of numbers, or Dict("discrete",
    "continuous") of both, as pyRDDLGym-rl's SimplifiedActionRDDLEnv has it; with `box` one Box of
    numbers from -1 to 1 for everything. `normalize`: numbers are from -1 to 1.
    """

    def __init__(
        self, problem: Problem, batch: _native.EnvPool, *, box: bool, normalize: bool
    ) -> None:
        self.plan: ActionPlan = plan_of(problem)
        self._batch, self._values = batch, batch.action_values
        self._model = problem.model
        self._box = box
        self._squash = Squash(self.plan) if box or normalize else None
        self._lower, self._upper = self._number_limits()
        rows = (len(self._values), len(self._lower))  # of the same shape, numpy compares quickest
        self._row_limits = np.full(rows, self._lower), np.full(rows, self._upper)
        self.space = self._new_space()
        self._stepper = self._new_stepper()

    def _new_stepper(self) -> _native.ChoiceWriter:
        """The native way, many times as fast. It leaves to Python what it does not take, such as lists."""
        plan = self.plan
        columns = [-1] * len(plan.category_counts) if plan.max_sub_actions else plan.columns.tolist()
        least = [0] * len(columns) if plan.max_sub_actions else plan.values.tolist()
        squash = [None] * len(plan.numbers) if self._squash is None else self._squash.parameters
        limits = self._lower.tolist(), self._upper.tolist()
        changes: tuple[list[int], list[float], list[float]] = [], [], []
        if plan.max_sub_actions:
            changes = plan.columns.tolist(), plan.values.tolist(), plan.defaults.tolist()
        return _native.ChoiceWriter(
            self._batch,
            list(zip(columns, plan.category_counts, least)),
            list(zip(plan.number_columns.tolist(), *limits, squash)),
            changes,
            box=self._box,
        )

    def _number_limits(self) -> tuple[Array, Array]:
        count = len(self.plan.numbers)
        if self._squash is not None:
            return np.full(count, -1, np.float32), np.full(count, 1, np.float32)
        bounds = np.array([each.bounds for each in self.plan.numbers]).reshape(-1, 2)
        return bounds[:, 0].astype(np.float32), bounds[:, 1].astype(np.float32)

    def _new_space(self) -> spaces.Space[Any]:
        counts = self.plan.category_counts
        if self._box:
            return spaces.Box(-1, 1, (len(counts) + len(self._lower),), np.float32)
        discrete = spaces.Discrete(counts[0]) if len(counts) == 1 else spaces.MultiDiscrete(counts)
        continuous = spaces.Box(self._lower, self._upper, dtype=np.float32)
        if not len(self._lower):
            return discrete
        if not counts:
            return continuous
        return spaces.Dict({"discrete": discrete, "continuous": continuous})

    def step(self, actions: Any, into: Any = None) -> bool:
        ended = self._stepper.step(actions, into)
        if ended is not None:
            return ended
        self._batch.finish()
        self._write(actions, self._values)
        return self._batch.step_values(into)

    def violated(self, actions: Any) -> Array:
        values = np.empty_like(self._values)
        self._write(actions, values)
        return np.array(self._batch.violated_preconditions(values)) >= 0

    def records(self, actions: Any) -> NDArray[np.uint8]:
        values = np.empty_like(self._values)
        self._write(actions, values)
        return records_of(self._model.actions, self._model.action_size, values)

    def default(self) -> Any:
        plan = self.plan
        categories = (
            np.array(plan.category_counts) - 1
            if plan.max_sub_actions
            else plan.defaults[plan.columns].astype(np.int64) - plan.values
        )
        return self._packed(categories, plan.defaults[plan.number_columns])

    def actions_of(self, records: NDArray[np.uint8]) -> Any:
        values = values_of(self._model.actions, records)
        actions = self._packed(self.plan.categories_of(values), values[:, self.plan.number_columns])
        is_one = len(self.plan.category_counts) == 1 and not self._box
        if is_one and isinstance(actions, dict):
            return actions | {"discrete": actions["discrete"][:, 0]}
        return actions[:, 0] if is_one and not self.plan.numbers else actions

    def _packed(self, categories: Array, numbers: Array) -> Any:
        """As the space has them, along the last axis; numbers in the problem's own scale."""
        counts = np.array(self.plan.category_counts, float)
        if self._squash is not None:
            numbers = self._squash.numbers(numbers)
        numbers = numbers.astype(np.float32)
        if self._box:
            middles = (categories + 0.5) / counts * 2 - 1
            return np.concatenate([middles, numbers], axis=-1).astype(np.float32)
        if isinstance(self.space, spaces.Dict):
            return {"discrete": categories, "continuous": numbers}
        return categories if self.plan.category_counts else numbers

    def _write(self, actions: Any, values: Array) -> None:
        """(n, columns)"""
        if isinstance(actions, Mapping) and "action" in actions:
            actions = actions["action"]  # as pyRDDLGym's agents of learners send it
        categories, numbers = self._split(actions)
        self.plan.check_categories(categories)
        self._check_numbers(numbers)
        if self._squash is not None:
            numbers = self._squash.values(numbers)
        self.plan.write(categories, numbers, values)

    def _check_numbers(self, numbers: Array) -> None:
        lower, upper = self._row_limits
        if (numbers >= lower).all() and (numbers <= upper).all():
            return
        outside = ~((numbers >= self._lower) & (numbers <= self._upper))  # also nan
        row, place = np.argwhere(outside)[0]
        raise ActionError(
            f"the number for '{self.plan.numbers[place].name}' is {numbers[row, place]:g}, "
            f"which is not from {self._lower[place]:g} to {self._upper[place]:g}"
        )

    def _split(self, actions: Any) -> tuple[Array, Array]:
        rows, counts = len(self._values), self.plan.category_counts
        discrete: Any = np.empty((rows, 0), np.int64)
        continuous: Any = np.empty((rows, 0), np.float32)
        if isinstance(self.space, spaces.Dict):
            try:
                discrete, continuous = actions["discrete"], actions["continuous"]
            except (KeyError, TypeError, IndexError):
                raise ActionError("an action has the keys 'discrete' and 'continuous'") from None
        elif self._box or not counts:
            continuous = actions
        else:
            discrete = actions
        if self._box:
            continuous = _matrix(continuous, rows, len(counts) + len(self._lower), "numbers")
            shares = (continuous[:, : len(counts)] + 1) / 2
            if np.isnan(shares).any():
                raise ActionError("an action is nan")
            limits = np.array(counts, np.int64)
            discrete = np.clip(shares * limits, 0, limits - 1).astype(np.int64)
            continuous = continuous[:, len(counts) :]
        categories = _matrix(discrete, rows, len(counts), "categories")
        if categories.dtype.kind not in "iub":
            raise ActionError(f"categories are whole numbers, not {categories.dtype}")
        return categories, _matrix(continuous, rows, len(self._lower), "numbers")


def _matrix(given: Any, rows: int, columns: int, what: str) -> Array:
    array = numbers_in("an action", given, ActionError)
    if array.size != rows * columns:
        shape = array.shape if rows == 1 else array.shape[1:]
        raise ActionError(f"an action has {columns} {what}, not the shape {shape}")
    return array.reshape(rows, columns)
