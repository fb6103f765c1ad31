"""Ids and specifications of Gymnasium, problems given as text, names of errors, python -m rddlc."""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import gymnasium
from support import DOOR, FOLDER, GLASS, example

import rddlc
from rddlc.repository_names import known_instances
from rddlc.versions import HAS_VECTORS

CAR = FOLDER / "mountain_car"


class Registration(unittest.TestCase):
    def test_own_files_have_ids(self) -> None:
        folder = os.getcwd()
        try:
            os.chdir(CAR)
            rddlc.register("Climb-v0", "domain.rddl", "instance.rddl", engine="interpreter", horizon=7)
        finally:
            os.chdir(folder)
        env = gymnasium.make("Climb-v0", observations="flat")
        self.assertEqual(env.observation_space.shape, (2,))
        self.assertEqual(env.unwrapped.horizon, 7)
        self.assertEqual(env.spec.max_episode_steps, 7)
        with self.assertRaisesRegex(rddlc.ArgumentError, "no option 'horizn'"):
            rddlc.register("Climb-v1", CAR, 1, horizn=7)

    def test_what_is_made_has_a_specification(self) -> None:
        env = example("mountain_car", horizon=9, vectorized=True)
        self.assertEqual(env.spec.max_episode_steps, 9)
        again = gymnasium.make(env.spec)
        self.assertEqual(again.observation_space, env.observation_space)
        self.assertEqual(again.unwrapped.problem.engine, "interpreter")
        self.assertEqual(pickle.loads(pickle.dumps(env)).spec, env.spec)

    @unittest.skipUnless(HAS_VECTORS, "vectors need gymnasium 1.0")
    def test_vectors_are_made_of_ids_and_specifications(self) -> None:
        rddlc.register("ClimbTogether-v0", CAR, 1, engine="interpreter", horizon=7)
        envs = gymnasium.make_vec("ClimbTogether-v0", num_envs=3)
        self.assertEqual((envs.num_envs, envs.unwrapped.horizon), (3, 7))
        envs = rddlc.make_vec(CAR, 1, num_envs=2, engine="interpreter")
        self.assertEqual(gymnasium.make_vec(envs.spec, num_envs=4).num_envs, 4)
        single = example("mountain_car", horizon=9)
        self.assertEqual(gymnasium.make_vec(single.spec, num_envs=4).unwrapped.horizon, 9)

    def test_render_modes_are_known_before_anything_is_made(self) -> None:
        self.assertEqual(rddlc.make.metadata["render_modes"], rddlc.RDDLEnv.metadata["render_modes"])
        rddlc.register("Climb-v2", CAR, 1, engine="interpreter")
        env = gymnasium.make("Climb-v2", render_mode="rgb_array")
        env.reset(seed=1)
        self.assertEqual(env.render().shape, (400, 600, 3))


    def test_ids_say_that_the_repository_is_missing(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "sitecustomize.py").write_text(
                "import importlib.util\nfind = importlib.util.find_spec\n"
                "importlib.util.find_spec = lambda name, *rest: None if name == 'rddlrepository' else find(name, *rest)"
            )
            path = os.pathsep.join([folder, *sys.path])
            made = subprocess.run(
                [sys.executable, "-c", "import gymnasium, rddlc; gymnasium.make('rddlc/HVAC_ippc2023-1-v0')"],
                env={k: v for k, v in os.environ.items() if k != "RDDL_REPOSITORY"} | {"PYTHONPATH": path},
                capture_output=True,
                text=True,
            )
        self.assertRegex(made.stderr, "rddlc.Error: .*HVAC_ippc2023.*pip install rddlrepository")

    @unittest.skipUnless(rddlc.problems(), "rddlrepository is not installed")
    def test_ids_are_known_without_the_repository(self) -> None:
        there = {(each.name, instance) for each in rddlc.problems() for instance in each.instances}
        self.assertEqual(set(known_instances()), there)


class Pictures(unittest.TestCase):
    def test_lists_of_pictures(self) -> None:
        env = example("mountain_car", render_mode="rgb_array_list", render_size=(60, 40))
        with self.assertRaisesRegex(rddlc.EpisodeOver, r"reset\(\) before render"):
            env.render()
        env.reset(seed=1)
        for count in (4, 3):
            for _ in range(3):
                env.step({"throttle": 1.0})
            frames = env.render()
            self.assertEqual([frame.shape for frame in frames], [(40, 60, 3)] * count)
        env.step({})
        env.reset()
        self.assertEqual(len(env.render()), 1)

    def test_what_gymnasium_makes_shows_itself_in_notebooks(self) -> None:
        rddlc.register("Climb-v3", CAR, 1, engine="interpreter")
        env = gymnasium.make("Climb-v3")
        env.reset(seed=1)
        self.assertIn("<img", env._repr_html_())


class Texts(unittest.TestCase):
    def test_one_text_and_two(self) -> None:
        begin = DOOR.index("non-fluents two")
        for texts in ((DOOR,), (DOOR[:begin], DOOR[begin:])):
            env = rddlc.make(*texts, engine="interpreter")
            self.assertEqual(env.model.instance, "doors_1")
            self.assertEqual(pickle.loads(pickle.dumps(env.problem)).model.instance, "doors_1")

    def test_a_file_and_a_text(self) -> None:
        instance = (CAR / "instance.rddl").read_text()
        env = rddlc.make(CAR / "domain.rddl", instance, engine="interpreter")
        self.assertEqual(env.model.domain, example("mountain_car").model.domain)

    def test_mistakes_are_shown_in_the_text(self) -> None:
        with self.assertRaisesRegex(rddlc.CompileError, "domain.rddl:7.*por"):
            rddlc.make(GLASS.replace("filled + pour;", "filled + por;"), engine="interpreter")


class Names(unittest.TestCase):
    def test_errors_are_shown_by_the_name_that_catches_them(self) -> None:
        for error in (
            rddlc.Error, rddlc.ActionError, rddlc.ArgumentError, rddlc.CompileError, rddlc.EpisodeOver
        ):  # fmt: skip
            self.assertEqual(f"{error.__module__}.{error.__qualname__}", f"rddlc.{error.__name__}")
        self.assertIsInstance(pickle.loads(pickle.dumps(rddlc.ActionError("no"))), rddlc.ActionError)

    def test_the_package_is_the_program(self) -> None:
        build = Path(rddlc.__file__).parents[2]
        path = f"{build / 'bin'}{os.pathsep}{os.environ.get('PATH', '')}"
        for folders, status, pattern in ((path, 0, "rddl run"), ("", 1, "no program rddl")):
            made = subprocess.run(
                [sys.executable, "-m", "rddlc", "help"],
                env=os.environ | {"PATH": folders},
                capture_output=True,
                text=True,
            )
            self.assertEqual(made.returncode, status)
            self.assertIn(pattern, made.stdout + made.stderr)

    @unittest.skipIf(sys.prefix == sys.base_prefix or not rddlc.problems(), "no virtual environment with rddlrepository")
    def test_the_program_finds_the_repository_beside_its_python(self) -> None:
        kept = {k: v for k, v in os.environ.items() if k not in ("RDDL_REPOSITORY", "VIRTUAL_ENV")}
        made = subprocess.run(
            [sys.executable, "-m", "rddlc", "list", "mountaincar"],
            env=kept | {"PATH": str(Path(rddlc.__file__).parents[2] / "bin")},
            capture_output=True,
            text=True,
        )
        self.assertIn("MountainCar_ippc2023", made.stdout, made.stderr)


if __name__ == "__main__":
    unittest.main()
