"""Which actions satisfy the preconditions."""

from __future__ import annotations

from typing import Any

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from . import _native
from .errors import Error
from .problems import Problem
from .records import columns_of


class ActionMasks:
    """Of the first environment of a batch, for each category of an action whether it is legal, while
    all others have their default."""

    def __init__(self, problem: Problem, batch: _native.Batch, writer: Any) -> None:
        self._batch = batch
        self._problem = problem
        self._space: spaces.Space[Any] = writer.space
        self._plan = getattr(writer, "plan", None)
        self._masks = np.zeros(batch.choice_count(), np.uint8)
        self._table: dict[tuple[int, int], int] | None = None

    def flat(self) -> NDArray[np.bool_]:
        """(sum of categories,), one after the other."""
        parts = [part for part in self._parts() if part is not None]
        if not parts:
            raise Error("there is nothing to mask: the actions have no categories")
        return np.concatenate(parts)

    def for_space(self) -> Any:
        """As the action space's sample(mask) takes it: int8; None for what has no categories."""
        parts = [None if part is None else part.astype(np.int8) for part in self._parts()]
        space = self._space
        if isinstance(space, spaces.Discrete):
            return parts[0]
        if isinstance(space, spaces.MultiDiscrete):
            return tuple(parts)
        if not isinstance(space, spaces.Dict):
            return None
        if self._plan is None:
            return dict(zip(space.spaces, parts))
        discrete = space["discrete"]
        mask = parts[0] if isinstance(discrete, spaces.Discrete) else tuple(parts)
        return {"discrete": mask, "continuous": None}

    def _parts(self) -> list[NDArray[np.bool_] | None]:
        """Of each category in turn; None where a value has no categories."""
        self._batch.action_masks(self._masks)
        allowed = self._masks.astype(bool)
        plan = self._plan
        if plan is None:
            return self._parts_of_dictionary(allowed)
        if plan.picks:
            changes = [
                self._allowed(allowed, int(column), int(value))
                for column, value in zip(plan.columns[:-1], plan.values[:-1])
            ]
            part = np.array([*changes, allowed[0]])
            return [part] * plan.picks
        return [
            np.array([self._allowed(allowed, int(column), int(least) + k) for k in range(count)])
            for column, least, count in zip(plan.columns, plan.values, plan.category_counts)
        ]

    def _parts_of_dictionary(self, allowed: NDArray[np.bool_]) -> list[NDArray[np.bool_] | None]:
        parts: list[NDArray[np.bool_] | None] = []
        columns = columns_of(self._problem.model.actions)
        if len(columns) != len(self._space.spaces):  # type: ignore[attr-defined]
            return [None] * len(self._space.spaces)  # type: ignore[attr-defined]
        for index, space in enumerate(self._space.spaces.values()):  # type: ignore[attr-defined]
            if not isinstance(space, spaces.Discrete):
                parts.append(None)
                continue
            start, count = int(space.start), int(space.n)
            parts.append(
                np.array([self._allowed(allowed, index, start + k) for k in range(count)])
            )
        return parts

    def _allowed(self, allowed: NDArray[np.bool_], column: int, value: int) -> bool:
        """Changes that are no choice are numbers, of which nobody knows; the default is choice 0."""
        choice = self._choices().get((column, value))
        return bool(allowed[choice]) if choice is not None else self._is_free(allowed, column, value)

    def _is_free(self, allowed: NDArray[np.bool_], column: int, value: int) -> bool:
        is_default = self._defaults[column] == value
        return bool(allowed[0]) if is_default else True

    def _choices(self) -> dict[tuple[int, int], int]:
        """The simulator's choice that sets a column to a value, but for defaults."""
        if self._table is None:
            model = self._problem.model
            first, begin = {}, 0
            for fluent in model.actions:
                first[fluent.index] = begin
                begin += fluent.count
            self._table = {}
            for choice in range(1, len(self._masks)):
                fluent_index, grounding, value = self._batch.choice(choice)
                self._table[first[fluent_index] + grounding, value] = choice
            self._defaults = [
                each for fluent in model.actions for each in self._problem.constants(fluent.name)
            ]
        return self._table
