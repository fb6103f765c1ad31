"""The reference: what the real pyRDDLGym does from given states under given actions.

The simulator is stepped directly (RDDLSimulator.step on arrays), from states that we put into its
table of values. A step only rebinds entries of that table and never writes into an array, so that
a shallow copy of the table is a full reset to the same state; `draw` checks that.
"""

import logging
import runpy
import time
import warnings
import zlib
from dataclasses import dataclass

import numpy as np

import pyRDDLGym
from model import (
    REWARD,
    TERMINATED,
    TRUNCATED,
    Columns,
    DrawPoint,
    Fluent,
    Problem,
    Transitions,
    Values,
    stack,
)
from problems import Case
from pyRDDLGym.core.parser.expr import Expression

DETERMINISTIC_DISTRIBUTIONS = {"KronDelta", "DiracDelta"}
ATTEMPTS_AT_LEGAL_ACTIONS = 20
SHARE_OF_DEFAULT_ACTIONS = 0.1
LEAST_DRAWS = 500  # at a point, however slow
MARGIN = 0.05  # how far beyond their bounds states are scattered, as a share of the range


class Reference:
    """One instance, loaded by pyRDDLGym, and a random stream of our own for its actions."""

    def __init__(self, case: Case):
        warnings.simplefilter("ignore")
        np.seterr(all="ignore")
        logging.disable(logging.WARNING)
        self.env = pyRDDLGym.make(
            str(case.domain_path),
            str(case.instance_path),
            vectorized=True,
            backend_kwargs={
                "objects_as_strings": False,
                "python_functions": python_functions(case),
            },
        )
        self.model = self.env.model
        self.simulator = self.env.sampler
        self.seed = zlib.crc32(case.label.encode())
        self.simulator.seed(self.seed)
        self.choices = np.random.default_rng([self.seed, 1])
        self.problem = self._describe()
        self.initial_table = dict(self.simulator.init_values)

    # -------------------------------------------------------------------------- description

    def _describe(self) -> Problem:
        model = self.model
        random = random_names(model)
        next_names = model.next_state

        def fluent(name: str, cpf: str | None) -> Fluent:
            value_range = model.variable_ranges[name]
            parameters = model.variable_params[name]
            return Fluent(
                name,
                value_range,
                tuple(len(model.type_to_objects[parameter]) for parameter in parameters),
                tuple(model.variable_groundings[name]),
                tuple(o.removeprefix("@") for o in model.type_to_objects.get(value_range, ())),
                cpf in random,
            )

        random_states = {name for name, cpf in next_names.items() if cpf in random}
        endings = [*model.terminations, *model.invariants]
        return Problem(
            states=tuple(fluent(name, next_names[name]) for name in model.state_fluents),
            observations=tuple(fluent(name, name) for name in model.observ_fluents),
            actions=tuple(fluent(name, None) for name in model.action_fluents),
            horizon=model.horizon,
            random_reward=is_random(model.reward, random),
            random_ending=any(is_random(condition, random_states) for condition in endings),
        )

    # ----------------------------------------------------------------------------- stepping

    def seconds_a_step(self) -> float:
        state, action = self.initial_state(), self.default_action()
        begin = time.perf_counter()
        for _ in range(3):
            self.step(state, action)
        return (time.perf_counter() - begin) / 3

    def initial_state(self) -> Values:
        return {f.name: self._flat(f, self.initial_table[f.name]) for f in self.problem.states}

    def step(self, state: Values, action: Values) -> Values:
        """One step of the real simulator: the outcome as flat values."""
        return self._step(self._table(state), self._action(action))

    def draw(self, state: Values, action: Values, count: int) -> DrawPoint:
        """The same step `count` times, with new random numbers each time."""
        table = self._table(state)
        before = {name: np.copy(value) for name, value in table.items() if value is not None}
        arrays = self._action(action)
        rows = [self._step(dict(table), arrays) for _ in range(count)]
        for name, value in before.items():
            if not np.array_equal(value, table[name], equal_nan=np.asarray(value).dtype.kind == "f"):
                raise AssertionError(f"a step of the reference changed {name} of its start")
        return DrawPoint(state, action, stack(rows))

    def _step(self, table: dict, arrays: dict) -> Values:
        simulator = self.simulator
        simulator.subs = table
        _, reward, terminated = simulator.step(arrays)
        outcome = {f.name: self._flat(f, table[f.name]) for f in self.problem.outcome_fluents()}
        outcome[REWARD] = np.array([reward], dtype=np.float64)
        outcome[TERMINATED] = np.array([terminated], dtype=np.bool_)
        outcome[TRUNCATED] = np.array([not simulator.check_state_invariants(silent=True)])
        return outcome

    def _table(self, state: Values) -> dict:
        """The simulator's table of values at the start of a step."""
        table = dict(self.initial_table)
        for fluent in self.problem.states:
            table[fluent.name] = self._shaped(fluent, state[fluent.name])
        return table

    def _action(self, action: Values) -> dict:
        return {f.name: self._shaped(f, action[f.name]) for f in self.problem.actions}

    @staticmethod
    def _shaped(fluent: Fluent, values: np.ndarray):
        return values.reshape(fluent.shape) if fluent.shape else values[0]

    @staticmethod
    def _flat(fluent: Fluent, value) -> np.ndarray:
        # The simulator does not convert on assignment: an int fluent may hold bools, a real one ints.
        return np.asarray(value).astype(fluent.dtype).reshape(-1)

    # ------------------------------------------------------------------------------ actions

    def default_action(self) -> Values:
        return {f.name: self._flat(f, self.initial_table[f.name]) for f in self.problem.actions}

    def random_action(self, state: Values) -> Values:
        """A random action that max-nondef-actions and the preconditions allow; at worst the default.

        What breaks a precondition is thinned out and shrunk towards the default, a little more at
        every attempt.
        """
        default = self.default_action()
        if self.choices.random() < SHARE_OF_DEFAULT_ACTIONS:
            return default
        wild = {f.name: self._random_values(f) for f in self.problem.actions}
        for attempt in range(ATTEMPTS_AT_LEGAL_ACTIONS):
            action = self._thin(wild, default, 1.0 - attempt / ATTEMPTS_AT_LEGAL_ACTIONS)
            if self._is_legal(state, action):
                return action
        return default

    def _random_values(self, fluent: Fluent) -> np.ndarray:
        count = len(fluent.groundings)
        if fluent.range == "bool":
            return self.choices.random(count) < 0.5
        if fluent.objects:
            return self.choices.integers(len(fluent.objects), size=count)
        low, high = (
            np.broadcast_to(bound, fluent.shape).reshape(-1).astype(float)
            for bound in self.env._bounds[fluent.name]
        )
        # A missing bound becomes some tens away from the other one, or from 0.
        low, high = (
            np.where(np.isfinite(low), low, np.where(np.isfinite(high), high - 20.0, -10.0)),
            np.where(np.isfinite(high), high, np.where(np.isfinite(low), low + 20.0, 10.0)),
        )
        values = low + (high - low) * self.choices.random(count)
        if fluent.range == "int":
            return np.clip(np.round(values), np.ceil(low), np.floor(high)).astype(np.int64)
        return values

    def _thin(self, wild: Values, default: Values, share: float) -> Values:
        """Keeps each entry with probability `share`, at most as many as allowed, reals shrunk."""
        unusual = [
            (f, index)
            for f in self.problem.actions
            for index in np.flatnonzero(wild[f.name] != default[f.name])
        ]
        kept = [entry for entry in unusual if self.choices.random() < share]
        self.choices.shuffle(kept)
        action = {name: np.copy(values) for name, values in default.items()}
        for fluent, index in kept[: int(self.model.max_allowed_actions)]:
            value = wild[fluent.name][index]
            if fluent.range == "real":
                base = default[fluent.name][index]
                value = base + (value - base) * share
            action[fluent.name][index] = value
        return action

    def _is_legal(self, state: Values, action: Values) -> bool:
        if not self.model.preconditions:
            return True
        self.simulator.subs = self._table(state)
        return self.simulator.check_action_preconditions(self._action(action), silent=True)

    # ------------------------------------------------------------------------------ walking

    def walk(self, count: int, stride: int) -> Transitions:
        """`count` transitions along episodes of random legal actions: every `stride`-th step, and
        as many as there is room for of those that ended an episode.

        Actions are held for some steps, longer in some episodes than in others: that takes the
        state further than shaking it would.
        Steps that pyRDDLGym refuses (a distribution's parameter out of its range) end their
        episode and are left out.
        """
        steps: list[tuple[Values, Values, Values]] = []
        ends: list[int] = []
        state, action, age, hold = self.initial_state(), None, 0, 0.5
        for _ in range(count * stride):
            if age == 0:
                hold = self.choices.choice([0.0, 0.5, 0.9, 0.98])
            if action is None or self.choices.random() > hold or not self._is_legal(state, action):
                action = self.random_action(state)
            try:
                outcome = self.step(state, action)
            except (ValueError, ArithmeticError):
                state, action, age = self.initial_state(), None, 0
                continue
            steps.append((state, action, outcome))
            state, age = {f.name: outcome[f.name] for f in self.problem.states}, age + 1
            ended = bool(outcome[TERMINATED][0] or outcome[TRUNCATED][0])
            if ended:
                ends.append(len(steps) - 1)
            if ended or age == self.problem.horizon:
                state, action, age = self.initial_state(), None, 0
        kept = sorted(set(ends[: count // 4]) | set(range(0, len(steps), stride)))
        return transitions_of([steps[index] for index in kept])

    def scatter(self, walk: Transitions, count: int) -> Transitions | None:
        """`count` steps from states drawn uniformly within the bounds of the state, or within what
        the walk has seen, and a little beyond: random walks seldom get to the ends. Only where
        every state is real-valued, since values of other kinds often do not go together."""
        if any(f.range != "real" for f in self.problem.states):
            return None
        steps = []
        for _ in range(4 * count):
            state = {f.name: self._scattered_values(f, walk) for f in self.problem.states}
            if len(steps) == count or not self._is_running(state):
                continue
            action = self.random_action(state)
            try:
                steps.append((state, action, self.step(state, action)))
            except (ValueError, ArithmeticError):
                continue
        return transitions_of(steps) if steps else None

    def _scattered_values(self, fluent: Fluent, walk: Transitions) -> np.ndarray:
        seen = walk.states[fluent.name]
        low, high = (
            np.broadcast_to(bound, fluent.shape).reshape(-1).astype(float)
            for bound in self.env._bounds[fluent.name]
        )
        low = np.where(np.isfinite(low), low, seen.min(axis=0))
        high = np.where(np.isfinite(high), high, seen.max(axis=0))
        return low + (high - low) * self.choices.uniform(-MARGIN, 1.0 + MARGIN, len(low))

    def _is_running(self, state: Values) -> bool:
        self.simulator.subs = self._table(state)
        return not self.simulator.check_terminal_states()

    def draw_at(self, starts: list[tuple[Values, Values]], count: int) -> list[DrawPoint]:
        """Draws from each state under its action, except for those that pyRDDLGym refuses."""
        points = []
        for state, action in starts:
            try:
                points.append(self.draw(state, action, count))
            except (ValueError, ArithmeticError):  # a distribution's parameter out of its range
                continue
        return points


def transitions_of(steps: list[tuple[Values, Values, Values]]) -> Transitions:
    states, actions, outcomes = zip(*steps)
    return Transitions(stack(states), stack(actions), stack(outcomes))


def joined(first: Transitions, second: Transitions | None) -> Transitions:
    if second is None:
        return first

    def both(a: Columns, b: Columns) -> Columns:
        return {name: np.concatenate([a[name], b[name]]) for name in a}

    return Transitions(
        both(first.states, second.states),
        both(first.actions, second.actions),
        both(first.outcomes, second.outcomes),
    )


# ---------------------------------------------------------------------------------- recording


@dataclass(frozen=True)
class Plan:
    """How much of an instance is compared."""

    transitions: int = 50
    stride: int = 20  # steps walked for each transition kept
    draw_points: int = 4
    draws: int = 2000  # at each of these points
    glances: int = 40  # draws at the start of every transition
    seconds: float = 60.0  # for the walk, and for the draws; less is compared where steps are slow


@dataclass
class Recording:
    """The behaviour of the reference on one instance."""

    problem: Problem
    walk: Transitions
    points: list[DrawPoint]  # with many draws first, then those with few


def record(case: Case, plan: Plan) -> Recording:
    reference = Reference(case)
    affordable = plan.seconds / reference.seconds_a_step()
    stride = int(np.clip(affordable / plan.transitions, 1, plan.stride))
    walk = reference.walk(int(min(plan.transitions, affordable)), stride)
    walk = joined(walk, reference.scatter(walk, plan.transitions // 2))
    points: list[DrawPoint] = []
    if reference.problem.is_random():
        draws = int(min(plan.draws, max(affordable, LEAST_DRAWS)))
        count = int(np.clip(affordable / draws, 1, plan.draw_points))
        glanced = int(min(len(walk), max(1, affordable / plan.glances)))
        starts = [(reference.initial_state(), reference.random_action(reference.initial_state()))]
        starts += walk.starts(count - 1)
        points += reference.draw_at(starts, draws)
        points += reference.draw_at(walk.starts(glanced), plan.glances)
    return Recording(reference.problem, walk, points)


# ------------------------------------------------------------------------- what depends on draws


def python_functions(case: Case) -> dict:
    """The external functions by name; in RDDL a name may have a minus."""
    if case.python_functions is None:
        return {}
    functions = runpy.run_path(str(case.python_functions))
    return functions | {name.replace("_", "-"): value for name, value in functions.items()}


def random_names(model) -> set[str]:
    """The CPFs whose value depends, within the step, on a random draw."""
    random: set[str] = set()
    while True:
        found = {name for name, (_, body) in model.cpfs.items() if is_random(body, random)}
        if found <= random:
            return random
        random |= found


def is_random(expression, random: set[str]) -> bool:
    """Does the expression draw, or mention one of the given names?"""
    if isinstance(expression, Expression):
        kind, name = expression.etype
        if kind == "randomvector":  # external functions of ours draw nothing
            return True
        if kind == "randomvar" and name not in DETERMINISTIC_DISTRIBUTIONS:
            return True
        if kind == "pvar" and name in random:
            return True
        return is_random(expression.args, random)
    if isinstance(expression, (tuple, list)):
        return any(is_random(part, random) for part in expression)
    if isinstance(expression, dict):
        return any(is_random(part, random) for part in expression.values())
    return False

