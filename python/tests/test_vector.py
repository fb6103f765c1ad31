"""rddlc.make_vec: the same episodes as single environments, resets, ends, copies."""

from __future__ import annotations

import multiprocessing
import unittest
from typing import Any

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode
from support import example, problem_of

import rddlc

FORMS: list[dict[str, Any]] = [
    {},
    {"actions": "box", "normalize": True},
    {"actions": "dict"},
    {"observations": "dict", "actions": "dict"},
]
COUNT = 20


def vector(name: str = "network", num_envs: int = COUNT, **options: Any) -> rddlc.RDDLVectorEnv:
    return rddlc.make_vec(example(name).problem, num_envs=num_envs, **options)


def row(actions: Any, place: int) -> Any:
    if isinstance(actions, dict):
        return {name: row(value, place) for name, value in actions.items()}
    return actions[place]


class Episodes(unittest.TestCase):
    def test_each_environment_is_a_single_one_of_its_seed(self) -> None:
        for name in ("network", "mountain_car"):
            for form in FORMS:
                envs = vector(name, horizon=4, **form)
                singles = self.singles(name, form)
                observations, _ = envs.reset(seed=7)
                starts = [env.reset(seed=7 + place)[0] for place, env in enumerate(singles)]
                envs.action_space.seed(1)
                for place, start in enumerate(starts):
                    np.testing.assert_equal(row(observations, place), start)
                for _ in range(4):
                    actions = envs.action_space.sample()
                    observations, rewards, terminated, truncated, _ = envs.step(actions)
                    for place, env in enumerate(singles):
                        expected = env.step(row(actions, place))
                        np.testing.assert_equal(row(observations, place), expected[0])
                        ends = bool(terminated[place]), bool(truncated[place])
                        self.assertEqual((rewards[place], *ends), expected[1:4])

    def singles(self, name: str, form: dict[str, Any]) -> list[rddlc.RDDLEnv]:
        options = {"observations": "flat", "actions": "simplified", "vectorized": True} | form
        problem = example(name).problem
        return [rddlc.make(problem, horizon=4, **options) for _ in range(COUNT)]

    def test_threads_and_batch_size_change_nothing(self) -> None:
        few, many = vector(num_envs=3, threads=1), vector(num_envs=COUNT, threads=3)
        few.reset(seed=1)
        many.reset(seed=1)
        for _ in range(10):
            step = few.step(np.zeros(3, int))
            np.testing.assert_equal(many.step(np.zeros(COUNT, int))[0][:3], step[0])

    def test_spaces_hold_what_is_seen(self) -> None:
        for form in FORMS:
            envs = vector("mountain_car", **form)
            self.assertIn(envs.reset(seed=1)[0], envs.observation_space)
            self.assertIn(envs.step(envs.action_space.sample())[0], envs.observation_space)


class Ends(unittest.TestCase):
    def ended(self, mode: str) -> tuple[rddlc.RDDLVectorEnv, Any]:
        envs = vector(horizon=3, autoreset_mode=mode)
        envs.reset(seed=1)
        for _ in range(2):
            envs.step(np.zeros(COUNT, int))
        return envs, envs.step(np.zeros(COUNT, int))

    def test_next_step(self) -> None:
        envs, (_, _, _, truncated, infos) = self.ended("NextStep")
        self.assertIs(envs.metadata["autoreset_mode"], AutoresetMode.NEXT_STEP)
        self.assertTrue(truncated.all())
        self.assertEqual(infos["cause"].tolist(), ["horizon"] * COUNT)
        _, rewards, _, truncated, infos = envs.step(np.zeros(COUNT, int))
        self.assertEqual((rewards.any(), truncated.any(), infos), (False, False, {}))

    def test_same_step(self) -> None:
        envs, (observations, _, _, truncated, infos) = self.ended("SameStep")
        disabled, (final, *_) = self.ended("Disabled")
        self.assertTrue(truncated.all())
        np.testing.assert_array_equal(infos["final_obs"], final)
        self.assertTrue(infos["_final_obs"].all())
        self.assertEqual(infos["final_info"]["cause"][0], "horizon")
        np.testing.assert_array_equal(observations, disabled.reset()[0])

    def test_same_step_by_dictionaries(self) -> None:
        by_dictionary, by_category = (
            vector(autoreset_mode="SameStep", horizon=3, actions=actions)
            for actions in ("dict", "simplified")
        )
        count = len(by_category.model.types["computer"].objects)
        nothing = np.full(COUNT, count)
        for envs, action in ((by_dictionary, {}), (by_category, nothing)):
            envs.reset(seed=7)
            for _ in range(3):
                envs.last = envs.step(action)
        np.testing.assert_equal(by_dictionary.last, by_category.last)

    def test_disabled(self) -> None:
        envs, (final, *_) = self.ended("Disabled")
        np.testing.assert_array_equal(envs.step(np.zeros(COUNT, int))[0], final)
        mask = np.arange(COUNT) % 2 == 0
        observations, _ = envs.reset(options={"reset_mask": mask})
        np.testing.assert_array_equal(observations[~mask], final[~mask])
        self.assertFalse(envs.step(np.zeros(COUNT, int))[3][mask].any())


class States(unittest.TestCase):
    def state(self) -> rddlc.State:
        env = example("network")
        env.reset(seed=9)
        for _ in range(3):
            env.step({})
        return env.get_state()

    def rows_of(self, envs: rddlc.RDDLVectorEnv) -> list[bytes]:
        record = np.zeros(envs.model.state_size, np.uint8)
        found = []
        for place in range(envs.num_envs):
            envs._batch.read_state(place, record)
            found.append((record.tobytes(), envs._batch.progress(place)[0]))
        return found

    def test_all_environments_begin_in_a_state(self) -> None:
        state = self.state()
        for form in FORMS:
            envs = vector(**form)
            scales = form.get("normalize", False)
            single = rddlc.make(envs.problem, observations="flat", normalize=scales)
            expected, _ = single.reset(seed=1, options={"state": state})
            observations, _ = envs.reset(seed=1, options={"state": state})
            self.assertEqual(self.rows_of(envs), [(state.record, state.steps)] * COUNT)
            if not isinstance(observations, dict):
                np.testing.assert_array_equal(observations, np.tile(expected, (COUNT, 1)))
            envs.action_space.seed(1)
            envs.step(envs.action_space.sample())
            self.assertGreater(len(set(self.rows_of(envs))), 5)  # each has luck of its own

    def test_some_environments_begin_in_states(self) -> None:
        state, envs, plain = self.state(), vector(), vector()
        mask = np.arange(COUNT) % 2 == 0
        for each in (envs, plain):
            each.reset(seed=1)
            each.step(np.zeros(COUNT, int))
        before = self.rows_of(envs)
        envs.reset(options={"reset_mask": mask, "state": state})
        for place, row in enumerate(self.rows_of(envs)):
            self.assertEqual(row, (state.record, 3) if mask[place] else before[place])
        start = self.rows_of(vector_reset(plain))[0]
        states = [state if place == 4 else None for place in range(COUNT)]
        envs.reset(options={"state": states})
        self.assertEqual(self.rows_of(envs)[4], (state.record, 3))
        self.assertEqual(self.rows_of(envs)[5], start)

    def test_a_refused_reset_changes_nothing(self) -> None:
        envs, plain = vector(), vector()
        for each in (envs, plain):
            each.reset(seed=1)
        for call in (
            lambda: envs.reset(seed=2, options={"stat": 1}),
            lambda: envs.reset(seed=2, options={"state": 1}),
            lambda: envs.reset(seed=[5] * (COUNT - 1) + [1 << 64]),
            lambda: envs.reset(seed=2, options={"reset_mask": np.ones(3, bool)}),
        ):
            with self.assertRaises(rddlc.Error):
                call()
        for _ in range(5):
            np.testing.assert_equal(envs.step(np.zeros(COUNT, int)), plain.step(np.zeros(COUNT, int)))


def vector_reset(envs: rddlc.RDDLVectorEnv) -> rddlc.RDDLVectorEnv:
    envs.reset()
    return envs


class Arrays(unittest.TestCase):
    def test_copies_stay_and_views_change(self) -> None:
        for copies in (True, False):
            envs = vector("mountain_car", actions="box", copy=copies)
            envs.reset(seed=1)
            first = envs.step(np.ones((COUNT, 1), np.float32))[0]
            kept = first.copy()
            envs.step(np.ones((COUNT, 1), np.float32))
            self.assertEqual(bool((first == kept).all()), copies)

    def test_refused_actions_change_nothing(self) -> None:
        envs = vector()
        start, _ = envs.reset(seed=1)
        for bad in (np.full(COUNT, 99), np.zeros(COUNT + 1, int), np.full(COUNT, 0.5)):
            with self.assertRaises(rddlc.ActionError):
                envs.step(bad)
        again, _ = vector().reset(seed=1)
        np.testing.assert_array_equal(start, again)
        np.testing.assert_equal(
            envs.step(np.zeros(COUNT, int)), self.first_step(np.zeros(COUNT, int))
        )

    def first_step(self, actions: Any) -> Any:
        envs = vector()
        envs.reset(seed=1)
        return envs.step(actions)

    def test_masks_are_a_row_each(self) -> None:
        envs = rddlc.make_vec(problem_of("refuses_some"), num_envs=3)
        envs.reset(seed=1)
        self.assertEqual(envs.action_masks().tolist(), [[True, False, True]] * 3)

    def test_a_forked_process_steps_on(self) -> None:
        envs = vector(threads=2)
        envs.reset(seed=1)
        reader, writer = multiprocessing.Pipe(duplex=False)
        process = multiprocessing.get_context("fork").Process(
            target=lambda: writer.send(envs.step(np.zeros(COUNT, int))[1])
        )
        process.start()
        self.assertTrue(reader.poll(60))
        rewards = reader.recv()
        process.join()
        np.testing.assert_array_equal(rewards, envs.step(np.zeros(COUNT, int))[1])


class Registration(unittest.TestCase):
    def test_gymnasium_makes_them_by_id(self) -> None:
        name = "rddlc/MountainCar_ippc2023-1-v0"
        env = gymnasium.make(name, engine="interpreter", render_mode="rgb_array")
        env.reset(seed=1)
        self.assertEqual(env.spec.id, name)
        envs = gymnasium.make_vec(name, num_envs=4, engine="interpreter")
        self.assertIsInstance(envs, rddlc.RDDLVectorEnv)
        self.assertEqual(envs.reset(seed=1)[0].shape, (4, 2))

    def test_wrappers_of_gymnasium_work(self) -> None:
        env = gymnasium.wrappers.RecordEpisodeStatistics(example("network", horizon=2))
        env.reset(seed=1)
        env.step({})
        self.assertEqual(env.step({})[4]["episode"]["l"], 2)
        envs = gymnasium.wrappers.vector.RecordEpisodeStatistics(vector(horizon=2))
        envs.reset(seed=1)
        envs.step(np.zeros(COUNT, int))
        self.assertEqual(envs.step(np.zeros(COUNT, int))[4]["episode"]["l"].tolist(), [2] * COUNT)


if __name__ == "__main__":
    unittest.main()
