"""RDDL problems as domains of scikit-decide (pip install scikit-decide).

    from rddlc.skdecide import RDDLDomainSimplifiedSpaces
    from skdecide.hub.solver.cgp import CGP

RDDLDomain and its two simplified forms are for solvers that learn from episodes, RDDLSimulation for
those that draw from any state (MCTS), RDDLPlanning for those that ask for the distribution of next
states (LRTDP, ILAOstar, AOstar).
"""

from __future__ import annotations

import os
import time
from pathlib import Path
from typing import Any

from skdecide import Domain, ImplicitSpace, Space, TransitionOutcome, Value
from skdecide.builders.domain import (
    DeterministicInitialized,
    FullyObservable,
    Renderable,
    UnrestrictedActions,
)
from skdecide.core import DiscreteDistribution
from skdecide.domains import GoalMDPDomain, RLDomain, StatelessSimulatorDomain
from skdecide.hub.space.gym import GymSpace, ListSpace

from .. import _problem_of, make
from ..arguments import finite, whole
from ..environment import RDDLEnv
from ..errors import Error
from ..problems import Problem
from ..states import State
from ..transitions import Outcome, Transitions

COST_ERROR = 1e-9  # relative


class D(RLDomain, UnrestrictedActions, FullyObservable, Renderable):
    T_state = Any  # an observation of the environment
    T_observation = T_state
    T_event = Any  # an action of the environment
    T_value = float
    T_info = dict[str, Any]


class RDDLDomain(D):
    """An environment with dictionaries of observations and of actions. Partially observed problems
    show observations only. An end is an end, whatever its cause."""

    def __init__(
        self,
        domain: str | os.PathLike[str] | Problem | None = None,
        instance: str | int | os.PathLike[str] | None = None,
        *,
        movie: str | os.PathLike[str] | None = None,
        movie_name: str | None = None,
        movie_dir: str | os.PathLike[str] = "rddl_movies",
        max_frames: int = 1000,
        display_within_jupyter: bool = False,
        display_with_pygame: bool = False,
        visualizer: Any = "",
        base_class: type[Any] | None = None,
        backend: Any = None,
        **options: Any,
    ) -> None:
        """domain, instance, options: as `rddlc.make` takes them; render_mode is "rgb_array" by
        default. movie: a GIF of the latest episode that has ended, or of those that `save_gif` asks
        for.

        The other names are those of `skdecide.hub.domain.rddl.RDDLDomain`, where domain and instance
        are rddl_domain and rddl_instance:

        movie_name: each episode becomes a GIF movie_dir/movie_name/movie_name_TIME.gif, when it ends
            or has max_frames steps.
        display_within_jupyter: render() shows the picture in a notebook. display_with_pygame: in a
            window.
        visualizer: the name of one of ours; a class of pyRDDLGym's means ours for the domain.
        base_class: pyRDDLGym-rl's SimplifiedActionRDDLEnv means actions="simplified".
        backend: not used, since there is just this one.
        """
        if domain is None:
            domain, instance = options.pop("rddl_domain", None), options.pop("rddl_instance", None)
        if getattr(base_class, "__name__", "").startswith("SimplifiedAction"):
            options = {"actions": "simplified", **options}
        if isinstance(visualizer, str):
            options["visualizer"] = visualizer
        mode = "human" if display_with_pygame else "rgb_array"
        self.env: RDDLEnv = make(domain, instance, **{"render_mode": mode, **options})
        self._movie = movie
        self._movies = None if movie_name is None else Path(movie_dir) / movie_name
        self._max_frames = whole("max_frames", max_frames, 1)
        self._shows = display_within_jupyter

    def save_gif(self, path: str | os.PathLike[str]) -> None:
        """The episode so far."""
        self.env.save_gif(path)

    def _state_reset(self) -> Any:
        return self.env.reset()[0]

    def _state_step(self, action: Any) -> TransitionOutcome:
        observation, reward, terminated, truncated, info = self.env.step(action)
        is_over = terminated or truncated
        if is_over and self._movie is not None:
            self.env.save_gif(self._movie)
        if self._movies is not None and (is_over or self.env.timestep == self._max_frames):
            self._movies.mkdir(parents=True, exist_ok=True)
            self.env.save_gif(
                self._movies / f"{self._movies.name}_{time.strftime('%Y%m%d-%H%M%S')}.gif"
            )
        return TransitionOutcome(observation, Value(reward=reward), is_over, info)

    def _get_action_space_(self) -> Space[Any]:
        return GymSpace(self.env.action_space)

    def _get_observation_space_(self) -> Space[Any]:
        return GymSpace(self.env.observation_space)

    def _render_from(self, memory: Any, **options: Any) -> Any:
        """The present state of the environment."""
        picture = self.env.render()
        if self._shows:
            _show_in_notebook(self.env)
        return picture


def _show_in_notebook(env: RDDLEnv) -> None:
    try:
        from IPython.display import clear_output, display
    except ImportError:
        return
    clear_output(wait=True)
    display(env)


class RDDLDomainRL(RDDLDomain):
    """Dictionaries of observations, as "MultiInputPolicy" takes them, and simplified actions."""

    def __init__(self, domain: Any = None, instance: Any = None, **options: Any) -> None:
        super().__init__(domain, instance, **{"actions": "simplified", **options})


class RDDLDomainSimplifiedSpaces(RDDLDomain):
    """Flat observations, and actions in one Box or Discrete, as scikit-decide's CGP takes them."""

    def __init__(self, domain: Any = None, instance: Any = None, **options: Any) -> None:
        super().__init__(
            domain, instance, **{"observations": "flat", "actions": "box", **options}
        )


class _Planning(Domain):  # what the two below have in common
    T_state = State
    T_observation = State
    T_event = int
    T_value = float
    T_info = None

    def __init__(
        self,
        domain: str | os.PathLike[str] | Problem,
        instance: str | int | os.PathLike[str] | None = None,
        **options: Any,
    ) -> None:
        problem = _problem_of(domain, instance, options, Transitions)
        self.transitions = Transitions(problem, **options)
        self._pictures: RDDLEnv | None = None

    @property
    def discount(self) -> float:
        """Returns the instance's discount; solvers ask for it."""
        return self.transitions.problem.model.discount

    def action(self, number: int) -> dict[str, Any]:
        """Returns an action in the form that `rddlc.make`'s environments take."""
        return self.transitions.action(number)

    def _get_action_space_(self) -> Space[int]:
        return ListSpace(range(self.transitions.action_count))

    def _get_applicable_actions_from(self, memory: State) -> Space[int]:
        return ListSpace(self.transitions.applicable(memory))

    def _get_observation_space_(self) -> Space[State]:
        return ImplicitSpace(lambda state: isinstance(state, State))

    def _get_initial_state_(self) -> State:
        return self.transitions.start()

    def _render_from(self, memory: State, **options: Any) -> Any:
        """(height, width, 3) uint8: a picture of that state."""
        if self._pictures is None:
            self._pictures = RDDLEnv(self.transitions.problem, render_mode="rgb_array")
        self._pictures.reset(seed=0, options={"state": memory})
        return self._pictures.render()


class RDDLSimulation(
    _Planning, StatelessSimulatorDomain, DeterministicInitialized, FullyObservable, Renderable
):
    """Steps from any state, by draws. Actions are numbers from 0 on, those that satisfy the
    preconditions are applicable, and a state is an `rddlc.State`.

    levels, horizon, seed: as `Transitions` takes them.
    """

    def _state_sample(self, memory: State, action: int) -> TransitionOutcome:
        drawn = self.transitions.sample(memory, action)
        return TransitionOutcome(drawn.state, Value(reward=drawn.reward), drawn.state.causes != 0)


class RDDLPlanning(_Planning, GoalMDPDomain, Renderable):
    """Distributions of next states, costs, and the end of the episode as the goal.

    The cost of a step is most_reward less its reward, and an early end costs most_reward for each
    step that is left, discounted: so the cheapest policy is the one with the highest return. Distributions
    are exact, or estimated from `samples` draws, as a problem needs that draws from infinitely many values.
    """

    def __init__(
        self,
        domain: str | os.PathLike[str] | Problem,
        instance: str | int | os.PathLike[str] | None = None,
        *,
        most_reward: float = 0.0,
        **options: Any,
    ) -> None:
        """most_reward: the largest reward of a step. levels, samples, horizon, seed, most_outcomes:
        see `Transitions`."""
        super().__init__(domain, instance, **options)
        self._most_reward = finite("most_reward", most_reward)
        transitions = self.transitions
        if not transitions.horizon:
            raise Error("the problem has no horizon: say horizon=N")

    def _get_next_state_distribution(self, memory: State, action: int) -> DiscreteDistribution:
        outcomes = self.transitions.outcomes(memory, action)
        return DiscreteDistribution([(each.state, each.probability) for each in outcomes])

    def _get_transition_value(
        self, memory: State, action: int, next_state: State | None = None
    ) -> Value:
        outcomes = self.transitions.outcomes(memory, action)
        if next_state is not None:
            outcomes = tuple(each for each in outcomes if each.state == next_state)
        total = sum(each.probability for each in outcomes)
        return Value(cost=sum(each.probability * self._cost(each) for each in outcomes) / total)

    def _cost(self, outcome: Outcome) -> float:
        most, cost = self._most_reward, self._most_reward - outcome.reward
        if cost < -COST_ERROR * max(1.0, abs(most)):
            raise Error(
                f"a step has the reward {outcome.reward:g}: say most_reward={outcome.reward:g} or more, "
                f"instead of {most:g}"
            )
        left = self.transitions.horizon - outcome.state.steps if outcome.state.causes else 0
        return max(cost, 0.0) + most * sum(self.discount**step for step in range(1, left + 1))

    def _is_terminal(self, state: State) -> bool:
        return state.causes != 0

    def _get_goals_(self) -> Space[State]:
        return ImplicitSpace(lambda state: state.causes != 0)
