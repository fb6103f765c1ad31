"""Values of fluents by name: {"pos___c1": 1.0, ...}, or arrays {"pos": [1.0, 2.0], ...}, or both."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..arguments import array_in, shown, whole
from ..errors import ArgumentError, Error
from ..model import Fluent
from ..problems import Problem
from ..records import Column, columns_of, grounded_view
from ..states import State

MOST_NESTED = 64  # lists in lists, as NumPy's arrays have dimensions; a list may hold itself


class NamedValues:
    """Reads them, and raises `error` for names and values that cannot be. what: "action"."""

    def __init__(
        self, fluents: list[Fluent], defaults: list[Any], what: str, error: type[Error]
    ) -> None:
        columns = columns_of(fluents)
        self._what, self._error = what, error
        self._defaults = defaults
        self._entries = [_Entry(column, what, error) for column in columns]
        self._place = {column.name: index for index, column in enumerate(columns)}
        self._lifted, begin = {}, 0
        for fluent in fluents:
            self._lifted[fluent.name] = (begin, fluent)
            begin += fluent.count

    def values(self, given: Mapping[str, Any]) -> list[Any]:
        """Returns the values of all columns, as Python numbers; missing names get their default."""
        values = list(self._defaults)
        try:
            items = given.items()
        except AttributeError:
            raise self._error(
                f"the {self._what} is a dictionary, not a {type(given).__name__}"
            ) from None
        for name, value in items:
            place = self._place.get(name)
            if place is not None:
                values[place] = self._entries[place].value(value)
            else:
                self._write_lifted(name, value, values)
        return values

    def _write_lifted(self, name: str, value: Any, values: list[Any]) -> None:
        if name not in self._lifted:
            raise self._error(
                f"there is no {self._what} '{name}'; there are {', '.join(list(self._place)[:8])}"
                f"{', ...' if len(self._place) > 8 else ''}"
            )
        begin, fluent = self._lifted[name]
        array = array_in(f"{self._what} '{name}'", value, self._error)
        if array.shape != fluent.shape:
            raise self._error(
                f"{self._what} '{name}' has the shape {fluent.shape}, not {array.shape}"
            )
        for place, each in enumerate(array.ravel().tolist(), begin):
            values[place] = self._entries[place].value(each)


class _Entry:
    """The type and bounds of a value."""

    def __init__(self, column: Column, what: str, error: type[Error]) -> None:
        self._name, self._error = f"{what} '{column.name}'", error
        self._objects = column.fluent.objects
        self._is_real = column.fluent.scalar == "real"
        self._kind = column.fluent.range
        self._lower, self._upper = column.bounds

    def value(self, given: Any) -> Any:
        """Returns a Python number. Arrays and lists of one element are that element."""
        for _ in range(MOST_NESTED):
            if not isinstance(given, (list, tuple)) or len(given) != 1:
                break
            given = given[0]
        if isinstance(given, str):
            return self._index_of(given)
        if isinstance(given, np.ndarray):
            if given.size != 1:
                raise self._error(
                    f"{self._name} is one value, not an array of shape {given.shape}"
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

    def _refusal(self, given: Any) -> Error:
        what = f"a {self._kind}"
        if self._objects is not None:
            what = f"one of {', '.join(self._objects)}, or its index"
        elif np.isfinite([self._lower, self._upper]).any() and self._kind != "bool":
            what += f" from {self._lower:g} to {self._upper:g}"
        return self._error(f"{self._name} is {shown(given)}, which is not {what}")


def default_values(problem: Problem, fluents: list[Fluent]) -> list[Any]:
    """The defaults of action-fluents, and the initial values of state-fluents, as Python numbers."""
    values: list[Any] = []
    for fluent in fluents:
        convert = float if fluent.scalar == "real" else int
        values += [convert(each) for each in problem.constants(fluent.name)]
    return values


def state_from(problem: Problem, values: Mapping[str, Any], steps: int) -> State:
    """Values that are absent are the initial ones."""
    model = problem.model
    defaults = default_values(problem, model.states)
    named = NamedValues(model.states, defaults, "state-fluent", ArgumentError)
    record = np.zeros((1, model.state_size), np.uint8)
    if row := tuple(named.values(values)):
        grounded_view(record, model.states)[0] = row
    return State(record.tobytes(), whole("steps", steps, 0), 0, problem.state_form.problem)
