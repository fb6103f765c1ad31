"""pyRDDLGym in its quicker, vectorised form: how long it loads and how fast it steps."""

import time

import pyRDDLGym

from common import steps_in
from random_actions import draw_course


class VectorizedEnvironment:
    """One environment and a course of random legal actions for it, drawn beforehand."""

    def __init__(self, domain: str, instance: str, seconds_to_draw: float):
        begin = time.perf_counter()
        self.env = pyRDDLGym.make(domain, instance, vectorized=True)
        self.env.reset(seed=0)
        self.load_seconds = time.perf_counter() - begin
        self.course = draw_course(self.env, seconds_to_draw)
        self.first_step_seconds = self.load_seconds + self._pass_seconds(self.course[:1])

    def measure(self, seconds: float) -> dict:
        """The same trajectory again and again, so that the actions are legal every time."""
        steps, elapsed = steps_in(seconds, lambda: (len(self.course), self._pass_seconds(self.course)))
        return {"environments": 1, "threads": 1, "steps": steps, "seconds": elapsed}

    def _pass_seconds(self, actions: list[dict]) -> float:
        env = self.env
        env.reset(seed=0)
        begin = time.perf_counter()
        for action in actions:
            _, _, terminated, truncated, _ = env.step(action)
            if terminated or truncated:
                env.reset()
        return time.perf_counter() - begin
