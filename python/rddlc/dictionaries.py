"""Observations and actions as dictionaries with pyRDDLGym's names, order and values."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from . import _native
from .errors import ActionError
from .model import Fluent
from .problems import Problem
from .records import Column, columns_of, grounded_view, lifted_views
from .spaces import ActionDict, action_space, grounded_space, lifted_space


class GroundedReader:
    """Reads {"pos___c1": value, ...} from the first record: reals are arrays of shape ()."""

    def __init__(self, fluents: list[Fluent], records: NDArray[np.uint8]) -> None:
        columns = columns_of(fluents)
        self.space = grounded_space(fluents)
        self._names = [column.name for column in columns]
        self._record = grounded_view(records, fluents)
        self._boxes = [
            (name, space.dtype) for name, space in self.space.items() if isinstance(space, spaces.Box)
        ]

    def read(self) -> dict[str, Any]:
        values = dict(zip(self._names, self._record.item()))
        for name, dtype in self._boxes:
            values[name] = np.array(values[name], dtype)
        return values


class LiftedReader:
    """Reads {"pos": array, ...} from the first record: arrays of the fluents' shapes, or (1,)."""

    def __init__(self, fluents: list[Fluent], records: NDArray[np.uint8]) -> None:
        self.space = lifted_space(fluents)
        self._views = [(name, view[0]) for name, view in lifted_views(records, fluents).items()]

    def read(self) -> dict[str, Any]:
        return {name: view.copy() for name, view in self._views}


class DictionaryActions:
    """Writes action dictionaries into the first record. Names may be grounded or lifted; missing
    values have their default. `limits_all`: whether max-nondef-actions also counts types other
    than bool."""

    def __init__(
        self, problem: Problem, batch: _native.Batch, *, lifted: bool, limits_all: bool
    ) -> None:
        model = problem.model
        columns = columns_of(model.actions)
        self._entries = [_Entry(column) for column in columns]
        self._batch = batch
        self._record = grounded_view(batch.actions, model.actions)
        self._asked = batch.actions.copy()
        self._asked_view = grounded_view(self._asked, model.actions)
        self._defaults = _defaults(problem)
        self._place = {column.name: index for index, column in enumerate(columns)}
        self._lifted = _ranges(model.actions)
        self._limit = model.limited_actions
        self._counted = [limits_all or column.fluent.scalar == "bool" for column in columns]
        by_name = dict(zip(self._place, self._defaults))
        self._default = lifted_defaults(problem) if lifted else by_name
        self.space = action_space(model, self._default, lifted=lifted)
        self.step = batch.step

    def write(self, action: Mapping[str, Any]) -> None:
        """Raises ActionError, and has changed nothing then."""
        values = self._values(action)
        if values:
            self._record[0] = tuple(values)

    def violated(self, action: Mapping[str, Any]) -> NDArray[np.bool_]:
        """(1,):the first precondition that is violated, or -1."""
        self._asked_view[0] = tuple(self._values(action))
        return np.array(self._batch.violated_preconditions(self._asked)) >= 0

    def default(self) -> dict[str, Any]:
        return self._default

    def _values(self, action: Mapping[str, Any]) -> list[Any]:
        values = list(self._defaults)
        try:
            items = action.items()
        except AttributeError:
            raise ActionError(f"an action is a dictionary, not a {type(action).__name__}") from None
        for name, value in items:
            place = self._place.get(name)
            if place is not None:
                values[place] = self._entries[place].value(value)
            else:
                self._write_lifted(name, value, values)
        if self._limit is not None:
            self._check_limit(values)
        return values

    def write_record(self) -> None:
        """The record is what `write` has written."""

    def _write_lifted(self, name: str, value: Any, values: list[Any]) -> None:
        if name not in self._lifted:
            raise ActionError(
                f"there is no action '{name}'; there are {', '.join(list(self._place)[:8])}"
                f"{', ...' if len(self._place) > 8 else ''}"
            )
        begin, fluent = self._lifted[name]
        array = np.asarray(value)
        if array.shape != fluent.shape:
            raise ActionError(
                f"action '{name}' has the shape {fluent.shape}, not {array.shape}"
            )
        for place, each in enumerate(array.ravel().tolist(), begin):
            values[place] = self._entries[place].value(each)

    def _check_limit(self, values: list[Any]) -> None:
        triples = zip(values, self._defaults, self._counted)
        changes = sum(counted and value != default for value, default, counted in triples)
        if changes > self._limit:
            raise ActionError(
                f"{changes} action values differ from their default, "
                f"and max-nondef-actions allows {self._limit}"
            )


class _Entry:
    """The type and bounds of an action value."""

    def __init__(self, column: Column) -> None:
        self._name = column.name
        self._objects = column.fluent.objects
        self._is_real = column.fluent.scalar == "real"
        self._kind = column.fluent.range
        self._lower, self._upper = column.bounds

    def value(self, given: Any) -> Any:
        """Returns a Python number. Arrays of one element are that element."""
        if isinstance(given, str):
            return self._index_of(given)
        if isinstance(given, np.ndarray):
            if given.size != 1:
                raise ActionError(
                    f"action '{self._name}' is one value, not an array of shape {given.shape}"
                )
            given = given.item()
        try:
            if not self._lower <= given <= self._upper:
                raise self._refusal(given)
            number = float(given) if self._is_real else int(given)
        except (TypeError, ValueError, OverflowError):
            raise self._refusal(given) from None
        if number != given:
            raise self._refusal(given)
        return number

    def _index_of(self, name: str) -> int:
        if self._objects is None or name.removeprefix("@") not in self._objects:
            raise self._refusal(name)
        return self._objects.index(name.removeprefix("@"))

    def _refusal(self, given: Any) -> ActionError:
        what = f"a {self._kind}"
        if self._objects is not None:
            what = f"one of {', '.join(self._objects)}, or its index"
        elif np.isfinite([self._lower, self._upper]).any() and self._kind != "bool":
            what += f" from {self._lower:g} to {self._upper:g}"
        return ActionError(f"action '{self._name}' is {given!r}, which is not {what}")


def _defaults(problem: Problem) -> list[Any]:
    """Returns all action values, as Python numbers."""
    values: list[Any] = []
    for fluent in problem.model.actions:
        convert = float if fluent.scalar == "real" else int
        values += [convert(each) for each in problem.constants(fluent.name)]
    return values


def lifted_defaults(problem: Problem) -> dict[str, Any]:
    """(*shape), or (1,), of each action-fluent."""
    return {
        fluent.name: np.reshape(problem.constants(fluent.name), fluent.shape or (1,))
        for fluent in problem.model.actions
    }


def _ranges(fluents: list[Fluent]) -> dict[str, tuple[int, Fluent]]:
    ranges, begin = {}, 0
    for fluent in fluents:
        ranges[fluent.name] = (begin, fluent)
        begin += fluent.count
    return ranges


__all__ = ["ActionDict", "DictionaryActions", "GroundedReader", "LiftedReader"]
