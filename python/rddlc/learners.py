"""The learners of rddlc: proximal policy optimisation, and Cartesian genetic programming.

Both are native: they know simulators, not Gymnasium's spaces, and learn without Python's lock. What
they save is what `rddl evaluate` and `rddl export` read (docs/solvers.md).
"""

from __future__ import annotations

import html
import math
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, TypeVar

from . import _native
from .arguments import SEEDS, seed_of, thread_count, whole, whole_or_none
from .dictionaries import GroundedReader, LiftedReader
from .environment import RDDLEnv
from .errors import ArgumentError, Error
from .lifted import LiftedRows
from .problems import Problem
from .vector import RDDLVectorEnv

Solvable = Problem | RDDLEnv | RDDLVectorEnv
Callback = Callable[["Learner"], bool | None]
"""Called after each update; learning ends where it gives False."""
MOST_EPISODES = 10_000_000
EVALUATION_SEED = 0x65766131  # with the learner's seed, as `rddl train` has it
EVALUATION_HORIZON = 1000  # of a problem without one
L = TypeVar("L", bound="Learner")


@dataclass(frozen=True)
class Estimate:
    """A mean of episodes, with the half width of its 95 % confidence interval."""

    mean: float
    deviation: float
    minimum: float
    maximum: float
    half_width: float


@dataclass(frozen=True)
class Evaluation:
    """What a policy earns."""

    episodes: int
    returns: Estimate
    """Sums of rewards, undiscounted."""
    discounted_returns: Estimate
    lengths: Estimate
    """Steps."""
    terminated: int
    """Episodes that a termination condition has ended."""
    faulted: int

    def is_better_than(self, other: Evaluation | None) -> bool:
        """As `rddl train` chooses the best policy: by the mean return, and of equal ones by which
        reaches its end sooner. One that is not finite is never better."""
        mean = self.returns.mean
        if not math.isfinite(mean) or other is None:
            return math.isfinite(mean)
        is_sooner = self.terminated > 0 and self.lengths.mean < other.lengths.mean
        return mean > other.returns.mean or (mean == other.returns.mean and is_sooner)

    def __str__(self) -> str:
        returns = self.returns
        return f"return {returns.mean:.6g} +- {returns.half_width:.3g} ({self.episodes} episodes)"


@contextmanager
def _refusals() -> Iterator[None]:
    """An option that is refused is an argument that cannot be."""
    try:
        yield
    except _native.Refused as refused:
        raise ArgumentError(str(refused)) from None


def chosen_action(env: RDDLEnv | RDDLVectorEnv, function: str) -> Any:
    """What a policy has written into the environment's records, as env.step takes it."""
    fluents, batch = env.problem.model.actions, env._batch
    if isinstance(env, RDDLVectorEnv):
        return LiftedRows(fluents, batch.actions, batch.actions).rows(copy=True)
    if env._forms["actions"] != "dict":
        raise Error(f"{function}() gives dictionaries: make the environment with actions='dict'")
    reader = LiftedReader if env._forms["vectorized"] else GroundedReader
    return reader(fluents, batch.actions).read()


def evaluation_of(
    policy: _native.Policy, episodes: int, seed: int, threads: int, horizon: int | None
) -> Evaluation:
    """The returns of a policy in the episodes of this seed."""
    found = policy.evaluate(
        whole("episodes", episodes, 1, MOST_EPISODES),
        seed_of(seed),
        thread_count(threads),
        whole_or_none("horizon", horizon, 0),
    )
    return Evaluation(
        episodes=found["episodes"],
        returns=Estimate(**found["return"]),
        discounted_returns=Estimate(**found["discounted_return"]),
        lengths=Estimate(**found["length"]),
        terminated=found["terminated"],
        faulted=found["faulted"],
    )


@dataclass(frozen=True)
class _Best:
    text: str
    evaluation: Evaluation


class Learner:
    """What PPO and CGP have in common."""

    extension: ClassVar[str]
    total: ClassVar[str]  # the option that tells how long to learn

    def __init__(self, env_or_problem: Solvable, **options: Any) -> None:
        self.problem: Problem = (
            env_or_problem if isinstance(env_or_problem, Problem) else env_or_problem.problem
        )
        self._options = options
        self._native: _native.Learner | None = None
        self._loaded: str | None = None  # a policy file
        self._best: _Best | None = None
        self._latest: Evaluation | None = None
        self._forget_actor()

    def _forget_actor(self) -> None:
        """Called before whatever changes the policy: no other value is kept of it."""
        self._actor: _native.Policy | None = None
        self._acts_in: Any = None

    def _new_native(self, options: dict[str, Any]) -> _native.Learner:
        raise NotImplementedError

    def learn(
        self: L,
        amount: int,
        callback: Callback | None = None,
        *,
        evaluations: int = 20,
        evaluation_episodes: int = 20,
    ) -> L:
        """Learns for so many steps (PPO) or generations (CGP); again, it goes on from where it was.
        Ctrl-C ends it, within an update, too, and leaves what has been learned.

        callback: called with the learner after each update; learning ends where it gives False.
        evaluations: so often, evenly, the policy is evaluated in `evaluation_episodes` episodes of
            the same seeds, and `best` keeps the best one; 0: never.
        """
        amount = whole(self.total, amount, 1)
        evaluations = whole("evaluations", evaluations, 0)
        evaluation_episodes = whole("evaluation_episodes", evaluation_episodes, 1, MOST_EPISODES)
        if self._loaded is not None:
            raise Error(
                "a policy that was loaded cannot learn on, since its file does not hold all that "
                "learning needs: learn with a new one"
            )
        before = self.steps
        learner = self._new_native(self._options | {self.total: before + amount})
        if self._native is not None:
            learner.load(self._native.save())
        self._forget_actor()
        self._native = learner
        made, evaluated_at = 0, -1
        while not learner.done:
            self._forget_actor()
            learner.update()
            due = (self.steps - before) * evaluations // amount
            if due > made:
                self._evaluate_for_best(evaluation_episodes)
                made, evaluated_at = due, self.steps
            if callback is not None and callback(self) is False:
                break
        if evaluations and evaluated_at != self.steps:
            self._evaluate_for_best(evaluation_episodes)
        return self

    def _evaluate_for_best(self, episodes: int) -> None:
        problem = self.problem.model
        self._latest = self.evaluate(
            episodes if problem.stochastic else 1,
            seed=(int(self._options.get("seed", 0)) + EVALUATION_SEED) % SEEDS,
            horizon=None if problem.horizon else EVALUATION_HORIZON,
        )
        if self._latest.is_better_than(None if self._best is None else self._best.evaluation):
            self._best = _Best(self.policy_text, self._latest)

    @property
    def steps(self) -> int:
        """Steps or generations that have been learned."""
        return 0 if self._native is None else self._native.steps

    @property
    def progress(self) -> dict[str, float]:
        """What is known after the last update, by Stable-Baselines3's names; "eval/mean_reward" and
        "eval/mean_ep_length" after the first evaluation."""
        known = {} if self._native is None else self._native.row()
        if self._latest is not None:
            known["eval/mean_reward"] = self._latest.returns.mean
            known["eval/mean_ep_length"] = self._latest.lengths.mean
        return known

    @property
    def policy_text(self) -> str:
        """What a policy file holds: the policy as it is now."""
        if self._native is not None:
            return self._native.policy_text()
        if self._loaded is not None:
            return self._loaded
        raise Error("nothing has been learned yet: call learn() or load()")

    @property
    def best(self: L) -> L:
        """The policy that was best in the evaluations of learn(), as `rddl train` keeps it: to
        predict, to evaluate and to save. It stays what it is while learning goes on. Of a policy
        that was loaded, and where nothing was evaluated, it is the policy as it is now."""
        text = self.policy_text if self._best is None else self._best.text
        return self._of_text(text, self.problem)

    @property
    def best_evaluation(self) -> Evaluation | None:
        """The returns of the best policy when it was chosen; None before the first evaluation."""
        return None if self._best is None else self._best.evaluation

    def policy(self, *, deterministic: bool = True, seed: int = 0) -> _native.Policy:
        """A policy by what has been learned so far."""
        seed = seed_of(seed)
        return _native.policy_of_text(
            self.problem.simulator, self.policy_text, not deterministic, seed
        )

    def predict(self, env: RDDLEnv | RDDLVectorEnv) -> tuple[Any, None]:
        """The action, as env.step takes it, for where `env` stands; None, as Stable-Baselines3 has a
        second result. `env` is of any instance that the policy may act in, and has actions="dict".
        Call it once before each step."""
        if self._actor is None:
            self._actor, self._acts_in = self.policy(), None
        self._actor.act(env._batch, self._acts_in is not env)
        self._acts_in = env
        return chosen_action(env, "predict"), None

    def evaluate(
        self,
        episodes: int = 100,
        *,
        seed: int = 0,
        threads: int = 0,
        horizon: int | None = None,
    ) -> Evaluation:
        """Its returns in the episodes of this seed; as `rddl evaluate --seed`. horizon: steps;
        None: the instance's; 0: none. threads: 0: one for each core."""
        return evaluation_of(self.policy(), episodes, seed, threads, horizon)

    def save(self, path: str | os.PathLike[str], *, best: bool = False) -> Path:
        """Writes the policy file: of the policy as it is now, or of the `best` one. Its name gets its
        extension if it has none."""
        file = Path(os.fsdecode(path))
        file = file if file.suffix else file.with_suffix(self.extension)
        _native.write_file(file, (self.best if best else self).policy_text)
        return file

    @classmethod
    def load(cls: type[L], path: str | os.PathLike[str], env_or_problem: Solvable) -> L:
        """From a policy file, to predict and evaluate."""
        return cls._of_text(Path(os.fsdecode(path)).read_bytes(), env_or_problem)

    @classmethod
    def _of_text(cls: type[L], text: str | bytes, env_or_problem: Solvable) -> L:
        learner = cls.__new__(cls)
        Learner.__init__(learner, env_or_problem)  # without what it takes to learn
        learner._loaded = text if isinstance(text, str) else text.decode(errors="replace")
        learner.policy()  # refuses what is none
        return learner

    def __getstate__(self) -> dict[str, Any]:
        """Pickles and copies learn on as the original does."""
        work = None if self._native is None else (self._native.steps, self._native.save())
        return self.__dict__ | {"_native": work, "_actor": None, "_acts_in": None}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        if state["_native"] is None:
            return
        steps, work = state["_native"]
        self._native = self._new_native(self._options | {self.total: max(steps, 1)})
        self._native.load(work)


class PPO(Learner):
    """Proximal policy optimisation: a neural network.

    Options are keywords, with the values that `rddl help train ppo` lists; lists are Python's, and
    True and False are on and off:

    """

    __doc__ = (__doc__ or "") + _native.ppo_options()

    extension, total = ".json", "steps"

    def __init__(self, env_or_problem: Solvable, **options: Any) -> None:
        super().__init__(env_or_problem, **options)
        self._new_native({"steps": 1, **options})  # refuses options that cannot be

    def _new_native(self, options: dict[str, Any]) -> _native.Learner:
        with _refusals():
            return _native.ppo(self.problem.simulator, options)


class CGP(Learner):
    """Cartesian genetic programming: a formula, which str() tells.

    Options are keywords, with the values that `rddl help train cgp` lists; lists are Python's, and
    True and False are on and off:

    """

    __doc__ = (__doc__ or "") + _native.cgp_options()

    extension, total = ".cgp", "generations"

    def __init__(self, env_or_problem: Solvable, **options: Any) -> None:
        super().__init__(env_or_problem, **options)
        self._new_native({"generations": 1, **options})  # refuses options that cannot be

    def _new_native(self, options: dict[str, Any]) -> _native.Learner:
        with _refusals():
            return _native.cgp(self.problem.simulator, options)

    @property
    def formula(self) -> str:
        """A line for each action-fluent."""
        return _native.formula_of_text(self.problem.simulator, self.policy_text).rstrip("\n")

    def __str__(self) -> str:
        return self.formula

    def _repr_html_(self) -> str:
        """In a notebook it is its formula."""
        return f"<pre>{html.escape(self.formula)}</pre>"
