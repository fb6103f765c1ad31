"""Learners for the mountain car: each gives a policy, which is a function from an environment to an
action as the environment takes it. Those whose package is not installed raise ImportError."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

import rddlc

Policy = Callable[[rddlc.RDDLEnv], Any]
SEED = 7


def at_random(problem: rddlc.Problem) -> Policy:
    return lambda env: env.action_space.sample()


def rddlc_ppo(problem: rddlc.Problem) -> Policy:
    model = rddlc.PPO(problem, seed=SEED).learn(400_000)
    return lambda env: model.predict(env)[0]


def rddlc_cgp(problem: rddlc.Problem) -> Policy:
    model = rddlc.CGP(problem, seed=SEED).learn(25)
    print(f"  rddlc's CGP found: {model.formula}".replace("\n", "; "))
    return lambda env: model.predict(env)[0]


def stable_baselines3_ppo(problem: rddlc.Problem) -> Policy:
    import torch
    from stable_baselines3 import PPO

    from rddlc import sb3

    torch.set_num_threads(1)
    envs = sb3.make_vec(problem, num_envs=16, actions="box", normalize=True)
    model = PPO("MlpPolicy", envs, n_steps=256, batch_size=256, seed=SEED, device="cpu")
    model.learn(100_000)
    return from_flat(problem, lambda seen: model.predict(seen, deterministic=True)[0], normalize=True)


def rllib_ppo(problem: rddlc.Problem) -> Policy:
    import ray
    import torch
    from ray.rllib.algorithms.ppo import PPOConfig

    from rddlc import rllib

    torch.set_num_threads(1)  # its networks are small
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False, ignore_reinit_error=True)
    try:
        algorithm = (
            PPOConfig()
            .environment(rllib.NAME, env_config=rllib.env_config(*problem.files))
            .env_runners(num_env_runners=0, num_envs_per_env_runner=16)
            .training(train_batch_size_per_learner=4000, minibatch_size=250, num_epochs=10)
            .debugging(seed=SEED, log_level="ERROR")
            .build_algo()
        )
        for _ in range(25):
            algorithm.train()
        module = algorithm.get_module()
        algorithm.stop()
    finally:
        ray.shutdown()
    kind = module.get_inference_action_dist_cls()

    def act(seen: Any) -> Any:
        with torch.no_grad():
            outputs = module.forward_inference({"obs": torch.from_numpy(seen[np.newaxis])})
        return kind.from_logits(outputs["action_dist_inputs"]).to_deterministic().sample()[0].numpy()

    return from_flat(problem, act, normalize=True)


def scikit_decide_cgp(problem: rddlc.Problem) -> Policy:
    from skdecide.hub.solver.cgp import CGP

    from rddlc.skdecide import RDDLDomainSimplifiedSpaces

    with tempfile.TemporaryDirectory() as folder:
        factory = partial(RDDLDomainSimplifiedSpaces, problem, render_mode=None)
        solver = CGP(factory, folder_name=f"{folder}/cgp", n_it=25, verbose=False)
        solver.solve()
    return from_flat(problem, solver.sample_action)


def from_flat(problem: rddlc.Problem, act: Callable[[Any], Any], **forms: Any) -> Policy:
    """The policy of a learner that knows flat observations and a box of actions: the state is shown
    to it in an environment of that form."""
    flat = rddlc.make(problem, observations="flat", actions="box", **forms)
    flat.reset(seed=SEED)
    names = [name for fluent in problem.model.actions for name in fluent.groundings]

    def policy(env: rddlc.RDDLEnv) -> Any:
        seen, _ = flat.reset(options={"state": env.get_state()})
        numbers = np.asarray(act(seen), np.float64).ravel()
        bounds = [(env.action_space[name].low, env.action_space[name].high) for name in names]
        shares = (np.clip(numbers, -1, 1) + 1) / 2
        pairs = zip(names, bounds, shares)
        return {name: low + share * (high - low) for name, (low, high), share in pairs}

    return policy


LEARNERS: dict[str, Callable[[rddlc.Problem], Policy]] = {
    "random": at_random,
    "rddlc PPO": rddlc_ppo,
    "rddlc CGP": rddlc_cgp,
    "RLlib PPO": rllib_ppo,
    "Stable-Baselines3 PPO": stable_baselines3_ppo,
    "scikit-decide CGP": scikit_decide_cgp,
}
