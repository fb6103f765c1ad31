"""rddlc.PPO, rddlc.CGP and rddlc.DRP.

Over 400 lines: all learners promise the same, which one set of tests asks of each.
"""

from __future__ import annotations

import copy
import io
import pickle
import re
import tempfile
import threading
import time
import unittest
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from typing import Any, get_type_hints

import gymnasium
import numpy as np
from gymnasium.wrappers import TimeLimit
from support import example

import rddlc
from rddlc.learner_options import CGPOptions, DRPOptions, PPOOptions


def played(model: rddlc.Learner, env: rddlc.RDDLEnv, seed: int) -> float:
    env.reset(seed=seed)
    total, over = 0.0, False
    while not over:
        _, reward, terminated, truncated, _ = env.step(model.predict(env)[0])
        total, over = total + reward, terminated or truncated
    return total


class Learners(unittest.TestCase):
    def models(self) -> list[rddlc.Learner]:
        problem = example("mountain_car").problem
        ppo = rddlc.PPO(problem, environments=4, rollout=16, minibatch=64, seed=1)
        cgp = rddlc.CGP(problem, children=4, nodes=20, seed=1)
        drp = rddlc.DRP(problem, hidden=8, seed=1)
        return [ppo.learn(200), cgp.learn(5), drp.learn(1)]

    def recurrent(self) -> rddlc.Learner:
        maze = example("t_maze").problem
        options = {"environments": 4, "rollout": 16, "minibatch": 64, "seed": 1}
        return rddlc.PPO(maze, recurrent=6, segment=8, **options).learn(2000)

    def test_what_is_saved_acts_alike(self) -> None:
        for model in (*self.models(), self.recurrent()):
            with tempfile.TemporaryDirectory() as folder:
                file = model.save(Path(folder) / "policy")
                self.assertEqual(file.suffix, model.extension)
                again = type(model).load(file, model.problem)
            self.assertEqual(again.evaluate(3, seed=5), model.evaluate(3, seed=5))

    def test_predictions_earn_what_evaluations_tell(self) -> None:
        for model in (*self.models(), self.recurrent()):
            for vectorized in (False, True):
                env = rddlc.make(model.problem, vectorized=vectorized)
                expected = model.evaluate(1, seed=3).returns.mean
                self.assertAlmostEqual(played(model, env, 3), expected)
                self.assertAlmostEqual(played(model, env, 3), expected)

    def test_each_environment_has_a_memory_of_its_own(self) -> None:
        maze = example("t_maze").problem
        # It solves the maze, so what it does at the junction depends on what each has seen before.
        model = rddlc.PPO(maze, environments=16, minibatch=256, epochs=10, learning_rate=1e-3,
                          hidden=[32, 32], recurrent=16, seed=1)  # fmt: skip
        model.learn(80_000)
        envs = rddlc.make_vec(maze, num_envs=8, observations="dict", actions="dict")
        envs.reset(seed=3)
        rewards = [envs.step(model.predict(envs)[0])[1] for _ in range(40)]
        paid = [reward for step in rewards for reward in step if reward > 0]
        self.assertGreater(len(paid), 16)
        self.assertTrue(all(reward >= 0 for step in rewards for reward in step))

    def test_predictions_of_many_environments(self) -> None:
        for model in self.models():
            envs = rddlc.make_vec(model.problem, num_envs=3, observations="dict", actions="dict")
            envs.reset(seed=1)
            actions, _ = model.predict(envs)
            self.assertIn(actions, envs.action_space)
            envs.step(actions)

    def test_learning_goes_on(self) -> None:
        ppo, cgp, _ = self.models()
        before = ppo.steps, cgp.steps
        ppo.learn(200)
        cgp.learn(5)
        self.assertEqual((before[0] * 2, before[1] * 2), (ppo.steps, cgp.steps))
        self.assertIn("train/approx_kl", ppo.progress)

    def test_callbacks_end_it(self) -> None:
        seen: list[int] = []
        model = rddlc.PPO(example("network"), environments=4, rollout=16, minibatch=64)
        model.learn(10_000, callback=lambda learner: seen.append(learner.steps) or len(seen) < 3)
        self.assertEqual(seen, [64, 128, 192])

    def test_looks_meanwhile_see_what_is_learned(self) -> None:
        """Using the policy in a callback, between calls of learn() or after a Ctrl-C freezes
        nothing."""
        problem = example("mountain_car").problem
        options = {"environments": 4, "rollout": 16, "minibatch": 64, "seed": 1}
        env = rddlc.make(problem)
        seen: list[str] = []

        def looks(model: rddlc.Learner) -> None:
            env.reset(seed=1)
            model.predict(env)
            model.evaluate(1)
            seen.append(model.policy_text)

        kept = rddlc.PPO(problem, **options).learn(640)
        looked = rddlc.PPO(problem, **options).learn(640, callback=looks)
        self.assertEqual(len(set(seen)), 10)  # each update makes another policy
        self.assertEqual(looked.policy_text, seen[-1])
        self.assertEqual(looked.policy_text, kept.policy_text)
        self.assertEqual(looked.evaluate(3), kept.evaluate(3))
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(looked.save(Path(folder) / "x").read_text(), kept.policy_text)
        env.reset(seed=1)
        fresh, _ = rddlc.PPO(problem, **options).learn(640).predict(env)
        self.assertEqual(looked.predict(env)[0], fresh)

    def test_an_error_in_a_callback_leaves_what_is_learned(self) -> None:
        problem = example("mountain_car").problem
        options = {"environments": 4, "rollout": 16, "minibatch": 64, "seed": 1}

        def fails(model: rddlc.Learner) -> None:
            model.evaluate(1)
            if model.steps == 128:
                raise KeyError

        model = rddlc.PPO(problem, **options)
        with self.assertRaises(KeyError):
            model.learn(640, callback=fails)
        kept = rddlc.PPO(problem, **options).learn(640, callback=lambda m: m.steps < 128)
        self.assertEqual(model.policy_text, kept.policy_text)

    def test_the_best_policy_is_kept_beside_the_last(self) -> None:
        """The step size is so large that it spoils what was learned."""
        problem = example("cart_pole").problem
        model = rddlc.PPO(
            problem, environments=4, rollout=32, minibatch=128, learning_rate=0.05,
            schedule="constant", seed=1,
        )  # fmt: skip
        found: list[tuple[float, str]] = []
        model.learn(128 * 20, callback=lambda m: found.append((m.progress["eval/mean_reward"], m.policy_text)))
        returns = [each for each, _ in found]
        self.assertEqual(len(found), 20)
        self.assertLess(returns[-1], max(returns))
        self.assertEqual(model.best_evaluation.returns.mean, max(returns))
        best = model.best
        self.assertIn(best.policy_text, [text for each, text in found if each == max(returns)])
        self.assertEqual(model.policy_text, found[-1][1])
        self.assertIsInstance(best, rddlc.PPO)
        self.assertGreater(best.evaluate(20, seed=9).returns.mean, model.evaluate(20, seed=9).returns.mean)
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(model.save(Path(folder) / "b", best=True).read_text(), best.policy_text)
            last = model.save(Path(folder) / "l")
            self.assertEqual(last.read_text(), model.policy_text)
            loaded = rddlc.PPO.load(last, problem)
            self.assertEqual(loaded.best.policy_text, loaded.policy_text)
        before = model.best_evaluation
        model.learn(128)  # the best of all, not of the last call
        self.assertFalse(before.is_better_than(model.best_evaluation))
        self.assertTrue(model.best_evaluation == before or model.best_evaluation.is_better_than(before))

    def test_learning_that_evaluates_nothing_has_no_best(self) -> None:
        model = rddlc.CGP(example("mountain_car"), children=4, nodes=20).learn(5, evaluations=0)
        self.assertIsNone(model.best_evaluation)
        self.assertEqual(model.best.policy_text, model.policy_text)

    def test_evaluations_change_nothing_that_is_learned(self) -> None:
        for name in ("mountain_car", "network"):
            texts = {
                rddlc.CGP(example(name), children=4, nodes=20, seed=1)
                .learn(60, evaluations=count)
                .policy_text
                for count in (0, 1, 20)
            }
            self.assertEqual(len(texts), 1)

    def test_pickles_and_copies_learn_on_alike(self) -> None:
        for model in self.models():
            env = rddlc.make(model.problem)
            env.reset(seed=1)
            model.predict(env)
            twins = [pickle.loads(pickle.dumps(model)), copy.deepcopy(model)]
            amount = 64 if isinstance(model, rddlc.PPO) else 5
            model.learn(amount)
            for twin in twins:
                self.assertNotEqual(twin.steps, model.steps)
                twin.learn(amount)
                self.assertEqual((twin.steps, twin.policy_text), (model.steps, model.policy_text))
                self.assertEqual(twin.best_evaluation, model.best_evaluation)
            loaded = pickle.loads(pickle.dumps(model.best))
            self.assertEqual(loaded.policy_text, model.best.policy_text)

    def test_formulas_are_told(self) -> None:
        formula = str(self.models()[1])
        self.assertTrue(formula.startswith("throttle = "), formula)
        self.assertIn("throttle", self.models()[1]._repr_html_())

    def test_options_that_cannot_be(self) -> None:
        problem = example("network").problem
        for options in ({"step": 1}, {"rollout": "x"}, {"schedule": "x"}, {"preset": "x"}):
            with self.assertRaises(rddlc.Error):
                rddlc.PPO(problem, **options)
        with self.assertRaisesRegex(rddlc.Error, "learn"):
            rddlc.PPO(problem).evaluate()

    def test_options_beyond_their_ranges_are_refused_by_their_keywords(self) -> None:
        problem = example("network").problem
        ppo: dict[str, list[Any]] = {
            "minibatch": [0, -3, "many", None, 1.5, True], "steps": [1.5], "epochs": [-1, 0], "clip": [float("nan"), -1, 0, 10.5],
            "gamma": [2, float("inf")], "rollout": [0], "environments": [0, 2**40], "stack": [0, 2000],
            "threads": [0], "hidden": [[0], [64, -1], []], "recurrent": [-1], "segment": [1],
            "learning_rate": [-1, 0, 0.0], "squash": ["maybe", 1], "seed": [-1, 2**64], "memory_limit": [0],
            "log_std": [99], "preset": ["x"], "noise": [3], "value_clip": [-1],
        }  # fmt: skip
        cgp: dict[str, list[Any]] = {
            "nodes": [-1, 0], "children": [0, -2], "islands": [0, 99_999], "levels_back": [-1],
            "episodes": [0], "constants": [-1, 1e9], "measure": ["best"], "lifted": [None],
            "restart_after": [-1], "time": ["perhaps"], "compat": [True], "functions": [[], ["no such"], "add\0"],
        }  # fmt: skip
        for learner, wrong in ((rddlc.PPO, ppo), (rddlc.CGP, cgp)):
            for keyword, values in wrong.items():
                for value in values:
                    with self.subTest(keyword=keyword, value=value):
                        with self.assertRaisesRegex(rddlc.ArgumentError, f"^{keyword}: "):
                            learner(problem, **{keyword: value})

    def test_what_is_wrong_with_an_option_is_said(self) -> None:
        problem = example("network").problem
        wrong: list[tuple[dict[str, Any], str]] = [
            ({"minibatch": True}, "minibatch: 'True' is not an int from 1 to"),
            ({"schedule": True}, "schedule: 'True' is not one of linear"),
            ({"seed": 2**64}, r"seed: '18446744073709551616' is not an int from 0 to 2\^64 - 1"),
            ({"clip": 0}, "clip: '0' is not a number above 0, up to 10"),
            ({"preset": "fast\0"}, "preset: 'fast"),
            ({"preset": "\udc80"}, r"preset: ''\\udc80''"),
            ({"preset": "\x1b[31m"}, "preset: '\ufffd\\[31m'"),
        ]
        for options, message in wrong:
            with self.subTest(message=message), self.assertRaisesRegex(rddlc.ArgumentError, message):
                rddlc.PPO(problem, **options)

    def test_names_of_other_programs_and_of_the_command_line_mean_a_keyword(self) -> None:
        problem = example("network").problem
        ppo = {
            "lr": "learning_rate", "envs": "environments", "n_envs": "environments",
            "num_envs": "environments", "n_steps": "rollout", "ent_coef": "entropy",
            "batch_size": "minibatch", "n_epochs": "epochs", "clip_range": "clip", "vf_coef": "value_weight",
            "max_grad_norm": "gradient_norm", "net_arch": "hidden", "gama": "gamma",
            "total_timesteps": "steps", "entropy_coeff": "entropy", "lambda_": "gae_lambda",
            "sgd_minibatch_size": "minibatch", "num_sgd_iter": "epochs", "learning_rat": "learning_rate",
        }  # fmt: skip
        cgp = {"gens": "generations", "cols": "nodes", "population_size": "children", "fitness": "measure"}
        for learner, names in ((rddlc.PPO, ppo), (rddlc.CGP, cgp)):
            for name, keyword in names.items():
                with self.subTest(name=name):
                    with self.assertRaisesRegex(rddlc.ArgumentError, f"did you mean '{keyword}'"):
                        learner(problem, **{name: 1})
        with self.assertRaisesRegex(rddlc.ArgumentError, "no option 'zebra'$"):
            rddlc.PPO(problem, zebra=1)

    def test_a_policy_of_the_other_learner_is_refused(self) -> None:
        problem = example("network").problem
        with tempfile.TemporaryDirectory() as name:
            formula = rddlc.CGP(problem, children=4).learn(1).save(Path(name) / "x.cgp")
            network = rddlc.PPO(problem, environments=4, rollout=16, minibatch=32).learn(64).save(Path(name) / "x.json")
            self.assertIsInstance(rddlc.CGP.load(formula, problem), rddlc.CGP)
            with self.assertRaisesRegex(rddlc.ArgumentError, r"x\.cgp'.* CGP .*rddlc\.CGP\.load"):
                rddlc.PPO.load(formula, problem)
            with self.assertRaisesRegex(rddlc.ArgumentError, r"x\.json'.* PPO .*rddlc\.PPO\.load"):
                rddlc.CGP.load(network, problem)
            reactive = rddlc.DRP(problem, hidden=8, horizon=4).learn(1).save(Path(name) / "y.json")
            self.assertIsInstance(rddlc.DRP.load(reactive, problem), rddlc.DRP)
            with self.assertRaisesRegex(rddlc.ArgumentError, r"y\.json'.* DRP .*rddlc\.DRP\.load"):
                rddlc.PPO.load(reactive, problem)
            with self.assertRaisesRegex(rddlc.ArgumentError, r"x\.json'.* PPO .*rddlc\.PPO\.load"):
                rddlc.DRP.load(network, problem)
            unknown = Path(name) / "z.json"
            for text in ("null", '{"solver":"drp"}'):
                unknown.write_text(text)
                with self.assertRaisesRegex(rddlc.Error, "it is not a policy of PPO or DRP"):
                    rddlc.DRP.load(unknown, problem)

    def test_keywords_that_are_not_known_are_refused_with_what_was_meant(self) -> None:
        problem = example("network").problem
        with self.assertRaisesRegex(rddlc.ArgumentError, "'minibach'; did you mean 'minibatch'"):
            rddlc.PPO(problem, minibach=5)
        with self.assertRaisesRegex(rddlc.ArgumentError, "'node'; did you mean 'nodes'"):
            rddlc.CGP(problem, node=5)

    def test_the_arguments_of_stable_baselines3_are_refused_with_a_sentence(self) -> None:
        with self.assertRaisesRegex(rddlc.ArgumentError, r"alone, as in rddlc.PPO\(env\)"):
            rddlc.PPO("MlpPolicy", example("mountain_car"))

    def test_every_option_of_the_command_line_is_a_keyword(self) -> None:
        problem = example("network").problem
        rddlc.PPO(
            problem, environments=4, rollout=16, epochs=1, minibatch=32, learning_rate=1e-3,
            schedule="kl", gamma=0.9, gae_lambda=1, clip=0.1, value_clip=1.0, value_weight=1,
            entropy=0.01, gradient_norm=0, target_kl=0.1, noise="sde", sde_steps=4, correlation=0.5,
            log_std=-1.0, squash=True, curiosity=False, hidden=(8, 8), activation="relu", stack=2,
            recurrent=0, segment=4, time_input="on", bootstrap=True, threads=1, seed=2**64 - 1,
            memory_limit=2**30, preset="sb3", imitate="noop", imitate_episodes=1,
        ).learn(128)  # fmt: skip
        rddlc.CGP(
            problem, children=4, nodes=9, constants=0, levels_back=3, mutation="gene",
            functions=["add", "logic"], episodes=2, measure="min", restart_after=0, tune_every=0,
            lifted="off", parsimony=False, time=True, compat="none", islands=1, migrate_every=0,
            threads=1, seed=3, memory_limit=2**30,
        ).learn(2)  # fmt: skip
        rddlc.DRP(
            problem, episodes=8, horizon=3, learning_rate=1e-3, clip=2.0, relax="exact", sharpness=5,
            hidden=(8, 8), activation="relu", time_input=False, seed=3, memory_limit=2**30,
        ).learn(24)  # fmt: skip
        for learner in rddlc.PPO, rddlc.CGP, rddlc.DRP:
            self.assertIn("\n    memory_limit: ", str(learner.__doc__))

    def test_policies_do_not_act_in_other_problems(self) -> None:
        others = [rddlc.make(example(name).problem) for name in ("reservoir", "network", "t_maze")]
        for model in self.models():
            for env in others:
                env.reset(seed=1)
                with self.assertRaisesRegex(rddlc.Error, "mountain_car"):
                    model.predict(env)
            car = rddlc.make(model.problem)
            expected = played(model, car, 3)
            with self.assertRaises(rddlc.Error):
                model.predict(others[0])
            self.assertAlmostEqual(played(model, car, 3), expected)

    def test_lifted_programs_read_the_non_fluents_of_where_they_act(self) -> None:
        domain = """domain d { types { tank : object; };
            pvariables { LEAK(tank) : { non-fluent, real, default = -1.0 };
                water(tank) : { state-fluent, real, default = 5.0 };
                pump(tank) : { action-fluent, bool, default = false }; };
            cpfs { water'(?t) = water(?t) - LEAK(?t) + pump(?t); };
            reward = sum_{?t : tank} [water(?t) * LEAK(?t)]; }"""
        instance = """non-fluents n { domain = d; objects { tank : { %s }; };
            non-fluents { LEAK(%s) = 1.0; }; }
            instance i { domain = d; non-fluents = n; horizon = 9; discount = 1.0; }"""
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "domain.rddl").write_text(domain)

            def problem(tanks: list[str], leaking: str) -> rddlc.Problem:
                file = folder / f"{leaking}{len(tanks)}.rddl"
                file.write_text(instance % (", ".join(tanks), leaking))
                return rddlc.make(str(folder / "domain.rddl"), str(file)).problem

            model = rddlc.CGP(problem(["t1", "t2"], "t1"), lifted="on", children=4, nodes=9).learn(1)
            lines = model.policy_text.splitlines()
            inputs = [line for line in lines if line.startswith("input ")]
            leak = next(i for i, line in enumerate(inputs) if line.endswith(" LEAK(?tank)"))
            begin = lines.index(inputs[0])
            program = [line for line in lines[:begin] if not line.startswith("#")]
            program += ["input 0 1 " + line.split(" ", 3)[3] for line in inputs]
            program += ["constants 0", "nodes 0", "outputs 1", f"output {leak} pump(?tank)", "end"]
            (folder / "leak.cgp").write_text("\n".join(program) + "\n")
            model = rddlc.CGP.load(folder / "leak.cgp", model.problem)
            for tanks in (["t1", "t2"], ["t1", "t2", "t3"]):
                for leaking in tanks:
                    env = rddlc.make(problem(tanks, leaking))
                    env.reset(seed=0)
                    action = model.predict(env)[0]
                    self.assertEqual({k for k, v in action.items() if v}, {f"pump___{leaking}"})

    def test_other_threads_run_meanwhile(self) -> None:
        model = rddlc.PPO(example("network"), environments=64, rollout=128, epochs=10)
        learning = threading.Thread(target=lambda: model.learn(1))
        learning.start()
        ticks = 0
        while learning.is_alive():
            time.sleep(0.001)
            ticks += 1
        self.assertGreater(ticks, 3)


class Verbs(unittest.TestCase):
    """The verbs of Stable-Baselines3."""

    OPTIONS: dict[str, Any] = {"environments": 4, "rollout": 16, "minibatch": 64, "seed": 1}
    FORMS = (
        {},
        {"vectorized": True},
        {"observations": "flat"},
        {"observations": "flat", "actions": "simplified", "normalize": True},
        {"observations": "flat", "actions": "box"},
    )

    def test_observations_of_its_environment_are_where_it_stands(self) -> None:
        for name in ("mountain_car", "network"):
            problem = example(name).problem
            learned = rddlc.PPO(problem, **self.OPTIONS).learn(total_timesteps=128)
            expected = learned.evaluate(1, seed=3).returns.mean
            for form in self.FORMS:
                env = rddlc.make(problem, **form)
                model = copy.copy(learned)
                model._env = env
                observation, _ = env.reset(seed=3)
                self.assertIn(model.best.predict(observation)[0], env.action_space)
                total, over = 0.0, False
                while not over:
                    action, _ = model.predict(observation)
                    self.assertIn(action, env.action_space)
                    observation, reward, terminated, truncated, _ = env.step(action)
                    total, over = total + reward, terminated or truncated
                with self.subTest(name=name, form=form):
                    self.assertAlmostEqual(total, expected, places=3)  # actions are float32

    def test_observations_of_other_places(self) -> None:
        problem = example("network").problem
        for form in self.FORMS:
            env, other = rddlc.make(problem, **form), rddlc.make(problem, **form)
            model = rddlc.CGP(env, children=4, nodes=20, seed=1, time=False).learn(3)
            env.reset(seed=1)
            other.reset(seed=9)
            for _ in range(5):
                observation = other.step(model.predict(other)[0])[0]
            np.testing.assert_equal(model.predict(observation), model.predict(other))

    def test_rows_of_observations(self) -> None:
        for form in ({}, {"actions": "dict"}, {"observations": "dict"}):
            envs = rddlc.make_vec(example("network").problem, num_envs=3, **form)
            model = rddlc.PPO(envs, **self.OPTIONS).learn(128)
            observations, _ = envs.reset(seed=1)
            actions, _ = model.predict(observations)
            self.assertIn(actions, envs.action_space)
            np.testing.assert_equal(actions, model.predict(envs)[0])
        with self.assertRaisesRegex(rddlc.ArgumentError, "an observation is one of"):
            model.predict({"no": 1})
        maze = example("t_maze")
        model = rddlc.PPO(maze, **self.OPTIONS).learn(128)
        with self.assertRaisesRegex(rddlc.Error, "partially observed"):
            model.predict({})

    def test_wrapped_environments(self) -> None:
        env = TimeLimit(example("mountain_car"), 5)
        model = rddlc.PPO(env, **self.OPTIONS).learn(128)
        observation, _ = env.reset(seed=1)
        self.assertEqual(model.predict(env), model.predict(observation))
        for given in (gymnasium.make("CartPole-v1"), 3, "network"):
            with self.assertRaisesRegex(rddlc.ArgumentError, "learners and planners take an environment of rddlc"):
                rddlc.PPO(given)

    def test_amounts(self) -> None:
        problem = example("mountain_car").problem
        model = rddlc.PPO(problem, **self.OPTIONS)
        self.assertEqual(model.learn(total_timesteps=64, evaluations=0).steps, 64)
        for wrong in ({}, {"amount": 1, "total_timesteps": 1}):
            with self.assertRaisesRegex(rddlc.ArgumentError, "one number of steps"):
                model.learn(**wrong)
        with self.assertRaisesRegex(rddlc.ArgumentError, "learn.generations"):
            rddlc.CGP(problem).learn(total_timesteps=64)

    def test_progress_is_printed(self) -> None:
        model = rddlc.PPO(example("mountain_car").problem, verbose=1, **self.OPTIONS)
        told, shown = io.StringIO(), io.StringIO()
        with redirect_stdout(told), redirect_stderr(shown):
            model.learn(128, evaluations=2, progress_bar=True)
        self.assertEqual(len(told.getvalue().splitlines()), 2)
        self.assertIn("128 steps: return", told.getvalue())
        self.assertIn("100% 128 of 128", shown.getvalue())

    def test_callbacks(self) -> None:
        model = rddlc.PPO(example("mountain_car").problem, **self.OPTIONS)
        with tempfile.TemporaryDirectory() as folder:
            checkpoints = rddlc.callbacks.CheckpointCallback(128, folder)
            best = rddlc.callbacks.EvalCallback(
                64, n_eval_episodes=2, best_model_save_path=folder, reward_threshold=-1e9
            )
            model.learn(256, [checkpoints], evaluations=0)
            names = sorted(each.name for each in Path(folder).iterdir())
            self.assertEqual(names, ["model_128_steps.json", "model_256_steps.json"])
            model.learn(256, [checkpoints, best], evaluations=0)
            self.assertEqual(model.steps, 256 + 64)  # the threshold ends it
            again = rddlc.PPO.load(Path(folder) / "best_model.json", model.problem)
            self.assertEqual(again.evaluate(2).returns.mean, best.best_mean_reward)

    def test_ppo_begins_as_a_policy_acts(self) -> None:
        problem = example("mountain_car").problem
        small = {"environments": 4, "rollout": 16, "minibatch": 64, "hidden": 16, "seed": 1}
        self.assertLess(rddlc.PPO(problem, **small).learn(64).best.evaluate(1).returns.mean, 1)
        with tempfile.TemporaryDirectory() as folder:
            driver = rddlc.CGP(problem, seed=1).learn(20)
            file = driver.save(Path(folder) / "driver")
            model = rddlc.PPO(problem, imitate=file, imitate_episodes=4, verbose=1, **small)
            with redirect_stdout(io.StringIO()) as printed:
                model.learn(64)
        self.assertIn("steps are imitated, whose episodes return 96.0312", printed.getvalue())
        self.assertIn("\n0 steps: return", printed.getvalue(), "the policy that imitates is evaluated")
        self.assertGreater(model.best_evaluation.returns.mean, 80)
        model.learn(64)  # the file is gone: a learner that has begun needs no imitation
        self.assertGreater(model.best_evaluation.returns.mean, 80)
        planned = rddlc.PPO(problem, imitate="plan:cem,steps=200", imitate_episodes=1, **small)
        self.assertEqual(planned.learn(64).steps, 64)

    def test_what_cannot_be_imitated_is_refused(self) -> None:
        problem = example("mountain_car").problem
        for options, said in (
            ({"imitate": "plan:none"}, "imitate: .*none"),
            ({"imitate": "plan:cem,step=1"}, "imitate: .*step"),
            ({"imitate": "no_such_file"}, "no_such_file"),
            ({"imitate": "hand.rddl"}, "imitate: 'hand.rddl' holds a policy block.*imitate that trace"),
            ({"imitate": "noop", "recurrent": 4}, "recurrent"),
            ({"imitate": "noop", "imitate_episodes": 0}, "imitate_episodes"),
        ):
            with self.assertRaisesRegex(rddlc.Error, said):
                rddlc.PPO(problem, **options)
        for given in (rddlc.plan.UCT(problem), rddlc.PPO(problem), 3, b"noop"):
            with self.subTest(given=given), self.assertRaisesRegex(rddlc.ArgumentError, "imitate is .*not a text"):
                rddlc.PPO(problem, imitate=given)
        for nothing in ("", None):
            rddlc.PPO(problem, imitate=nothing)

    def test_options_are_typed_as_they_are(self) -> None:
        kinds = ((rddlc.PPO, PPOOptions), (rddlc.CGP, CGPOptions), (rddlc.DRP, DRPOptions))
        for kind, options in kinds:
            named = re.findall(r"^ +(\w+): ", kind.__doc__ or "", re.MULTILINE)
            self.assertEqual(sorted(named), sorted(get_type_hints(options)))
        with self.assertRaisesRegex(rddlc.ArgumentError, "did you mean 'learning_rate'"):
            rddlc.PPO(example("network"), learnin_rate=1)


if __name__ == "__main__":
    unittest.main()
