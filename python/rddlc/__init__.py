"""RDDL problems as Gymnasium environments, stepped by simulators that rddlc compiles.

    import rddlc
    env = rddlc.make("MountainCar_ippc2023", "1")
"""

from __future__ import annotations

import os
from typing import Any

from . import _native, callbacks, causes, gradients, plan
from .arguments import keywords_of, refuse_unknown
from .environment import RDDLEnv
from .errors import ActionError, ArgumentError, CompileError, EpisodeOver, Error
from .evaluation import Estimate, Evaluation
from .learners import CGP, DRP, PPO, Learner
from .model import Condition, Fluent, Model, ObjectType
from .problems import Problem, problems
from .registration import register, register_environments, spec_of
from .states import State
from .vector import RDDLVectorEnv

__version__: str = _native.version

__all__ = [
    "ActionError",
    "ArgumentError",
    "CGP",
    "CompileError",
    "Condition",
    "DRP",
    "EpisodeOver",
    "Error",
    "Estimate",
    "Evaluation",
    "Fluent",
    "Learner",
    "Model",
    "ObjectType",
    "PPO",
    "Problem",
    "RDDLEnv",
    "RDDLVectorEnv",
    "State",
    "callbacks",
    "causes",
    "gradients",
    "make",
    "make_vec",
    "plan",
    "problems",
    "register",
]

_OF_PROBLEM = ("instance_name", "engine", "externs", "extended", "details")
_OF_PYRDDLGYM = ("backend", "backend_kwargs", "debug_path", "log_path")


def make(
    domain: str | os.PathLike[str] | Problem,
    instance: str | int | os.PathLike[str] | None = None,
    **options: Any,
) -> RDDLEnv:
    """A `gymnasium.Env` of a problem: two files, one file that holds both, a folder and an instance,
    their texts, a problem and an instance of rddlrepository, or a `Problem`.

    engine: "auto" (default), "compiled" or "interpreter"; instance_name, externs, extended, details: see
        `Problem`.
    vectorized: keys are fluents and values arrays, instead of a key for each grounding.
    observations: "dict", or "flat": float32 (features,).
    actions: "dict"; "simplified": Discrete, MultiDiscrete, Box or both in a Dict, as pyRDDLGym-rl
        has them; "box": one Box of float32 from -1 to 1 for everything.
    normalize: flat observations with two bounds, and all numbers of simplified actions, are from -1
        to 1.
    enforce_action_constraints: a step that violates a precondition raises ActionError.
    enforce_action_count_non_bool: max-nondef-actions also counts ints, objects and reals.
    action_mask: info["action_mask"] marks the actions that satisfy the preconditions, in the form
    that action_space.sample(mask) takes.
    horizon: steps, not negative; None: the instance's; 0: no horizon.
    render_mode: None, "rgb_array", "rgb_array_list", "ansi" or "human" (a window, with pygame).
    render_size: width and height in pixels (600, 400). visualizer: see `rddl render`.

    Raises CompileError with the compiler's diagnostics, and Error if files are missing.
    """
    problem = _problem_of(domain, instance, options, RDDLEnv)
    env = RDDLEnv(problem, **options)
    env.spec = spec_of(problem, env.horizon, options)
    return env


def make_vec(
    domain: str | os.PathLike[str] | Problem,
    instance: str | int | os.PathLike[str] | None = None,
    num_envs: int = 1,
    **options: Any,
) -> RDDLVectorEnv:
    """A `gymnasium.vector.VectorEnv` of `num_envs` environments in one batch; problems as in `make`.

    instance_name, engine, externs, extended, details, horizon, normalize, render_size, visualizer: as
        in `make`.
    observations: "flat" (default): float32 (num_envs, features); "dict": arrays (num_envs, *shape).
    actions: "simplified" (default), "box", or "dict" of arrays.
    autoreset_mode: "NextStep" (default), "SameStep" or "Disabled", or a Gymnasium AutoresetMode.
    enforce_action_constraints, action_mask: as in `make`; a mask is (num_envs, sum of categories).
    render_mode: None, "rgb_array" or "ansi": render() has a picture of each environment.
    threads: 0: one for each core.
    copy: whether arrays are copies; else they may be the engine's own memory, which the next step
        changes.
    """
    if (steps := options.pop("max_episode_steps", None)) is not None:  # Gymnasium's name of a horizon
        options["horizon"] = steps
    problem = _problem_of(domain, instance, options, RDDLVectorEnv)
    envs = RDDLVectorEnv(problem, num_envs, **options)
    envs.spec = spec_of(problem, envs.horizon, options)
    return envs


def _problem_of(domain: Any, instance: Any, options: dict[str, Any], taker: type[Any]) -> Problem:
    """Takes what is about loading out of the options. Refuses those that neither a problem nor
    `taker` has."""
    for name in _OF_PYRDDLGYM:
        if name in options:
            raise ArgumentError(f"{name} is an option of pyRDDLGym's environments: rddlc.backend.make makes them")
    refuse_unknown("option", options, (*_OF_PROBLEM, *keywords_of(taker.__init__)))
    of_problem = {key: options.pop(key) for key in _OF_PROBLEM if key in options}
    if not isinstance(domain, Problem):
        return Problem(domain, instance, **of_problem)
    if instance is not None or of_problem:
        given = ", ".join([*of_problem, *(["instance"] if instance is not None else [])])
        raise ArgumentError(f"the problem is loaded already: give {given} to rddlc.Problem")
    return domain


for maker, kind in ((make, RDDLEnv), (make_vec, RDDLVectorEnv)):
    setattr(maker, "metadata", kind.metadata)  # gymnasium.make reads the render modes there
for error in (ActionError, ArgumentError, CompileError, EpisodeOver, Error):
    error.__module__ = "rddlc"  # the name by which people catch it
register_environments()
