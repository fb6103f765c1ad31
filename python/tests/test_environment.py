"""rddlc.make: dictionaries, spaces, seeds, ends, errors, copies, pictures.

Over 400 lines: a test for each thing that can be seen.
"""

from __future__ import annotations

import copy
import gc
import importlib.util
import multiprocessing
import os
import pickle
import tempfile
import unittest
import unittest.mock
import warnings
import weakref
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import PIL.Image
import PIL.ImageSequence
from gymnasium.utils.env_checker import check_env
from support import EXAMPLES, TEXTS, example, written

import rddlc

FORMS: list[dict[str, Any]] = [
    {},
    {"vectorized": True},
    {"observations": "flat", "actions": "simplified"},
    {"observations": "flat", "actions": "box", "normalize": True},
]


def steps_of(env: rddlc.RDDLEnv, seed: int, count: int) -> list[Any]:
    env.reset(seed=seed)
    env.action_space.seed(seed)
    return [env.step(env.action_space.sample()) for _ in range(count)]


class Checkers(unittest.TestCase):
    def test_check_env_passes_in_all_forms(self) -> None:
        for name in EXAMPLES:
            for form in FORMS:
                with self.subTest(name=name, form=form):
                    check_env(example(name, render_mode="rgb_array", **form))

    def test_observations_stay_in_their_space(self) -> None:
        for name in EXAMPLES:
            for form in FORMS:
                env = example(name, **form)
                for observation, *_ in steps_of(env, 1, 5):
                    self.assertIn(observation, env.observation_space)


class Dictionaries(unittest.TestCase):
    def test_names_and_order_are_those_of_groundings(self) -> None:
        env = example("network")
        observation, _ = env.reset(seed=1)
        computers = env.model.types["computer"].objects
        self.assertEqual(list(observation), [f"running___{name}" for name in computers])

    def test_what_a_program_holds_of_observations_stays_as_it_is(self) -> None:
        ways: dict[str, Any] = {
            "all": lambda seen: seen,
            "its items": lambda seen: dict(seen),
            "an array": lambda seen: {"filled": seen["filled"]},
            "a view": lambda seen: {"filled": seen["filled"][...]},
            "memory": lambda seen: {"filled": memoryview(seen["filled"])},
        }
        for way, hold in ways.items():
            env = written("counters")
            kept = [hold(env.reset(seed=1)[0])]
            kept += [hold(env.step({"add___a": 1, "push": 0.5})[0]) for _ in range(4)]
            found = [{name: float(np.asarray(value)) for name, value in each.items()} for each in kept]
            self.assertEqual([each["filled"] for each in found], [0.0, 0.5, 1.0, 1.5, 2.0], way)
            self.assertEqual([each.get("count___a", at) for at, each in enumerate(found)], [0, 1, 2, 3, 4], way)

    def test_what_a_program_does_to_an_observation_leaves_no_trace(self) -> None:
        def unwritable(seen: Any) -> None:
            seen["filled"].setflags(write=False)

        def retyped(seen: Any) -> None:
            seen["filled"].dtype = np.int64  # deprecated since numpy 2.5

        def reordered(seen: Any) -> None:
            seen["count___a"] = seen.pop("count___a")

        for change in (
            unwritable,
            retyped,
            reordered,
            lambda seen: seen.clear(),
            lambda seen: seen.update(filled=None, shade="red", count___a=7),
            lambda seen: seen.update(more=1),
            lambda seen: seen.pop("shade"),
            lambda seen: seen["filled"].__iadd__(3),
            lambda seen: seen.update(filled=seen["count___a"], count___a=seen["filled"]),
        ):
            env, other = written("counters"), written("counters")
            for each in (env, other):
                each.reset(seed=1)
            for _ in range(4):
                found = env.step({"add___a": 1, "push": 0.5})[0]
                expected = other.step({"add___a": 1, "push": 0.5})[0]
                self.assertEqual(list(found), list(expected))
                self.assertEqual(repr(found), repr(expected))
                self.assertTrue(found["filled"].flags.writeable)
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    change(found)

    def test_observations_that_hold_their_environment_are_collected(self) -> None:
        for steps in range(3):
            env = example("mountain_car")
            observation, _ = env.reset(seed=1)
            for _ in range(steps):
                observation = env.step({})[0]
            observation["env"] = env
            alive = weakref.ref(env)
            del env, observation
            gc.collect()
            self.assertIsNone(alive())

    def test_lifted_and_grounded_names_set_the_same_values(self) -> None:
        env = example("network")
        env.reset(seed=1)
        twin = copy.deepcopy(env)
        count = len(env.model.types["computer"].objects)
        one = np.arange(count) == 2
        by_name = env.step({env.model.fluents["reboot"].groundings[2]: True})
        self.assertEqual(twin.step({"reboot": one}), by_name)

    def test_refused_actions_change_nothing(self) -> None:
        env = example("mountain_car")
        env.reset(seed=1)
        name = next(iter(env.action_space))
        bad = [{name: 7.0}, {"nothing": 1}, {name: float("nan")}, {name: "x"}, {name: None}, 3]
        bad.append({name: np.zeros(2)})
        before = env.get_state()
        for action in bad:
            with self.subTest(action=action), self.assertRaises(rddlc.ActionError):
                env.step(action)
        self.assertEqual(env.get_state(), before)

    def test_more_changes_than_max_nondef_actions_are_refused(self) -> None:
        env = example("network")
        env.reset(seed=1)
        self.assertEqual(env.model.max_nondef_actions, env.max_allowed_actions)
        too_many = np.ones(env.model.fluents["reboot"].shape)
        with self.assertRaisesRegex(rddlc.ActionError, "max-nondef-actions"):
            env.step({"reboot": too_many})
        for _ in range(20):
            self.assertIn(env.action_space.sample(), env.action_space)


class Episodes(unittest.TestCase):
    def test_same_seed_gives_same_steps(self) -> None:
        for form in FORMS:
            env = example("network", **form)
            first, again = steps_of(env, 7, 10), steps_of(env, 7, 10)
            for one, two in zip(first, again):
                np.testing.assert_equal(one, two)

    def test_compiled_and_interpreted_agree(self) -> None:
        for name in EXAMPLES:
            compiled = steps_of(example(name), 3, 8)
            interpreted = steps_of(example(name, engine="interpreter"), 3, 8)
            np.testing.assert_equal(compiled, interpreted)

    def test_the_horizon_truncates_with_its_cause(self) -> None:
        env = example("network", horizon=3)
        steps = steps_of(env, 1, 3)
        self.assertEqual([step[3] for step in steps], [False, False, True])
        self.assertEqual(steps[-1][4], {"cause": "horizon"})
        with self.assertRaisesRegex(rddlc.EpisodeOver, "horizon"):
            env.step({})

    def test_no_horizon(self) -> None:
        env = example("network", horizon=0)
        self.assertFalse(any(step[3] for step in steps_of(env, 1, 200)))

    def test_a_step_before_the_first_reset_is_refused(self) -> None:
        with self.assertRaisesRegex(rddlc.EpisodeOver, "reset"):
            example("network").step({})

    def test_violated_preconditions_are_refused_if_enforced(self) -> None:
        env = written("refuses", enforce_action_constraints=True)
        env.reset(seed=1)
        before = env.get_state()
        with self.assertRaisesRegex(rddlc.ActionError, "filled"):
            env.step({"pour": 5.0})
        self.assertEqual(env.get_state(), before)
        self.assertFalse(env.step({"pour": 0.5})[3])


class States(unittest.TestCase):
    def test_copies_and_pickles_go_on_alike(self) -> None:
        for form in FORMS:
            env = example("network", **form)
            steps_of(env, 5, 4)
            env.reset()  # not the first episode of the seed
            env.step(env.action_space.sample())
            for twin in (copy.deepcopy(env), pickle.loads(pickle.dumps(env))):
                action = env.action_space.sample()
                original = copy.deepcopy(env)
                np.testing.assert_equal(twin.step(action), original.step(action))
                np.testing.assert_equal(twin.reset(), original.reset())

    def test_set_state_goes_back(self) -> None:
        env = example("mountain_car")
        steps_of(env, 1, 3)
        state, shown = env.get_state(), env.state
        action = env.action_space.sample()
        first = env.step(action)
        env.set_state(state)
        np.testing.assert_equal(env.state, shown)
        np.testing.assert_equal(env.step(action), first)

    def test_states_have_no_luck(self) -> None:
        """A planner that returns to a state repeatedly sees possible futures, and not the one that
        is to come."""
        env = example("network")
        steps_of(env, 5, 3)
        state = env.get_state()
        env.step({})
        to_come = env.get_state()

        def successors(**luck: Any) -> list[rddlc.State]:
            found = []
            for _ in range(20):
                env.set_state(state, **luck)
                env.step({})
                found.append(env.get_state())
            return found

        several = successors()
        self.assertGreater(len(set(several)), 3)
        self.assertGreater(len(set(successors()) - set(several)), 0)
        self.assertEqual(len(set(successors(seed=3))), 1)
        self.assertNotEqual(successors(seed=3), successors(seed=4))
        self.assertEqual(set(successors(replay=True)), {to_come})
        other = example("network")
        other.set_state(state, seed=3)
        other.step({})
        self.assertEqual([other.get_state()], successors(seed=3)[:1])

    def test_the_same_calls_have_the_same_luck(self) -> None:
        found = []
        for _ in range(2):
            env = example("network")
            states = []
            env.reset(seed=5)
            for _ in range(10):
                env.set_state(env.get_state())
                env.step({})
                states.append(env.get_state())
            found.append(states)
        self.assertEqual(found[0], found[1])

    def test_later_episodes_are_those_of_the_seed(self) -> None:
        """Whatever luck an episode before them was given."""
        for changes in (
            lambda env: env.set_state(env.get_state()),
            lambda env: env.set_state(env.get_state(), seed=7),
            lambda env: env.set_state(env.get_state(), replay=True),
        ):
            env, plain = example("network"), example("network")
            for each in (env, plain):
                each.reset(seed=5)
                each.reset()
                each.step({})
            changes(env)
            env.step({})
            twins = [env, copy.deepcopy(env), pickle.loads(pickle.dumps(env))]
            plain.reset()
            expected = [plain.step({}) for _ in range(5)]
            for twin in twins:
                twin.reset()
                np.testing.assert_equal([twin.step({}) for _ in range(5)], expected)

    def test_copies_and_pickles_keep_luck_that_was_given(self) -> None:
        for luck in ({}, {"seed": 7}):
            env = example("network")
            steps_of(env, 5, 3)
            env.set_state(env.get_state(), **luck)
            env.step({})
            twins = [copy.deepcopy(env), pickle.loads(pickle.dumps(env))]
            expected = [env.step({}) for _ in range(5)]
            state = env.get_state()
            env.set_state(state)
            after = env.step({})
            for twin in twins:
                np.testing.assert_equal([twin.step({}) for _ in range(5)], expected)
                twin.set_state(state)
                np.testing.assert_equal(twin.step({}), after)

    def test_episodes_that_begin_in_a_state_have_luck_of_their_own(self) -> None:
        env = example("network")
        steps_of(env, 5, 3)
        state = env.get_state()
        found = set()
        for _ in range(20):
            env.reset(options={"state": state})
            env.step({})
            found.add(env.get_state())
        self.assertGreater(len(found), 3)

    def test_interm_fluents_of_the_last_step(self) -> None:
        env = example("mountain_car")
        env.reset(seed=1)
        with self.assertRaises(rddlc.Error):
            env.interm_fluents()
        before = env.state
        env.step({"throttle": 1.0})
        found = env.interm_fluents()
        self.assertEqual(list(found), ["slope", "speed"])
        self.assertAlmostEqual(found["speed"][0], float(env.state["position"] - before["position"]))

    def test_compiled_problems_tell_details_if_they_are_to(self) -> None:
        env = example("mountain_car", engine="compiled")
        env.reset(seed=1)
        env.step({"throttle": 1.0})
        with self.assertRaisesRegex(rddlc.Error, "details=True"):
            env.interm_fluents()
        detailed, interpreted = (
            example("mountain_car", engine="compiled", details=True),
            example("mountain_car"),
        )
        for each in (detailed, interpreted):
            each.reset(seed=1)
            each.step({"throttle": 1.0})
        np.testing.assert_equal(detailed.interm_fluents(), interpreted.interm_fluents())

    def test_violations_are_explained_alike_by_both_engines(self) -> None:
        messages = []
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "doors.rddl"
            file.write_text(TEXTS["refuses_some"])
            for engine in ("compiled", "interpreter"):
                env = rddlc.make(file, engine=engine, enforce_action_constraints=True)
                env.reset(seed=1)
                with self.assertRaises(rddlc.ActionError) as raised:
                    env.step({"open___d2": 1})
                messages.append(str(raised.exception))
        self.assertEqual(messages[0], messages[1])
        self.assertIn("d2", messages[0])

    def test_a_problem_is_found_again_until_its_files_change(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "doors.rddl"
            file.write_text(TEXTS["refuses_some"])
            first = rddlc.Problem(file)
            self.assertEqual(rddlc.Problem(file).model.horizon, first.model.horizon)
            file.write_text(TEXTS["refuses_some"].replace("horizon = 5", "horizon = 7"))
            self.assertEqual(rddlc.Problem(file).model.horizon, 7)
            file.write_text(TEXTS["mistake"])
            with self.assertRaises(rddlc.CompileError):
                rddlc.Problem(file)

    def test_episodes_begin_where_options_say(self) -> None:
        env = example("mountain_car")
        steps_of(env, 1, 5)
        state, shown = env.get_state(), env.state
        observation, _ = env.reset(options={"state": state})
        np.testing.assert_equal(observation, shown)
        self.assertEqual(env.timestep, 5)


class Masks(unittest.TestCase):
    def test_masks_tell_what_preconditions_allow(self) -> None:
        env = written("refuses_some", actions="simplified", action_mask=True)
        _, info = env.reset(seed=1)
        mask = info["action_mask"]
        self.assertEqual(mask.dtype, np.int8)
        self.assertEqual(mask.tolist(), [1, 0, 1])  # open d1, open d2 (locked), nothing
        np.testing.assert_array_equal(env.action_masks(), mask.astype(bool))
        for _ in range(20):
            self.assertNotEqual(env.action_space.sample(mask), 1)


class Choices(unittest.TestCase):
    def test_an_action_leaves_nothing_to_the_next(self) -> None:
        """Whichever way each was given."""
        forms = (lambda n: n, lambda n: {"action": n}, lambda n: np.array([n]), lambda n: np.int64(n))
        for name in ("network", "robot"):
            env, plain = (example(name, actions="simplified") for _ in range(2))
            if not isinstance(env.action_space, gymnasium.spaces.Discrete):
                continue
            for each in (env, plain):
                each.reset(seed=1)
            last = int(env.action_space.n) - 1
            for place, number in enumerate((1, last, 0, 2, last, 1, 0, last, 2, 1, 2, 0, last)):
                form = forms[place % len(forms)]
                np.testing.assert_equal(env.step(form(number)), plain.step(number))
                np.testing.assert_array_equal(env._batch.action_values, plain._batch.action_values)


class Processes(unittest.TestCase):
    def test_forked_and_spawned_processes_step(self) -> None:
        env = example("network")
        expected = [step[1] for step in steps_of(copy.deepcopy(env), 2, 5)]
        for method in ("fork", "spawn"):
            with multiprocessing.get_context(method).Pool(1) as pool:
                self.assertEqual(pool.apply(rewards, (env, 2, 5)), expected)

    def test_threads_step_environments_of_their_own(self) -> None:
        problem = example("network").problem
        with ThreadPoolExecutor(4) as pool:
            all_rewards = list(pool.map(lambda _: rewards(rddlc.make(problem), 2, 30), range(4)))
        self.assertTrue(all(each == all_rewards[0] for each in all_rewards))


def rewards(env: rddlc.RDDLEnv, seed: int, count: int) -> list[float]:
    return [step[1] for step in steps_of(env, seed, count)]


class Errors(unittest.TestCase):
    def test_the_compiler_says_what_is_wrong(self) -> None:
        with self.assertRaises(rddlc.CompileError) as raised:
            written("mistake")
        text = str(raised.exception)
        self.assertRegex(text, r"mistake\.rddl:\d+:\d+: error: ")
        self.assertIn("^", text)

    def test_missing_files_and_names(self) -> None:
        with self.assertRaisesRegex(rddlc.Error, "No such file"):
            rddlc.make("/nowhere/domain.rddl", "/nowhere/instance.rddl")

    def test_options_that_are_none(self) -> None:
        for option in ({"actions": "x"}, {"observations": "x"}, {"render_mode": "x"}):
            with self.assertRaises(ValueError):
                example("network", **option)


class Pictures(unittest.TestCase):
    def test_render_modes(self) -> None:
        env = example("mountain_car", render_mode="rgb_array", render_size=(300, 200))
        env.reset(seed=1)
        before = env.render()
        self.assertEqual((before.shape, before.dtype), ((200, 300, 3), np.uint8))
        env.step(env.action_space.sample())
        self.assertTrue((env.render() != before).any())
        text = example("mountain_car", render_mode="ansi")
        text.reset(seed=1)
        self.assertIn("step 0", text.render())

    def test_pictures_show_where_it_stands(self) -> None:
        """This also holds after another state was set, in copies and in pickles."""
        env = example("mountain_car", render_mode="rgb_array", render_size=(64, 64))
        env.reset(seed=1)
        start, first = env.get_state(), env.render()
        for _ in range(30):
            env.step({"throttle": 1.0})
        later, shown = env.get_state(), env.render()
        self.assertTrue((first != shown).any())
        twins = [copy.deepcopy(env), pickle.loads(pickle.dumps(env))]
        env.set_state(start)
        np.testing.assert_array_equal(env.render(), first)
        env.reset(options={"state": later})  # without the return until then
        shown = env.render()
        for twin in twins:
            np.testing.assert_array_equal(twin.render(), shown)

    def test_movies_and_replay_pages(self) -> None:
        env = example("mountain_car", render_mode="rgb_array", render_size=(60, 40))
        steps_of(env, 1, 3)
        with tempfile.TemporaryDirectory() as folder:
            movie = Path(folder) / "movie.gif"
            env.save_gif(movie)
            self.assertEqual(movie.read_bytes()[:6], b"GIF89a")
            with PIL.Image.open(movie) as image:
                self.assertEqual(len(list(PIL.ImageSequence.Iterator(image))), 4)
        self.assertIn("<html", env.replay_page())
        with self.assertRaisesRegex(rddlc.Error, "render_mode"):
            example("mountain_car").replay_page()

    def test_a_window_that_cannot_open_is_an_error(self) -> None:
        if importlib.util.find_spec("pygame") is None:
            self.skipTest("pygame is not installed")
        env = example("mountain_car", render_mode="human")
        with unittest.mock.patch.dict(os.environ, SDL_VIDEODRIVER="none_such"):
            with self.assertRaisesRegex(rddlc.Error, "cannot open a window.*rgb_array"):
                env.reset(seed=1)
                env.render()

    def test_a_notebook_shows_an_environment(self) -> None:
        env = example("mountain_car")
        self.assertIn("reset()", env._repr_html_())
        env.reset(seed=1)
        self.assertIn("data:image/png;base64,", env._repr_html_())


if __name__ == "__main__":
    unittest.main()
