"""pyRDDLGym's environments with our simulator in place of its own."""

from __future__ import annotations

import copy
import re
import unittest
import warnings

import numpy as np
import pyRDDLGym
from pyRDDLGym.core.debug.exception import RDDLActionPreconditionNotSatisfiedError
from pyRDDLGym.core.policy import NoOpAgent, RandomAgent

import rddlc
from rddlc.backend import RDDLSimulator
from rddlc.environment import OF_PYRDDLGYM as ENVIRONMENTS_OF_PYRDDLGYM
from rddlc.model import OF_PYRDDLGYM

# Deterministic ones, with reals, bools, objects; and a partially observed one.
PROBLEMS = ["HVAC_ippc2023", "MarsRover_ippc2023", "MountainCar_ippc2023", "Reacher_physics"]


def pair(name: str, **options: object) -> tuple[pyRDDLGym.RDDLEnv, pyRDDLGym.RDDLEnv]:
    """The environment with our simulator, and with its own."""
    instance = next(each.instances[0] for each in rddlc.problems() if each.name == name)
    problem = rddlc.Problem(name, instance, engine="interpreter")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        ours = pyRDDLGym.make(
            *problem.files, backend=RDDLSimulator, backend_kwargs={"problem": problem}, **options
        )
        return ours, pyRDDLGym.make(*problem.files, **options)


class Backend(unittest.TestCase):
    def test_a_refused_seed_changes_nothing(self) -> None:
        (ours, _), (kept, _) = pair("MarsRover_ippc2023"), pair("MarsRover_ippc2023")
        for env in (ours, kept):
            env.reset(seed=1)
        with self.assertRaisesRegex(rddlc.Error, "seed"):
            ours.sampler.seed(1 << 64)
        np.testing.assert_equal(ours.reset(), kept.reset())
        np.testing.assert_equal(ours.step({}), kept.step({}))

    def test_steps_are_those_of_its_own_simulator(self) -> None:
        for name in PROBLEMS:
            for vectorized in (False, True):
                ours, theirs = pair(name, vectorized=vectorized)
                np.testing.assert_equal(ours.reset(seed=1), theirs.reset(seed=1))
                self.assertEqual(ours.action_space, theirs.action_space)
                noop = {}
                for _ in range(10):
                    found, expected = ours.step(noop), theirs.step(noop)
                    for key, value in expected[0].items():
                        np.testing.assert_allclose(found[0][key], value, rtol=1e-9)
                        self.assertEqual(np.shape(found[0][key]), np.shape(value), key)
                    self.assertAlmostEqual(found[1], expected[1])
                    self.assertEqual(found[2:4], expected[2:4])

    def test_nothing_is_observed_at_first(self) -> None:
        ours, theirs = pair("SysAdmin_POMDP_ippc2011")
        self.assertEqual(ours.reset(seed=1), theirs.reset(seed=1))
        self.assertEqual(list(ours.step({})[0]), list(theirs.step({})[0]))

    def test_agents_and_preconditions_work(self) -> None:
        ours, _ = pair("Wildfire_MDP_ippc2014", enforce_action_constraints=True)
        agent = RandomAgent(ours.action_space, num_actions=ours.max_allowed_actions, seed=1)
        found = agent.evaluate(ours, episodes=2, seed=1)
        self.assertTrue(np.isfinite(found["mean"]))
        for name in ("MountainCar_ippc2023", "HVAC_ippc2023", "MarsRover_ippc2023"):  # with reals
            returns = []
            for env in pair(name):
                env.horizon = 5
                agent = RandomAgent(env.action_space, num_actions=len(env.action_space), seed=1)
                returns.append(agent.evaluate(env, episodes=2, seed=1)["mean"])
            np.testing.assert_allclose(*returns, rtol=1e-9, err_msg=name)
        ours, _ = pair("MountainCar_ippc2023", enforce_action_constraints=True)
        ours.reset(seed=1)
        ours.step({"action": 0.5})
        with self.assertRaises(RDDLActionPreconditionNotSatisfiedError):
            ours.step({"action": 2.0})


class Agents(unittest.TestCase):
    def test_they_act_in_environments_of_rddlc(self) -> None:
        for name, kind in (
            ("MountainCar_ippc2023", NoOpAgent),
            ("HVAC_ippc2023", NoOpAgent),
            ("Wildfire_MDP_ippc2014", RandomAgent),
        ):
            env = rddlc.make(name, 1, engine="interpreter")
            found = kind(env.action_space, env.max_allowed_actions).evaluate(env, episodes=2, seed=1)
            self.assertTrue(np.isfinite(found["mean"]))

    def test_random_agents_draw_the_same_numbers_as_on_pyrddlgym(self) -> None:
        for name in ("MountainCar_ippc2023", "HVAC_ippc2023", "UAV_Mixed"):  # deterministic, with reals
            instance = next(each for each in rddlc.problems() if each.name == name).instances[0]
            returns = []
            for env in (rddlc.make(name, instance, engine="interpreter"), pyRDDLGym.make(name, str(instance))):
                agent = RandomAgent(env.action_space, env.max_allowed_actions, seed=3)
                returns.append(agent.evaluate(env, episodes=1, seed=1)["mean"])
            np.testing.assert_allclose(*returns, rtol=1e-6, err_msg=name)  # theirs are drawn as float32

    def test_names_of_pyrddlgyms_environments_lead_to_ours(self) -> None:
        env = rddlc.make("HVAC_ippc2023", 1, engine="interpreter")
        for name, ours in ENVIRONMENTS_OF_PYRDDLGYM.items():
            self.assertTrue(hasattr(pyRDDLGym.make("HVAC_ippc2023", "1"), name), name)
            with self.assertRaises(AttributeError) as refused:
                getattr(env, name)
            self.assertIn(ours, str(refused.exception))
        self.assertFalse(hasattr(env, "no_such_thing"))

    def test_names_of_pyrddlgyms_model_lead_to_ours(self) -> None:
        model = rddlc.make("HVAC_ippc2023", 1, engine="interpreter").model
        theirs = pyRDDLGym.make("HVAC_ippc2023", "1").model
        for name, ours in OF_PYRDDLGYM.items():
            self.assertTrue(hasattr(theirs, name), name)
            with self.assertRaisesRegex(AttributeError, "rddlc.backend.make") as refused:
                getattr(model, name)
            self.assertIn(ours, str(refused.exception))
            self.assertTrue(hasattr(model, re.match(r"\w+", ours)[0]), ours)
        self.assertEqual(list(model.types["zone"].objects), theirs.type_to_objects["zone"])
        self.assertEqual([each.name for each in model.states], list(theirs.state_fluents))
        self.assertFalse(hasattr(model, "no_such_thing"))
        self.assertIsNot(copy.deepcopy(model), model)


if __name__ == "__main__":
    unittest.main()
