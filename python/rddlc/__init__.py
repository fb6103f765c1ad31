"""RDDL problems as Gymnasium environments, stepped by simulators that rddlc compiles.

    import rddlc
    env = rddlc.make("MountainCar_ippc2023", "1")
"""

from __future__ import annotations

import os
from typing import Any

from . import causes
from .environment import RDDLEnv, State
from .errors import ActionError, CompileError, EpisodeOver, Error
from .model import Condition, Fluent, Model, ObjectType
from .problems import Problem, problems

__version__ = "0.2.0"

__all__ = [
    "ActionError",
    "CompileError",
    "Condition",
    "EpisodeOver",
    "Error",
    "Fluent",
    "Model",
    "ObjectType",
    "Problem",
    "RDDLEnv",
    "State",
    "causes",
    "make",
    "problems",
]

_OF_PROBLEM = ("engine", "externs", "extended")


def make(
    domain: str | os.PathLike[str] | Problem,
    instance: str | int | os.PathLike[str] | None = None,
    **options: Any,
) -> RDDLEnv:
    """A `gymnasium.Env` of a problem: two files, one file that holds both, a folder and an instance,
    a problem and an instance of rddlrepository, or a `Problem`.

    engine: "compiled" (default) or "interpreter"; externs, extended: see `Problem`.
    vectorized: keys are fluents and values arrays, instead of a key for each grounding.
    observations: "dict", or "flat": float32 (features,).
    actions: "dict"; "simplified": Discrete, MultiDiscrete, Box or both in a Dict, as pyRDDLGym-rl
        has them; "box": one Box of float32 from -1 to 1 for everything.
    normalize: flat observations with two bounds, and all numbers of simplified actions, are from -1
        to 1.
    enforce_action_constraints: a step that violates a precondition raises ActionError.
    enforce_action_count_non_bool: max-nondef-actions counts ints, objects and reals, too.
    action_mask: info["action_mask"] tells which actions satisfy the preconditions, in the form that
        action_space.sample(mask) takes.
    horizon: steps; None: the instance's; 0: none.
    render_mode: None, "rgb_array", "ansi" or "human" (a window, with pygame).
    render_size: width and height in pixels (600, 400). visualizer: see `rddl render`.

    Raises CompileError with the compiler's diagnostics, and Error where files are missing.
    """
    of_problem = {key: options.pop(key) for key in _OF_PROBLEM if key in options}
    if not isinstance(domain, Problem):
        domain = Problem(domain, instance, **of_problem)
    return RDDLEnv(domain, **options)
