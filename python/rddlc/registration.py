"""Ids and specifications for Gymnasium: "rddlc/MountainCar_ippc2023-1-v0" is instance 1 of a problem of
rddlrepository, and people register their own files."""

from __future__ import annotations

import os
import re
from typing import Any

import gymnasium
from gymnasium.envs.registration import EnvSpec

from . import _native
from .arguments import keywords_of, refuse_unknown
from .environment import RDDLEnv
from .problems import Problem, problems
from .repository_names import known_instances
from .vector import RDDLVectorEnv

ID = re.compile(r"[\w:.-]+")


def register_environments() -> None:
    """All problems that are there and not registered yet, for make and make_vec. Without rddlrepository those
    that it has, so that make says what is missing."""
    there = [(each.name, instance) for each in problems() for instance in each.instances]
    for problem, instance in there or known_instances():
        name = f"rddlc/{problem}-{instance}-v0"
        if name not in gymnasium.registry and ID.fullmatch(f"{problem}-{instance}"):
            _register(name, {"domain": problem, "instance": instance})


def register(
    id: str,
    domain: str | os.PathLike[str],
    instance: str | int | os.PathLike[str] | None = None,
    **options: Any,
) -> None:
    """Lets `gymnasium.make(id)` and `gymnasium.make_vec(id, num_envs=N)` make environments of these
    files, texts or problems of rddlrepository. id: "Heater-v0" or "mine/Heater-v0". options: as
    `rddlc.make` and `make_vec` take them."""
    known = [*keywords_of(Problem.__init__), *keywords_of(RDDLEnv.__init__)]
    refuse_unknown("option", options, [*known, *keywords_of(RDDLVectorEnv.__init__)])
    places: list[Any] = [domain, instance]
    given = [os.path.abspath(each) if _is_file(each) else each for each in places]
    _register(id, {"domain": given[0], "instance": given[1], **options})


def _is_file(given: Any) -> bool:
    """Whether it is a path that exists: a process may change its folder before it makes anything."""
    is_path = isinstance(given, os.PathLike) or (isinstance(given, str) and "{" not in given)
    return is_path and os.path.exists(given) and (_native.is_path(given) or os.path.isfile(given))


def _register(id: str, arguments: dict[str, Any]) -> None:
    """gymnasium.make gives the environment itself, which shows itself in notebooks: what Gymnasium's
    wrappers would check, it refuses by itself."""
    gymnasium.register(
        id=id,
        entry_point="rddlc:make",
        vector_entry_point="rddlc:make_vec",
        order_enforce=False,
        disable_env_checker=True,
        kwargs=arguments,
    )


def spec_of(problem: Problem, horizon: int, options: dict[str, Any]) -> EnvSpec:
    """What `gymnasium.make` makes the same environment of."""
    domain, *instance = problem.files
    arguments = {"domain": domain, "instance": instance[0] if instance else None}
    return EnvSpec(
        id="rddlc/{}-v0".format(re.sub(r"[^\w:.-]", "_", problem.model.instance)),
        entry_point="rddlc:make",
        vector_entry_point="rddlc:make_vec",
        order_enforce=False,
        disable_env_checker=True,
        max_episode_steps=horizon or None,
        kwargs={**arguments, **problem.options, **options},
    )
