"""Many environments of a problem, stepped together."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from . import _native, causes
from .errors import EpisodeOver
from .learning import ChoiceActions, FlatReader
from .legal import legal_space
from .lifted import LiftedActions, LiftedRows
from .masks import ActionMasks
from .model import Model
from .problems import Problem, batch_horizon

AUTORESET = {AutoresetMode.DISABLED: 0, AutoresetMode.NEXT_STEP: 1, AutoresetMode.SAME_STEP: 2}
CAUSE_TEXTS = np.array(causes.TEXTS, object)


class RDDLVectorEnv(VectorEnv[Any, Any, NDArray[Any]]):
    """Environments of one problem in the batch engine, with threads of its own.

    Environment i of reset(seed=s) has the episodes of one `rddlc.make` with the seed s + i.
    """

    metadata: dict[str, Any] = {"render_modes": [], "autoreset_mode": AutoresetMode.NEXT_STEP}

    def __init__(
        self,
        problem: Problem,
        num_envs: int = 1,
        *,
        observations: str = "flat",
        actions: str = "simplified",
        normalize: bool = False,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        threads: int = 0,
        horizon: int | None = None,
        copy: bool = True,
    ) -> None:
        """See `rddlc.make_vec`, which loads the problem, too."""
        mode = AutoresetMode(autoreset_mode)
        self.metadata = {**self.metadata, "autoreset_mode": mode}
        self.problem, self.num_envs = problem, num_envs
        self._batch = _native.Batch(
            problem.simulator,
            environments=num_envs,
            threads=threads,
            autoreset=AUTORESET[mode],
            horizon=batch_horizon(horizon),
            records=observations == "dict",
            values=observations != "dict",
        )
        self._reader = self._new_reader(observations, normalize)
        self._writer = self._new_writer(actions, normalize)
        self._masks = ActionMasks(problem, self._batch, self._writer)
        self._mode, self._copies = mode, copy
        self._has_begun = False
        self._no_texts = np.full(num_envs, CAUSE_TEXTS[0], object)
        self.single_observation_space = self._reader.space
        self.single_action_space = self._writer.space
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        if problem.model.preconditions:
            self.action_space = legal_space(self.action_space, self._writer, num_envs)
        batch = self._batch
        is_view = getattr(self._reader, "is_view", False)
        self._engine_shape = batch.observation_values.shape if is_view else None
        self._rewards, self._causes = batch.rewards, batch.causes
        self._terminated, self._truncated = batch.terminated, batch.truncated

    def _new_reader(self, observations: str, normalize: bool) -> Any:
        batch = self._batch
        if observations == "flat":
            return FlatReader(
                self.problem, batch.observation_values, batch.final_values, normalize=normalize
            )
        if observations == "dict":
            return LiftedRows(
                self.problem.model.observed, batch.observations, batch.final_observations
            )
        raise ValueError(f"observations is {observations!r}, which is neither 'flat' nor 'dict'")

    def _new_writer(self, actions: str, normalize: bool) -> Any:
        if actions == "dict":
            return LiftedActions(self.problem, self._batch)
        if actions in ("simplified", "box"):
            box = actions == "box"
            return ChoiceActions(self.problem, self._batch, box=box, normalize=normalize)
        raise ValueError(f"actions is {actions!r}, which is none of 'simplified', 'box' and 'dict'")

    @property
    def model(self) -> Model:
        return self.problem.model

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: Mapping[str, Any] | None = None,
    ) -> tuple[Any, dict[str, Any]]:
        """Starts episodes: of seed + i, or of the i-th seed; without seeds the next ones. options:
        {"reset_mask": (num_envs,) bool} starts them only there."""
        mask = None if options is None else options.get("reset_mask")
        if mask is not None and np.shape(mask) != (self.num_envs,):
            raise ValueError(f"reset_mask has the shape {np.shape(mask)}, not ({self.num_envs},)")
        if seed is None and not self._has_begun:
            seed = int(self.np_random.integers(1 << 62))
        if seed is not None:
            self._set_seeds(seed, mask)
        self._batch.reset(mask)
        self._has_begun = True
        return self._reader.rows(copy=self._copies), {}

    def _set_seeds(self, seed: int | Sequence[int | None], mask: NDArray[np.bool_] | None) -> None:
        if isinstance(seed, (int, np.integer)):
            self._np_random, self._np_random_seed = np.random.default_rng(seed), int(seed)
            seed = [int(seed) + i for i in range(self.num_envs)]
        if len(seed) != self.num_envs:
            raise ValueError(f"there are {len(seed)} seeds for {self.num_envs} environments")
        for place, each in enumerate(seed):
            if each is not None and (mask is None or mask[place]):
                self._batch.set_seeds(place, [each])

    def step(
        self, actions: Any
    ) -> tuple[Any, NDArray[Any], NDArray[Any], NDArray[Any], dict[str, Any]]:
        """One step of each. Where episodes end, infos["cause"] says why (`RDDLEnv.step`), with the
        mask infos["_cause"]. With same-step autoreset infos["final_obs"] are observations, rows of
        which mean something where infos["_final_obs"] is true.

        Raises ActionError, and has changed nothing then.
        """
        if not self._has_begun:
            raise EpisodeOver("no episode has begun: call reset() before step()")
        if not self._copies:
            any_ended = self._writer.step_rows(actions, None)
            results = (self._rewards, self._terminated, self._truncated)
            return self._reader.rows(copy=False), *results, self._infos() if any_ended else {}
        into = self._room()
        any_ended = self._writer.step_rows(actions, into)
        rows = self._reader.rows(copy=True) if into[0] is None else into[0]
        return rows, *into[1:], self._infos() if any_ended else {}

    def _room(self) -> tuple[Any, NDArray[Any], NDArray[Any], NDArray[Any]]:
        """New arrays for a step: observations (None if they are not the engine's values), rewards,
        terminated, truncated."""
        count = self.num_envs
        shape = self._engine_shape
        return (
            None if shape is None else np.empty(shape, np.float32),
            np.empty(count),
            np.empty(count, bool),
            np.empty(count, bool),
        )

    def _infos(self) -> dict[str, Any]:
        ended = self._causes != 0
        texts = self._no_texts.copy()  # few end in a step
        texts[ended] = CAUSE_TEXTS[self._causes[ended]]
        of_ends: dict[str, Any] = {"cause": texts, "_cause": ended}
        if self._mode != AutoresetMode.SAME_STEP:
            return of_ends
        final = self._reader.final_rows()
        return {"final_obs": final, "_final_obs": ended, "final_info": of_ends, "_final_info": ended}

    def action_masks(self) -> NDArray[np.bool_]:
        """(num_envs, sum of categories): see `RDDLEnv.action_masks`."""
        return self._masks.rows()

    def __str__(self) -> str:
        return f"<RDDLVectorEnv {self.problem.name}, num_envs={self.num_envs}>"
