"""Ids for Gymnasium: "rddlc/MountainCar_ippc2023-1-v0" is instance 1 of a problem of rddlrepository."""

from __future__ import annotations

import re

import gymnasium

from .problems import problems

ID = re.compile(r"[\w:.-]+")


def register_environments() -> None:
    """All problems that are there and not registered yet, for make and make_vec."""
    for problem in problems():
        for instance in problem.instances:
            name = f"rddlc/{problem.name}-{instance}-v0"
            if name in gymnasium.registry or not ID.fullmatch(f"{problem.name}-{instance}"):
                continue
            gymnasium.register(
                id=name,
                entry_point="rddlc:make",
                vector_entry_point="rddlc:make_vec",
                kwargs={"domain": problem.name, "instance": instance},
            )
