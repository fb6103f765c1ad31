"""Converts categories and numbers to action values."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import ActionError
from ..problems import Problem
from ..records import Column, columns_of

Array = NDArray[Any]

MOST_CATEGORIES = 1024
"""Ints of more values are numbers, which are rounded."""


@dataclass(frozen=True, eq=False)
class ActionPlan:
    """The categories and numbers that a learner chooses, and the columns of action values that they
    set.

    Without sub-actions there is a category for each bool, object or int of few values, in declaration
    order. With sub-actions, where max-nondef-actions lets few values change, each category is a change
    of the default action: of a bool, in its order, to its other value; of an object or an int to
    each other value; of a number to the one that is chosen for it. The last category changes
    nothing.
    """

    defaults: Array  # (columns,)
    numbers: list[Column]
    number_columns: Array  # (numbers,)
    category_counts: list[int]
    max_sub_actions: int  # 0: each category sets a value of its own
    columns: Array  # of each category, or of each change; -1: no column
    values: Array  # the least of each category, or that of each change

    def check_categories(self, categories: Array) -> None:
        """Raises ActionError for one that does not exist. categories: (n, categories)"""
        if not self.category_counts:
            return
        outside = (categories < 0) | (categories >= np.array(self.category_counts))
        if outside.any():
            row, place = np.argwhere(outside)[0]
            raise ActionError(
                f"category {place} is {categories[row, place]}, which is not from 0 to "
                f"{self.category_counts[place] - 1}"
            )

    def categories_of(self, values: Array) -> Array:
        """(n, categories) that write rows of values: the inverse of `write`."""
        if not self.max_sub_actions:
            return values[:, self.columns].astype(np.int64) - self.values.astype(np.int64)
        nothing = len(self.columns) - 1
        chosen = np.full((len(values), self.max_sub_actions), nothing)
        numbers = set(self.number_columns.tolist())
        category_of = {
            (column, None if column in numbers else value): category
            for category, (column, value) in enumerate(zip(self.columns.tolist(), self.values.tolist()))
        }
        for row, column in np.argwhere(values != self.defaults):
            free = int(np.argmax(chosen[row] == nothing))
            value = None if column in numbers else values[row, column].item()
            chosen[row, free] = category_of[int(column), value]
        return chosen

    def write(self, categories: Array, numbers: Array, values: Array) -> None:
        """Into rows of action values: (n, columns)."""
        if not self.max_sub_actions:
            if len(self.columns):
                values[:, _as_slice(self.columns)] = categories + self.values
            if self.numbers:
                values[:, _as_slice(self.number_columns)] = numbers
            return
        values[:] = self.defaults
        rows = np.arange(len(values))
        for change in categories.T:
            changed = self.columns[change]
            acts = changed >= 0
            values[rows[acts], changed[acts]] = self.values[change][acts]
        for place, column in enumerate(self.number_columns):
            chosen = (self.columns[categories] == column).any(axis=1)
            values[chosen, column] = numbers[chosen, place]


def _as_slice(columns: Array) -> Any:
    """The same columns, by a slice if they stand together: numpy copies these several times as fast."""
    begin, end = int(columns[0]), int(columns[-1]) + 1
    return slice(begin, end) if end - begin == len(columns) else columns


class Squash:
    """Maps numbers from -1 to 1 to those of any bounds: -1 and 1 are the bounds if there are two.
    Otherwise the middle is the default, or lies a unit from the only bound, and the ends are
    some 74 units away: sinh(5 u), so that small numbers are well separated."""

    def __init__(self, plan: ActionPlan) -> None:
        lower, upper = np.array([each.bounds for each in plan.numbers]).reshape(-1, 2).T
        self._lower, self._upper = lower, upper
        self._has_lower, self._has_upper = np.isfinite(lower), np.isfinite(upper)
        self._default = plan.defaults[plan.number_columns]
        self._unit = np.maximum(1.0, np.abs(self._default))

    @property
    def parameters(self) -> list[tuple[float, float, float, float]]:
        """Lower, upper, default and unit of each number."""
        rows = zip(self._lower.tolist(), self._upper.tolist(), self._default.tolist(), self._unit.tolist())
        return list(rows)

    def values(self, numbers: Array) -> Array:
        """(n, numbers) in the problem's own scale."""
        numbers = numbers.astype(np.float64)
        share = (numbers + 1) / 2
        with np.errstate(invalid="ignore"):
            between = self._lower + share * (self._upper - self._lower)
            above = self._lower + self._unit * np.sinh(5 * share) / np.sinh(2.5)
            below = self._upper - self._unit * np.sinh(5 * (1 - share)) / np.sinh(2.5)
            free = self._default + self._unit * np.sinh(5 * numbers)
        both, one = self._has_lower & self._has_upper, self._has_lower
        unbounded = np.where(one, above, np.where(self._has_upper, below, free))
        return np.where(both, np.minimum(between, self._upper), unbounded)

    def numbers(self, values: Array) -> Array:
        """(n, numbers) for values: the inverse of `values`."""
        with np.errstate(invalid="ignore", divide="ignore"):
            between = (values - self._lower) / (self._upper - self._lower)
            above = np.arcsinh((values - self._lower) / self._unit * np.sinh(2.5)) / 5
            below = 1 - np.arcsinh((self._upper - values) / self._unit * np.sinh(2.5)) / 5
            free = np.arcsinh((values - self._default) / self._unit) / 5
        both, one = self._has_lower & self._has_upper, self._has_lower
        share = np.where(both, between, np.where(one, above, below))
        is_bounded = both | one | self._has_upper
        return np.clip(np.where(is_bounded, np.nan_to_num(share, posinf=1, neginf=0) * 2 - 1, free), -1, 1)


def plan_of(problem: Problem) -> ActionPlan:
    """Raises ActionError where there is nothing to choose."""
    columns = columns_of(problem.model.actions)
    defaults = np.array(
        [float(each) for fluent in problem.model.actions for each in problem.constants(fluent.name)]
    )
    is_category = [0 < (column.category_count or 0) <= MOST_CATEGORIES for column in columns]
    if not columns:
        raise ActionError("the problem has no action-fluents: there is nothing to choose")
    limit = problem.model.limited_actions
    if limit is not None and limit > 0:
        return _plan_of_sub_actions(columns, defaults, is_category, limit)
    return _plan_of_values(columns, defaults, is_category)


def _plan_of_values(
    columns: Sequence[Column], defaults: Array, is_category: Sequence[bool]
) -> ActionPlan:
    categories = [index for index, each in enumerate(is_category) if each]
    numbers = [index for index, each in enumerate(is_category) if not each]
    return ActionPlan(
        defaults=defaults,
        numbers=[columns[index] for index in numbers],
        number_columns=np.array(numbers, np.int64),
        category_counts=[columns[index].category_count or 0 for index in categories],
        max_sub_actions=0,
        columns=np.array(categories, np.int64),
        values=np.array([int(columns[index].bounds[0]) for index in categories], np.int64),
    )


def _plan_of_sub_actions(
    columns: Sequence[Column], defaults: Array, is_category: Sequence[bool], limit: int
) -> ActionPlan:
    changes: list[tuple[int, float]] = []
    for index, column in enumerate(columns):
        if not is_category[index]:
            changes.append((index, defaults[index]))  # the number comes later
            continue
        lower, upper = column.bounds
        values = np.arange(lower, upper + 1)
        changes += [(index, value) for value in values if value != defaults[index]]
    changes.append((-1, 0.0))
    numbers = [index for index, each in enumerate(is_category) if not each]
    return ActionPlan(
        defaults=defaults,
        numbers=[columns[index] for index in numbers],
        number_columns=np.array(numbers, np.int64),
        category_counts=[len(changes)] * limit,
        max_sub_actions=limit,
        columns=np.array([column for column, _ in changes], np.int64),
        values=np.array([value for _, value in changes]),
    )
