"""Callbacks of learn(), by Stable-Baselines3's names."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from .arguments import whole

if TYPE_CHECKING:
    from .learners import Learner

Callback = Callable[["Learner"], bool | None]
"""Called after each update; learning ends when it returns False."""


class CheckpointCallback:
    """Writes a policy file PREFIX_N_steps into a folder each `save_freq` steps or generations."""

    def __init__(
        self, save_freq: int, save_path: str | os.PathLike[str], name_prefix: str = "model"
    ) -> None:
        self._every = whole("save_freq", save_freq, 1)
        self._folder, self._prefix = Path(os.fsdecode(save_path)), name_prefix
        self._due = self._every

    def __call__(self, model: Learner) -> None:
        if model.steps >= self._due:
            self._due = (model.steps // self._every + 1) * self._every
            self._folder.mkdir(parents=True, exist_ok=True)
            model.save(self._folder / f"{self._prefix}_{model.steps}_steps{model.extension}")


class EvalCallback:
    """Evaluates the policy each `eval_freq` steps or generations, writes the best one into a folder,
    and ends learning at a mean return of `reward_threshold`."""

    def __init__(
        self,
        eval_freq: int,
        *,
        n_eval_episodes: int = 20,
        seed: int = 0,
        best_model_save_path: str | os.PathLike[str] | None = None,
        reward_threshold: float | None = None,
    ) -> None:
        self._every = whole("eval_freq", eval_freq, 1)
        self._episodes, self._seed = whole("n_eval_episodes", n_eval_episodes, 1), seed
        self._folder = None if best_model_save_path is None else Path(os.fsdecode(best_model_save_path))
        self._threshold = reward_threshold
        self._due = self._every
        self.best_mean_reward = float("-inf")
        self.last_mean_reward = float("-inf")

    def __call__(self, model: Learner) -> bool:
        if model.steps < self._due:
            return True
        self._due = (model.steps // self._every + 1) * self._every
        self.last_mean_reward = model.evaluate(self._episodes, seed=self._seed).returns.mean
        if self.last_mean_reward > self.best_mean_reward:
            self.best_mean_reward = self.last_mean_reward
            if self._folder is not None:
                self._folder.mkdir(parents=True, exist_ok=True)
                model.save(self._folder / f"best_model{model.extension}")
        return self._threshold is None or self.best_mean_reward < self._threshold
