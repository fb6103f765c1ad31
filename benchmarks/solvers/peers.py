"""How fast peers learn on pyRDDLGym, in processor time, beside which speed.py sets ours.

    PYTHON benchmarks/solvers/peers.py sb3 [--steps 4096] [--packages FOLDER]
    PYTHON benchmarks/solvers/peers.py skdecide [--generations 6] [--packages FOLDER]

PYTHON is one that has Stable-Baselines3, or scikit-decide; FOLDER a site-packages with pyRDDLGym and rddlrepository, where
it has them not. The problem is MountainCar_ippc2023 1. Prints steps (sb3) or evaluations (skdecide) a second of one core.
"""

import argparse
import contextlib
import io
import sys
import tempfile
import time

import gymnasium
import numpy as np


class Flat(gymnasium.Env):
    """pyRDDLGym's environment with boxes in place of its dictionaries; the horizon is an end as any other."""

    def __init__(self):
        import pyRDDLGym

        self.env = pyRDDLGym.make("MountainCar_ippc2023", "1")
        observed, acted = self.env.observation_space.spaces, self.env.action_space.spaces
        self.names, self.actions = list(observed), list(acted)
        box = lambda spaces: gymnasium.spaces.Box(
            np.array([float(np.min(s.low)) for s in spaces], np.float32),
            np.array([float(np.max(s.high)) for s in spaces], np.float32))
        self.observation_space, self.action_space = box(observed.values()), box(acted.values())

    def _row(self, observation):
        return np.array([float(observation[name]) for name in self.names], np.float32)

    def reset(self, seed=None, options=None):
        observation, info = self.env.reset(seed=seed)
        return self._row(observation), {}

    def step(self, action):
        observation, reward, terminated, truncated, _ = self.env.step(
            {name: float(a) for name, a in zip(self.actions, np.atleast_1d(action))})
        return self._row(observation), float(reward), bool(terminated or truncated), False, {}


def sb3(arguments):
    """Steps a second of PPO with its defaults: 10 epochs of minibatches of 64."""
    import torch
    from stable_baselines3 import PPO

    torch.set_num_threads(1)
    model = PPO("MlpPolicy", Flat(), seed=0, device="cpu")
    begin = time.process_time()
    model.learn(arguments.steps)
    return model.num_timesteps / (time.process_time() - begin)


def skdecide(arguments):
    """Evaluations of a program a second: a parent, then four children a generation."""
    from skdecide import TransitionOutcome, Value
    from skdecide.builders.domain import FullyObservable
    from skdecide.domains import RLDomain
    from skdecide.hub.solver.cgp import CGP
    from skdecide.hub.space.gym import GymSpace

    class Domain(RLDomain, FullyObservable):
        T_state = T_observation = T_event = np.ndarray
        T_value, T_info = float, dict

        def _state_reset(self):
            return env.reset()[0]

        def _state_step(self, action):
            observation, reward, ends, _, info = env.step(action)
            return TransitionOutcome(observation, Value(reward=reward), ends, info)

        def _get_action_space_(self):
            return GymSpace(env.action_space)

        def _get_observation_space_(self):
            return GymSpace(env.observation_space)

    env = Flat()
    with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()):
        solver = CGP(Domain, folder_name=folder, n_it=arguments.generations, verbose=False)
        begin = time.process_time()
        solver.solve()
        seconds = time.process_time() - begin
    return (1 + 4 * arguments.generations) / seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("peer", choices=["sb3", "skdecide"])
    parser.add_argument("--steps", type=int, default=4096)
    parser.add_argument("--generations", type=int, default=6)
    parser.add_argument("--packages")
    arguments = parser.parse_args()
    if arguments.packages:
        sys.path.append(arguments.packages)
    rate = {"sb3": sb3, "skdecide": skdecide}[arguments.peer](arguments)
    print(f"{rate:.4g}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
