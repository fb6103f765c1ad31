"""Exact derivatives of a problem's steps (docs/planning.md).

    env = rddlc.make("Reservoir_ippc2023", "1")
    jacobian = env.jacobian(None, {"release___t1": 2.0})
    jacobian.reward_by_action

    step = rddlc.gradients.Derivatives(env)
    next_state, reward = step.torch(state, action)  # tensors that carry gradients
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _native
from .arguments import one_of, whole
from .errors import ActionError, ArgumentError, Error
from .problems import Problem
from .records import columns_of, values_of
from .states import State
from .translation.named_values import NamedValues, default_values

Array = NDArray[np.float64]

RELAXATIONS = ("exact", "straight", "soft")


@dataclass(frozen=True)
class Jacobian:
    """Derivatives of a step at a state with S values and an action with A values. Their names are
    groundings, "rlevel___t1", in declaration order and row-major; bools are 0 and 1, objects their
    index."""

    state_names: tuple[str, ...]
    action_names: tuple[str, ...]
    next_state: Array
    """(S,)"""
    reward: float
    next_by_state: Array
    """(S, S): row i is of next_state[i]"""
    next_by_action: Array
    """(S, A)"""
    reward_by_state: Array
    """(S,)"""
    reward_by_action: Array
    """(A,)"""


class Derivatives:
    """The steps of a problem as a function that can be differentiated.

    relax: "exact": comparisons, roundings and draws of bools and ints have derivative 0, which is true
        almost everywhere; "straight": exact values, with the derivatives of relaxed ones; "soft": bools
        are between 0 and 1 everywhere, and values are not those of the problem.
    sharpness: of the sigmoids in place of comparisons.

    Raises Error where a problem has functions of matrices, random vectors or external functions.
    """

    def __init__(
        self, env_or_problem: Any, *, relax: str = "exact", sharpness: float = 10.0
    ) -> None:
        inner = getattr(env_or_problem, "unwrapped", env_or_problem)
        problem = getattr(inner, "problem", inner)
        if not isinstance(problem, Problem):
            raise ArgumentError(
                f"derivatives are those of an environment or a problem, not of a {type(inner).__name__}"
            )
        if not sharpness > 0:
            raise ArgumentError(f"sharpness is above 0, not {sharpness}")
        self.problem = problem
        model = problem.model
        self.state_names = tuple(each.name for each in columns_of(model.states))
        self.action_names = tuple(each.name for each in columns_of(model.actions))
        self._native = _native.Derivatives(
            problem.simulator, one_of("relax", relax, RELAXATIONS), float(sharpness)
        )

    def step(
        self, states: Any, actions: Any, *, seeds: Any = 0, steps: int = 0
    ) -> tuple[Array, Array]:
        """Next states (n, S) and rewards (n,) of states (n, S) and actions (n, A), which are nan where
        a step faults. seeds: of what each draws, as an environment's after reset(seed=...) draws in its
        first episode; an int, or (n,). steps: made so far."""
        given = self._rows(states, actions, seeds)
        return self._step(*given, whole("steps", steps, 0))

    def pull_back(
        self,
        states: Any,
        actions: Any,
        next_adjoints: Any,
        reward_adjoints: Any,
        *,
        seeds: Any = 0,
        steps: int = 0,
    ) -> tuple[Array, Array]:
        """The derivatives by states (n, S) and actions (n, A) of the sum of all next states times
        next_adjoints (n, S) and rewards times reward_adjoints (n,): reverse mode."""
        states, actions, numbers = self._rows(states, actions, seeds)
        next_adjoints = _array("next_adjoints", next_adjoints, states.shape)
        reward_adjoints = _array("reward_adjoints", reward_adjoints, states.shape[:1])
        by_state, by_action = np.empty_like(states), np.empty_like(actions)
        self._native.pull_back(
            states,
            actions,
            numbers,
            whole("steps", steps, 0),
            next_adjoints,
            reward_adjoints,
            by_state,
            by_action,
        )
        return by_state, by_action

    def jacobian(self, state: Any, action: Any, *, seed: int = 0, steps: int | None = None) -> Jacobian:
        """All derivatives of one step. state: a State, a dictionary of values (others are the initial
        ones) or (S,). action: a dictionary of values (others are defaults) or (A,). steps: made so far;
        None: those of the State, or 0."""
        if steps is None:
            steps = state.steps if isinstance(state, State) else 0
        state, action = self._state(state), self._action(action)
        count = len(state) + 1
        states, actions = np.tile(state, (count, 1)), np.tile(action, (count, 1))
        adjoints = np.eye(count)
        by_state, by_action = self.pull_back(
            states, actions, adjoints[:, :-1], adjoints[:, -1], seeds=seed, steps=steps
        )
        next_states, rewards = self.step(state[None], action[None], seeds=seed, steps=steps)
        return Jacobian(
            self.state_names,
            self.action_names,
            next_states[0],
            float(rewards[0]),
            by_state[:-1],
            by_action[:-1],
            by_state[-1],
            by_action[-1],
        )

    def torch(self, states: Any, actions: Any, *, seeds: Any = 0, steps: int = 0) -> tuple[Any, Any]:
        """As `step`, with tensors of torch, through which gradients flow back."""
        return _torch_step().apply(states, actions, self, seeds, steps)

    # ---- forms

    def _step(
        self, states: Array, actions: Array, seeds: NDArray[np.uint64], steps: int
    ) -> tuple[Array, Array]:
        next_states, rewards = np.empty_like(states), np.empty(len(states))
        self._native.step(states, actions, seeds, steps, next_states, rewards)
        return next_states, rewards

    def _rows(
        self, states: Any, actions: Any, seeds: Any
    ) -> tuple[Array, Array, NDArray[np.uint64]]:
        try:
            count = len(states)
        except TypeError:  # a number, None
            raise ArgumentError(
                f"states: rows of {len(self.state_names)} numbers, not a {type(states).__name__}"
            ) from None
        states = _array("states", states, (count, len(self.state_names)))
        actions = _array("actions", actions, (count, len(self.action_names)))
        return states, actions, _seeds(seeds, count)

    def _state(self, given: Any) -> Array:
        model = self.problem.model
        if isinstance(given, State):
            record = self.problem.state_form.record_of(given)
            return values_of(model.states, record[None])[0]
        if isinstance(given, Mapping):
            defaults = default_values(self.problem, model.states)
            named = NamedValues(model.states, defaults, "state-fluent", ArgumentError)
            return np.array(named.values(given), np.float64)
        return _array("the state", given, (len(self.state_names),))

    def _action(self, given: Any) -> Array:
        if isinstance(given, Mapping):
            fluents = self.problem.model.actions
            defaults = default_values(self.problem, fluents)
            named = NamedValues(fluents, defaults, "action", ActionError)
            return np.array(named.values(given), np.float64)
        return _array("the action", given, (len(self.action_names),))


def _array(what: str, given: Any, shape: tuple[int, ...]) -> Array:
    try:
        array = np.ascontiguousarray(given, np.float64)
    except (ValueError, TypeError):
        raise ArgumentError(f"{what}: numbers of the shape {shape}") from None
    if array.shape != shape:
        raise ArgumentError(f"{what}: the shape is {shape}, not {array.shape}")
    return array


def _seeds(given: Any, count: int) -> NDArray[np.uint64]:
    try:
        # Objects keep whole numbers of any size, and fractions, which a cast would cut off.
        numbers = np.asarray(given, None if isinstance(given, np.ndarray) else object)
        if _are_seeds(numbers):
            return np.ascontiguousarray(np.broadcast_to(numbers.astype(np.uint64), (count,)))
    except (ValueError, TypeError, OverflowError):
        pass
    raise ArgumentError(f"seeds are a whole number from 0 to 2^64 - 1, or {count} of them")


def _are_seeds(numbers: NDArray[Any]) -> bool:
    if numbers.dtype.kind == "O":
        return all(
            isinstance(each, (int, np.integer)) and not isinstance(each, bool) and each >= 0
            for each in numbers.flat
        )
    return numbers.dtype.kind in "iu" and bool((numbers >= 0).all())


def _torch_step() -> Any:
    """The function of torch, which is made when it is needed: torch is optional."""
    try:
        import torch
    except ImportError:
        raise Error("gradients in torch need torch: pip install torch") from None

    class Step(torch.autograd.Function):
        @staticmethod
        def forward(ctx: Any, states: Any, actions: Any, step: Derivatives, seeds: Any, steps: int) -> Any:
            ctx.save_for_backward(states, actions)
            ctx.step, ctx.seeds, ctx.steps = step, seeds, steps
            results = step.step(_numpy(states), _numpy(actions), seeds=seeds, steps=steps)
            return tuple(torch.as_tensor(each).to(states) for each in results)

        @staticmethod
        def backward(ctx: Any, next_adjoints: Any, reward_adjoints: Any) -> Any:
            states, actions = ctx.saved_tensors
            found = ctx.step.pull_back(
                _numpy(states),
                _numpy(actions),
                _numpy(next_adjoints),
                _numpy(reward_adjoints),
                seeds=ctx.seeds,
                steps=ctx.steps,
            )
            by_state, by_action = (torch.as_tensor(each).to(states) for each in found)
            return by_state, by_action, None, None, None

    return Step


def _numpy(tensor: Any) -> Array:
    array: Array = tensor.detach().cpu().double().numpy()
    return array
