"""Actions that violate preconditions are refused, where an environment enforces these."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _native
from .errors import ActionError
from .problems import Problem
from .translation.protocols import ActionWriter


def check_preconditions(
    problem: Problem, batch: _native.EnvPool, writer: ActionWriter, actions: Any
) -> None:
    """Raises ActionError, which names the first environment, if there are several, and objects."""
    records = writer.records(actions)
    violated = np.flatnonzero(np.array(batch.violated_preconditions(records)) >= 0)
    if not len(violated):
        return
    place = int(violated[0])
    reason = _reason(problem, batch, place, records)
    raise ActionError(reason if len(records) == 1 else f"environment {place}: {reason}")


def _reason(problem: Problem, batch: _native.EnvPool, place: int, records: Any) -> str:
    if problem.has_details:
        batch.actions[:] = records
        return batch.explain_violation(place)
    single = _native.EnvPool(problem.detailed, values=False)
    single.reset()
    state = np.zeros(problem.model.state_size, np.uint8)
    batch.read_state(place, state)
    single.write_state(0, state, batch.progress(place)[0])
    single.actions[:] = records[place]
    return single.explain_violation(0)
