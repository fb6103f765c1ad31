"""Whatever is asked for, nothing crashes: a sentence says what is wrong, and nothing is changed."""

from __future__ import annotations

import os
import pickle
import tempfile
import unittest
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from support import FOLDER, TEXTS, example, problem_of, problem_of_text

import rddlc
from rddlc.transitions import Transitions

CAR = FOLDER / "mountain_car"
LOADED = rddlc.Problem(CAR, 1, engine="interpreter")
Case = tuple[Callable[[], Any], type[BaseException], str]


def vector(**options: Any) -> rddlc.RDDLVectorEnv:
    return rddlc.make_vec(CAR, 1, **{"num_envs": 4, "engine": "interpreter", **options})


class Refusals(unittest.TestCase):
    def check(self, cases: list[Case]) -> None:
        for number, (call, error, pattern) in enumerate(cases):
            with self.subTest(number=number, pattern=pattern), self.assertRaisesRegex(error, pattern):
                call()

    def test_of_what_is_made(self) -> None:
        self.check(
            [
                (lambda: vector(num_envs=0), rddlc.Error, "num_envs is 0"),
                (lambda: vector(num_envs=-1), rddlc.Error, "num_envs is -1"),
                (lambda: vector(num_envs=1 << 40), rddlc.Error, "GiB|memory"),
                (lambda: vector(num_envs="4"), TypeError, ""),
                (lambda: vector(observations="none"), ValueError, "not one of 'flat', 'dict'"),
                (lambda: vector(autoreset_mode="none"), ValueError, ""),
                (lambda: example("mountain_car", observations="none"), ValueError, "not one of"),
                (lambda: example("mountain_car", no_option=1), TypeError, "no_option'; there are .*horizon"),
                (lambda: example("mountain_car", vectorised=1), TypeError, "'vectorised'; did you mean 'vectorized'"),
                (lambda: vector(n_envs=1), TypeError, "'n_envs'; there are"),
                (lambda: example("mountain_car", log_path="x"), TypeError, "pyRDDLGym's.* rddlc.backend.make"),
                (lambda: vector(render_mode="human"), ValueError, "not one of None, .rgb_array., .ansi."),
                (lambda: vector(no_option=1), TypeError, "no_option'; there are .*autoreset_mode"),
                (lambda: rddlc.make(LOADED, engine="interpreter"), rddlc.Error, "loaded already"),
                (lambda: rddlc.make(LOADED, 2), rddlc.Error, "loaded already: give instance"),
                (lambda: rddlc.Problem(CAR, 1, externs="f.hpp"), rddlc.Error, "list of headers"),
                (lambda: example("mountain_car", render_size=3), rddlc.Error, "width and a height"),
                (lambda: example("mountain_car", render_mode="ansi", render_size=(0, 9)), rddlc.Error, "16 to 8192"),
                (lambda: example("mountain_car", render_mode="ansi", visualizer="x"), rddlc.Error, "no visualizer"),
                (lambda: rddlc.make("/etc/passwd", engine="interpreter"), rddlc.CompileError, "E0"),
                (lambda: rddlc.make("/no/such/file", engine="interpreter"), rddlc.Error, "no/such"),
                (lambda: rddlc.make("a\0b", engine="interpreter"), rddlc.ArgumentError, "NUL"),
                (lambda: rddlc.make(3.5, engine="interpreter"), rddlc.ArgumentError, "neither a str"),
                (lambda: rddlc.make("a\udc80", engine="interpreter"), rddlc.ArgumentError, "not UTF-8"),
                (lambda: rddlc.make("/no/\x1b[2J\u009bsuch", engine="interpreter"), rddlc.Error, "/no/\ufffd.2J\ufffdsuch"),
                (lambda: rddlc.make(CAR, "\x1b[2J", engine="interpreter"), rddlc.Error, "\ufffd.2J"),
                (lambda: rddlc.Problem(CAR, 1, externs=["a\0"]), rddlc.ArgumentError, "NUL"),
                (lambda: rddlc.Problem(CAR, 1, instance_name=3), rddlc.ArgumentError, "instance_name is 3"),
                (lambda: rddlc.Problem(CAR, 1, extended="no"), rddlc.ArgumentError, "extended is 'no'"),
                (lambda: rddlc.Problem(CAR, 1, details=1), rddlc.ArgumentError, "details is 1"),
                (lambda: rddlc.make(CAR, 1, engine="none"), ValueError, "not one of"),
                (lambda: Transitions(example("mountain_car").problem, levels=-1), rddlc.Error, "2 or more"),
            ]
        )

    def test_of_episodes(self) -> None:
        env = example("mountain_car")
        env.reset(seed=1)
        env.step({"throttle": 0.5})
        before = env.get_state()
        other = example("network")
        other.reset(seed=1)
        own: list[object] = []
        own.append(own)
        deep: list[object] = [0.5]
        for _ in range(100_000):
            deep = [deep]
        self.check(
            [
                (lambda: env.reset(options=[1]), TypeError, "a dictionary, not a list"),
                (lambda: env.reset(seed=2, options={"state": 3}), TypeError, "rddlc.State, not a int"),
                (lambda: env.reset(seed=-1), Exception, "greater or equal to zero"),
                (lambda: env.set_state(None), TypeError, "rddlc.State"),
                (lambda: env.set_state(other.get_state()), rddlc.Error, "bytes, not"),
                (lambda: env.set_state(replace(before, steps=-1)), rddlc.Error, "steps is -1"),
                (lambda: env.set_state(replace(before, steps=1.5)), rddlc.Error, "steps is 1.5"),
                (lambda: env.set_state(replace(before, causes=16)), rddlc.Error, "causes is 16"),
                (lambda: env.set_state(replace(before, record="x")), rddlc.Error, "record is bytes"),
                (lambda: env.set_state(before, seed=1, replay=True), rddlc.Error, "not both"),
                (lambda: env.reset(options={"stat": before}), rddlc.Error, "'stat'; did you mean 'state'"),
                (lambda: env.reset(seed=2, options={"state": other.get_state()}), rddlc.Error, "bytes, not"),
                (lambda: env.step({"throttle": 10**400}), rddlc.ActionError, "throttle"),
                (lambda: env.step({"throttle": 1j}), rddlc.ActionError, "throttle"),
                (lambda: env.step({"throttle": b"\x01"}), rddlc.ActionError, "throttle"),
                (lambda: env.step({"throttle": bytearray(b"\x01")}), rddlc.ActionError, "throttle"),
                (lambda: env.step({"throttle": memoryview(b"\x01")}), rddlc.ActionError, "throttle"),
                (lambda: env.step({"throttle": 10**5000}), rddlc.ActionError, "a number of 16610 bits"),
                (lambda: env.step({"throttle": own}), rddlc.ActionError, r"throttle.* is \[\[...\]\], "),
                (lambda: env.step({"throttle": deep}), rddlc.ActionError, "throttle"),
                (lambda: env.step({1: 2}), rddlc.ActionError, "no action '1'"),
            ]
        )
        self.assertEqual(env.get_state(), before)

    def test_of_many_environments(self) -> None:
        envs = vector()
        envs.reset(seed=1)
        envs.step(np.full((4, 1), 0.5, np.float32))
        before = [envs._batch.progress(place) for place in range(4)]
        over = Transitions(LOADED, horizon=1).sample(Transitions(LOADED).start(), 0).state
        two = np.zeros((4, 1), np.float32)
        two[3] = 2
        self.check(
            [
                (lambda: envs.step(two), rddlc.ActionError, "throttle"),
                (lambda: envs.step(b"\x01"), rddlc.ActionError, "not an array"),
                (lambda: envs.step({"throttle": 0.5}), rddlc.ActionError, "not an array of numbers"),
                (lambda: envs.step([[1], [1, 2], [1], [1]]), rddlc.ActionError, "not an array"),
                (lambda: envs.step(np.full_like(two, np.nan)), rddlc.ActionError, "throttle"),
                (lambda: envs.step(two[:3]), rddlc.ActionError, "shape"),
                (lambda: envs.step("abcd"), Exception, ""),
                (lambda: envs.reset(seed=[1, 2]), ValueError, "2 seeds for 4"),
                (lambda: envs.reset(seed=[1, 2, 3, -1]), ValueError, "seed is -1"),
                (lambda: envs.reset(seed=(1 << 64) - 2), rddlc.Error, "64 bits"),
                (lambda: envs.reset(options={"reset_mask": np.ones(2, bool)}), ValueError, "shape"),
                (lambda: envs.reset(options={"reset_mask": [1, 2, 3, 4]}), rddlc.Error, "bool"),
                (lambda: envs.reset(options={"mask": None}), rddlc.Error, "'mask'; there are reset_mask, state"),
                (lambda: envs.reset(options={"state": 3}), rddlc.Error, "rddlc.State"),
                (lambda: envs.reset(options={"state": [None]}), rddlc.Error, "1 states for 4"),
                (lambda: envs.reset(options={"state": [None, None, None, 3]}), rddlc.Error, "rddlc.State"),
                (lambda: envs.reset(options={"state": over}), rddlc.EpisodeOver, "horizon"),
                (lambda: envs.reset(options=3), rddlc.Error, "a dictionary"),
            ]
        )
        self.assertEqual([envs._batch.progress(place) for place in range(4)], before)

    def test_of_arrays_by_name(self) -> None:
        single = example("network")
        envs = rddlc.make_vec(single.problem, num_envs=2, actions="dict")
        computers = envs.action_space["reboot"].shape[1]
        for env in (single, envs):
            env.reset(seed=1)
            size = computers if env is single else 2 * computers
            refused = [bytes(size), bytearray(size), memoryview(bytes(size)), [True, [1]], [None] * size, {1}]
            self.check(
                [(partial(env.step, {"reboot": each}), rddlc.ActionError, "reboot") for each in refused]
            )

    def test_of_discrete_actions(self) -> None:
        env = example("network", actions="simplified")
        env.reset(seed=1)
        before = env.get_state()
        for action in (-1, 9, 10**30, 1.5, "x", None, [1, 2], np.nan, {}):
            with self.subTest(action=action), self.assertRaises((rddlc.ActionError, TypeError, OverflowError)):
                env.step(action)
        self.assertEqual(env.get_state(), before)

    def test_of_learners(self) -> None:
        problem = example("mountain_car").problem
        model = rddlc.CGP(problem).learn(1)
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.check(
            [
                (lambda: model.evaluate(0), rddlc.Error, "episodes is 0: one or more"),
                (lambda: model.evaluate(-1), rddlc.Error, "episodes is -1: one or more"),
                (lambda: model.learn(-1), ValueError, "one or more"),
                (lambda: rddlc.CGP.load(model.save(folder / "x"), problem).learn(1), rddlc.Error, "learn on"),
                (lambda: rddlc.CGP(problem).best, rddlc.Error, "nothing has been learned"),
                (lambda: rddlc.PPO(problem, environments=-1), rddlc.Error, ""),
                (lambda: rddlc.PPO(problem, seed=-1), rddlc.Error, "seed"),
                (lambda: rddlc.CGP.load("/etc/passwd", problem), rddlc.Error, ""),
                (lambda: model.save("/no/such/folder/x"), rddlc.Error, "no/such"),
                (lambda: model.save("a\0b"), rddlc.ArgumentError, "NUL"),
                (lambda: rddlc.PPO.load("a\0b", problem), rddlc.ArgumentError, "NUL"),
                (lambda: rddlc.PPO.load("/no/such", problem), rddlc.ArgumentError, "no policy file"),
            ]
        )

    def test_of_transitions(self) -> None:
        transitions = Transitions(problem_of("refuses_some"))
        foreign = Transitions(example("mountain_car").problem).start()
        self.check(
            [
                (lambda: transitions.sample(foreign, 0), rddlc.Error, "bytes"),
                (lambda: transitions.applicable(foreign), rddlc.Error, "bytes"),
                (lambda: transitions.outcomes(foreign, 0), rddlc.Error, "bytes"),
                (lambda: transitions.outcomes(transitions.start(), -1), rddlc.ActionError, "0 to 2"),
                (lambda: transitions.sample(transitions.start(), 99), rddlc.ActionError, "0 to 2"),
                (lambda: transitions.action(-1), rddlc.ActionError, "0 to 2"),
            ]
        )

    def test_of_states_of_other_problems(self) -> None:
        """They have the same size; and a bool has to be 0 or 1."""
        text = TEXTS["refuses_some"]
        problem = problem_of_text(text)
        others = [
            problem_of_text(text.replace("is_open", "is_shut")),
            problem_of_text(text.replace("d2", "d3")),
            problem_of_text(text.replace("doors_1", "doors_2")),
        ]
        env, envs, transitions = rddlc.make(problem), rddlc.make_vec(problem, num_envs=2), Transitions(problem)
        env.reset(seed=1)
        own = env.get_state()
        foreign = [Transitions(other).start() for other in others]
        for state in (*foreign, replace(own, record=b"\xff" * len(own.record)), replace(own, problem="")):
            self.assertEqual(len(state.record), len(own.record))
            self.check(
                [
                    (lambda: env.set_state(state), rddlc.Error, "another problem|neither 0 nor 1"),
                    (lambda: env.reset(options={"state": state}), rddlc.Error, ""),
                    (lambda: envs.reset(options={"state": state}), rddlc.Error, ""),
                    (lambda: transitions.sample(state, 0), rddlc.Error, ""),
                    (lambda: transitions.outcomes(state, 0), rddlc.Error, ""),
                    (lambda: transitions.applicable(state), rddlc.Error, ""),
                ]
            )
        self.assertEqual(env.get_state(), own)
        rddlc.make(problem_of_text(text)).set_state(own)  # the same problem, loaded twice


NUMBERS: dict[str, Any] = {
    "-1": -1,
    "0": 0,
    "2**31": 1 << 31,
    "2**63": 1 << 63,
    "2**64": 1 << 64,
    "10**5000": 10**5000,
    "nan": float("nan"),
    "inf": float("inf"),
    "1.5": 1.5,
    "True": True,
    "np.True_": np.True_,
    "np.int64(3)": np.int64(3),
    "np.uint8(3)": np.uint8(3),
    "np.float64(3)": np.float64(3),
    "np.array([3])": np.array([3]),
    "text": "3",
}
SMALL = {"np.int64(3)", "np.uint8(3)"}
SEED = SMALL | {"0", "2**31", "2**63"}


class Numbers(unittest.TestCase):
    """Each numeric argument of the package with each of NUMBERS: it does what it says, or an
    rddlc.Error names the argument."""

    def check(self, name: str, call: Callable[[Any], Any], accepted: set[str]) -> None:
        for text, number in NUMBERS.items():
            with self.subTest(argument=name, number=text):
                if text in accepted:
                    call(number)
                    continue
                with self.assertRaises(rddlc.Error) as raised:
                    call(number)
                self.assertRegex(str(raised.exception), name)

    def test_of_environments(self) -> None:
        self.check("horizon", lambda n: rddlc.make(LOADED, horizon=n), SMALL | {"0", "2**31"})
        self.check(
            "render_size|16 to 8192",
            lambda n: rddlc.make(LOADED, render_size=(n, 90), render_mode="ansi"),
            set(),
        )
        self.check("horizon", lambda n: vector(horizon=n), SMALL | {"0", "2**31"})
        self.check("num_envs|environments", lambda n: vector(num_envs=n), SMALL)
        self.check("threads", lambda n: vector(threads=n), SMALL | {"0"})

    def test_of_seeds(self) -> None:
        env, envs = rddlc.make(LOADED), vector()
        env.reset(seed=1)
        state = env.get_state()
        self.check("seed", lambda n: env.reset(seed=n), SEED)
        self.check("seed", lambda n: env.set_state(state, seed=n), SEED)
        self.check("seed", lambda n: envs.reset(seed=n), SEED - {"np.array([3])"})

    def test_a_refused_seed_changes_nothing(self) -> None:
        env = example("network")
        env.reset(seed=1)
        for number in (-1, 1 << 64, 10**5000, 1.5, True):
            with self.assertRaises(rddlc.Error):
                env.reset(seed=number)
            with self.assertRaises(rddlc.Error):
                env.set_state(env.get_state(), seed=number)
        expected = example("network")
        expected.reset(seed=1)
        again = pickle.loads(pickle.dumps(env))
        for _ in range(5):
            step = expected.step({})
            np.testing.assert_equal(env.step({}), step)
            np.testing.assert_equal(again.step({}), step)

    def test_of_learners(self) -> None:
        new = partial(rddlc.CGP, LOADED, children=4, nodes=10)
        model = new().learn(3)
        at_once: Callable[[Any], bool] = lambda _: False  # noqa: E731
        self.check("generations", lambda n: new().learn(n, at_once), SMALL | {"2**31"})
        self.check("evaluations", lambda n: new().learn(1, evaluations=n), SMALL | {"0", "2**31"})
        self.check("evaluation_episodes", lambda n: new().learn(1, evaluation_episodes=n), SMALL)
        self.check("episodes", lambda n: model.evaluate(n), SMALL)
        self.check("seed", lambda n: model.evaluate(1, seed=n), SEED)
        self.check("seed", lambda n: model.policy(seed=n), SEED)
        self.check("threads", lambda n: model.evaluate(1, threads=n), SMALL | {"0"})
        self.check("horizon", lambda n: model.evaluate(1, horizon=n), SMALL | {"0", "2**31"})

    def test_of_transitions(self) -> None:
        new = partial(Transitions, LOADED)
        transitions = new()
        start = transitions.start()
        self.check("levels", lambda n: new(levels=n), SMALL)
        self.check("samples", lambda n: new(samples=n), SMALL | {"0", "2**31"})
        self.check("horizon", lambda n: new(horizon=n), SMALL | {"0", "2**31"})
        self.check("most_outcomes", lambda n: new(most_outcomes=n), SMALL | {"2**31"})
        self.check("seed", lambda n: new(seed=n).sample(new(seed=n).start(), 0), SEED)
        many = new(levels=4)
        self.check("action", lambda n: many.sample(start, n), SMALL | {"0"})
        self.check("action", lambda n: many.outcomes(start, n), SMALL | {"0"})
        self.check("action", lambda n: many.action(n), SMALL | {"0"})


class Paths(unittest.TestCase):
    """A path that ends early for C++ is another file."""

    def test_of_nul_characters(self) -> None:
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        (folder / "kept").write_text("precious")
        (folder / "domain.rddl").write_bytes((CAR / "domain.rddl").read_bytes())
        model = rddlc.CGP(LOADED, children=4, nodes=10).learn(1)
        env = rddlc.make(LOADED, render_mode="rgb_array", render_size=(32, 32))
        env.reset(seed=1)
        text = str(folder / "kept") + "\0.gif"
        domain, instance = str(CAR / "domain.rddl"), str(CAR / "instance.rddl")
        for path in (text, os.fsencode(text), Path(text), Named(text)):
            for call in (
                lambda: env.save_gif(path),
                lambda: model.save(path),
                lambda: model.save(path, best=True),
                lambda: rddlc.CGP.load(path, LOADED),
                lambda: rddlc.Problem(path),
                lambda: rddlc.Problem(domain + "\0x", instance, engine="interpreter"),
                lambda: rddlc.Problem(domain, instance + "\0x", engine="interpreter"),
                lambda: rddlc.Problem(domain, instance, externs=[path], engine="interpreter"),
            ):
                with self.subTest(path=path), self.assertRaises((rddlc.Error, ValueError)) as raised:
                    call()
                self.assertRegex(str(raised.exception), "NUL|null")
        self.assertEqual((folder / "kept").read_text(), "precious")
        self.assertEqual({each.name for each in folder.iterdir()}, {"kept", "domain.rddl"})

    def test_of_all_kinds_of_paths(self) -> None:
        folder = Path(self.enterContext(tempfile.TemporaryDirectory())) / "größe"
        folder.mkdir()
        model = rddlc.CGP(LOADED, children=4, nodes=10).learn(1)
        env = rddlc.make(LOADED, render_mode="rgb_array", render_size=(32, 32))
        env.reset(seed=1)
        for number, kind in enumerate((str, os.fsencode, Path, Named)):
            policy, movie = folder / f"{number}.cgp", folder / f"{number}.gif"
            self.assertEqual(model.save(kind(policy)), policy)
            self.assertEqual(rddlc.CGP.load(kind(policy), LOADED).policy_text, model.policy_text)
            env.save_gif(kind(movie))
            self.assertTrue(movie.read_bytes().startswith(b"GIF"))
            for text in ("domain", "instance"):
                (folder / f"{text}.rddl").write_bytes((CAR / f"{text}.rddl").read_bytes())
            problem = rddlc.Problem(
                kind(folder / "domain.rddl"), kind(folder / "instance.rddl"), engine="interpreter"
            )
            self.assertEqual(problem.files[0], str(folder / "domain.rddl"))

    def test_of_names_that_are_not_utf_8(self) -> None:
        folder = os.fsencode(self.enterContext(tempfile.TemporaryDirectory()))
        model = rddlc.CGP(LOADED, children=4, nodes=10).learn(1)
        for path in (folder + b"/caf\xe9", os.fsdecode(folder + b"/caf\xe9")):
            with self.assertRaisesRegex(rddlc.Error, "not UTF-8"):
                model.save(path)
            with self.assertRaisesRegex(rddlc.Error, "not UTF-8"):
                rddlc.Problem(path)
        self.assertEqual(os.listdir(folder), [])


class Named:
    def __init__(self, path: Any) -> None:
        self._path = str(path)

    def __fspath__(self) -> str:
        return self._path


if __name__ == "__main__":
    unittest.main()
