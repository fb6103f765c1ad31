"""The learners of rddlc: proximal policy optimisation, and Cartesian genetic programming.

Both are native: they know simulators, not Gymnasium's spaces, and learn without Python's lock. What
they save is what `rddl evaluate` and `rddl export` read (docs/solvers.md).
"""

from __future__ import annotations

import html
import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, TypeVar

from . import _native
from .dictionaries import GroundedReader, LiftedReader
from .environment import RDDLEnv
from .errors import Error
from .lifted import LiftedRows
from .problems import Problem
from .vector import RDDLVectorEnv

Solvable = Problem | RDDLEnv | RDDLVectorEnv
Callback = Callable[["Learner"], bool | None]
"""Called after each update; learning ends where it gives False."""
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

    def __str__(self) -> str:
        returns = self.returns
        return f"return {returns.mean:.6g} +- {returns.half_width:.3g} ({self.episodes} episodes)"


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
        self._text: str | None = None
        self._policy: _native.Policy | None = None
        self._acts_in: Any = None

    def _new_native(self, options: dict[str, Any]) -> _native.Learner:
        raise NotImplementedError

    def learn(self: L, amount: int, callback: Callback | None = None) -> L:
        """Learns for so many steps (PPO) or generations (CGP); again, it goes on from where it was.
        Ctrl-C ends it, within an update, too, and leaves what has been learned."""
        if amount < 1:
            raise ValueError(f"{amount} {self.total} cannot be learned: one or more")
        before = 0 if self._native is None else self._native.steps
        learner = self._new_native(self._options | {self.total: before + amount})
        if self._native is not None:
            learner.load(self._native.save())
        self._native = learner
        self._text = self._policy = None
        while not learner.done:
            learner.update()
            if callback is not None and callback(self) is False:
                break
        return self

    @property
    def steps(self) -> int:
        """Steps or generations that have been learned."""
        return 0 if self._native is None else self._native.steps

    @property
    def progress(self) -> dict[str, float]:
        """What is known after the last update, by Stable-Baselines3's names."""
        return {} if self._native is None else self._native.row()

    @property
    def policy_text(self) -> str:
        """What a policy file holds."""
        if self._text is None:
            if self._native is None:
                raise Error("nothing has been learned yet: call learn() or load()")
            self._text = self._native.policy_text()
        return self._text

    def policy(self, *, deterministic: bool = True, seed: int = 0) -> _native.Policy:
        """A policy by what has been learned so far."""
        return _native.policy_of_text(
            self.problem.simulator, self.policy_text, not deterministic, seed
        )

    def predict(self, env: RDDLEnv | RDDLVectorEnv) -> tuple[Any, None]:
        """The action, as env.step takes it, for where `env` stands; None, as Stable-Baselines3 has a
        second result. `env` is of any instance that the policy may act in, and has actions="dict".
        Call it once before each step."""
        if self._policy is None:
            self._policy, self._acts_in = self.policy(), None
        batch = env._batch
        self._policy.act(batch, self._acts_in is not env)
        self._acts_in = env
        fluents = env.problem.model.actions
        if isinstance(env, RDDLVectorEnv):
            return LiftedRows(fluents, batch.actions, batch.actions).rows(copy=True), None
        if env._forms["actions"] != "dict":
            raise Error("predict() gives dictionaries: make the environment with actions='dict'")
        reader = LiftedReader if env._forms["vectorized"] else GroundedReader
        return reader(fluents, batch.actions).read(), None

    def evaluate(self, episodes: int = 100, *, seed: int = 0, threads: int = 0) -> Evaluation:
        """What it earns in the episodes of this seed; as `rddl evaluate --seed`."""
        found = self.policy().evaluate(episodes, seed, threads)
        return Evaluation(
            episodes=found["episodes"],
            returns=Estimate(**found["return"]),
            discounted_returns=Estimate(**found["discounted_return"]),
            lengths=Estimate(**found["length"]),
            terminated=found["terminated"],
            faulted=found["faulted"],
        )

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Writes the policy file; its name gets its extension if it has none."""
        file = Path(path)
        file = file if file.suffix else file.with_suffix(self.extension)
        _native.write_file(os.fspath(file), self.policy_text)
        return file

    @classmethod
    def load(cls: type[L], path: str | os.PathLike[str], env_or_problem: Solvable) -> L:
        """From a policy file, to predict and evaluate."""
        learner = cls(env_or_problem)
        learner._text = Path(path).read_text()
        learner.policy()  # refuses what is none
        return learner


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
