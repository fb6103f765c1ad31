"""Writes sb3_updates.json: networks before and after updates by Stable-Baselines3's PPO, and the batches.

    pip install stable-baselines3 && python record_sb3_updates.py

The test Ppo.UpdatesAsStableBaselines3Does makes the same updates of the same weights and batches.
"""

import json
from pathlib import Path

import gymnasium as gym
import numpy as np
import torch
from stable_baselines3 import PPO
from stable_baselines3.common.logger import configure

SAMPLES, EPOCHS, HIDDEN, RATE, ENTROPY = 48, 3, [12, 9], 3e-4 * 10, 0.01


class Nothing(gym.Env):
    def __init__(self, action_space):
        self.observation_space = gym.spaces.Box(-10, 10, (3,), np.float32)
        self.action_space = action_space

    def reset(self, *, seed=None, options=None):
        return np.zeros(3, np.float32), {}

    def step(self, action):
        return np.zeros(3, np.float32), 0.0, False, False, {}


def numbers(tensor):
    return [float(f"{x:.9g}") for x in tensor.detach().numpy().ravel()]


def layer(linear):
    return {"weights": [numbers(row) for row in linear.weight], "bias": numbers(linear.bias)}


def weights(policy):
    def layers(hidden, last):
        return [layer(m) for m in hidden if isinstance(m, torch.nn.Linear)] + [layer(last)]
    extractor = policy.mlp_extractor
    return {"policy": layers(extractor.policy_net, policy.action_net),
            "value": layers(extractor.value_net, policy.value_net),
            "log_std": numbers(policy.log_std) if hasattr(policy, "log_std") else []}


def update(action_space, reals, categories):
    torch.manual_seed(1)
    random = np.random.default_rng(2)
    model = PPO("MlpPolicy", Nothing(action_space), n_steps=SAMPLES, batch_size=SAMPLES, n_epochs=EPOCHS,
                learning_rate=RATE, ent_coef=ENTROPY, device="cpu",
                policy_kwargs={"net_arch": {"pi": HIDDEN, "vf": HIDDEN}})
    model.set_logger(configure(None, []))
    with torch.no_grad():  # not so near to 0 that all actions are alike
        model.policy.action_net.weight.mul_(50)
        for parameter in model.policy.parameters():
            parameter.copy_(torch.tensor(numbers(parameter)).reshape(parameter.shape))
    before = weights(model.policy)
    observations = random.normal(size=(SAMPLES, 3)).astype(np.float32)
    if reals:
        actions = random.normal(size=(SAMPLES, reals)).astype(np.float32)
    else:
        actions = np.stack([random.integers(0, n, SAMPLES) for n in categories], 1).astype(np.float32)
    with torch.no_grad():
        values, log_probabilities, _ = model.policy.evaluate_actions(
            torch.tensor(observations), torch.tensor(actions))
    # Log-probabilities of a policy that is a little different, so that some ratios are clipped.
    log_probabilities = log_probabilities.numpy() + random.normal(0, 0.2, SAMPLES).astype(np.float32)
    values = values.numpy().ravel()
    advantages = random.normal(size=SAMPLES).astype(np.float32)
    returns = advantages + values

    buffer = model.rollout_buffer
    buffer.reset()
    for name, array in (("observations", observations), ("actions", actions), ("values", values),
                        ("log_probs", log_probabilities), ("advantages", advantages), ("returns", returns)):
        getattr(buffer, name)[...] = array.reshape(getattr(buffer, name).shape)
    buffer.pos, buffer.full = SAMPLES, True
    model._current_progress_remaining = 1.0
    model.train()
    return {"reals": reals, "categories": categories, "hidden": HIDDEN, "epochs": EPOCHS, "learning_rate": RATE,
            "entropy": ENTROPY, "before": before, "after": weights(model.policy),
            "observations": observations.tolist(), "actions": actions.tolist(), "values": values.tolist(),
            "log_probabilities": log_probabilities.tolist(), "advantages": advantages.tolist(),
            "returns": returns.tolist()}


if __name__ == "__main__":
    updates = [update(gym.spaces.Box(-1, 1, (2,), np.float32), 2, []),
               update(gym.spaces.MultiDiscrete([3, 2]), 0, [3, 2])]
    Path(__file__).with_name("sb3_updates.json").write_text(json.dumps(updates) + "\n")
