"""RDDL problems as environments of RLlib (pip install "ray[rllib]").

    from rddlc import rllib
    config = PPOConfig().environment("rddlc", env_config=rllib.env_config("MountainCar_ippc2023", 1))

Importing this module registers "rddlc". A configuration is plain data: each process of a Ray cluster
loads the problem itself, from names, or from the texts of files that it need not have.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ray.tune.registry import register_env

from .. import _problem_of, make
from ..environment import RDDLEnv
from ..problems import files_of_texts

NAME = "rddlc"
FORMS: dict[str, Any] = {"observations": "flat", "actions": "box", "normalize": True}
"""The options of RLlib's default models; each may be overridden."""


def env_config(
    domain: str | os.PathLike[str],
    instance: str | int | os.PathLike[str] | None = None,
    **options: Any,
) -> dict[str, Any]:
    """The `env_config` of a problem: domain, instance and options as `rddlc.make` takes them. Of files
    it holds the texts, so that machines of a cluster need not share a file system; headers of
    external functions are named by their paths."""
    problem = _problem_of(domain, instance, dict(options), RDDLEnv)
    texts = {Path(file).name: Path(file).read_text() for file in problem.files}
    if len(texts) < len(problem.files):  # two files of one name, in two folders
        texts = {f"{place}-{Path(file).name}": Path(file).read_text()
                 for place, file in enumerate(problem.files)}
    return {"texts": texts, **options}


def create_env(config: Mapping[str, Any]) -> RDDLEnv:
    """An environment by an `env_config`: what `env_config` gives, or the arguments of `rddlc.make`."""
    options = {**FORMS, **config}
    texts = options.pop("texts", None)
    if texts is None:
        return make(options.pop("domain"), options.pop("instance", None), **options)
    return make(*files_of_texts(texts), **options)


register_env(NAME, create_env)
