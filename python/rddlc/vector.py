"""Many environments of a problem, stepped together."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from . import _native, causes
from .arguments import SEEDS, one_of, options_of_reset, seed_of, seed_or_none, thread_count, whole
from .errors import ArgumentError, EpisodeOver
from .model import Model
from .problems import Problem, batch_horizon
from .states import State
from .translation.choice_actions import ChoiceActions
from .translation.dictionary_actions import LiftedActions
from .translation.legal import legal_space
from .translation.masks import ActionMasks
from .translation.protocols import ActionWriter
from .translation.readers import observation_reader

OBSERVATIONS = ("flat", "dict")
ACTIONS = ("simplified", "box", "dict")
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
        """See `rddlc.make_vec`, which also loads the problem."""
        mode = _mode_of(autoreset_mode)
        num_envs = whole("num_envs", num_envs, 1)
        self.metadata = {**self.metadata, "autoreset_mode": mode}
        self.problem, self.num_envs = problem, num_envs
        self._batch = _native.Batch(
            problem.simulator,
            environments=num_envs,
            threads=thread_count(threads),
            autoreset=AUTORESET[mode],
            horizon=batch_horizon(horizon),
            records=observations == "dict",
            values=observations != "dict",
        )
        self._reader = observation_reader(
            problem.model.observed,
            self._batch,
            flat=one_of("observations", observations, OBSERVATIONS) == "flat",
            lifted=True,
            normalize=normalize,
            by_values=actions != "dict",
        )
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
        self._engine_shape = batch.observation_values.shape if self._reader.is_view else None
        self._rewards, self._causes = batch.rewards, batch.causes
        self._terminated, self._truncated = batch.terminated, batch.truncated

    def _new_writer(self, actions: str, normalize: bool) -> ActionWriter:
        if one_of("actions", actions, ACTIONS) == "dict":
            return LiftedActions(self.problem, self._batch)
        return ChoiceActions(
            self.problem, self._batch, box=actions == "box", normalize=normalize
        )

    @property
    def model(self) -> Model:
        return self.problem.model

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: Mapping[str, Any] | None = None,
    ) -> tuple[Any, dict[str, Any]]:
        """Starts episodes with seed + i, or with the i-th seed; without seeds the next ones.
        options: {"reset_mask": (num_envs,) bool} starts them only there; {"state": State} starts
        them in that state, each with random numbers of its own, and {"state": [State or None, ...]}
        each in its own state, or in its initial one."""
        given = options_of_reset(options, ("reset_mask", "state"))
        mask = self._mask_of(given.get("reset_mask"))
        chosen = np.arange(self.num_envs) if mask is None else np.flatnonzero(mask)
        states = self._states_of(given.get("state"), chosen)
        if seed is None and not self._has_begun:
            seed = int(self.np_random.integers(1 << 62))
        if seed is not None:
            self._set_seeds(seed, chosen)
        self._batch.reset(mask)
        if states:
            self._enter(states)
        self._has_begun = True
        return self._reader.rows(copy=self._copies), {}

    def _mask_of(self, given: Any) -> NDArray[np.bool_] | None:
        if given is None:
            return None
        mask = np.ascontiguousarray(given)
        if mask.shape != (self.num_envs,) or mask.dtype != np.bool_:
            raise ArgumentError(
                f"reset_mask has the shape {mask.shape} of {mask.dtype}, not ({self.num_envs},) of bool"
            )
        return mask

    def _states_of(self, given: Any, chosen: NDArray[np.int64]) -> dict[int, State]:
        """Returns the states by the places of environments; a state that is over starts no episode."""
        if isinstance(given, State):
            states: Any = [given] * self.num_envs
        elif given is None or isinstance(given, (list, tuple)):
            states = given or []
        else:
            raise ArgumentError(f"a state is an rddlc.State, not a {type(given).__name__}")
        if given is not None and len(states) != self.num_envs:
            raise ArgumentError(f"there are {len(states)} states for {self.num_envs} environments")
        entered = {place: states[place] for place in chosen.tolist() if states and states[place] is not None}
        for state in {id(each): each for each in entered.values()}.values():
            self.problem.state_form.record_of(state)
            state.refuse_end()
        return entered

    def _enter(self, states: Mapping[int, State]) -> None:
        records = [self.problem.state_form.record_of(each) for each in states.values()]
        steps = np.array([each.steps for each in states.values()], np.int64)
        self._batch.write_states(np.array(list(states), np.int64), np.array(records), steps)

    def _set_seeds(self, seed: Any, chosen: NDArray[np.int64]) -> None:
        seeds = self._seeds_of(seed)
        if not _is_list(seed):
            self._np_random, self._np_random_seed = np.random.default_rng(seeds[0]), seeds[0]
        for place in chosen.tolist():
            if (its := seeds[place]) is not None:
                self._batch.set_seeds(place, [its])

    def _seeds_of(self, seed: Any) -> list[int | None]:
        """One for each environment; None: it continues with its own."""
        if not _is_list(seed):
            first = seed_of(seed)
            if first + self.num_envs > SEEDS:
                raise ArgumentError(f"seed is {first}: seed + {self.num_envs - 1} is beyond 64 bits")
            return [first + place for place in range(self.num_envs)]
        if len(seed) != self.num_envs:
            raise ArgumentError(f"there are {len(seed)} seeds for {self.num_envs} environments")
        return [seed_or_none(each) for each in seed]

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
            any_ended = self._writer.step(actions, None)
            results = (self._rewards, self._terminated, self._truncated)
            return self._reader.rows(copy=False), *results, self._infos() if any_ended else {}
        into = self._room()
        any_ended = self._writer.step(actions, into)
        rows = self._reader.rows(copy=True) if into[0] is None else into[0]
        return rows, *into[1:], self._infos() if any_ended else {}

    def _room(self) -> tuple[Any, NDArray[Any], NDArray[Any], NDArray[Any]]:
        """Returns new arrays for a step: observations (None if they are not the engine's values),
        rewards, terminated, truncated."""
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


def _mode_of(given: Any) -> AutoresetMode:
    if isinstance(given, AutoresetMode):
        return given
    return AutoresetMode(one_of("autoreset_mode", given, [each.value for each in AutoresetMode]))


def _is_list(given: Any) -> bool:
    return isinstance(given, Sequence) or (isinstance(given, np.ndarray) and given.ndim == 1)
