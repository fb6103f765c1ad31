"""How policies act in environments: in what forms these show observations and take actions."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _native
from .environment import RDDLEnv
from .errors import ArgumentError, Error
from .problems import Problem
from .records import records_of
from .translation.readers import dictionary_reader
from .vector import RDDLVectorEnv

Environment = RDDLEnv | RDDLVectorEnv


def environment_in(given: Any) -> Environment | None:
    """The environment within wrappers of Gymnasium or Stable-Baselines3; None: there is none."""
    inner = getattr(given, "unwrapped", given)
    inner = inner if isinstance(inner, Environment) else getattr(inner, "env", None)
    return inner if isinstance(inner, Environment) else None


def problem_in(given: Any) -> Problem:
    """The problem, or that of an environment."""
    if isinstance(given, Problem):
        return given
    env = environment_in(given)
    if env is None:
        raise ArgumentError(
            f"learners and planners take an environment of rddlc or an rddlc.Problem, not a "
            f"{type(given).__name__}"
        )
    return env.problem


def shows(env: Environment, observation: Any) -> bool:
    """Whether that is what the environment shows now."""
    reader = env._reader
    shown = reader.read() if isinstance(env, RDDLEnv) else reader.rows(copy=False)
    if not isinstance(shown, dict):
        return np.array_equal(shown, observation)
    return (
        isinstance(observation, dict)
        and shown.keys() == observation.keys()
        and all(np.array_equal(value, observation[name]) for name, value in shown.items())
    )


def batch_at(env: Environment, observation: Any) -> _native.EnvPool:
    """Environments where that is observed, at the start of an episode."""
    model = env.model
    if model.partially_observed:
        raise Error(
            "the problem is partially observed, and the observation is not the present one of the "
            "environment: predict(env)"
        )
    try:
        values = env._reader.values(observation)
    except (KeyError, TypeError, ValueError, IndexError):
        raise ArgumentError(
            f"an observation is one of {env._reader.space}, or rows of them"
        ) from None
    records = records_of(model.states, model.state_size, values)
    batch = _native.EnvPool(env.problem.simulator, environments=len(records), values=False)
    batch.reset()
    places = np.arange(len(records))
    batch.write_states(places, records, np.zeros_like(places))
    return batch


def actions_in(env: Environment, records: NDArray[np.uint8], *, is_single: bool) -> Any:
    """The actions of records as env.step takes them: of one environment, or rows."""
    if env._writer.plan is None:
        lifted = not isinstance(env, RDDLEnv) or env._forms["vectorized"]
        reader = dictionary_reader(env.model.actions, records, lifted=lifted)
        return _in_shape(env, reader.read()) if is_single else reader.rows(copy=True)
    rows = env._writer.actions_of(records)
    if not is_single:
        return rows
    return {name: row[0] for name, row in rows.items()} if isinstance(rows, dict) else rows[0]


def _in_shape(env: Environment, action: dict[str, Any]) -> dict[str, Any]:
    """The numbers of an action with the shape that they have in its space."""
    space: Any = env._writer.space
    return {
        name: np.reshape(value, space[name].shape) if isinstance(value, np.ndarray) else value
        for name, value in action.items()
    }
