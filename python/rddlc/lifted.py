"""Dictionaries of arrays for many environments: a key for each fluent, a row for each environment."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _native
from .dictionaries import lifted_defaults
from .errors import ActionError
from .model import Fluent
from .problems import Problem
from .records import lifted_views
from .spaces import ActionDict, action_space, lifted_space


class LiftedRows:
    """Reads observations {"pos": (n, *shape), ...}."""

    def __init__(
        self, fluents: list[Fluent], records: NDArray[np.uint8], final_records: NDArray[np.uint8]
    ) -> None:
        self.space = lifted_space(fluents)
        self._views = lifted_views(records, fluents)
        self._final_views = lifted_views(final_records, fluents)

    def rows(self, *, copy: bool) -> dict[str, NDArray[Any]]:
        return {name: view.copy() for name, view in self._views.items()} if copy else self._views

    def final_rows(self) -> dict[str, NDArray[Any]]:
        return {name: view.copy() for name, view in self._final_views.items()}


class LiftedActions:
    """Writes actions {"push": (n, *shape), ...}; fluents that are not there have their default."""

    def __init__(self, problem: Problem, batch: _native.VectorEnv) -> None:
        model = problem.model
        self._batch = batch
        self._views = lifted_views(batch.actions, model.actions)
        self._asked = batch.actions.copy()
        self._asked_views = lifted_views(self._asked, model.actions)
        self._defaults = lifted_defaults(problem)
        self.space = action_space(model, self._defaults, lifted=True)
        self.step = batch.step

    def step_rows(self, actions: Mapping[str, Any], into: Any) -> bool:
        """See `ChoiceActions.step_rows`."""
        self._batch.finish()
        self.write_rows(actions)
        return self.step(into)

    def write_rows(self, actions: Mapping[str, Any]) -> None:
        """Raises ActionError, and has changed nothing then."""
        self._write(self._checked_arrays(actions), self._views)

    def violated(self, actions: Mapping[str, Any]) -> NDArray[np.bool_]:
        """(n,):the first precondition that is violated, or -1."""
        self._write(self._checked_arrays(actions), self._asked_views)
        return np.array(self._batch.violated_preconditions(self._asked)) >= 0

    def default(self) -> dict[str, Any]:
        return self._defaults

    def _checked_arrays(self, actions: Mapping[str, Any]) -> dict[str, NDArray[Any]]:
        arrays = {name: self._checked(name, value) for name, value in actions.items()}
        if isinstance(self.space, ActionDict):
            self._check_limit(arrays, self.space.limit)
        return arrays

    def _write(self, arrays: Mapping[str, NDArray[Any]], views: Mapping[str, NDArray[Any]]) -> None:
        for name, view in views.items():
            view[:] = arrays.get(name, self._defaults[name])

    def _checked(self, name: str, value: Any) -> NDArray[Any]:
        if name not in self._views:
            raise ActionError(f"there is no action '{name}'; there are {', '.join(self._views)}")
        view, box = self._views[name], self.space[name]
        array = np.asarray(value)
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
