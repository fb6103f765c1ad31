"""Planners: they act well at once, by searching before each action (docs/planning.md).

    env = rddlc.make("MountainCar_ippc2023", "1")
    planner = rddlc.plan.CEM(env, seconds=0.1)
    observation, info = env.reset(seed=0)
    observation, reward, terminated, truncated, info = env.step(planner.act(observation))
"""

from __future__ import annotations

import os
from typing import Any, ClassVar

from . import _native
from .acting import Environment, actions_in, environment_in, problem_in
from .arguments import shown
from .environment import RDDLEnv
from .errors import ArgumentError
from .evaluation import Evaluation, evaluation_of
from .learners import Learner, Solvable, Wrapped
from .problems import Problem

__all__ = ["CEM", "Gradient", "Planner", "Rollout", "UCT"]


class Planner:
    """What all planners have in common. Options are keywords; True and False are yes and no."""

    name: ClassVar[str]

    def __init__(self, env_or_problem: Solvable, **options: Any) -> None:
        self._env = environment_in(env_or_problem)
        self.problem: Problem = problem_in(env_or_problem)
        self.text = ",".join([f"plan:{self.name}", *map(_option, options.items())])
        """As `rddl evaluate --policy` takes it."""
        self._native = _native.policy_named(self.problem.simulator, self.text)
        self._acted_in: Any = None

    def act(self, observation: Any = None, env: Wrapped | None = None) -> Any:
        """Returns the action, as env.step takes it, for the present state of the planner's environment,
        or of another one of the same problem, also within wrappers, which may stand in the first place
        too. A planner uses the state, not the observation; of a problem that is observed in part, the
        observations of the env since its reset. Call it once before each step."""
        acting = self._acting_env(observation, env)
        batch = acting._batch
        self._native.plan(batch, self._acted_in is not batch)
        self._acted_in = batch
        return actions_in(acting, batch.actions, is_single=isinstance(acting, RDDLEnv))

    def _acting_env(self, observation: Any, env: Any) -> Environment:
        given = observation if env is None else env
        acting = environment_in(given)
        if environment_in(observation) not in (None, acting):
            raise ArgumentError("act: there are two envs: say in which one it acts")
        if acting is None and (env is not None or _is_no_observation(given)):
            raise ArgumentError(f"act: {shown(given)} is neither an observation nor an env of rddlc")
        acting = self._env if acting is None else acting
        if acting is None:
            raise ArgumentError("act: the planner was made of a problem: say in which env it acts")
        form = acting.problem.state_form.problem
        if form != self.problem.state_form.problem:
            raise ArgumentError(
                f"act: the env is of {acting.model.instance}, and the planner of "
                f"{self.problem.model.instance}"
            )
        return acting

    def evaluate(
        self,
        episodes: int = 10,
        *,
        seed: int = 0,
        threads: int = 0,
        horizon: int | None = None,
    ) -> Evaluation:
        """The returns of the planner in the episodes of this seed; as `rddl evaluate --seed`.
        horizon: steps; None: the instance's; 0: no horizon. threads: 0: one for each core."""
        return evaluation_of(self._native, episodes, seed, threads, horizon)

    def __repr__(self) -> str:
        return f"<{self.text} of {self.problem.model.instance}>"


def _is_no_observation(given: Any) -> bool:
    return isinstance(given, (str, bytes, Problem)) or hasattr(given, "step")


def _option(item: tuple[str, Any]) -> str:
    keyword, value = item
    if isinstance(value, bool):
        value = "yes" if value else "no"
    if isinstance(value, (Learner, Planner)):
        raise ArgumentError(
            f"{keyword} is a {type(value).__name__}, not a text: give the name of a policy file, as "
            f"save() writes it, or that of a policy, as in {keyword}='random'"
        )
    word = os.fsdecode(value) if isinstance(value, os.PathLike) else str(value)
    if "," in word:
        raise ArgumentError(f"{keyword}: '{word}' has a comma in it, which separates options")
    return f"{keyword}={word}"


class CEM(Planner):
    """The best of many courses of actions, sampled again and again, for any kind of actions:

    """

    __doc__ = (__doc__ or "").rstrip(" ") + _native.planner_options("cem")
    name = "cem"


class Gradient(Planner):
    """Plans that go up the exact gradient of their return, for reals, ints between bounds and bools:

    """

    __doc__ = (__doc__ or "").rstrip(" ") + _native.planner_options("gradient")
    name = "gradient"


class Rollout(Planner):
    """Each action of a policy improved: others are tried, and the policy plays on.

    """

    __doc__ = (__doc__ or "").rstrip(" ") + _native.planner_options("rollout")
    name = "rollout"


class UCT(Planner):
    """A tree of actions and of what they lead to, built by trials, for any kind of actions.

    """

    __doc__ = (__doc__ or "").rstrip(" ") + _native.planner_options("uct")
    name = "uct"
