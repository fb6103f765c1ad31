"""pyRDDLGym-jax's compiled, vmapped rollouts: how long the first step takes and how fast they are."""

import time

import jax
import numpy as np
import pyRDDLGym
from pyRDDLGym_jax.core.compiler import JaxRDDLCompiler

from common import steps_in
from random_actions import draw_course


class Rollouts:
    def __init__(self, domain: str, instance: str, seconds_to_draw: float):
        np.seterr(all="ignore")
        begin = time.perf_counter()
        env = pyRDDLGym.make(domain, instance, vectorized=True)
        self.compiler = JaxRDDLCompiler(env.model)
        self.compiler.compile()
        self.fluents, self.non_fluents = self.compiler.split_fluent_nonfluent(self.compiler.init_values)
        self.parameters = self.compiler.model_aux["params"]
        self.horizon = env.horizon
        self.defaults = env.sampler.noop_actions
        self._make_first_step()
        self.first_step_seconds = time.perf_counter() - begin
        self.actions = self._stacked(draw_course(env, seconds_to_draw))

    def measure(self, batch: int, seconds: float, cores: int) -> dict:
        """Whole rollouts of the horizon; their compilation is not counted."""
        rollout = self._compiled_rollouts(batch)
        rollout(0)
        numbers = iter(range(1, 1 << 30))

        def run() -> tuple[int, float]:
            begin = time.perf_counter()
            rollout(next(numbers))
            return batch * self.horizon, time.perf_counter() - begin

        begin = time.process_time()
        steps, elapsed = steps_in(seconds, run)
        figures = {"environments": batch, "threads": cores, "steps": steps, "seconds": elapsed}
        return {**figures, "processor_seconds": time.process_time() - begin}

    def bytes_per_environment(self) -> int:
        return sum(np.asarray(value).nbytes for value in self.fluents.values())

    def _make_first_step(self) -> None:
        step = jax.jit(self.compiler.compile_transition())
        key = jax.random.PRNGKey(0)
        outcome = step(key, self.defaults, self.fluents, self.non_fluents, self.parameters)
        jax.block_until_ready(outcome)
        # Rollouts want their fluents in the types that a step gives them.
        self.types = {name: value.dtype for name, value in outcome[0].items()}

    def _stacked(self, course: list[dict]) -> dict:
        """Arrays by fluent, the first axis being time."""
        course = [course[step % len(course)] for step in range(self.horizon)]
        return {
            name: np.stack([action[name] for action in course]).astype(self.types[name])
            for name in self.defaults
        }

    def _compiled_rollouts(self, batch: int):
        def prepared_action(key, actions, hyperparameters, step, fluents, history):
            return {name: values[step] for name, values in actions.items()}

        rollouts = jax.jit(self.compiler.compile_rollouts(prepared_action, self.horizon, batch))
        start = {
            name: np.broadcast_to(np.asarray(value, self.types[name]), (batch, *np.shape(value)))
            for name, value in self.fluents.items()
        }
        start, actions = jax.device_put(start), jax.device_put(self.actions)

        def run(number: int) -> None:
            key = jax.random.PRNGKey(number)
            log, _ = rollouts(key, actions, None, start, self.non_fluents, self.parameters)
            jax.block_until_ready(log)

        return run
