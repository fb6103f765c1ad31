"""Action spaces whose random actions satisfy the preconditions where an environment stands, as those of
`rddl run --policy random` do."""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from functools import cache
from typing import Any

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from ..versions import sample_arguments
from .protocols import ActionWriter

Array = NDArray[Any]

DRAWS = 8  # are made before values of an illegal action fall back to their default
TRIES = 128
"""Actions that are tried. If no action is legal in an environment, the last one stays."""


def legal_space(space: spaces.Space[Any], writer: ActionWriter, environments: int) -> spaces.Space[Any]:
    """The same space, whose `sample()` draws legal actions. With a mask it draws what the mask allows.

    Copies of it, and what is pickled, are the plain space: they belong to no environment.
    """
    kind: Any = type(space)
    legal = _blank(_legal_kind(kind))
    legal.__dict__.update(space.__dict__, _sampler=_Sampler(space, writer, environments))
    return legal


def go_on_from(space: spaces.Space[Any], other: spaces.Space[Any]) -> None:
    """`space` draws from now on what `other`, which is equal, would draw."""
    space.__dict__.update(deepcopy(other).__dict__)


class _Legal(spaces.Space[Any]):
    _sampler: _Sampler

    def sample(self, mask: Any | None = None, probability: Any | None = None) -> Any:
        if mask is not None or probability is not None:
            return super().sample(*sample_arguments(mask, probability))
        return self._sampler.sample(super().sample, self.np_random)

    def __reduce__(self) -> tuple[Any, ...]:
        plain = {name: value for name, value in self.__dict__.items() if name != "_sampler"}
        return _blank, (type(self).__bases__[1],), plain


@cache
def _legal_kind(kind: Any) -> Any:
    return type(kind.__name__, (_Legal, kind), {})


def _blank(kind: type[spaces.Space[Any]]) -> spaces.Space[Any]:
    return kind.__new__(kind)


class _Sampler:
    """Draws until an action is legal. After some draws, of the values that differ from their default
    half fall back to it, again and again; where not even the default action is legal, that begins
    anew with another draw.

    Rows are lists of arrays (environments, values), one for each entry of a dictionary.
    """

    def __init__(self, space: spaces.Space[Any], writer: ActionWriter, environments: int) -> None:
        self._writer, self._environments = writer, environments
        self._is_dict = isinstance(space, spaces.Dict)
        self._entries = dict(space.spaces) if isinstance(space, spaces.Dict) else {"": space}
        self._default: list[Array] | None = None

    def sample(self, draw: Callable[[], Any], random: np.random.Generator) -> Any:
        action = draw()
        illegal = self._writer.violated(action)
        if not illegal.any():
            return action
        rows, defaults = self._rows(action), self._defaults()
        for tried in range(1, TRIES):
            is_default = ~np.hstack([a != b for a, b in zip(rows, defaults)]).any(axis=1)
            renewed = illegal & ((tried < DRAWS) | is_default)
            fresh = self._rows(draw()) if renewed.any() else rows
            falling = (illegal & ~renewed)[:, None]
            rows = [
                np.where(falling & (random.random(row.shape) < 0.5), default, row)
                for row, default in zip(rows, defaults)
            ]
            rows = [np.where(renewed[:, None], new, row) for new, row in zip(fresh, rows)]
            illegal = self._writer.violated(self._action(rows))
            if not illegal.any():
                break
        return self._action(rows)

    def _rows(self, action: Any) -> list[Array]:
        entries = [action[name] for name in self._entries] if self._is_dict else [action]
        return [np.asarray(entry).reshape(self._environments, -1) for entry in entries]

    def _action(self, rows: list[Array]) -> Any:
        entries = [
            _entry(space, row) for space, row in zip(self._entries.values(), rows, strict=True)
        ]
        return dict(zip(self._entries, entries)) if self._is_dict else entries[0]

    def _defaults(self) -> list[Array]:
        """(values,) of each entry, as near to the default as the space goes."""
        if self._default is None:
            given = self._writer.default()
            entries = [given[name] for name in self._entries] if self._is_dict else [given]
            single = self._writer.space
            plain = (
                [single.spaces[name] for name in self._entries]
                if isinstance(single, spaces.Dict)
                else [single]
            )
            self._default = [_within(space, entry) for space, entry in zip(plain, entries)]
        return self._default


def _entry(space: spaces.Space[Any], row: Array) -> Any:
    if isinstance(space, spaces.Discrete):
        return row.item() if space.dtype is None else space.dtype.type(row.item())
    return row.reshape(space.shape or ()).astype(space.dtype)


def _within(space: spaces.Space[Any], value: Any) -> Array:
    """(values,)"""
    if isinstance(space, spaces.Discrete):
        start = int(space.start)
        value = np.clip(value, start, start + int(space.n) - 1)
    elif isinstance(space, spaces.MultiDiscrete):
        value = np.clip(value, 0, space.nvec - 1)
    elif isinstance(space, spaces.Box):
        value = np.clip(np.reshape(value, space.shape), space.low, space.high)
    return np.asarray(value, space.dtype).ravel()
