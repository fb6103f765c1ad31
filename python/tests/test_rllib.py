"""rddlc.rllib with RLlib itself, which scripts/test.sh does not install:

    pip install "ray[rllib]" torch && PYTHONPATH=build/python python python/tests/test_rllib.py
"""

from __future__ import annotations

import json
import os
import pickle
import shutil
import subprocess
import sys
import tempfile
import unittest
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from support import FOLDER, example

import rddlc

if find_spec("ray") is None:
    raise unittest.SkipTest("RLlib is not installed")

import ray
from ray.rllib.algorithms.ppo import PPOConfig

from rddlc import rllib

FROM_JSON = """
import json, sys
from rddlc import rllib
env = rllib.create_env(json.load(sys.stdin))
observation, _ = env.reset(seed=3)
print(json.dumps([env.model.instance, env.horizon, observation.tolist()]))
"""


def config(name: str = "mountain_car", **options: object) -> dict[str, object]:
    folder = FOLDER / name
    return rllib.env_config(
        folder / "domain.rddl", folder / "instance.rddl", engine="interpreter", **options
    )


class Configurations(unittest.TestCase):
    def test_they_are_data_and_need_no_files(self) -> None:
        """Made of files that are gone, sent as JSON, opened by another process."""
        with tempfile.TemporaryDirectory() as folder:
            copy = shutil.copytree(FOLDER / "mountain_car", Path(folder) / "car")
            made = rllib.env_config(copy / "domain.rddl", copy / "instance.rddl", engine="interpreter")
        sent = pickle.loads(pickle.dumps(made))
        self.assertEqual(sent, made)
        found = subprocess.run(
            [sys.executable, "-c", FROM_JSON],
            input=json.dumps(sent),
            capture_output=True,
            text=True,
            check=True,
        )
        env = example("mountain_car", observations="flat", actions="box", normalize=True)
        expected = [env.model.instance, env.horizon, env.reset(seed=3)[0].tolist()]
        self.assertEqual(json.loads(found.stdout), expected)

    def test_options_are_those_of_make(self) -> None:
        env = rllib.create_env(config("network", actions="simplified", horizon=3))
        self.assertEqual(env.action_space.n, 9)
        self.assertEqual(env.horizon, 3)

    def test_arguments_of_make_will_do(self) -> None:
        folder = FOLDER / "mountain_car"
        files = {"domain": str(folder / "domain.rddl"), "instance": str(folder / "instance.rddl")}
        env = rllib.create_env({**files, "engine": "interpreter"})
        self.assertEqual(env.observation_space.shape, (2,))

    def test_mistakes_are_told_where_the_configuration_is_made(self) -> None:
        with self.assertRaises(rddlc.Error):
            rllib.env_config("no_such_problem", 1)


class Cluster(unittest.TestCase):
    def test_its_ppo_learns_in_other_processes(self) -> None:
        ray.init(
            num_cpus=2,
            include_dashboard=False,
            log_to_driver=False,
            runtime_env={"env_vars": {"PYTHONPATH": os.environ.get("PYTHONPATH", "")}},
        )
        try:
            algorithm = (
                PPOConfig()
                .environment(rllib.NAME, env_config=config(horizon=50))
                .env_runners(num_env_runners=1, num_envs_per_env_runner=2)
                .training(train_batch_size_per_learner=200, minibatch_size=100, num_epochs=1)
                .build_algo()
            )
            result = algorithm.train()
            algorithm.stop()
        finally:
            ray.shutdown()
        runners = result["env_runners"]
        self.assertGreaterEqual(runners["num_env_steps_sampled"], 200)
        self.assertTrue(np.isfinite(runners["episode_return_mean"]))
        self.assertEqual(runners["episode_len_max"], 50)


if __name__ == "__main__":
    unittest.main()
