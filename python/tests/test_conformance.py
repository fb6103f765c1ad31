"""rddlc.make beside pyRDDLGym.make, in one process.

    python python/tests/test_conformance.py [--all]

Each step begins in pyRDDLGym's own state. Names, order, starts, spaces and shapes are compared for
all problems; what a step gives for those without random numbers. `--all`: the first instances of
all of rddlrepository, instead of a few.
"""

from __future__ import annotations

import sys
import unittest
import warnings
from typing import Any

import numpy as np
import pyRDDLGym
from gymnasium import spaces
from pyRDDLGym.core.policy import RandomAgent

import rddlc

FEW = [
    "Acrobot_gym",
    "Elevators",
    "HVAC_ippc2023",
    "MarsRover_ippc2023",
    "MountainCar_ippc2023",
    "Quadcopter_physics",
    "Reservoir_ippc2023",
    "SysAdmin_POMDP_ippc2011",
    "TSP_or",
    "Wildfire_MDP_ippc2014",
]
STEPS = 8


def plain(value: Any, objects: tuple[str, ...] | None) -> Any:
    """pyRDDLGym's value as ours: objects as their index, nothing observed as 0."""
    array = np.atleast_1d(np.asarray(value))
    if array.dtype == object and array.ravel()[0] is None:
        return np.zeros(1)
    if objects is not None and array.dtype.kind in "US":
        return np.vectorize(objects.index)(array)
    return array.astype(float)


class Pair:
    """The same problem in both."""

    def __init__(self, name: str, instance: str, vectorized: bool) -> None:
        self.ours = rddlc.make(name, instance, vectorized=vectorized, engine="interpreter")
        self.theirs = pyRDDLGym.make(*self.ours.problem.files, vectorized=vectorized)
        self.objects: dict[str, tuple[str, ...] | None] = {}
        for fluent in self.ours.model.fluents.values():
            for key in (fluent.name, *fluent.groundings):
                self.objects[key] = fluent.objects

    def difference(self, theirs: dict[str, Any], ours: dict[str, Any]) -> str:
        if list(theirs) != list(ours):
            return f"names: {list(theirs)[:5]} and {list(ours)[:5]}"
        for key, value in theirs.items():
            expected, found = plain(value, self.objects[key]), np.atleast_1d(ours[key])
            if not np.allclose(expected, found, rtol=1e-9, atol=1e-12, equal_nan=True):
                return f"{key}: {expected} and {found}"
        return ""

    def difference_of_spaces(self) -> str:
        for theirs, ours in (
            (self.theirs.observation_space, self.ours.observation_space),
            (self.theirs.action_space, self.ours.action_space),
        ):
            if list(theirs.spaces) != list(ours.spaces):
                return f"names of {theirs} and {ours}"
            for key, space in theirs.spaces.items():
                if isinstance(space, spaces.Box) and space.dtype == np.float32:
                    low, high = ours[key].low.astype(np.float32), ours[key].high.astype(np.float32)
                    if not (np.allclose(space.low, low) and np.allclose(space.high, high)):
                        return f"bounds of {key}: {space} and {ours[key]}"
        return ""

    def difference_of_steps(self) -> str:
        theirs, ours = self.theirs, self.ours
        agent = RandomAgent(theirs.action_space, num_actions=ours.max_allowed_actions, seed=1)
        theirs.reset(seed=1)
        ours.reset(seed=1)
        for _ in range(STEPS):
            action = agent.sample_action()
            difference = self.difference(theirs.state, ours.state)
            if difference:
                return "state: " + difference
            expected, found = theirs.step(action), ours.step(action)
            difference = self.difference(expected[0], found[0])
            if difference or not np.isclose(expected[1], found[1], rtol=1e-9):
                return difference or f"rewards {expected[1]} and {found[1]}"
            if expected[2:4] != found[2:4]:
                return f"ends {expected[2:4]} and {found[2:4]}"
            if found[2] or found[3]:
                return ""
        return ""


def differences(name: str, instance: str) -> list[str]:
    found = []
    for vectorized in (False, True):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            pair = Pair(name, instance, vectorized)
            expected, _ = pair.theirs.reset(seed=1)
            ours, _ = pair.ours.reset(seed=1)
            found.append(pair.difference_of_spaces())
            found.append(pair.difference(expected, ours))
            if not pair.ours.model.stochastic and not vectorized:
                found.append(pair.difference_of_steps())
    return [each for each in found if each]


class Conformance(unittest.TestCase):
    def test_a_few_problems(self) -> None:
        first_instance = {each.name: each.instances[0] for each in rddlc.problems()}
        for name in FEW:
            with self.subTest(name=name):
                self.assertEqual(differences(name, first_instance[name]), [])


def compare_all() -> int:
    failed = 0
    listed = rddlc.problems()
    for problem in listed:
        found = differences(problem.name, problem.instances[0])
        failed += bool(found)
        for difference in found:
            print(f"{problem.name}: {difference}", flush=True)
    print(f"{len(listed) - failed} of {len(listed)} problems agree")
    return failed > 0


if __name__ == "__main__":
    if "--all" in sys.argv:
        sys.exit(compare_all())
    unittest.main()
