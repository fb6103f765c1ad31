"""Readers of observations: dictionaries with pyRDDLGym's names and order, and rows of numbers."""

from __future__ import annotations

import math
from collections import OrderedDict
from typing import Any

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from .. import _native
from ..model import Fluent
from ..records import Column, columns_of, grounded_view, lifted_views
from .fluent_spaces import grounded_space, lifted_space
from .protocols import ObservationReader

Array = NDArray[Any]
Records = NDArray[np.uint8]
LEAST_SINGLE, MOST_SINGLE = (float(each) for each in (np.finfo(np.float32).tiny, np.finfo(np.float32).max))


def dictionary_reader(
    fluents: list[Fluent], records: Records, final_records: Records | None = None, *, lifted: bool
) -> ObservationReader:
    """lifted: a key for each fluent, and arrays; else a key for each grounding."""
    final = records if final_records is None else final_records
    return (LiftedReader if lifted else GroundedReader)(fluents, records, final)


def observation_reader(
    fluents: list[Fluent],
    batch: _native.EnvPool,
    *,
    flat: bool,
    lifted: bool,
    normalize: bool,
    by_values: bool,
) -> ObservationReader:
    """flat: rows of numbers; else dictionaries. by_values: whether actions are rows of values; steps by
    records leave the last observations of episodes as records alone."""
    if flat:
        final = batch.final_values if by_values else grounded_view(batch.final_observations, fluents)
        return FlatReader(fluents, batch.observation_values, final, normalize=normalize)
    return dictionary_reader(fluents, batch.observations, batch.final_observations, lifted=lifted)


class LearnersReader:
    """Reads the dictionaries of another reader as learners take them ("MultiInputPolicy" of
    Stable-Baselines3), and pyRDDLGym-rl gives them: numbers are float32, of the shape (1,) in place of (),
    and ints with bounds are counted from 0."""

    is_view = False

    def __init__(self, reader: ObservationReader) -> None:
        self._reader = reader
        given: Any = reader.space
        self._least = {
            name: int(space.start) if isinstance(space, spaces.Discrete) else 0
            for name, space in given.items()
        }
        self._entries: dict[str, Any] = {name: _learners_space(space) for name, space in given.items()}
        self.space = spaces.Dict(OrderedDict(self._entries))

    def read(self) -> dict[str, Any]:
        return self._as_learners_take(self._reader.read())

    def rows(self, *, copy: bool) -> dict[str, Any]:
        return self._as_learners_take(self._reader.rows(copy=copy), -1)

    def final_rows(self) -> dict[str, Any]:
        return self._as_learners_take(self._reader.final_rows(), -1)

    def values(self, observations: Any) -> Array:
        return self._reader.values({name: observations[name] + least for name, least in self._least.items()})

    def _as_learners_take(self, values: dict[str, Any], *rows: int) -> dict[str, Any]:
        return {
            name: values[name] - self._least[name]
            if isinstance(space, spaces.Discrete)
            else np.reshape(values[name], (*rows, *space.shape)).astype(np.float32)
            for name, space in self._entries.items()
        }


def _learners_space(space: Any) -> spaces.Space[Any]:
    if isinstance(space, spaces.Discrete):
        return spaces.Discrete(int(space.n))
    lower, upper = (np.reshape(each, space.shape or (1,)) for each in (space.low, space.high))
    return spaces.Box(lower.astype(np.float32), upper.astype(np.float32), dtype=np.float32)


class GroundedReader:
    """Reads {"pos___c1": value, ...}: reals are arrays of shape (). Rows are {"pos___c1": (n,), ...}."""

    is_view = False

    def __init__(self, fluents: list[Fluent], records: Records, final_records: Records) -> None:
        columns = columns_of(fluents)
        self.space = grounded_space(fluents)
        self._names = [column.name for column in columns]
        self._view, self._final_view = (
            grounded_view(each, fluents) for each in (records, final_records)
        )
        named = [
            (column.name, column.offset, column.fluent.scalar, isinstance(self.space[column.name], spaces.Box))
            for column in columns
        ]
        self.native = _native.DictionaryReader(records, named)

    def read(self) -> dict[str, Any]:
        return self.native.read()

    def rows(self, *, copy: bool) -> dict[str, Array]:
        return self._rows(self._view.copy() if copy else self._view)

    def final_rows(self) -> dict[str, Array]:
        return self._rows(self._final_view.copy())

    def values(self, observations: Any) -> Array:
        return np.column_stack([np.ravel(observations[name]) for name in self._names])

    def _rows(self, view: NDArray[np.void]) -> dict[str, Array]:
        return {name: view[f"f{place}"] for place, name in enumerate(self._names)}


class LiftedReader:
    """Reads {"pos": (*shape), ...} or {"pos": (n, *shape), ...}; a shape is never ()."""

    is_view = False

    def __init__(self, fluents: list[Fluent], records: Records, final_records: Records) -> None:
        self.space = lifted_space(fluents)
        self._views = lifted_views(records, fluents)
        self._final_views = lifted_views(final_records, fluents)

    def read(self) -> dict[str, Any]:
        return {name: view[0].copy() for name, view in self._views.items()}

    def rows(self, *, copy: bool) -> dict[str, Array]:
        return {name: view.copy() for name, view in self._views.items()} if copy else self._views

    def final_rows(self) -> dict[str, Array]:
        return {name: view.copy() for name, view in self._final_views.items()}

    def values(self, observations: Any) -> Array:
        counts = {name: view[0].size for name, view in self._views.items()}
        return np.hstack([np.reshape(observations[name], (-1, counts[name])) for name in counts])


class FlatReader:
    """Rows of float32 (n, features): bools are 0 and 1, objects a feature for each object (1 for the
    one that it is), numbers themselves. `normalize`: those with two bounds are -1 at the lower and 1
    at the upper one."""

    def __init__(
        self, fluents: list[Fluent], values: Array, final_values: Array, *, normalize: bool
    ) -> None:
        self._values, self._first, self._final_values = values, values[0], final_values
        self._columns = [_ColumnFeatures(column, normalize) for column in columns_of(fluents)]
        self._writer = _native.FeatureWriter([each.native for each in self._columns])
        self.is_view = not normalize and not any(each.objects for each in self._columns)
        self.names = [name for each in self._columns for name in each.names]
        lower, upper = np.array([limits for each in self._columns for limits in each.limits]).reshape(-1, 2).T
        with np.errstate(over="ignore"):  # a bound that no float32 has is infinite
            self.space = spaces.Box(lower.astype(np.float32), upper.astype(np.float32), dtype=np.float32)

    def rows(self, *, copy: bool) -> Array:
        """(n, features)"""
        if self.is_view:
            return self._values.copy() if copy else self._values
        return self._features(self._values)

    def final_rows(self) -> Array:
        """(n, features)"""
        final = self._final_values
        if final.dtype.names is not None:  # records
            final = np.stack([final[name] for name in final.dtype.names], axis=1)
        return self._features(final.astype(np.float32))

    def _features(self, rows: Array) -> Array:
        features = np.empty((len(rows), self._writer.width), np.float32)
        self._writer.write(rows, features, len(rows))
        return features

    def read(self) -> Array:
        """(features,)"""
        if self.is_view:
            return self._first.copy()
        features = np.empty(self._writer.width, np.float32)
        self._writer.write(self._first, features, 1)
        return features

    def values(self, observations: Any) -> Array:
        rows = np.reshape(observations, (-1, self._writer.width))
        columns: list[Array] = []
        first = 0
        for column in self._columns:
            features = rows[:, first : first + len(column.names)]
            columns.append(features.argmax(axis=1) if column.objects else features[:, 0] * column.half + column.middle)
            first += len(column.names)
        return np.stack(columns, axis=1)


class _ColumnFeatures:
    """The features of a column, of which `limits` are the bounds: (value - middle) / half, also of the 0 and 1
    that say whether it is an object. Those of values `inside` are from -1 to 1."""

    def __init__(self, column: Column, normalize: bool) -> None:
        self.objects = column.fluent.objects or ()
        self.names = [f"{column.name}={each}" for each in self.objects] or [column.name]
        lower, upper = (0.0, 1.0) if self.objects else column.bounds
        self.middle, self.half = 0.0, 1.0
        middle, half = lower / 2 + upper / 2, upper / 2 - lower / 2
        self.inside = math.inf, -math.inf
        # Not if a bound is infinite.
        if normalize and LEAST_SINGLE <= half <= MOST_SINGLE and abs(middle) <= MOST_SINGLE:
            self.middle, self.half, self.inside = middle, half, (lower, upper)
            lower, upper = -1.0, 1.0
        self.limits = [(lower, upper)] * len(self.names)

    @property
    def native(self) -> tuple[int, float, float, float, float]:
        return len(self.objects), self.middle, self.half, *self.inside
