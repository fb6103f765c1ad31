"""Dictionaries of observations for learners."""

from __future__ import annotations

from collections import OrderedDict
from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray


class MultiInput(gymnasium.ObservationWrapper[Any, Any, Any]):
    """Dictionaries of observations as "MultiInputPolicy" takes them: numbers are float32 arrays, of the
    shape (1,) in place of (), and ints with bounds are counted from 0."""

    def __init__(self, env: gymnasium.Env[Any, Any]) -> None:
        super().__init__(env)
        given: Any = env.observation_space
        self._least = {
            name: int(space.start) if isinstance(space, spaces.Discrete) else 0
            for name, space in given.items()
        }
        self._entries = {name: _input_space(space) for name, space in given.items()}
        self.observation_space = spaces.Dict(OrderedDict(self._entries))

    def observation(self, observation: Any) -> dict[str, Any]:
        return {
            name: observation[name] - self._least[name]
            if isinstance(space, spaces.Discrete)
            else np.reshape(observation[name], space.shape or (1,)).astype(np.float32)
            for name, space in self._entries.items()
        }

    def action_masks(self) -> NDArray[np.bool_]:
        """See `RDDLEnv.action_masks`."""
        masks: NDArray[np.bool_] = self.env.unwrapped.action_masks()  # type: ignore[attr-defined]
        return masks


def _input_space(space: Any) -> gymnasium.Space[Any]:
    if isinstance(space, spaces.Discrete):
        return spaces.Discrete(int(space.n))
    lower, upper = (np.reshape(each, space.shape or (1,)) for each in (space.low, space.high))
    return spaces.Box(lower.astype(np.float32), upper.astype(np.float32), dtype=np.float32)
