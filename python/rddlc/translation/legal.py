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

from .. import _native
from ..problems import Problem
from ..versions import sample_arguments
from .protocols import ActionWriter

Array = NDArray[Any]

TRIES = 4
"""Actions that are tried: a space may round a legal one to one that is not. If no action is legal in an
environment, the last one stays."""


def legal_space(
    space: spaces.Space[Any], writer: ActionWriter, problem: Problem, batch: _native.EnvPool
) -> spaces.Space[Any]:
    """The same space, whose `sample()` draws legal actions. With a mask it draws what the mask allows.

    Copies of it, and what is pickled, are the plain space: they belong to no environment.
    """
    kind: Any = type(space)
    legal = _blank(_legal_kind(kind))
    legal.__dict__.update(space.__dict__, _sampler=_Sampler(space, writer, problem, batch))
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
    """Draws by Gymnasium, and where that is illegal by the random policy of `rddl run`, which searches."""

    def __init__(
        self, space: spaces.Space[Any], writer: ActionWriter, problem: Problem, batch: _native.EnvPool
    ) -> None:
        self._space, self._writer, self._problem, self._batch = space, writer, problem, batch
        self._records = np.zeros_like(batch.actions)
        self._policy: _native.Policy | None = None  # made when it is needed

    def sample(self, draw: Callable[[], Any], random: np.random.Generator) -> Any:
        action = draw()
        for _ in range(TRIES):
            if not self._writer.violated(action).any():
                break
            action = self._legal_action(int(random.integers(1 << 32)))
        return action

    def _legal_action(self, number: int) -> Any:
        if self._policy is None:
            self._policy = _native.policy_named(self._problem.simulator, "random")
        self._policy.draw(self._batch, number, self._records)
        rows = self._writer.actions_of(self._records)
        if not isinstance(self._space, spaces.Dict):
            return _entry(self._space, rows)
        return {name: _entry(space, rows[name]) for name, space in self._space.spaces.items()}


def _entry(space: spaces.Space[Any], rows: Array) -> Any:
    if isinstance(space, spaces.Discrete):
        return rows.item() if space.dtype is None else space.dtype.type(rows.item())
    entry = rows.reshape(space.shape or ()).astype(space.dtype)
    return entry if not isinstance(space, spaces.Box) else np.clip(entry, space.low, space.high)
