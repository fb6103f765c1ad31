"""One environment of a problem."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

from . import _native, causes
from .dictionaries import DictionaryActions, GroundedReader, LiftedReader
from .errors import ActionError, EpisodeOver, Error
from .learning import ChoiceActions, FlatReader
from .legal import go_on_from, legal_space
from .masks import ActionMasks
from .model import Model
from .problems import Problem, batch_horizon
from .records import lifted_views
from .rendering import Renderer

OBSERVATIONS = ("dict", "flat")
ACTIONS = ("dict", "simplified", "box")


@dataclass(frozen=True)
class State:
    """Where an episode stands: the bytes of the true state's record, the steps made, and why it is
    over (`rddlc.causes`; 0: it runs)."""

    record: bytes
    steps: int
    causes: int = 0


class RDDLEnv(gymnasium.Env[Any, Any]):
    """A problem as a Gymnasium environment, stepped by its compiled simulator.

    The same seed gives the same episodes as `rddl run --seed`, bit for bit.
    """

    metadata: dict[str, Any] = {"render_modes": ["human", "rgb_array", "ansi"], "render_fps": 10}

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
        """See `rddlc.make`, which loads the problem, too."""
        self._forms = {
            "vectorized": vectorized,
            "observations": _one_of("observations", observations, OBSERVATIONS),
            "actions": _one_of("actions", actions, ACTIONS),
            "normalize": normalize,
            "enforce_action_constraints": enforce_action_constraints,
            "enforce_action_count_non_bool": enforce_action_count_non_bool,
            "action_mask": action_mask,
            "horizon": horizon,
            "render_mode": render_mode,
            "render_size": render_size,
            "visualizer": visualizer,
        }
        self.problem = problem
        self.render_mode = _one_of("render_mode", render_mode, (None, *self.metadata["render_modes"]))
        self._batch = _native.Batch(
            problem.simulator,
            horizon=batch_horizon(horizon),
            records=observations == "dict",
            values=observations != "dict",
        )
        self._seed: int | None = None
        self._connect()

    def _connect(self) -> None:
        """All that looks at the batch's arrays."""
        batch, forms = self._batch, self._forms
        self._reader = self._new_reader()
        self._writer = self._new_writer()
        self.observation_space = self._reader.space
        self.action_space = self._writer.space
        if self.model.preconditions:
            self.action_space = legal_space(self._writer.space, self._writer, 1)
        self._masks = ActionMasks(self.problem, batch, self._writer)
        self._rewards, self._causes = batch.rewards, batch.causes
        self._enforces = forms["enforce_action_constraints"]
        self._tells_mask = forms["action_mask"]
        self._ended = 0
        self._renderer: Renderer | None = None
        if self.render_mode is not None:
            self._renderer = self._new_renderer()

    def _new_reader(self) -> Any:
        if self._forms["observations"] == "flat":
            return FlatReader(
                self.problem,
                self._batch.observation_values,
                self._batch.final_values,
                normalize=self._forms["normalize"],
            )
        kind = LiftedReader if self._forms["vectorized"] else GroundedReader
        return kind(self.model.observed, self._batch.observations)

    def _new_writer(self) -> Any:
        if self._forms["actions"] == "dict":
            return DictionaryActions(
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
    def model(self) -> Model:
        return self.problem.model

    @property
    def horizon(self) -> int:
        """Steps until an episode is cut off; 0: never."""
        given = self._forms["horizon"]
        return self.model.horizon if given is None else given

    @property
    def discount(self) -> float:
        return self.model.discount

    @property
    def max_allowed_actions(self) -> int:
        """How many action values may differ from their default."""
        limit = self.model.limited_actions
        return sum(fluent.count for fluent in self.model.actions) if limit is None else limit

    @property
    def state(self) -> dict[str, Any]:
        """The true state in the form of dictionary observations, also where it is not observed."""
        record = np.zeros((1, self.model.state_size), np.uint8)
        self._batch.read_state(0, record[0])
        kind = LiftedReader if self._forms["vectorized"] else GroundedReader
        return kind(self.model.states, record).read()

    @property
    def timestep(self) -> int:
        """Steps made in this episode."""
        return self._batch.progress(0)[0]

    # ---- episodes

    def reset(
        self, *, seed: int | None = None, options: Mapping[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Starts an episode: the first one of `seed`, or the next one. Before the first seed one is
        drawn. options: {"state": State} starts it there."""
        state = _state_in(options)
        super().reset(seed=seed)
        if seed is None and self._seed is None:
            seed = int(self.np_random.integers(1 << 63))
        if seed is not None:
            self._seed = seed
            self._batch.set_seed(seed)
        self._batch.reset()
        self._ended = self._batch.causes_of(0)
        if state is not None:
            self._restore(state)
        if self._renderer is not None:
            self._renderer.begin(self._batch, self.horizon)
            self._show()
        info: dict[str, Any] = {}
        self._tell(self._ended, info)
        return self._reader.read(), info

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """One step. At an end, info["cause"] says why: "terminated", "horizon", "invariant" (a state
        invariant is violated) or "fault" (info["fault"] tells which); several are joined by ", ".

        Raises ActionError or EpisodeOver, and has changed nothing then.
        """
        if self._ended or self._seed is None:
            raise self._no_step()
        self._batch.finish()
        self._writer.write(action)
        if self._enforces:
            self._check_preconditions()
        self._writer.step()
        ended = self._causes.item()
        info: dict[str, Any] = {}
        if ended or self._tells_mask:
            self._ended = ended
            self._tell(ended, info)
        if self._renderer is not None:
            self._renderer.add_step(self._batch, causes.text_of(ended))
            self._show()
        terminated, truncated = (ended & 1) != 0, ended > 1
        return self._reader.read(), self._rewards.item(), terminated, truncated, info

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

    def _check_preconditions(self) -> None:
        self._writer.write_record()
        if self._batch.violated_preconditions(self._batch.actions)[0] >= 0:
            raise ActionError(self._why_violated())

    def _why_violated(self) -> str:
        if self.problem.has_details:
            return self._batch.explain_violation(0)
        batch = _native.Batch(self.problem.detailed, values=False)
        batch.reset()
        record = np.zeros(self.model.state_size, np.uint8)
        self._batch.read_state(0, record)
        batch.write_state(0, record, self.timestep)
        batch.actions[:] = self._batch.actions
        return batch.explain_violation(0)

    def action_masks(self) -> NDArray[np.bool_]:
        """(sum of categories,): which values of a Discrete or MultiDiscrete action satisfy the
        preconditions, each while the others have their default (sb3-contrib's MaskablePPO)."""
        return self._masks.rows()[0]

    # ---- states

    def get_state(self) -> State:
        """To go back to, or on from, in any environment of the same problem."""
        record = np.zeros(self.model.state_size, np.uint8)
        self._batch.read_state(0, record)
        return State(record.tobytes(), self.timestep, self._ended)

    def set_state(self, state: State) -> None:
        """The episode goes on from there. The random numbers of a step depend on seed, episode and
        the number of the step: those that follow are this episode's own."""
        if not isinstance(state, State):
            raise TypeError(f"a state is an rddlc.State, not a {type(state).__name__}")
        if self._seed is None:
            self.reset()
        self._restore(state)

    def _restore(self, state: State) -> None:
        record = np.frombuffer(state.record, np.uint8)
        self._batch.write_state(0, record, state.steps)
        self._ended = state.causes

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
        """(height, width, 3) uint8, a text, or None: as `render_mode` says."""
        if self._renderer is None or self._seed is None:
            return None
        if self.render_mode == "human":
            return self._renderer.show()
        return self._renderer.text() if self.render_mode == "ansi" else self._renderer.pixels()

    def _show(self) -> None:
        if self.render_mode == "human" and self._renderer is not None:
            self._renderer.show()

    def _repr_html_(self) -> str:
        """In a notebook an environment is a picture of its state."""
        if self._seed is None:
            return f"<code>{self}</code>: call reset() to see its state"
        renderer = self._renderer
        if renderer is None:
            renderer = self._new_renderer()
            renderer.begin(self._batch, self.horizon)
        return renderer.image_tag()

    def replay_page(self) -> str:
        """The episode so far as a page that replays it (docs/pictures.md), an HTML file of its own;
        of environments with a render_mode."""
        return self._remembered().page()

    def save_gif(self, path: str | os.PathLike[str]) -> None:
        """Writes the episode so far, but no more than its last 1,000 steps, as a movie; of
        environments with a render_mode."""
        self._remembered().write_gif(os.fspath(path))

    def _remembered(self) -> Renderer:
        if self._renderer is None or self._seed is None:
            raise Error("only an environment with a render_mode remembers its episode")
        return self._renderer

    def close(self) -> None:
        if self._renderer is not None:
            self._renderer.close()

    def __str__(self) -> str:
        return f"<RDDLEnv {self.problem.name}>"

    # ---- copies

    def __deepcopy__(self, memo: dict[int, Any]) -> RDDLEnv:
        """What follows is the same in both as long as the actions are."""
        copy = type(self)(self.problem, **self._forms)
        copy._take(self, self._batch.copy())
        return copy

    def __reduce__(self) -> tuple[Any, ...]:
        episode = self._batch.progress(0)[1]
        state = None if self._seed is None else self.get_state()
        random = (self._np_random, self._np_random_seed, self.action_space)
        return _unpickled, (
            type(self),
            self.problem,
            self._forms,
            (self._seed, episode, state),
            random,
            self.spec,
        )

    def _take(self, other: RDDLEnv, batch: _native.Batch) -> None:
        self._batch = batch
        self._connect()
        self._seed, self._ended = other._seed, other._ended
        self._np_random, self._np_random_seed = other._np_random, other._np_random_seed
        go_on_from(self.action_space, other.action_space)
        self.spec = other.spec
        if self._renderer is not None and self._seed is not None:
            self._renderer.begin(batch, self.horizon)


def _unpickled(
    kind: type[RDDLEnv],
    problem: Problem,
    forms: dict[str, Any],
    position: tuple[int | None, int, State | None],
    random: Any,
    spec: Any,
) -> RDDLEnv:
    env = kind(problem, **forms)
    seed, episode, state = position
    if seed is not None and state is not None:
        env.reset(seed=seed)
        for _ in range(episode):
            env._batch.reset()
        env._restore(state)
    env._np_random, env._np_random_seed, action_space = random
    go_on_from(env.action_space, action_space)
    env.spec = spec
    return env


def _state_in(options: Mapping[str, Any] | None) -> Any:
    """A State, or None."""
    if options is not None and not isinstance(options, Mapping):
        raise TypeError(f"options are a dictionary, not a {type(options).__name__}")
    state = (options or {}).get("state")
    if state is not None and not isinstance(state, State):
        raise TypeError(f"a state is an rddlc.State, not a {type(state).__name__}")
    return state


def _one_of(what: str, given: Any, known: tuple[Any, ...]) -> Any:
    if given not in known:
        names = ", ".join(repr(each) for each in known)
        raise ValueError(f"{what} is {given!r}, which is none of {names}")
    return given
