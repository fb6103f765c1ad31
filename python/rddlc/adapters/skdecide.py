"""RDDL problems as domains of scikit-decide (pip install scikit-decide).

    from rddlc.skdecide import RDDLDomainSimplifiedSpaces
    from skdecide.hub.solver.cgp import CGP

RDDLDomain and its two simplified forms are for solvers that learn from episodes, RDDLSimulation for
those that draw from any state (MCTS), RDDLPlanning for those that ask for the distribution of next
states (LRTDP, ILAOstar, AOstar).
"""

from __future__ import annotations

import os
from typing import Any

from skdecide import Domain, ImplicitSpace, Space, TransitionOutcome, Value
from skdecide.builders.domain import DeterministicInitialized, FullyObservable, Renderable
from skdecide.core import DiscreteDistribution
from skdecide.domains import GoalMDPDomain, RLDomain, StatelessSimulatorDomain
from skdecide.hub.space.gym import GymSpace, ListSpace

from .. import _problem_of, make
from ..arguments import finite
from ..environment import RDDLEnv
from ..errors import Error
from ..problems import Problem
from ..states import State
from ..transitions import Outcome, Transitions

COST_ERROR = 1e-9  # relative


class D(RLDomain, FullyObservable, Renderable):
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
        domain: str | os.PathLike[str] | Problem,
        instance: str | int | os.PathLike[str] | None = None,
        *,
        movie: str | os.PathLike[str] | None = None,
        **options: Any,
    ) -> None:
        """domain, instance, options: as `rddlc.make` takes them; render_mode is "rgb_array" by
        default. movie: a GIF of the latest episode that has ended, or of those that `save_gif` asks
        for."""
        self.env: RDDLEnv = make(domain, instance, **{"render_mode": "rgb_array", **options})
        self._movie = movie

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
        return TransitionOutcome(observation, Value(reward=reward), is_over, info)

    def _get_action_space_(self) -> Space[Any]:
        return GymSpace(self.env.action_space)

    def _get_observation_space_(self) -> Space[Any]:
        return GymSpace(self.env.observation_space)

    def _render_from(self, memory: Any, **options: Any) -> Any:
        """The present state of the environment."""
        return self.env.render()


class RDDLDomainRL(RDDLDomain):
    """Dictionaries of observations, and simplified actions."""

    def __init__(self, domain: Any, instance: Any = None, **options: Any) -> None:
        super().__init__(domain, instance, **{"actions": "simplified", **options})


class RDDLDomainSimplifiedSpaces(RDDLDomain):
    """Flat observations, and actions in one Box or Discrete, as scikit-decide's CGP takes them."""

    def __init__(self, domain: Any, instance: Any = None, **options: Any) -> None:
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
