"""Two courses of one problem, interpreted and with engine="auto", side by side."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import numpy as np

import rddlc


class Courses:
    """Steps both by the same actions, and compares all bits."""

    def __init__(self, problem: rddlc.Problem, make: Callable[[rddlc.Problem], Any],
                 clock: Callable[[], float] = time.perf_counter) -> None:
        self.problem, self._clock = problem, clock
        self._envs = [make(problem), make(rddlc.Problem(*problem.files, engine="interpreter"))]
        for env in self._envs:
            env.reset(seed=5)
        self._actions = self._envs[1].action_space
        self._actions.seed(5)
        self.steps = 0
        self.seconds: list[float] = []  # of the steps of engine="auto"

    def run_until_compiled(self, seconds: float = 300) -> None:
        end = time.monotonic() + seconds
        while not self.problem.simulator.is_settled and time.monotonic() < end:
            self.run(1)

    def run(self, steps: int) -> None:
        for _ in range(steps):
            action = self._actions.sample()
            begin = self._clock()
            found = self._envs[0].step(action)
            self.seconds.append(self._clock() - begin)
            expected = self._envs[1].step(action)
            if bits_of(found) != bits_of(expected):
                raise AssertionError(f"step {self.steps}: {found} is not {expected}")
            self.steps += 1
            self._reset_if_over(found)

    def _reset_if_over(self, found: Any) -> None:
        if isinstance(found[2], bool) and (found[2] or found[3]):
            first, second = (env.reset() for env in self._envs)
            if bits_of(first) != bits_of(second):
                raise AssertionError(f"reset after step {self.steps}: {first} is not {second}")


def bits_of(value: Any) -> Any:
    """All numbers as bytes: nan equals nan, and 0 is not -0."""
    if isinstance(value, dict):
        return {key: bits_of(each) for key, each in value.items()}
    if isinstance(value, (tuple, list)):
        return [bits_of(each) for each in value]
    if isinstance(value, np.ndarray) and value.dtype == object:
        return [bits_of(each) for each in value.tolist()]
    if isinstance(value, (np.ndarray, np.generic, float)):
        return np.asarray(value).tobytes()
    return value
