"""Gymnasium spaces of fluents."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Mapping, Sequence
from copy import deepcopy
from typing import Any

import numpy as np
from gymnasium import spaces
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from ..model import Fluent, Model
from ..records import STORED, Column, columns_of
from ..versions import sample_arguments


class ActionDict(spaces.Dict):
    """Dictionaries of action values of which only `limit` may differ from their default."""

    def __init__(
        self, entries: Mapping[str, spaces.Space[Any]], defaults: Mapping[str, Any], limit: int
    ) -> None:
        super().__init__(OrderedDict(entries))
        self.defaults = {key: np.reshape(value, entries[key].shape or ()) for key, value in defaults.items()}
        self.limit = limit

    def changes(self, action: Mapping[str, Any]) -> int:
        """How many values differ from their default."""
        return sum(
            int(np.count_nonzero(np.asarray(action[key]) != default))
            for key, default in self.defaults.items()
            if key in action
        )

    def contains(self, x: Any) -> bool:
        return super().contains(x) and self.changes(x) <= self.limit

    def sample(self, mask: Any | None = None, probability: Any | None = None) -> dict[str, Any]:
        """A sample of each value; all but `limit` of them, which are drawn, get their default."""
        sampled = super().sample(*sample_arguments(mask, probability))
        sizes = [default.size for default in self.defaults.values()]
        kept = np.zeros(sum(sizes), bool)
        kept[self.np_random.permutation(kept.size)[: self.limit]] = True
        parts = np.split(kept, np.cumsum(sizes)[:-1])
        for (key, default), part in zip(self.defaults.items(), parts):
            if default.ndim:
                sampled[key] = np.where(part.reshape(default.shape), sampled[key], default)
                sampled[key] = sampled[key].astype(self.spaces[key].dtype)
            elif not part[0]:
                sampled[key] = np.int64(default)
        return sampled


class ActionDictBatch(spaces.Dict):
    """Actions of several environments, each of which is one of `single`."""

    def __init__(self, single: ActionDict, count: int) -> None:
        entries = ((key, batch_space(space, count)) for key, space in single.spaces.items())
        super().__init__(OrderedDict(entries))
        self.single, self.count = single, count

    def seed(self, seed: Any = None) -> Any:
        self.single.seed(seed if seed is None or isinstance(seed, dict) else int(seed))
        return super().seed(seed)

    def sample(self, mask: Any | None = None, probability: Any | None = None) -> dict[str, Any]:
        rows = [self.single.sample(*sample_arguments(mask, probability)) for _ in range(self.count)]
        return {key: np.stack([row[key] for row in rows]) for key in self.spaces}

    def contains(self, x: Any) -> bool:
        rows = range(self.count)
        return super().contains(x) and all(
            self.single.changes({key: value[row] for key, value in x.items()}) <= self.single.limit
            for row in rows
        )


@batch_space.register(ActionDict)
def _batch_of_action_dict(space: ActionDict, n: int = 1) -> ActionDictBatch:
    return ActionDictBatch(deepcopy(space), n)


def grounded_space(fluents: Sequence[Fluent], shape: tuple[int, ...] = ()) -> spaces.Dict:
    """A space for each value: Discrete for bools, objects and bounded ints, else a Box of that shape."""
    return _in_order({column.name: _space_of_value(column, shape) for column in columns_of(fluents)})


def lifted_space(fluents: Sequence[Fluent]) -> spaces.Dict:
    """A Box for each fluent, of its shape or (1,): int8 of bools, int64 of ints and objects,
    float64 of reals."""
    return _in_order({fluent.name: _space_of_fluent(fluent) for fluent in fluents})


def _in_order(entries: dict[str, spaces.Space[Any]]) -> spaces.Dict:
    """Gymnasium sorts the names of other mappings."""
    return spaces.Dict(OrderedDict(entries))


def action_space(model: Model, defaults: Mapping[str, Any], *, lifted: bool) -> spaces.Dict:
    """The space of action dictionaries; `defaults` by the same keys. Numbers have the shape (1,), as those of
    pyRDDLGym: its RandomAgent takes the first entry of each."""
    space = lifted_space(model.actions) if lifted else grounded_space(model.actions, (1,))
    limit = model.limited_actions
    return space if limit is None else ActionDict(space.spaces, defaults, limit)


def _space_of_value(column: Column, shape: tuple[int, ...]) -> spaces.Space[Any]:
    stored = STORED[column.fluent.scalar]
    lower, upper = column.bounds
    count = column.category_count
    if count is not None and count <= np.iinfo(np.int32).max:
        return spaces.Discrete(count, start=int(lower))
    return spaces.Box(lower, upper, shape, stored.type)


def _space_of_fluent(fluent: Fluent) -> spaces.Box:
    shape = fluent.shape or (1,)
    lower, upper = np.array([column.bounds for column in columns_of([fluent])]).T
    stored = STORED[fluent.scalar]
    return spaces.Box(_limits(lower, shape, stored), _limits(upper, shape, stored), shape, stored.type)


def _limits(bounds: NDArray[np.float64], shape: tuple[int, ...], stored: np.dtype[Any]) -> Any:
    """A bound in the form of Box, which takes an infinite bound of ints as a scalar only."""
    if stored.kind != "i":
        return bounds.reshape(shape)
    if (bounds == bounds[0]).all():
        return bounds[0] if np.isinf(bounds[0]) else int(bounds[0])
    most = 2.0**62
    return np.clip(bounds, -most, most).astype(stored).reshape(shape)
