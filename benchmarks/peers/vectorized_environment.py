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
        self.first_step_seconds = self.load_seconds + self._play(self.course[:1])[0]

    def measure(self, seconds: float) -> dict:
        """The same trajectory again and again, so that the actions are legal every time."""
        processor_seconds = 0.0

        def play() -> tuple[int, float]:
            nonlocal processor_seconds
            elapsed, of_processor = self._play(self.course)
            processor_seconds += of_processor
            return len(self.course), elapsed

        steps, elapsed = steps_in(seconds, play)
        return {
            "environments": 1,
            "threads": 1,
            "steps": steps,
            "seconds": elapsed,
            "processor_seconds": processor_seconds,
        }

    def _play(self, actions: list[dict]) -> tuple[float, float]:
        """The seconds that the actions took, and those of the processor."""
        env = self.env
        env.reset(seed=0)
        begin, processor_begin = time.perf_counter(), time.process_time()
        for action in actions:
            _, _, terminated, truncated, _ = env.step(action)
            if terminated or truncated:
                env.reset()
        return time.perf_counter() - begin, time.process_time() - processor_begin
