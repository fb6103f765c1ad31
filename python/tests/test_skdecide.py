"""rddlc.skdecide with scikit-decide's own solvers, which scripts/test.sh does not install:

    python -m venv V && V/bin/pip install -r python/tests/requirements_skdecide.txt
    PYTHONPATH=build/python V/bin/python python/tests/test_skdecide.py
"""

from __future__ import annotations

import tempfile
import unittest
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
from support import FOLDER, example, problem_of_text

import rddlc

if find_spec("skdecide") is None:
    raise unittest.SkipTest("scikit-decide is not installed")

from skdecide.hub.solver.cgp import CGP
from skdecide.hub.solver.ilaostar import ILAOstar
from skdecide.hub.solver.lrtdp import LRTDP
from skdecide.hub.solver.mcts import MCTS

from rddlc.skdecide import (
    RDDLDomain,
    RDDLDomainRL,
    RDDLDomainSimplifiedSpaces,
    RDDLPlanning,
    RDDLSimulation,
)

HAS_THEIR_GYMNASIUM = find_spec("gymnasium.wrappers.compatibility") is not None

# Leaving at the end of the road has reward 10, once. Best: 3 steps ahead (-1 each), then out (10 -
# 2).
ROAD = """
domain road {
    pvariables {
        LAST : { non-fluent, int, default = 3 };
        place : { state-fluent, int, default = 0 };
        done : { state-fluent, bool, default = false };
        ahead : { action-fluent, bool, default = false };
        leave : { action-fluent, bool, default = false };
    };
    cpfs {
        place' = if (ahead ^ SLIP) then place + 1 else place;
        done' = done | (leave ^ place == LAST);
    };
    reward = (if (leave ^ place == LAST) then 10 else 0) - ahead - 2 * leave;
    termination { done; };
    action-preconditions { ahead => place < LAST; };
}
non-fluents none { domain = road; }
instance road_1 { domain = road; non-fluents = none; max-nondef-actions = 1; horizon = 8; discount = 1.0; }
"""
SURE = ROAD.replace(" ^ SLIP", "")
SLIPPERY = ROAD.replace("SLIP", "Bernoulli(0.5)").replace("then 10", "then 40")

BETS = """
domain bets {
    pvariables {
        won : { state-fluent, bool, default = false };
        good : { action-fluent, bool, default = false };
        bad : { action-fluent, bool, default = false };
    };
    cpfs { won' = Bernoulli(if (good) then 0.9 else if (bad) then 0.3 else 0); };
    reward = won';
}
non-fluents none { domain = bets; }
instance bets_1 { domain = bets; non-fluents = none; max-nondef-actions = 1; horizon = 2; discount = 1.0; }
"""


def earned(domain: RDDLSimulation | RDDLPlanning, solver: Any) -> float:
    """The return of the solver's actions in one episode."""
    state, total = domain.transitions.start(), 0.0
    while not state.causes:
        action = solver.sample_action(state)
        assert action in domain.get_applicable_actions(state)
        outcome = domain.transitions.sample(state, action)
        state, total = outcome.state, total + outcome.reward
    return total


def mcts(domain: Any, mode: Any, expander: Any) -> MCTS:
    return MCTS(
        lambda: domain,
        transition_mode=mode,
        expander=expander,
        rollout_budget=400,
        max_depth=8,
        ucb_constant=10.0,
    )


class Environments(unittest.TestCase):
    def test_steps_are_those_of_an_environment(self) -> None:
        domain = RDDLDomain(example("mountain_car").problem)
        env = example("mountain_car")
        np.random.seed(1)
        observation = domain.reset()
        env.reset(seed=1)
        env.set_state(domain.env.get_state())
        for _ in range(5):
            self.assertTrue(domain.get_observation_space().contains(observation))
            outcome = domain.step({"throttle": 0.5})
            observation = outcome.observation
            expected, reward, terminated, truncated, _ = env.step({"throttle": 0.5})
            self.assertEqual(observation, expected)
            self.assertEqual(outcome.value.reward, reward)
            self.assertEqual(outcome.termination, terminated or truncated)
        self.assertEqual(domain.render().shape, (400, 600, 3))

    def test_simplified_forms_have_simplified_spaces(self) -> None:
        problem = example("network").problem
        self.assertEqual(RDDLDomainRL(problem).get_action_space().unwrapped().n, 9)
        flat = RDDLDomainSimplifiedSpaces(problem)
        self.assertEqual(flat.get_observation_space().unwrapped().shape, (8,))
        self.assertEqual(flat.get_action_space().unwrapped().shape, (1,))
        self.assertEqual(flat.reset().shape, (8,))

    def test_its_cgp_learns(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            movie = Path(folder) / "car.gif"
            problem = example("mountain_car").problem
            factory = partial(RDDLDomainSimplifiedSpaces, problem, horizon=50)
            with CGP(factory, folder_name=f"{folder}/cgp", n_it=2, verbose=False) as solver:
                solver.solve()
                domain = factory(movie=movie)
                observation, over = domain.reset(), False
                while not over:
                    outcome = domain.step(solver.sample_action(observation))
                    observation, over = outcome.observation, outcome.termination
            self.assertEqual(movie.read_bytes()[:6], b"GIF89a")


class TheirArguments(unittest.TestCase):
    """Those of scikit-decide's own RDDLDomain, with which the notebooks make domains."""

    def test_names_and_movies_are_theirs(self) -> None:
        class SimplifiedActionRDDLEnv:
            """As pyRDDLGym-rl's."""

        class Visualizer:
            """As pyRDDLGym's."""

        problem = example("mountain_car").problem
        with tempfile.TemporaryDirectory() as folder:
            domain = RDDLDomain(
                rddl_domain=problem.files[0],
                rddl_instance=problem.files[1],
                base_class=SimplifiedActionRDDLEnv,
                visualizer=Visualizer,
                display_with_pygame=False,
                display_within_jupyter=True,
                movie_name="car",
                movie_dir=folder,
                max_frames=7,
            )
            self.assertEqual(domain.get_action_space().unwrapped().shape, (1,))
            domain.reset()
            for _ in range(7):
                self.assertEqual(list(Path(folder).rglob("*.gif")), [])
                domain.step(np.array([0.5], np.float32))
            movies = list(Path(folder, "car").glob("car_*.gif"))
            self.assertEqual(len(movies), 1)
            self.assertEqual(movies[0].read_bytes()[:6], b"GIF89a")
            flat = RDDLDomainSimplifiedSpaces(
                rddl_domain=problem.files[0],
                rddl_instance=problem.files[1],
                base_class=SimplifiedActionRDDLEnv,
            )
            self.assertEqual(flat.reset().shape, (2,))

    @unittest.skipUnless(HAS_THEIR_GYMNASIUM, "scikit-decide's learners need gymnasium below 1")
    @unittest.skipIf(find_spec("stable_baselines3") is None, "Stable-Baselines3 is not installed")
    def test_its_stable_baseline_learns(self) -> None:
        from skdecide.hub.solver.stable_baselines import StableBaseline
        from skdecide.utils import rollout
        from stable_baselines3 import PPO

        problem = example("mountain_car").problem
        for domain, policy in (
            (partial(RDDLDomainRL, problem), "MultiInputPolicy"),
            (partial(RDDLDomainRL, problem, observations="flat"), "MlpPolicy"),
        ):
            with StableBaseline(
                domain_factory=domain,
                algo_class=PPO,
                baselines_policy=policy,
                learn_config={"total_timesteps": 256},
                n_steps=128,
                verbose=0,
            ) as solver:
                solver.solve()
                rollout(domain(), solver, max_steps=20, verbose=False, render=False)

    @unittest.skipUnless(HAS_THEIR_GYMNASIUM, "scikit-decide's learners need gymnasium below 1")
    @unittest.skipIf(find_spec("ray") is None, "RLlib is not installed")
    def test_its_rllib_learns(self) -> None:
        from ray.rllib.algorithms.ppo import PPO
        from skdecide.hub.solver.ray_rllib import RayRLlib
        from skdecide.utils import rollout

        domain = partial(RDDLDomainRL, example("mountain_car").problem, observations="flat")
        with RayRLlib(domain_factory=domain, algo_class=PPO, train_iterations=1) as solver:
            solver.solve()
            rollout(domain(), solver, max_steps=20, verbose=False, render=False)


class Planners(unittest.TestCase):
    def test_mcts_plans_along_the_road(self) -> None:
        problem = problem_of_text(SURE)
        for domain, mode in (
            (RDDLSimulation(problem), MCTS.TransitionMode.SAMPLE),
            (RDDLPlanning(problem, most_reward=8), MCTS.TransitionMode.DISTRIBUTION),
        ):
            with mcts(domain, mode, MCTS.Expander.FULL) as solver:
                solver.solve()
                self.assertEqual(earned(domain, solver), 3 * -1 + 8)

    # MCTS draws without a seed, and takes the worse bet in one of five runs, also with more roll-outs.

    def test_mcts_takes_a_bet(self) -> None:
        domain = RDDLSimulation(problem_of_text(BETS))
        start = domain.transitions.start()
        with mcts(domain, MCTS.TransitionMode.SAMPLE, MCTS.Expander.PARTIAL) as solver:
            solver.solve()
            chosen = domain.action(solver.sample_action(start))
        self.assertEqual(sum(chosen.values()), 1)

    def test_lrtdp_and_ilao_find_the_best_policy(self) -> None:
        problem = problem_of_text(SURE)
        for solver_type in (LRTDP, ILAOstar):
            domain = RDDLPlanning(problem, most_reward=8)
            with solver_type(lambda: domain, discount=domain.discount) as solver:
                solver.solve()
                self.assertEqual(earned(domain, solver), 3 * -1 + 8, solver_type.__name__)

    def test_costs_are_what_is_not_earned(self) -> None:
        domain = RDDLPlanning(problem_of_text(SURE), most_reward=8)
        with LRTDP(lambda: domain) as solver:
            solver.solve()
            start = domain.transitions.start()
            self.assertAlmostEqual(solver.get_utility(start).cost, 8 * 8 - 5)

    def test_lrtdp_plans_with_estimates(self) -> None:
        domain = RDDLPlanning(problem_of_text(SLIPPERY), most_reward=38, samples=1000)
        with LRTDP(lambda: domain, continuous_planning=False) as solver:
            solver.solve()
            cost = solver.get_utility(domain.transitions.start()).cost
        self.assertAlmostEqual(8 * 38 - cost, best_on_slippery_road(), delta=1.5)

    def test_lrtdp_and_ilao_plan_exactly_where_draws_are_finite(self) -> None:
        for solver_type in (LRTDP, ILAOstar):
            domain = RDDLPlanning(problem_of_text(SLIPPERY), most_reward=38)
            with solver_type(lambda: domain) as solver:
                solver.solve()
                cost = solver.get_utility(domain.transitions.start()).cost
            self.assertAlmostEqual(8 * 38 - cost, best_on_slippery_road(), delta=0.01)

    def test_mcts_takes_a_bet_by_exact_distributions(self) -> None:
        domain = RDDLPlanning(problem_of_text(BETS), most_reward=20)
        start = domain.transitions.start()
        with mcts(domain, MCTS.TransitionMode.DISTRIBUTION, MCTS.Expander.FULL) as solver:
            solver.solve()
            chosen = domain.action(solver.sample_action(start))
        self.assertEqual(sum(chosen.values()), 1)

    def test_options_that_cannot_be_are_refused(self) -> None:
        problem = problem_of_text(SURE)
        for options, pattern in (
            ({"level": 3}, "'level'; did you mean 'levels'"),
            ({"engine": "interpreter"}, "loaded already"),
            ({"horizon": -1}, "horizon is -1"),
            ({"most_reward": float("nan")}, "most_reward is nan"),
        ):
            with self.assertRaisesRegex(rddlc.Error, pattern):
                RDDLPlanning(problem, **options)

    def test_a_wrong_bound_of_rewards_is_told(self) -> None:
        domain = RDDLPlanning(problem_of_text(SURE))
        state = domain.transitions.start()
        with self.assertRaisesRegex(rddlc.Error, "reward 8: say most_reward=8"):
            for _ in range(3):
                state = domain.transitions.outcomes(state, number_of(domain, "ahead"))[0].state
            domain.get_transition_value(state, number_of(domain, "leave"))

    def test_a_state_is_drawn_as_a_picture(self) -> None:
        domain = RDDLSimulation(example("mountain_car").problem)
        start = domain.transitions.start()
        later = domain.sample(start, 2).observation
        domain.set_memory(start)
        first = domain.render()
        domain.set_memory(later)
        self.assertEqual(first.shape, (400, 600, 3))
        self.assertTrue((domain.render() != first).any())


def number_of(domain: RDDLPlanning, name: str) -> int:
    numbers = range(domain.transitions.action_count)
    return next(each for each in numbers if domain.action(each)[name])


def best_on_slippery_road() -> float:
    """Solves it by dynamic programming over places and steps left."""
    value = np.zeros(4)
    for _ in range(8):
        ahead = [-1 + (value[place] + value[place + 1]) / 2 for place in range(3)]
        value = np.maximum(value, [*ahead, 38.0])
    return float(value[0])


if __name__ == "__main__":
    unittest.main()
