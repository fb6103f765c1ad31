"""The interfaces of the modules beside this one for environments."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from .action_plan import ActionPlan


class ObservationReader(Protocol):
    """Reads observations out of a batch."""

    @property
    def space(self) -> spaces.Space[Any]:
        """The observations of one environment."""

    @property
    def is_view(self) -> bool:
        """Whether rows may be the batch's own values, float32."""

    def read(self) -> Any:
        """A copy of the first environment's observation."""

    def rows(self, *, copy: bool) -> Any:
        """A row for each environment. Without a copy they may be the batch's own memory."""

    def values(self, observations: Any) -> NDArray[Any]:
        """(n, columns) of values that an observation, or rows of them, stand for. Raises KeyError or
        ValueError for those of another form."""

    def final_rows(self) -> Any:
        """Copies of the last observations of episodes; rows of other environments mean nothing."""


class ActionWriter(Protocol):
    """Writes actions into a batch: the action of its only environment, or a row for each one.

    Functions raise ActionError for an action that cannot be, and have changed nothing then.
    """

    @property
    def space(self) -> spaces.Space[Any]:
        """The actions of one environment."""

    @property
    def plan(self) -> ActionPlan | None:
        """How categories and numbers set action values; None: actions are dictionaries of values."""

    def step(self, actions: Any, into: Any = None) -> bool:
        """A step by these actions; `into`: see `_native.EnvPool.step`. Whether an episode has ended."""

    def violated(self, actions: Any) -> NDArray[np.bool_]:
        """(environments,): whether an action violates a precondition; nothing is changed."""

    def records(self, actions: Any) -> NDArray[np.uint8]:
        """(environments, bytes)"""

    def actions_of(self, records: NDArray[np.uint8]) -> Any:
        """A row of `space` for each record."""

    def default(self) -> Any:
        """The action of one environment that changes nothing."""
