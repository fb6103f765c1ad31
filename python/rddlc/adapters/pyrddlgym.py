"""pyRDDLGym's own environments, stepped by rddlc.

    from rddlc.backend import make   # in place of: from pyRDDLGym import make

Everything else of a program stays: RDDLEnv with its spaces, visualizers, logs and agents. Random
numbers are rddlc's own: the laws are the same, the draws are not.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pyRDDLGym
from numpy.typing import NDArray
from pyRDDLGym.core.debug.exception import RDDLValueOutOfRangeError
from pyRDDLGym.core.env import RDDLEnv
from pyRDDLGym.core.simulator import RDDLSimulator as Interpreted

from .. import _native, causes
from ..arguments import seed_or_none
from ..model import Fluent
from ..problems import NO_HORIZON, Problem
from ..records import lifted_views


def make(
    domain: str, instance: str, base_class: type[RDDLEnv] = RDDLEnv, **env_kwargs: Any
) -> RDDLEnv:
    """Makes an environment as pyRDDLGym.make does, from a name and an instance of rddlrepository or
    two files."""
    backend_kwargs = {"problem": Problem(domain, instance)} | env_kwargs.pop("backend_kwargs", {})
    return pyRDDLGym.make(
        domain,
        instance,
        base_class=base_class,
        backend=RDDLSimulator,
        backend_kwargs=backend_kwargs,
        **env_kwargs,
    )


class RDDLSimulator(Interpreted):
    """The simulator of an RDDLEnv: `backend=RDDLSimulator, backend_kwargs={"problem": problem}`,
    where the problem is loaded from the environment's files."""

    def __init__(self, *arguments: Any, problem: Problem, **options: Any) -> None:
        super().__init__(*arguments, **options)
        self.problem = problem
        model = problem.model
        self._batch = _native.EnvPool(problem.simulator, horizon=NO_HORIZON, values=False)
        self._causes = 0
        self._record = np.zeros((1, model.state_size), np.uint8)
        self._actions = lifted_views(self._batch.actions, model.actions)
        self._states = _Values(model.states, self._record, self)
        self._observed = _Values(
            model.observed if model.partially_observed else [], self._batch.observations, self
        )
        self.seed(int(self.rng.integers(1 << 32)))

    def seed(self, seed: int | None) -> None:
        seed = seed_or_none(seed)
        super().seed(seed)
        if seed is None:
            seed = int(self.rng.integers(1 << 32))
        self._batch.set_seed(seed)

    def reset(self) -> tuple[dict[str, Any], bool]:
        self._batch.reset()
        self._causes = self._batch.causes_of(0)
        self.subs = self.init_values.copy()
        self._read_state()
        if not self._pomdp:
            return self.state, self.check_terminal_states()
        return self._observed.of_nothing(), self.check_terminal_states()

    def step(self, actions: dict[str, Any]) -> tuple[dict[str, Any], float, bool]:
        self._write(actions)
        self._batch.step()
        self._causes = int(self._batch.causes[0])
        if self._causes & causes.FAULT:
            raise RDDLValueOutOfRangeError(self._batch.fault(0))
        self.subs.update(actions)
        self._read_state()
        observation = self._observed.read(self.subs) if self._pomdp else self.state
        return observation, float(self._batch.rewards[0]), self.check_terminal_states()

    def check_terminal_states(self) -> bool:
        return bool(self._causes & causes.TERMINATED)

    def check_state_invariants(self, silent: bool = False) -> bool:
        holds = not self._causes & causes.INVARIANT
        return holds if holds or silent else super().check_state_invariants(silent)

    def check_action_preconditions(self, actions: dict[str, Any], silent: bool = False) -> bool:
        self._write(actions)
        holds = self._batch.violated_preconditions(self._batch.actions)[0] < 0
        return holds if holds or silent else super().check_action_preconditions(actions, silent)

    def _write(self, actions: dict[str, Any]) -> None:
        for name, view in self._actions.items():
            view[0] = np.reshape(actions[name], view[0].shape)

    def _read_state(self) -> None:
        self._batch.read_state(0, self._record[0])
        self.state = self._states.read(self.subs)


class _Values:
    """Fluents of a record, as pyRDDLGym's simulator gives them: numpy's bools, names of objects, by
    grounded names unless tensors are kept."""

    def __init__(
        self, fluents: list[Fluent], record: NDArray[np.uint8], simulator: RDDLSimulator
    ) -> None:
        views = lifted_views(record, fluents)
        self._views = [(fluent, views[fluent.name][0]) for fluent in fluents]
        self._names = [
            (fluent.name,) if simulator.keep_tensors else fluent.groundings for fluent in fluents
        ]
        self._keeps_tensors = simulator.keep_tensors
        self._tells_names = simulator.objects_as_strings

    def read(self, subs: dict[str, Any]) -> dict[str, Any]:
        """Also writes the numbers into `subs`."""
        values: dict[str, Any] = {}
        for (fluent, view), names in zip(self._views, self._names):
            array = view.astype(bool) if fluent.scalar == "bool" else view.copy()
            subs[fluent.name] = array.reshape(fluent.shape)
            if fluent.objects is not None and self._tells_names:
                array = np.array(fluent.objects)[array]
            if self._keeps_tensors:
                values[fluent.name] = array.reshape(fluent.shape)
            else:
                values.update(zip(names, array.ravel()))
        return values

    def of_nothing(self) -> dict[str, None]:
        return {name: None for names in self._names for name in names}
