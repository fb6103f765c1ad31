"""Records of the C interface as numpy sees them: a value of each grounding, an array of each fluent."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .model import Fluent

STORED: dict[str, np.dtype[Any]] = {
    "bool": np.dtype(np.int8),
    "int": np.dtype(np.int64),
    "real": np.dtype(np.float64),
}
"""A byte of a bool is 0 or 1, so it may as well have a sign."""


@dataclass(frozen=True)
class Column:
    """One value of a record: a grounding of a fluent."""

    name: str
    fluent: Fluent
    grounding: int

    @property
    def offset(self) -> int:
        """Bytes into its record."""
        return self.fluent.offset + self.grounding * STORED[self.fluent.scalar].itemsize

    @property
    def bounds(self) -> tuple[float, float]:
        """The bounds from the constraints, or else those of the type: 0 and 1, or the objects'
        indices."""
        fluent = self.fluent
        if fluent.objects is not None:
            return 0.0, float(len(fluent.objects) - 1)
        if fluent.scalar == "bool":
            return 0.0, 1.0
        lower, upper = -np.inf, np.inf
        if fluent.lower is not None and fluent.upper is not None:
            lower = float(fluent.lower.flat[self.grounding])
            upper = float(fluent.upper.flat[self.grounding])
        if fluent.scalar == "int":
            return float(np.ceil(lower)), float(np.floor(upper))
        return lower, upper

    @property
    def category_count(self) -> int | None:
        """How many values it has, if it is not a real nor an int without two bounds."""
        lower, upper = self.bounds
        if self.fluent.scalar == "real" or not np.isfinite([lower, upper]).all():
            return None
        return int(upper - lower) + 1


def columns_of(fluents: Sequence[Fluent]) -> list[Column]:
    """The columns in declaration order, and row-major within a fluent: as in matrices of values."""
    return [
        Column(name, fluent, grounding)
        for fluent in fluents
        for grounding, name in enumerate(fluent.groundings)
    ]


def grounded_view(records: NDArray[np.uint8], fluents: Sequence[Fluent]) -> NDArray[np.void]:
    """(n,) structured: a field for each value, without copying. records: (n, bytes)."""
    columns = columns_of(fluents)
    layout = np.dtype(
        {
            "names": [f"f{index}" for index in range(len(columns))],
            "formats": [STORED[column.fluent.scalar] for column in columns],
            "offsets": [column.offset for column in columns],
            "itemsize": records.shape[1],
        }
    )
    return np.ndarray(len(records), layout, records)


def lifted_views(
    records: NDArray[np.uint8], fluents: Sequence[Fluent]
) -> dict[str, NDArray[np.generic]]:
    """(n, *shape) of each fluent, at least (n, 1), without copying."""
    views = {}
    for fluent in fluents:
        stored = STORED[fluent.scalar]
        shape = fluent.shape or (1,)
        strides = [stored.itemsize] * len(shape)
        for axis in reversed(range(len(shape) - 1)):
            strides[axis] = strides[axis + 1] * shape[axis + 1]
        views[fluent.name] = np.ndarray(
            (len(records), *shape), stored, records, fluent.offset, (records.shape[1], *strides)
        )
    return views


def records_of(fluents: Sequence[Fluent], size: int, values: NDArray[Any]) -> NDArray[np.uint8]:
    """(n, size) of rows of values, of which whole numbers may be floats."""
    is_real = [column.fluent.scalar == "real" for column in columns_of(fluents)]
    records = np.zeros((len(values), size), np.uint8)
    view = grounded_view(records, fluents)
    for place, row in enumerate(values.tolist()):
        if row:
            view[place] = tuple(each if real else round(each) for each, real in zip(row, is_real))
    return records


def values_of(fluents: Sequence[Fluent], records: NDArray[np.uint8]) -> NDArray[np.float64]:
    """(n, columns)"""
    view = grounded_view(records, fluents)
    names = view.dtype.names or ()
    return np.stack([view[name].astype(np.float64) for name in names], axis=1)
