"""Masks of the actions that satisfy the preconditions."""

from __future__ import annotations

from typing import Any

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from .. import _native
from ..errors import Error
from ..problems import Problem
from .protocols import ActionWriter

ALWAYS = -1  # in place of a choice: unknown, so it is allowed
Change = tuple[int, int]  # a column of action values, and what it is set to


class ActionMasks:
    """For each environment of a batch and each category of an action: whether it is legal, while
    all others have their default."""

    def __init__(self, problem: Problem, batch: _native.EnvPool, writer: ActionWriter) -> None:
        self._problem, self._batch = problem, batch
        self._space, self._plan = writer.space, writer.plan
        self._is_prepared = False  # that takes a while, and few ask

    def rows(self) -> NDArray[np.bool_]:
        """(environments, sum of categories): those of one entry after those of the other."""
        self._prepare()
        if not len(self._choices):
            raise Error("there is nothing to mask: the actions have no categories")
        self._batch.action_masks(self._masks.ravel())
        allowed: NDArray[np.bool_] = self._masks[:, self._choices].astype(bool)
        return allowed | (self._choices == ALWAYS)

    def for_space(self) -> Any:
        """Returns the masks of the first environment as the action space's sample(mask) takes them:
        int8; None for entries without categories."""
        self._prepare()
        if not len(self._choices):
            return None
        counts = [count for count in self._counts if count]
        masks = iter(np.split(self.rows()[0].astype(np.int8), np.cumsum(counts)[:-1]))
        parts = tuple(next(masks) if count else None for count in self._counts)
        space = self._space
        if self._plan is not None and isinstance(space, spaces.Dict):
            is_one = isinstance(space["discrete"], spaces.Discrete)
            return {"discrete": parts[0] if is_one else parts, "continuous": None}
        if isinstance(space, spaces.Dict):
            return dict(zip(space.spaces, parts))
        return parts[0] if isinstance(space, spaces.Discrete) else parts

    def _prepare(self) -> None:
        if self._is_prepared:
            return
        self._is_prepared = True
        entries = self._entries()
        choice_of = self._choice_table()
        self._counts = [len(entry) for entry in entries]
        self._choices = np.array(
            [choice_of.get(change, ALWAYS) for entry in entries for change in entry], np.int64
        )
        environments = len(self._batch.rewards)
        self._masks = np.zeros((environments, self._batch.choice_count()), np.uint8)

    def _entries(self) -> list[list[Change]]:
        """The changes of each category of each entry of the space; nothing for numbers."""
        if self._plan is None:
            return self._entries_of_dictionary()
        plan = self._plan
        changes = [(int(column), int(value)) for column, value in zip(plan.columns, plan.values)]
        if plan.max_sub_actions:
            return [changes] * plan.max_sub_actions
        return [
            [(column, least + k) for k in range(count)]
            for (column, least), count in zip(changes, plan.category_counts)
        ]

    def _entries_of_dictionary(self) -> list[list[Change]]:
        entries: list[list[Change]] = []
        for column, space in enumerate(self._space.spaces.values()):  # type: ignore[attr-defined]
            is_category = isinstance(space, spaces.Discrete)
            start = int(space.start) if is_category else 0
            entries.append([(column, start + k) for k in range(int(space.n))] if is_category else [])
        return entries

    def _choice_table(self) -> dict[Change, int]:
        """The simulator's choice that makes a change; choice 0 for what changes nothing."""
        model = self._problem.model
        first = {fluent.index: 0 for fluent in model.actions}
        table: dict[Change, int] = {(-1, 0): 0}
        begin = 0
        for fluent in model.actions:
            first[fluent.index] = begin
            for grounding, default in enumerate(self._problem.constants(fluent.name)):
                if fluent.scalar != "real":
                    table[begin + grounding, int(default)] = 0
            begin += fluent.count
        for choice in range(1, self._batch.choice_count()):
            fluent_index, grounding, value = self._batch.choice(choice)
            table[first[fluent_index] + grounding, value] = choice
        return table
