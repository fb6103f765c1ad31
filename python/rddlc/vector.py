"""Many environments of a problem, stepped together.

Over 400 lines: one class with the whole interface of gymnasium's vector environments.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from copy import deepcopy
from typing import Any

import gymnasium
import numpy as np
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from . import _native, causes
from .arguments import (
    SEEDS,
    one_of,
    options_of_reset,
    seed_of,
    seed_or_none,
    size_of,
    thread_count,
    whole,
    whole_or_none,
)
from .errors import ArgumentError, EpisodeOver, Error
from .preconditions import check_preconditions
from .problem_properties import ProblemProperties
from .problems import Problem, batch_horizon
from .rendering import Renderer
from .states import State
from .translation.choice_actions import ChoiceActions
from .translation.dictionary_actions import LiftedActions
from .translation.legal import go_on_from, legal_space
from .translation.masks import ActionMasks
from .translation.named_values import state_from
from .translation.protocols import ActionWriter
from .translation.readers import dictionary_reader, observation_reader
from .versions import HAS_VECTORS, AutoresetMode, VectorBase

OBSERVATIONS = ("flat", "dict")
ACTIONS = ("simplified", "box", "dict")
AUTORESET = {AutoresetMode.DISABLED: 0, AutoresetMode.NEXT_STEP: 1, AutoresetMode.SAME_STEP: 2}
CAUSE_TEXTS = np.array(causes.TEXTS, object)


class RDDLVectorEnv(ProblemProperties, VectorBase):
    """Environments of one problem in the batch engine, with threads of its own.

    Environment i of reset(seed=s) has the episodes of one `rddlc.make` with the seed s + i.
    """

    metadata: dict[str, Any] = {
        "render_modes": ["rgb_array", "ansi"],
        "render_fps": 10,
        "autoreset_mode": AutoresetMode.NEXT_STEP,
    }

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
        enforce_action_constraints: bool = False,
        action_mask: bool = False,
        render_mode: str | None = None,
        render_size: tuple[int, int] = (600, 400),
        visualizer: str = "",
    ) -> None:
        """See `rddlc.make_vec`, which also loads the problem."""
        if not HAS_VECTORS:
            raise Error(
                "vectors of environments need gymnasium 1.0 or later, and this is "
                f"{gymnasium.__version__}; single ones do not: rddlc.make"
            )
        self._forms = {
            "observations": one_of("observations", observations, OBSERVATIONS),
            "actions": one_of("actions", actions, ACTIONS),
            "normalize": normalize,
            "autoreset_mode": _mode_of(autoreset_mode),
            "threads": thread_count(threads),
            "horizon": whole_or_none("horizon", horizon, 0),
            "copy": copy,
            "enforce_action_constraints": enforce_action_constraints,
            "action_mask": action_mask,
            "render_mode": render_mode,
            "render_size": render_size,
            "visualizer": visualizer,
        }
        self.problem, self.num_envs = problem, whole("num_envs", num_envs, 1)
        self.render_mode = one_of("render_mode", render_mode, (None, *self.metadata["render_modes"]))
        self.metadata = {**self.metadata, "autoreset_mode": self._forms["autoreset_mode"]}
        self._batch = _native.EnvPool(
            problem.simulator,
            environments=self.num_envs,
            threads=self._forms["threads"] if self.num_envs > 1 else 1,
            autoreset=AUTORESET[self._forms["autoreset_mode"]],
            horizon=batch_horizon(horizon),
            records=observations == "dict",
            values=observations != "dict",
        )
        self._seeds: list[int | None] = [None] * self.num_envs
        self._renderer: Renderer | None = None
        if render_mode is not None:
            self._renderer = Renderer(
                problem.simulator, size_of(render_size), visualizer, self.metadata["render_fps"]
            )
        self._connect()

    def _connect(self) -> None:
        """Binds everything that reads the batch's arrays."""
        batch, forms = self._batch, self._forms
        self._reader = observation_reader(
            self.model.observed,
            batch,
            flat=forms["observations"] == "flat",
            lifted=True,
            normalize=forms["normalize"],
            by_values=forms["actions"] != "dict",
        )
        self._writer = self._new_writer()
        self._masks = ActionMasks(self.problem, batch, self._writer)
        self._mode, self._copies = forms["autoreset_mode"], forms["copy"]
        self._enforces, self._tells_mask = forms["enforce_action_constraints"], forms["action_mask"]
        self._has_begun = False
        self._no_texts = np.full(self.num_envs, CAUSE_TEXTS[0], object)
        self.single_observation_space = self._reader.space
        self.single_action_space = self._writer.space
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)
        if self.model.preconditions:
            self.action_space = legal_space(self.action_space, self._writer, self.problem, batch)
        self._engine_shape = batch.observation_values.shape if self._reader.is_view else None
        self._rewards, self._causes = batch.rewards, batch.causes
        self._terminated, self._truncated = batch.terminated, batch.truncated

    def _new_writer(self) -> ActionWriter:
        form = self._forms["actions"]
        if form == "dict":
            return LiftedActions(self.problem, self._batch)
        return ChoiceActions(
            self.problem, self._batch, box=form == "box", normalize=self._forms["normalize"]
        )

    # ---- what the problem says of itself

    @property
    def state(self) -> dict[str, NDArray[Any]]:
        """{"pos": (num_envs, *shape), ...}: the true states, also where they are not observed."""
        records = self._read_states()[0]
        return dictionary_reader(self.model.states, records, lifted=True).rows(copy=False)

    @property
    def timesteps(self) -> NDArray[np.int64]:
        """(num_envs,): steps made in the episodes."""
        return self._read_states()[1]

    def call(self, name: str, *arguments: Any, **options: Any) -> tuple[Any, ...]:
        """A result for each environment: of an attribute that they share (horizon, discount, model,
        ...), or of state, timestep, get_state, render and action_masks, which each has of its own."""
        own: dict[str, Callable[..., Any]] = {
            "state": self._state_rows,
            "timestep": lambda: self.timesteps.tolist(),
            "get_state": self.get_states,
            "render": self.render,
            "action_masks": self.action_masks,
        }
        if name in own:
            rows = own[name](*arguments, **options)
            return (None,) * self.num_envs if rows is None else tuple(rows)
        shared = getattr(self, {"action_space": "single_action_space",
                                "observation_space": "single_observation_space"}.get(name, name))
        if callable(shared) or arguments or options:
            raise ArgumentError(f"there is no function {name} of each environment; there are get_state, "
                                "render, action_masks")
        return (shared,) * self.num_envs

    def get_attr(self, name: str) -> tuple[Any, ...]:
        """Does the same as `call` without arguments."""
        return self.call(name)

    def _state_rows(self) -> list[dict[str, Any]]:
        state = self.state
        return [{name: rows[place] for name, rows in state.items()} for place in range(self.num_envs)]

    # ---- episodes

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
        return self._reader.rows(copy=self._copies), self._mask_infos()

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
                self._set_seed(place, its)

    def _set_seed(self, place: int, seed: int) -> None:
        self._seeds[place] = seed
        self._batch.set_seeds(place, [seed])

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
        if self._enforces:
            check_preconditions(self.problem, self._batch, self._writer, actions)
        into = self._new_results() if self._copies else None
        any_ended = self._writer.step(actions, into)
        infos = self._infos(any_ended) if any_ended or self._tells_mask else {}
        if into is None:
            results = self._rewards, self._terminated, self._truncated
            return self._reader.rows(copy=False), *results, infos
        rows = self._reader.rows(copy=True) if into[0] is None else into[0]
        return rows, *into[1:], infos

    def _new_results(self) -> tuple[Any, NDArray[Any], NDArray[Any], NDArray[Any]]:
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

    def _mask_infos(self) -> dict[str, Any]:
        if not self._tells_mask:
            return {}
        return {"action_mask": self.action_masks(), "_action_mask": np.ones(self.num_envs, bool)}

    def _infos(self, any_ended: bool) -> dict[str, Any]:
        return (self._infos_of_ends() if any_ended else {}) | self._mask_infos()

    def _infos_of_ends(self) -> dict[str, Any]:
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

    # ---- states

    def get_states(self) -> list[State]:
        """One for each environment, to go back to, or on from, in any environment of the problem."""
        records, steps, _, ended = self._read_states()
        form = self.problem.state_form.problem
        rows = zip(records, steps.tolist(), ended.tolist())
        return [State(record.tobytes(), count, causes, form) for record, count, causes in rows]

    def _read_states(self) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any], NDArray[Any]]:
        """Records, steps, episodes before this one, causes."""
        count = self.num_envs
        read = (
            np.zeros((count, self.model.state_size), np.uint8),
            np.zeros(count, np.int64),
            np.zeros(count, np.int64),
            np.zeros(count, np.uint8),
        )
        self._batch.read_states(*read)
        return read

    def state_from(self, values: Mapping[str, Any], *, steps: int = 0) -> State:
        """See `RDDLEnv.state_from`."""
        return state_from(self.problem, values, steps)

    def set_states(
        self,
        states: State | Sequence[State | None],
        *,
        seed: int | Sequence[int | None] | None = None,
        replay: bool = False,
    ) -> Any:
        """Episodes continue from there: all from one state, or each from its own; None: it stays as it
        is. Environments draw independently of each other. Returns observations.

        seed: of the random numbers that follow, also of later episodes: seed + i, or one for each;
            None: they are drawn from `np_random`.
        replay: random numbers are those that the environment has: see `RDDLEnv.set_state`.
        """
        if seed is not None and replay:
            raise ArgumentError("set_states takes a seed or replay=True, not both")
        chosen = self._states_of(states, np.arange(self.num_envs))
        seeds = None if seed is None else self._seeds_of(seed)
        if not self._has_begun:
            self.reset()
        if seeds is None and not replay:
            seeds = self.np_random.integers(1 << 63, size=self.num_envs).tolist()
        for place in chosen:
            if seeds is not None and (its := seeds[place]) is not None:
                self._set_seed(place, its)
        if chosen:
            self._enter(chosen)
        return self._reader.rows(copy=self._copies)

    # ---- pictures

    def render(self) -> tuple[Any, ...] | None:
        """A picture (height, width, 3) uint8 or a text for each environment, of where it stands."""
        renderer = self._renderer
        if renderer is None:
            return None
        if not self._has_begun:
            raise EpisodeOver("no episode has begun: call reset() before render()")
        single = _native.EnvPool(self.problem.simulator)
        single.reset()
        pictures = []
        for state in self.get_states():
            single.write_state(0, np.frombuffer(state.record, np.uint8), state.steps)
            renderer.begin(single, self.horizon)
            pictures.append(renderer.text() if self.render_mode == "ansi" else renderer.pixels())
        return tuple(pictures)

    def __str__(self) -> str:
        return f"<RDDLVectorEnv {self.problem.name}, num_envs={self.num_envs}>"

    # ---- copies

    def __deepcopy__(self, memo: dict[int, Any]) -> RDDLVectorEnv:
        """Returns a copy. The future is the same in both as long as the actions are."""
        copy = type(self)(self.problem, self.num_envs, **self._forms)
        copy._batch = self._batch.copy()
        copy._connect()
        copy._seeds, copy._has_begun = list(self._seeds), self._has_begun
        copy._go_on_from(deepcopy(self._random_numbers()))
        copy.spec = self.spec
        return copy

    def __reduce__(self) -> tuple[Any, ...]:
        position = (self._seeds, *self._read_states()) if self._has_begun else None
        made = (type(self), self.problem, self.num_envs, self._forms)
        return _unpickled, (*made, position, self._random_numbers(), self.spec)

    def _random_numbers(self) -> tuple[Any, ...]:
        spaces = self.action_space, self.single_action_space
        return self._np_random, self._np_random_seed, *spaces

    def _go_on_from(self, random: tuple[Any, ...]) -> None:
        self._np_random, self._np_random_seed, *spaces = random
        go_on_from(self.action_space, spaces[0])
        go_on_from(self.single_action_space, spaces[1])

    def _go_to(self, seeds: list[int], records: Any, steps: Any, episodes: Any, ended: Any) -> None:
        """Goes to the state after these episodes of the seeds."""
        self._seeds = list(seeds)
        self._batch.set_seeds(0, seeds)
        self._batch.reset()
        for episode in range(int(episodes.max())):
            self._batch.reset(episodes > episode)
        self._batch.write_states(np.arange(self.num_envs), records, steps)
        self._causes[:] = ended
        self._has_begun = True


def _unpickled(
    kind: type[RDDLVectorEnv],
    problem: Problem,
    num_envs: int,
    forms: dict[str, Any],
    position: tuple[Any, ...] | None,
    random: tuple[Any, ...],
    spec: Any,
) -> RDDLVectorEnv:
    envs = kind(problem, num_envs, **forms)
    if position is not None:
        envs._go_to(*position)
    envs._go_on_from(random)
    envs.spec = spec
    return envs


def _mode_of(given: Any) -> AutoresetMode:
    if isinstance(given, AutoresetMode):
        return given
    return AutoresetMode(one_of("autoreset_mode", given, [each.value for each in AutoresetMode]))


def _is_list(given: Any) -> bool:
    return isinstance(given, Sequence) or (isinstance(given, np.ndarray) and given.ndim == 1)
