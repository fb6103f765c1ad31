"""Writers of actions by dictionary, with pyRDDLGym's names and values."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import _native
from ..arguments import numbers_in
from ..errors import ActionError
from ..model import Model
from ..problems import Problem
from ..records import columns_of, grounded_view, lifted_views
from .fluent_spaces import ActionDict, action_space
from .named_values import NamedValues, default_values

Array = NDArray[Any]
Records = NDArray[np.uint8]


class DictionaryActions(ABC):
    """Values that a dictionary does not name have their default. The native writer takes what is
    common, and gives False for the rest: that is written, or refused with a reason, by Python."""

    plan = None

    def __init__(
        self, problem: Problem, batch: _native.EnvPool, counted: list[bool], *, grounded: bool
    ) -> None:
        model = problem.model
        self._fluents = model.actions
        self._batch, self._written, self._asked = batch, batch.actions, np.zeros_like(batch.actions)
        self._defaults = lifted_defaults(problem)
        for records in (self._written, self._asked):
            for name, view in lifted_views(records, model.actions).items():
                view[:] = self._defaults[name]
        columns, entries = _layout(model, counted, grounded=grounded)
        limit = -1 if model.limited_actions is None else model.limited_actions
        self.native, self._native_asked = (
            _native.DictionaryWriter(records, columns, entries, limit)
            for records in (self._written, self._asked)
        )

    def step(self, actions: Any, into: Any = None) -> bool:
        self._batch.finish()
        if not self.native.write(actions):
            self._write(actions, self._written)
        return self._batch.step(into)

    def violated(self, actions: Any) -> NDArray[np.bool_]:
        return np.array(self._batch.violated_preconditions(self.records(actions))) >= 0

    def records(self, actions: Any) -> Records:
        if not self._native_asked.write(actions):
            self._write(actions, self._asked)
        return self._asked

    def actions_of(self, records: Records) -> dict[str, Array]:
        return {name: view.copy() for name, view in lifted_views(records, self._fluents).items()}

    @abstractmethod
    def _write(self, actions: Any, records: Records) -> None:
        """Raises ActionError, and has changed nothing then."""


def _layout(
    model: Model, counted: list[bool], *, grounded: bool
) -> tuple[list[tuple[int, str, float, float, bool]], list[tuple[str, int, list[int], int]]]:
    """The columns of a record, and the names of them, as `_native.DictionaryWriter` takes both.
    Names of groundings come first where actions have them: in a complete dictionary in their order."""
    columns, first = columns_of(model.actions), 0
    entries: dict[str, tuple[str, int, list[int], int]] = {}
    if grounded:
        entries = {column.name: (column.name, place, [], 1) for place, column in enumerate(columns)}
    for fluent in model.actions:
        entries.setdefault(fluent.name, (fluent.name, first, list(fluent.shape), fluent.count))
        first += fluent.count
    layout = [(column.offset, column.fluent.scalar, *column.bounds, is_counted)
              for column, is_counted in zip(columns, counted)]
    return layout, list(entries.values())


class SingleActions(DictionaryActions):
    """The actions of one environment. Names may be grounded or lifted. `limits_all`: whether
    max-nondef-actions also counts ints, objects and reals."""

    def __init__(
        self, problem: Problem, batch: _native.EnvPool, *, lifted: bool, limits_all: bool
    ) -> None:
        model = problem.model
        columns = columns_of(model.actions)
        self._counted = [limits_all or column.fluent.scalar == "bool" for column in columns]
        super().__init__(problem, batch, self._counted, grounded=True)
        self._limit = model.limited_actions
        self._default_values = default_values(problem, model.actions)
        self._named = NamedValues(model.actions, self._default_values, "action", ActionError)
        by_name = dict(zip((column.name for column in columns), self._default_values))
        self._default = self._defaults if lifted else by_name
        self._lifted = lifted
        self.space = action_space(model, self._default, lifted=lifted)

    def default(self) -> dict[str, Any]:
        return self._default

    def actions_of(self, records: Records) -> dict[str, Array]:
        lifted = super().actions_of(records)
        if self._lifted:
            return lifted
        columns = ((fluent.groundings, lifted[fluent.name].reshape(len(records), -1)) for fluent in self._fluents)
        return {name: rows[:, place] for names, rows in columns for place, name in enumerate(names)}

    def _write(self, actions: Any, records: Records) -> None:
        values = self._named.values(actions)
        if self._limit is not None:
            self._check_limit(values)
        if values:
            grounded_view(records, self._fluents)[0] = tuple(values)

    def _check_limit(self, values: list[Any]) -> None:
        triples = zip(values, self._default_values, self._counted)
        changes = sum(counted and value != default for value, default, counted in triples)
        if changes > self._limit:
            raise ActionError(
                f"{changes} action values differ from their default, "
                f"and max-nondef-actions allows {self._limit}"
            )


class LiftedActions(DictionaryActions):
    """The actions {"push": (n, *shape), ...} of a batch."""

    def __init__(self, problem: Problem, batch: _native.EnvPool) -> None:
        model = problem.model
        counted = [True] * sum(fluent.count for fluent in model.actions)
        super().__init__(problem, batch, counted, grounded=False)
        self._views = lifted_views(batch.actions, model.actions)
        self.space = action_space(model, self._defaults, lifted=True)

    def default(self) -> dict[str, Any]:
        return self._defaults

    def _write(self, actions: Any, records: Records) -> None:
        if not isinstance(actions, Mapping):
            raise ActionError(f"actions are a dictionary, not a {type(actions).__name__}")
        arrays = {name: self._checked(name, value) for name, value in actions.items()}
        if isinstance(self.space, ActionDict):
            self._check_limit(arrays, self.space.limit)
        for name, view in lifted_views(records, self._fluents).items():
            view[:] = arrays.get(name, self._defaults[name])

    def _checked(self, name: str, value: Any) -> NDArray[Any]:
        if name not in self._views:
            raise ActionError(f"there is no action '{name}'; there are {', '.join(self._views)}")
        view, box = self._views[name], self.space[name]
        array = numbers_in(f"action '{name}'", value, ActionError)
        if array.size != view.size:
            raise ActionError(f"action '{name}' has the shape {view.shape}, not {array.shape}")
        array = array.reshape(view.shape)
        if view.dtype.kind == "i" and array.dtype.kind == "f" and (array != np.floor(array)).any():
            raise ActionError(f"action '{name}' holds numbers that are not whole")
        if not ((array >= box.low) & (array <= box.high)).all():  # type: ignore[attr-defined]
            raise ActionError(f"action '{name}' holds values outside {box}")
        return array

    def _check_limit(self, arrays: Mapping[str, NDArray[Any]], limit: int) -> None:
        changes = sum(
            (array != self._defaults[name]).reshape(len(array), -1).sum(axis=1)
            for name, array in arrays.items()
        )
        if np.max(changes, initial=0) > limit:
            raise ActionError(
                f"{np.max(changes)} action values of an environment differ from their default, "
                f"and max-nondef-actions allows {limit}"
            )


def lifted_defaults(problem: Problem) -> dict[str, Any]:
    """(*shape), or (1,), of each action-fluent."""
    return {
        fluent.name: np.reshape(problem.constants(fluent.name), fluent.shape or (1,))
        for fluent in problem.model.actions
    }
