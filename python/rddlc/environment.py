"""One environment of a problem.

Over 400 lines: one class with the whole interface of gymnasium.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from copy import deepcopy
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import gymnasium
import numpy as np
from gymnasium.envs.registration import EnvSpec
from numpy.typing import NDArray

from . import _native, causes
from .arguments import one_of, options_of_reset, seed_of, seed_or_none, size_of, whole_or_none
from .errors import ArgumentError, EpisodeOver, Error
from .gradients import Derivatives, Jacobian
from .preconditions import check_preconditions
from .problem_properties import ProblemProperties
from .problems import Problem, batch_horizon
from .records import lifted_views
from .rendering import Renderer
from .states import State
from .translation.choice_actions import ChoiceActions
from .translation.dictionary_actions import SingleActions
from .translation.legal import go_on_from, legal_space
from .translation.masks import ActionMasks
from .translation.named_values import state_from
from .translation.protocols import ActionWriter, ObservationReader
from .translation.readers import GroundedReader, LearnersReader, dictionary_reader, observation_reader

OBSERVATIONS = ("dict", "flat")
ACTIONS = ("dict", "simplified", "box")

# Attributes of pyRDDLGym's environments that programs ask for, and what ours has in their place.
OF_PYRDDLGYM = {
    "sampler": "env.state and env.interm_fluents() have the values",
    "set_visualizer": "render_mode and visualizer are options of make",
}


class RDDLEnv(ProblemProperties, gymnasium.Env[Any, Any]):
    """A problem as a Gymnasium environment, stepped by its compiled simulator.

    The same seed gives the same episodes as `rddl run --seed`, bit for bit.
    """

    metadata: dict[str, Any] = {
        "render_modes": ["human", "rgb_array", "rgb_array_list", "ansi"],
        "render_fps": 10,
    }

    _derivatives: Derivatives | None = None

    _np_random_seed: int | None = None  # which Gymnasium sets since 1.0

    def __init__(
        self,
        problem: Problem,
        *,
        vectorized: bool = False,
        observations: str = "dict",
        actions: str = "dict",
        normalize: bool = False,
        enforce_action_constraints: bool = False,
        enforce_action_count_non_bool: bool = True,
        action_mask: bool = False,
        horizon: int | None = None,
        render_mode: str | None = None,
        render_size: tuple[int, int] = (600, 400),
        visualizer: str = "",
    ) -> None:
        """See `rddlc.make`, which also loads the problem."""
        self._forms = {
            "vectorized": vectorized,
            "observations": one_of("observations", observations, OBSERVATIONS),
            "actions": one_of("actions", actions, ACTIONS),
            "normalize": normalize,
            "enforce_action_constraints": enforce_action_constraints,
            "enforce_action_count_non_bool": enforce_action_count_non_bool,
            "action_mask": action_mask,
            "horizon": whole_or_none("horizon", horizon, 0),
            "render_mode": render_mode,
            "render_size": size_of(render_size),
            "visualizer": visualizer,
        }
        self.problem = problem
        self.render_mode = one_of("render_mode", render_mode, (None, *self.metadata["render_modes"]))
        self._batch = _native.EnvPool(
            problem.simulator,
            horizon=batch_horizon(horizon),
            records=observations == "dict",
            values=observations != "dict",
        )
        self._seed: int | None = None
        self._spec: EnvSpec | None = None
        self._frames: list[NDArray[np.uint8]] = []  # since the last render()
        # An episode may continue with random numbers other than its own.
        self._luck: int | None = None  # the seed of these
        self._own: _native.EnvPool | None = None  # a batch that has the episode's own
        self._connect()

    def _connect(self) -> None:
        """Binds everything that reads the batch's arrays."""
        batch, forms = self._batch, self._forms
        self._reader = self._new_reader()
        self._writer = self._new_writer()
        self.observation_space = self._reader.space
        self.action_space = self._writer.space
        if self.model.preconditions:
            self.action_space = legal_space(self._writer.space, self._writer, self.problem, batch)
        self._masks = ActionMasks(self.problem, batch, self._writer)
        self._rewards, self._causes = batch.rewards, batch.causes
        self._enforces = forms["enforce_action_constraints"]
        self._tells_mask = forms["action_mask"]
        self._ended = 0
        self._stepper: _native.DictionaryStepper | None = None
        if isinstance(self._reader, GroundedReader) and isinstance(self._writer, SingleActions):
            self._stepper = _native.DictionaryStepper(batch, self._writer.native, self._reader.native)
        self._renderer: Renderer | None = None
        if self.render_mode is not None:
            self._renderer = self._new_renderer()

    def _new_reader(self) -> ObservationReader:
        is_flat, is_learned = self._forms["observations"] == "flat", self._forms["actions"] != "dict"
        reader = observation_reader(
            self.model.observed,
            self._batch,
            flat=is_flat,
            lifted=self._forms["vectorized"],
            normalize=self._forms["normalize"],
            by_values=is_learned,
        )
        return LearnersReader(reader) if is_learned and not is_flat else reader

    def _new_writer(self) -> ActionWriter:
        if self._forms["actions"] == "dict":
            return SingleActions(
                self.problem,
                self._batch,
                lifted=self._forms["vectorized"],
                limits_all=self._forms["enforce_action_count_non_bool"],
            )
        return ChoiceActions(
            self.problem,
            self._batch,
            box=self._forms["actions"] == "box",
            normalize=self._forms["normalize"],
        )

    def _new_renderer(self) -> Renderer:
        size, name = self._forms["render_size"], self._forms["visualizer"]
        return Renderer(self.problem.simulator, size, name, self.metadata["render_fps"])

    # ---- what the problem says of itself

    @property
    def spec(self) -> EnvSpec | None:
        """What Gymnasium made it of; the horizon is known to the problem."""
        return self._spec

    @spec.setter
    def spec(self, given: EnvSpec | None) -> None:
        if given is not None and given.max_episode_steps is None:
            given = replace(given, max_episode_steps=self.horizon or None)
        self._spec = given

    @property
    def vectorized(self) -> bool:
        """Whether keys are fluents and values arrays; pyRDDLGym's agents ask for it."""
        return self._forms["vectorized"]

    @property
    def state(self) -> dict[str, Any]:
        """The true state in the form of dictionary observations, also where it is not observed."""
        record = np.zeros((1, self.model.state_size), np.uint8)
        self._batch.read_state(0, record[0])
        return dictionary_reader(self.model.states, record, lifted=self._forms["vectorized"]).read()

    @property
    def timestep(self) -> int:
        """Steps made in this episode."""
        return self._batch.progress(0)[0]

    # ---- episodes

    def reset(
        self, *, seed: int | None = None, options: Mapping[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Starts an episode: the first one of `seed`, or the next one. Before the first seed one is
        drawn. options: {"state": State} starts it there; what it draws is the new episode's."""
        seed = seed_or_none(seed)
        state = options_of_reset(options, ("state",)).get("state")
        if state is not None:
            self.problem.state_form.record_of(state)
        super().reset(seed=seed)
        self._take_own_luck()
        if seed is None and self._seed is None:
            seed = int(self.np_random.integers(1 << 63))
        if seed is not None:
            self._seed = seed
            self._batch.set_seed(seed)
        self._batch.reset()
        self._ended = self._batch.causes_of(0)
        if state is not None:
            self._restore(state)
        self._begin_pictures()
        info: dict[str, Any] = {}
        self._tell(self._ended, info)
        return self._reader.read(), info

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """One step. At an end, info["cause"] says why: "terminated", "horizon", "invariant" (a state
        invariant is violated) or "fault" (info["fault"] describes it); several are joined by ", ".

        Raises ActionError or EpisodeOver, and has changed nothing then.
        """
        if self._ended or self._seed is None:
            raise self._no_step()
        if self._enforces:
            check_preconditions(self.problem, self._batch, self._writer, action)
        result: Any = None if self._stepper is None else self._stepper.step(action)
        if result is None:
            self._writer.step(action)
            result = self._result()
        if result[2] or result[3] or self._tells_mask:
            self._ended = self._causes.item()
            self._tell(self._ended, result[4])
        if self._renderer is not None:
            self._renderer.add_step(self._batch, causes.text_of(self._ended))
            self._show(self._renderer)
        return result

    def _result(self) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Of the step that the batch has made, whose cause is not told yet."""
        ended = self._causes.item()
        return self._reader.read(), self._rewards.item(), (ended & 1) != 0, ended > 1, {}

    def _no_step(self) -> Error:
        if self._seed is None:
            return EpisodeOver("no episode has begun: call reset() before step()")
        return EpisodeOver(f"the episode is over ({causes.text_of(self._ended)}): call reset()")

    def _tell(self, ended: int, info: dict[str, Any]) -> None:
        if ended:
            info["cause"] = causes.text_of(ended)
        if ended & causes.FAULT:
            info["fault"] = self._batch.fault(0)
        if self._tells_mask:
            info["action_mask"] = self._masks.for_space()

    def action_masks(self) -> NDArray[np.bool_]:
        """(sum of categories,): which values of a Discrete or MultiDiscrete action satisfy the
        preconditions, each while the others have their default (sb3-contrib's MaskablePPO)."""
        return self._masks.rows()[0]

    # ---- states

    def get_state(self) -> State:
        """To go back to, or on from, in any environment of the same problem."""
        record = np.zeros(self.model.state_size, np.uint8)
        self._batch.read_state(0, record)
        return State(record.tobytes(), self.timestep, self._ended, self.problem.state_form.problem)

    def state_from(self, values: Mapping[str, Any], *, steps: int = 0) -> State:
        """The state of these values, by the names of `env.state`, grounded or not; the others have
        their initial value. steps: made so far."""
        return state_from(self.problem, values, steps)

    def set_state(self, state: State, *, seed: int | None = None, replay: bool = False) -> None:
        """The episode continues from there, with new random numbers each time: a planner that tries
        an action several times sees several successors, and never the one that is to come. They are
        drawn from `np_random`, so that the same seed of reset() and the same calls give the same.

        seed: of the random numbers that follow: the same seed gives the same successors.
        replay: the numbers are this episode's own, which depend on its seed, its number and the
            number of the step alone: the same actions have the same results as before.
        """
        self.problem.state_form.record_of(state)
        if seed is not None and replay:
            raise ArgumentError("set_state takes a seed or replay=True, not both")
        luck = None if seed is None else seed_of(seed)
        if self._seed is None:
            self.reset()
        if replay:
            self._take_own_luck()
        else:
            self._take_luck(int(self.np_random.integers(1 << 63)) if luck is None else luck)
        self._restore(state)
        self._begin_pictures()

    def _take_luck(self, seed: int) -> None:
        """Random numbers of this seed until the episode ends; later ones have those of `_seed`."""
        if self._own is None:
            self._own = self._batch.copy()
        self._luck = seed
        self._batch.set_seed(seed)

    def _take_own_luck(self) -> None:
        if self._own is not None:
            self._batch.become(self._own)
        self._luck = self._own = None

    def _restore(self, state: State) -> None:
        self._batch.write_state(0, self.problem.state_form.record_of(state), state.steps)
        self._ended = state.causes

    def jacobian(self, state: Any, action: Any, *, seed: int = 0) -> Jacobian:
        """Exact derivatives of a step by state and action, which changes nothing here.

        state: None: the present one; an `rddlc.State`, a dictionary of values, or an array.
        action: a dictionary of values (others are defaults), or an array. seed: of what the step
        draws. Relaxed derivatives, many steps at once and torch: `rddlc.gradients.Derivatives`.
        """
        if self._derivatives is None:
            self._derivatives = Derivatives(self.problem)
        if action is None:
            raise ArgumentError("the action is a dictionary or an array; {} is the default action")
        given = self.get_state() if state is None else state
        return self._derivatives.jacobian(given, action, seed=seed)

    def interm_fluents(self) -> dict[str, NDArray[np.generic]]:
        """Values of interm- and derived-fluents in the last step, by their names: of an interpreted
        problem, or one that was loaded with details=True."""
        if not self.problem.has_details:
            raise Error("load the problem with details=True to ask for its interm-fluents")
        fluents = [
            each
            for role in ("interm-fluent", "derived-fluent")
            for each in self.model.with_role(role)
        ]
        record = np.zeros((1, self.problem.simulator.interm_size), np.uint8)
        self._batch.read_interm(0, record[0])
        return {name: view[0].copy() for name, view in lifted_views(record, fluents).items()}

    # ---- pictures

    def render(self) -> Any:
        """Returns (height, width, 3) uint8, a list of these since the last render() or reset(), a text,
        or None, as `render_mode` says."""
        if self._renderer is None:
            return None
        if self._seed is None:
            raise EpisodeOver("no episode has begun: call reset() before render()")
        if self.render_mode == "human":
            return self._renderer.show()
        if self.render_mode == "rgb_array_list":
            frames, self._frames = self._frames, []
            return frames
        return self._renderer.text() if self.render_mode == "ansi" else self._renderer.pixels()

    def _begin_pictures(self) -> None:
        """Starts drawing at the environment's present state."""
        if self._renderer is not None:
            self._renderer.begin(self._batch, self.horizon)
            self._frames = []
            self._show(self._renderer)

    def _show(self, renderer: Renderer) -> None:
        if self.render_mode == "human":
            renderer.show()
        elif self.render_mode == "rgb_array_list":
            self._frames.append(renderer.pixels())

    def _repr_html_(self) -> str:
        """Notebooks show an environment as a picture of its state."""
        if self._seed is None:
            return f"<code>{self}</code>: call reset() to see its state"
        renderer = self._renderer
        if renderer is None:
            renderer = self._new_renderer()
            renderer.begin(self._batch, self.horizon)
        return renderer.image_tag()

    def replay_page(self) -> str:
        """Returns the episode so far as a page that replays it (docs/pictures.md), an HTML file of
        its own; for environments with a render_mode."""
        return self._remembered().page()

    def save_gif(self, path: str | os.PathLike[str]) -> None:
        """Writes the episode so far (since the last set_state, if there was one), but no more than
        its last 1,000 steps, as a movie; for environments with a render_mode."""
        self._remembered().write_gif(path)

    def _remembered(self) -> Renderer:
        if self._renderer is None or self._seed is None:
            raise Error("only an environment with a render_mode remembers its episode")
        return self._renderer

    def close(self) -> None:
        if self._renderer is not None:
            self._renderer.close()

    def __str__(self) -> str:
        return f"<RDDLEnv {self.problem.name}>"

    if not TYPE_CHECKING:  # type checkers report what is missing by themselves

        def __getattr__(self, name: str) -> Any:
            if name not in OF_PYRDDLGYM:
                return object.__getattribute__(self, name)  # raises again, also what a property raised
            text = f"'{type(self).__name__}' object has no attribute '{name}': {OF_PYRDDLGYM[name]}, and "
            text += "rddlc.backend.make makes pyRDDLGym's own environment"
            raise AttributeError(text, name=name, obj=self)

    # ---- copies

    def __deepcopy__(self, memo: dict[int, Any]) -> RDDLEnv:
        """Returns a copy. The future is the same in both as long as the actions are: the copy draws
        what this one will draw. `set_state(env.get_state(), seed=...)` gives it random numbers
        of its own."""
        copy = type(self)(self.problem, **self._forms)
        copy._take(self, self._batch.copy())
        return copy

    def __reduce__(self) -> tuple[Any, ...]:
        episode = (self._batch if self._own is None else self._own).progress(0)[1]
        state = None if self._seed is None else self.get_state()
        random = (self._np_random, self._np_random_seed, self.action_space)
        return _unpickled, (
            type(self),
            self.problem,
            self._forms,
            (self._seed, episode, self._luck, state),
            random,
            self.spec,
        )

    def _take(self, other: RDDLEnv, batch: _native.EnvPool) -> None:
        self._batch = batch
        self._connect()
        self._seed, self._ended, self._luck = other._seed, other._ended, other._luck
        self._own = None if other._own is None else other._own.copy()
        self._np_random = deepcopy(other._np_random)  # else both draw from one
        self._np_random_seed = other._np_random_seed
        go_on_from(self.action_space, other.action_space)
        self.spec = other.spec
        if self._seed is not None:
            self._begin_pictures()


def _unpickled(
    kind: type[RDDLEnv],
    problem: Problem,
    forms: dict[str, Any],
    position: tuple[int | None, int, int | None, State | None],
    random: Any,
    spec: Any,
) -> RDDLEnv:
    env = kind(problem, **forms)
    seed, episode, luck, state = position
    if seed is not None and state is not None:
        env.reset(seed=seed)
        for _ in range(episode):
            env._batch.reset()
        if luck is not None:
            env._take_luck(luck)
        env._restore(state)
        env._begin_pictures()
    env._np_random, env._np_random_seed, action_space = random
    go_on_from(env.action_space, action_space)
    env.spec = spec
    return env
