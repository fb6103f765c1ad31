"""Observations as rows of numbers, and actions as categories and numbers: what learners take.

Everything works on the rows of a batch, so that one environment and many are the same.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from . import _native
from .choices import ActionPlan, Squash, plan_of
from .errors import ActionError
from .problems import Problem
from .quick import quick_writer
from .records import columns_of, grounded_view

Array = NDArray[Any]


class FlatReader:
    """Rows of float32 (n, features): bools are 0 and 1, objects a feature for each object (1 for the
    one that it is), numbers themselves. `normalize`: those with two bounds are -1 at the lower and 1
    at the upper one."""

    def __init__(
        self, problem: Problem, values: Array, final_values: Array, *, normalize: bool
    ) -> None:
        columns = columns_of(problem.model.observed)
        self._values, self._first, self._final_values = values, values[0], final_values
        self._sources: list[int] = []  # of each feature: a column
        objects: list[int] = []  # and the object that it is about, or -1
        self.names: list[str] = []
        for index, column in enumerate(columns):
            names = column.fluent.objects
            self._sources += [index] * (len(names) if names else 1)
            objects += range(len(names)) if names else [-1]
            self.names += [f"{column.name}={each}" for each in names] if names else [column.name]
        self._objects = np.array(objects)
        lower, upper = np.array([column.bounds for column in columns]).reshape(-1, 2)[self._sources].T
        is_object = self._objects >= 0
        lower, upper = np.where(is_object, 0, lower), np.where(is_object, 1, upper)
        self._is_plain = not is_object.any()
        self.is_view = self._is_plain and not normalize
        """Whether features are the batch's own memory."""
        self._middle: Array | None = None
        if normalize:
            scaled = np.isfinite(lower) & np.isfinite(upper) & (lower < upper)
            safe_lower, safe_upper = np.where(scaled, lower, 0), np.where(scaled, upper, 0)
            self._middle = ((safe_lower + safe_upper) / 2).astype(np.float32)
            self._half = np.where(scaled, (safe_upper - safe_lower) / 2, 1).astype(np.float32)
            lower, upper = np.where(scaled, -1, lower), np.where(scaled, 1, upper)
        self.space = spaces.Box(lower.astype(np.float32), upper.astype(np.float32), dtype=np.float32)

    def rows(self, *, copy: bool) -> Array:
        """(n, features). Without a copy they may be the batch's own memory."""
        return self._values.copy() if copy and self.is_view else self._features(self._values)

    def final_rows(self) -> Array:
        """(n, features) of the ends of episodes; rows of others mean nothing."""
        return self._features(self._final_values.copy())

    def _features(self, rows: Array) -> Array:
        if not self._is_plain:
            rows = rows[:, self._sources]
            rows = np.where(self._objects >= 0, rows == self._objects, rows).astype(np.float32)
        if self._middle is not None:
            rows = (rows - self._middle) / self._half
        return rows

    def read(self) -> Array:
        """(features,) of the first environment."""
        return self._first.copy() if self.is_view else self._features(self._values)[0]


class ChoiceActions:
    """Writes categories and numbers into the rows of a batch's action values.

    The space is Discrete or MultiDiscrete of categories, Box of numbers, or Dict("discrete",
    "continuous") of both, as pyRDDLGym-rl's SimplifiedActionRDDLEnv has it; with `box` one Box of
    numbers from -1 to 1 for everything. `normalize`: numbers are from -1 to 1.
    """

    def __init__(
        self, problem: Problem, batch: _native.Batch, *, box: bool, normalize: bool
    ) -> None:
        self.plan: ActionPlan = plan_of(problem)
        self._batch, self._values = batch, batch.action_values
        self._record = grounded_view(batch.actions, problem.model.actions)
        self._is_real = [each.fluent.scalar == "real" for each in columns_of(problem.model.actions)]
        self._box = box
        self._squash = Squash(self.plan) if box or normalize else None
        self._lower, self._upper = self._number_limits()
        rows = (len(self._values), len(self._lower))  # of the same shape, numpy compares quickest
        self._row_limits = np.full(rows, self._lower), np.full(rows, self._upper)
        self.space = self._new_space()
        self.step = batch.step_values
        self._quick_rows = None if self._squash is not None else self._new_row_writer(batch)
        self._quick = quick_writer(self.plan, self._values[0]) if self._squash is None else None

    def _new_row_writer(self, batch: _native.Batch) -> _native.RowWriter | None:
        """Writes rows of categories or of numbers, if each sets a value of its own and these stand
        together."""
        plan = self.plan
        if plan.picks or (plan.category_counts and plan.numbers):
            return None
        columns = plan.number_columns if plan.numbers else plan.columns
        if int(columns[-1]) - int(columns[0]) + 1 != len(columns):
            return None
        if plan.numbers:
            limits = [(lower, upper, 0.0) for lower, upper in zip(self._lower, self._upper)]
        else:
            counted = zip(plan.category_counts, plan.values)
            limits = [(0.0, float(count - 1), float(least)) for count, least in counted]
        return _native.RowWriter(batch, int(columns[0]), limits, categories=not plan.numbers)

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

    def write(self, action: Any) -> None:
        """Steps the first environment. Raises ActionError, and has changed nothing then."""
        if self._quick is not None and self._quick(action):
            return
        if isinstance(action, Mapping) and "action" in action:
            action = action["action"]  # as pyRDDLGym's agents of learners send it
        self.write_rows(_first_row(action))

    def step_rows(self, actions: Any, into: Any) -> bool:
        """A step by a row for each environment; `into`: see `_native.Batch.step`. Whether an episode
        has ended. Raises ActionError, and has changed nothing then."""
        if self._quick_rows is not None:
            ended = self._quick_rows.step(actions, into)
            if ended is not None:
                return ended
        self._batch.finish()
        self.write_rows(actions)
        return self.step(into)

    def write_rows(self, actions: Any) -> None:
        """A row for each environment. Raises ActionError, and has changed nothing then."""
        if self._quick_rows is not None and self._quick_rows.write(actions):
            return
        self._write_into(self._values, actions)

    def violated(self, actions: Any) -> NDArray[np.bool_]:
        """(n,): whether a row for each environment, or the action of the only one, violates a
        precondition."""
        values = np.empty_like(self._values)
        self._write_into(values, _first_row(actions) if len(values) == 1 else actions)
        return np.array(self._batch.violated_preconditions(values)) >= 0

    def default(self) -> Any:
        """The action of one environment that changes nothing."""
        plan = self.plan
        categories = (
            np.array(plan.category_counts) - 1
            if plan.picks
            else plan.defaults[plan.columns].astype(np.int64) - plan.values
        )
        numbers = plan.defaults[plan.number_columns]
        if self._squash is not None:
            numbers = self._squash.numbers(numbers)
        if self._box:
            middles = (categories + 0.5) / np.array(plan.category_counts, float) * 2 - 1
            return np.concatenate([middles, np.ravel(numbers)])
        if isinstance(self.space, spaces.Dict):
            return {"discrete": categories, "continuous": numbers}
        return categories if plan.category_counts else numbers

    def _write_into(self, values: Array, actions: Any) -> None:
        """(n, columns)"""
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
            discrete = np.clip((shares * limits).astype(np.int64), 0, limits - 1)
            continuous = continuous[:, len(counts) :]
        categories = _matrix(discrete, rows, len(counts), "categories")
        if categories.dtype.kind not in "iub":
            raise ActionError(f"categories are whole numbers, not {categories.dtype}")
        return categories, _matrix(continuous, rows, len(self._lower), "numbers")

    def write_record(self) -> None:
        """Copies the first row of values into the record, which preconditions are asked about."""
        values = self._values[0].tolist()
        self._record[0] = tuple(
            value if is_real else round(value) for value, is_real in zip(values, self._is_real)
        )


def _first_row(action: Any) -> Any:
    if isinstance(action, Mapping):
        return {key: np.asarray(value)[np.newaxis] for key, value in action.items()}
    return np.asarray(action)[np.newaxis]


def _matrix(given: Any, rows: int, columns: int, what: str) -> Array:
    array = np.asarray(given)
    if array.size != rows * columns:
        raise ActionError(f"an action has {columns} {what}, not the shape {array.shape[1:]}")
    return array.reshape(rows, columns)
