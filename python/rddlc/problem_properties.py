"""The properties of a problem that single environments and vectors share."""

from __future__ import annotations

from typing import Any

from .model import Model
from .problems import Problem


class ProblemProperties:
    """Reads the problem of an environment and the form that the caller asked for."""

    problem: Problem
    _forms: dict[str, Any]

    @property
    def model(self) -> Model:
        return self.problem.model

    @property
    def horizon(self) -> int:
        """Steps until an episode is cut off; 0: never."""
        given = self._forms["horizon"]
        return self.model.horizon if given is None else given

    @property
    def discount(self) -> float:
        return self.model.discount

    @property
    def max_allowed_actions(self) -> int:
        """How many action values may differ from their default."""
        return self.model.max_allowed_actions
