"""Environments as Stable-Baselines3 takes them, one or a batch.

    from rddlc import sb3
    from stable_baselines3 import PPO
    PPO("MlpPolicy", sb3.make_vec("CartPole_Continuous_gym", "0", num_envs=8)).learn(100_000)
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray
from stable_baselines3.common.vec_env import VecEnv as Base
from stable_baselines3.common.vec_env import VecMonitor

from .. import _problem_of
from ..arguments import refuse_unknown
from ..environment import RDDLEnv
from ..errors import Error
from ..vector import RDDLVectorEnv
from ..versions import AutoresetMode

Indices = None | int | Iterable[int]


def make(domain: Any, instance: Any = None, **options: Any) -> RDDLEnv:
    """`rddlc.make` with flat observations, and actions that Stable-Baselines3 takes: simplified where
    these are Discrete, MultiDiscrete or a Box with bounds, else "box" (it takes no dictionaries of
    actions, and no numbers without bounds). Options go before that: observations="dict" is for
    "MultiInputPolicy"."""
    problem = _problem_of(domain, instance, options, RDDLEnv)
    options = {"observations": "flat", "actions": "simplified", **options}
    env = RDDLEnv(problem, **options)
    if not takes_actions(env.action_space):
        env = RDDLEnv(problem, **options | {"actions": "box"})
    return env


def make_vec(domain: Any, instance: Any = None, num_envs: int = 1, **options: Any) -> VecMonitor:
    """The same of many environments in one batch (`rddlc.make_vec`), with a VecMonitor, so that
    learners log returns and lengths of episodes."""
    problem = _problem_of(domain, instance, options, RDDLVectorEnv)
    options = {"actions": "simplified", "autoreset_mode": "SameStep", **options}
    envs = RDDLVectorEnv(problem, num_envs, **options)
    if not takes_actions(envs.single_action_space):
        envs = RDDLVectorEnv(problem, num_envs, **options | {"actions": "box"})
    return VecMonitor(VecEnv(envs))


def takes_actions(space: gymnasium.Space[Any]) -> bool:
    """Whether Stable-Baselines3 has learners for such actions."""
    if isinstance(space, spaces.Box):
        return space.is_bounded()
    return isinstance(space, (spaces.Discrete, spaces.MultiDiscrete))


class VecEnv(Base):
    """Environments that restart in the step that ends them: infos[i] then holds
    "terminal_observation", "TimeLimit.truncated" and "cause"."""

    def __init__(self, env: RDDLVectorEnv) -> None:
        """`env` has autoreset_mode="SameStep", and actions that Stable-Baselines3 takes."""
        if env.metadata["autoreset_mode"] != AutoresetMode.SAME_STEP:
            raise Error("Stable-Baselines3 wants autoreset_mode='SameStep'")
        if isinstance(env.single_action_space, spaces.Dict):
            raise Error("Stable-Baselines3 takes no dictionaries of actions: say actions='box', or use make_vec")
        self.env = env
        self._actions: Any = None
        super().__init__(env.num_envs, env.single_observation_space, env.single_action_space)

    def reset(self) -> Any:
        seeds = [None if seed is None else int(seed) for seed in self._seeds]
        is_seeded = any(seed is not None for seed in seeds)
        observations, _ = self.env.reset(
            seed=seeds if is_seeded else None, options=self._options_of_reset()
        )
        self.reset_infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        self._reset_seeds()
        self._reset_options()
        return observations

    def _options_of_reset(self) -> dict[str, Any] | None:
        """Returns the options that set_options has left for the next reset: {"state": State} of
        each environment."""
        if not any(self._options):
            return None
        refuse_unknown("option of reset", {name for each in self._options for name in each}, ("state",))
        return {"state": [each.get("state") for each in self._options]}

    def step_async(self, actions: NDArray[Any]) -> None:
        self._actions = actions

    def step_wait(self) -> tuple[Any, NDArray[Any], NDArray[Any], list[dict[str, Any]]]:
        observations, rewards, terminated, truncated, info = self.env.step(self._actions)
        infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        if info:
            for place in np.flatnonzero(info["_final_obs"]):
                infos[place] = self._info_of_end(info, int(place), bool(terminated[place]))
        return observations, rewards.astype(np.float32), terminated | truncated, infos

    def _info_of_end(self, info: dict[str, Any], place: int, terminated: bool) -> dict[str, Any]:
        final = info["final_obs"]
        is_dict = isinstance(final, dict)
        return {
            "terminal_observation": {name: value[place] for name, value in final.items()}
            if is_dict
            else final[place],
            "TimeLimit.truncated": not terminated,
            "cause": info["final_info"]["cause"][place],
        }

    def action_masks(self) -> NDArray[np.bool_]:
        """(num_envs, sum of categories)"""
        return self.env.action_masks()

    def close(self) -> None:
        self.env.close()

    def get_attr(self, attr_name: str, indices: Indices = None) -> list[Any]:
        rows = self.env.get_attr(attr_name)
        return [rows[place] for place in self._get_indices(indices)]

    def get_images(self) -> list[Any]:
        images = self.env.render()
        if images is None:
            raise Error("there are no pictures: make the environments with render_mode='rgb_array', and call reset()")
        return list(images)

    def set_attr(self, attr_name: str, value: Any, indices: Indices = None) -> None:
        setattr(self.env, attr_name, value)

    def env_method(
        self, method_name: str, *method_args: Any, indices: Indices = None, **method_kwargs: Any
    ) -> list[Any]:
        """Does the same as `RDDLVectorEnv.call`: MaskablePPO asks for "action_masks" in this way."""
        rows = self.env.call(method_name, *method_args, **method_kwargs)
        return [rows[place] for place in self._get_indices(indices)]

    def env_is_wrapped(self, wrapper_class: type[Any], indices: Indices = None) -> list[bool]:
        return [False for _ in self._get_indices(indices)]

