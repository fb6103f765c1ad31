"""The learners of rddlc: proximal policy optimisation, Cartesian genetic programming, and deep reactive
policies by exact gradients.

All are native: they know simulators, not Gymnasium's spaces, and learn without Python's lock. What
they save is what `rddl evaluate` and `rddl export` read (docs/solvers.md).
"""

from __future__ import annotations

import html
import os
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Protocol, TypeVar

from . import _native
from .acting import actions_in, batch_at, environment_in, problem_in, shows
from .arguments import SEEDS, seed_of, shown, whole
from .callbacks import Callback
from .environment import RDDLEnv
from .errors import ArgumentError, Error
from .evaluation import MOST_EPISODES, Evaluation, evaluation_of
from .problems import Problem

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .learner_options import CGPOptions, DRPOptions, PPOOptions


class Wrapped(Protocol):
    """An environment of rddlc, also within wrappers of Gymnasium or Stable-Baselines3."""

    @property
    def unwrapped(self) -> Any: ...


Solvable = Problem | Wrapped
"""Whatever wrappers do to an environment, learners know its problem alone."""
EVALUATION_SEED = 0x65766131  # with the learner's seed, as `rddl train` has it
EVALUATION_HORIZON = 1000  # of a problem without one
L = TypeVar("L", bound="Learner")


@dataclass(frozen=True)
class _Best:
    text: str
    evaluation: Evaluation


class Learner:
    """The common part of PPO, CGP and DRP."""

    solver: ClassVar[str]
    extension: ClassVar[str]
    total: ClassVar[str]  # the option for the amount of training

    def __new__(cls: type[L], *given: Any, **options: Any) -> L:
        if len(given) > 1:
            raise ArgumentError(
                f"rddlc.{cls.__name__} takes an environment alone, as in rddlc.{cls.__name__}(env): what a policy "
                "is like is set by options"
            )
        return super().__new__(cls)

    def __init__(self, env_or_problem: Solvable, *, verbose: int = 0, **options: Any) -> None:
        self.problem = problem_in(env_or_problem)
        self._env = environment_in(env_or_problem)
        self._verbose = whole("verbose", verbose, 0)
        self._options = options
        self._native: _native.Learner | None = None
        self._loaded: str | None = None  # a policy file
        self._best: _Best | None = None
        self._latest: Evaluation | None = None
        self._forget_actor()

    def _forget_actor(self) -> None:
        """Called before whatever changes the policy: no other value is kept of it."""
        self._actor: _native.Policy | None = None
        self._is_deterministic = True
        self._acts_in: Any = None

    def _new_native(self, options: dict[str, Any]) -> _native.Learner:
        raise NotImplementedError

    def learn(
        self: L,
        amount: int | None = None,
        callback: Callback | Sequence[Callback] | None = None,
        *,
        total_timesteps: int | None = None,
        evaluations: int = 20,
        evaluation_episodes: int = 20,
        progress_bar: bool = False,
    ) -> L:
        """Learns for so many steps (PPO, DRP) or generations (CGP); another call continues.
        Ctrl-C ends it, also within an update, and keeps what has been learned.

        callback: called with the learner after each update; learning ends when it returns False.
            rddlc.callbacks has some. A list of callbacks is called in its order.
        total_timesteps: of PPO and DRP another name of `amount`.
        evaluations: so often, evenly, the policy is evaluated in `evaluation_episodes` episodes of
            the same seeds, and `best` keeps the best one; 0: never. With verbose=1 each of them is
            printed.
        progress_bar: whether a line on standard error shows how much has been learned.
        """
        amount = self._amount_of(amount, total_timesteps)
        callbacks = callback if isinstance(callback, Sequence) else [callback] if callback else []
        evaluations = whole("evaluations", evaluations, 0)
        evaluation_episodes = whole("evaluation_episodes", evaluation_episodes, 1, MOST_EPISODES)
        if self._loaded is not None:
            raise Error(
                "a policy that was loaded cannot learn on, since its file does not hold all that "
                "learning needs: learn with a new one"
            )
        before = self.steps
        learner = self._new_native(self._options | {self.total: before + amount})
        said = ""
        if self._native is None:
            said = learner.prepare()
        else:
            learner.load(self._native.save())
        self._forget_actor()
        self._native = learner
        if said:
            self._show_imitation(said, evaluations, evaluation_episodes)
        made, evaluated_at = 0, -1
        while not learner.done:
            self._forget_actor()
            learner.update()
            due = (self.steps - before) * evaluations // amount
            if due > made:
                self._evaluate_for_best(evaluation_episodes)
                made, evaluated_at = due, self.steps
            if progress_bar:
                _show_progress(self.steps - before, amount)
            if False in [each(self) for each in callbacks]:
                break
        if progress_bar:
            print(file=sys.stderr)
        if evaluations and evaluated_at != self.steps:
            self._evaluate_for_best(evaluation_episodes)
        return self

    def _show_imitation(self, said: str, evaluations: int, episodes: int) -> None:
        """The policy that imitates counts as the first one that was learned."""
        if self._verbose:
            print(said)
        if evaluations:
            self._evaluate_for_best(episodes)

    def _amount_of(self, amount: int | None, total_timesteps: int | None) -> int:
        if total_timesteps is not None and self.total != "steps":
            raise ArgumentError(f"this learner counts {self.total}, not steps: say learn({self.total})")
        if (amount is None) == (total_timesteps is None):
            raise ArgumentError(f"learn() takes one number of {self.total}")
        return whole(self.total, total_timesteps if amount is None else amount, 1)

    def _evaluate_for_best(self, episodes: int) -> None:
        problem = self.problem.model
        self._latest = self.evaluate(
            episodes if problem.stochastic else 1,
            seed=(int(self._options.get("seed", 0)) + EVALUATION_SEED) % SEEDS,
            horizon=None if problem.horizon else EVALUATION_HORIZON,
        )
        if self._latest.is_better_than(None if self._best is None else self._best.evaluation):
            self._best = _Best(self.policy_text, self._latest)
        if self._verbose:
            print(f"{self.steps} {self.total}: {self._latest}")

    @property
    def steps(self) -> int:
        """Steps or generations that have been learned."""
        return 0 if self._native is None else self._native.steps

    @property
    def progress(self) -> dict[str, float]:
        """Returns the results of the last update, by Stable-Baselines3's names; "eval/mean_reward"
        and "eval/mean_ep_length" after the first evaluation."""
        known = {} if self._native is None else self._native.row()
        if self._latest is not None:
            known["eval/mean_reward"] = self._latest.returns.mean
            known["eval/mean_ep_length"] = self._latest.lengths.mean
        return known

    @property
    def policy_text(self) -> str:
        """Returns the text of a policy file: the policy as it is now."""
        if self._native is not None:
            return self._native.policy_text()
        if self._loaded is not None:
            return self._loaded
        raise Error("nothing has been learned yet: call learn() or load()")

    @property
    def best(self: L) -> L:
        """Returns the best policy of the evaluations of learn(), as `rddl train` keeps it: to
        predict, to evaluate and to save. It stays the same while learning continues. For a
        policy that was loaded, and without evaluations, it is the policy as it is now."""
        text = self.policy_text if self._best is None else self._best.text
        return self._of_text(text, self._env or self.problem)

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

    def predict(
        self,
        observation: Any,
        state: Any = None,
        episode_start: Any = None,
        deterministic: bool = True,
    ) -> tuple[Any, None]:
        """Returns the action, as env.step takes it, for an observation or for an environment: of any
        instance that the policy may act in, also within wrappers. The second result and `state`
        and `episode_start` are Stable-Baselines3's, and mean nothing.

        An observation that the learner's own environment shows now stands for that environment: the
        policy knows the time, and remembers the episode, if it is called once before each step. Any
        other observation of a problem that is fully observed is taken for the start of an episode.
        Rows of observations give rows of actions.
        """
        env = environment_in(observation)
        if env is not None:
            batch = env._batch
        else:
            env = self._env = self._env or RDDLEnv(self.problem)
            batch = env._batch if shows(env, observation) else batch_at(env, observation)
        if self._actor is None or self._is_deterministic != deterministic:
            self._actor, self._acts_in = self.policy(deterministic=deterministic), None
            self._is_deterministic = deterministic
        self._actor.act(batch, self._acts_in is not batch)
        self._acts_in = batch
        is_single = isinstance(env, RDDLEnv) and len(batch.rewards) == 1
        return actions_in(env, batch.actions, is_single=is_single), None

    def evaluate(
        self,
        episodes: int = 100,
        *,
        seed: int = 0,
        threads: int = 0,
        horizon: int | None = None,
    ) -> Evaluation:
        """The returns of the policy in the episodes of this seed; as `rddl evaluate --seed`.
        horizon: steps; None: the instance's; 0: no horizon. threads: 0: one for each core."""
        return evaluation_of(self.policy(), episodes, seed, threads, horizon)

    def save(self, path: str | os.PathLike[str], *, best: bool = False) -> Path:
        """Writes the policy file: of the policy as it is now, or of the `best` one. Adds the
        extension if the name has no extension."""
        file = Path(_native.path_text(path))
        file = file if file.suffix else file.with_suffix(self.extension)
        _native.write_file(file, (self.best if best else self).policy_text)
        return file

    @classmethod
    def load(cls: type[L], path: str | os.PathLike[str], env_or_problem: Solvable) -> L:
        """From a policy file, or that of the folder of a run, to predict and evaluate."""
        learner = cls._of_text(_native.policy_of_file(path), env_or_problem)
        solver = _native.solver_of_text(learner.policy_text)
        if solver != cls.solver:
            raise ArgumentError(
                f"{shown(path)} is a policy that {solver.upper()} has learned: "
                f"rddlc.{solver.upper()}.load() reads it"
            )
        return learner

    @classmethod
    def _of_text(cls: type[L], text: str | bytes, env_or_problem: Solvable) -> L:
        learner = cls.__new__(cls)
        Learner.__init__(learner, env_or_problem)  # without what it takes to learn
        learner._loaded = text if isinstance(text, str) else text.decode(errors="replace")
        learner.policy()  # refuses impossible values
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


def _show_progress(made: int, amount: int) -> None:
    share = min(made / amount, 1)
    done = round(share * 40)
    print(f"\r[{'=' * done}{' ' * (40 - done)}] {share:4.0%} {made:,} of {amount:,}", end="", file=sys.stderr)


class PPO(Learner):
    """Proximal policy optimisation: a neural network.

    Options are keywords, with the values that `rddl help train ppo` lists; lists are Python's, and
    True and False are on and off:

    """

    __doc__ = (__doc__ or "").rstrip(" ") + _native.ppo_options()

    solver, extension, total = "ppo", ".json", "steps"

    def __init__(
        self, env_or_problem: Solvable, *, verbose: int = 0, **options: Unpack[PPOOptions]
    ) -> None:
        imitated = options.get("imitate")
        if imitated is None:
            options.pop("imitate", None)
        elif not isinstance(imitated, (str, os.PathLike)):
            raise ArgumentError(
                f"imitate is a {type(imitated).__name__}, not a text: give the name of a policy file, or "
                "that of a policy, as in imitate='plan:cem,steps=200' (a planner's is its `text`)"
            )
        super().__init__(env_or_problem, verbose=verbose, **options)
        self._new_native({"steps": 1, **options})  # refuses options that cannot be
        if imitated:  # "" is to imitate nothing
            # Refuses a policy that cannot act.
            _native.policy_named(self.problem.simulator, str(imitated))

    def _new_native(self, options: dict[str, Any]) -> _native.Learner:
        return _native.ppo(self.problem.simulator, options)


class CGP(Learner):
    """Cartesian genetic programming: finds a formula, which str() prints.

    Options are keywords, with the values that `rddl help train cgp` lists; lists are Python's, and
    True and False are on and off:

    """

    __doc__ = (__doc__ or "").rstrip(" ") + _native.cgp_options()

    solver, extension, total = "cgp", ".cgp", "generations"

    def __init__(
        self, env_or_problem: Solvable, *, verbose: int = 0, **options: Unpack[CGPOptions]
    ) -> None:
        super().__init__(env_or_problem, verbose=verbose, **options)
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
        """Notebooks show its formula."""
        return f"<pre>{html.escape(self.formula)}</pre>"


class DRP(Learner):
    """A deep reactive policy: a neural network that goes up the exact gradient of its return, through
    all steps of its episodes (docs/planning.md).

    Options are keywords, with the values that `rddl help train drp` lists; lists are Python's, and
    True and False are on and off:

    """

    __doc__ = (__doc__ or "").rstrip(" ") + _native.drp_options()

    solver, extension, total = "drp", ".json", "steps"

    def __init__(
        self, env_or_problem: Solvable, *, verbose: int = 0, **options: Unpack[DRPOptions]
    ) -> None:
        super().__init__(env_or_problem, verbose=verbose, **options)
        self._new_native({"steps": 1, **options})  # refuses options that cannot be

    def _new_native(self, options: dict[str, Any]) -> _native.Learner:
        return _native.drp(self.problem.simulator, options)
