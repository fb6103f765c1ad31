"""Types of the learners' options, for editors and type checkers. Their ranges and meanings stand in the
table of the solvers, which help(rddlc.PPO) prints."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TypedDict


class LearnerOptions(TypedDict, total=False):
    threads: int
    seed: int
    memory_limit: int


class PPOOptions(LearnerOptions, total=False):
    imitate: str | os.PathLike[str] | None
    imitate_episodes: int
    preset: str
    steps: int
    environments: int
    rollout: int
    epochs: int
    minibatch: int
    learning_rate: float
    schedule: str
    gamma: float
    gae_lambda: float
    clip: float
    value_clip: float
    value_weight: float
    entropy: float
    gradient_norm: float
    target_kl: float
    noise: str
    sde_steps: int
    correlation: float
    log_std: float
    squash: bool | str
    curiosity: bool | str
    hidden: int | str | Sequence[int]
    activation: str
    stack: int
    recurrent: int
    segment: int
    time_input: bool | str
    bootstrap: bool | str


class DRPOptions(TypedDict, total=False):
    seed: int
    memory_limit: int
    steps: int
    episodes: int
    horizon: int
    learning_rate: float
    clip: float
    relax: str
    sharpness: float
    hidden: int | str | Sequence[int]
    activation: str
    time_input: bool | str


class CGPOptions(LearnerOptions, total=False):
    generations: int
    children: int
    nodes: int
    constants: int
    levels_back: int
    mutation: str
    functions: str | Sequence[str]
    episodes: int
    measure: str
    restart_after: int
    tune_every: int
    lifted: bool | str
    parsimony: bool | str
    time: bool | str
    compat: str
    islands: int
    migrate_every: int
