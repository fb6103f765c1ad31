"""The tutorial of ICAPS 2024, "Implementing a scikit-decide domain for RDDL problems", with rddlc: list
problems, make a mountain car, look at it, solve it in two ways, and compare.

    pip install . rddlrepository
    python python/examples/mountain_car.py [FOLDER]

Movies of all policies go into the folder (mountain_car/).
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import rddlc

NAME, INSTANCE = "MountainCar_ippc2023", "1"
SEED = 7

Policy = Callable[[rddlc.RDDLEnv], Any]


def list_problems() -> None:
    problems = rddlc.problems()
    instances = sum(len(problem.instances) for problem in problems)
    print(f"{len(problems)} problems with {instances} instances, such as")
    for problem in problems[:3]:
        print(f"  {problem.name}: {problem.description}")


def look_at(env: rddlc.RDDLEnv) -> None:
    print(f"\n{env.problem.name}: {env.model.domain}, {env.horizon} steps, discount {env.discount}")
    print(f"  observes {env.observation_space}")
    print(f"  acts by  {env.action_space}")


def play(env: rddlc.RDDLEnv, policy: Policy, movie: Path) -> tuple[float, int, str]:
    """Return, steps, and why the episode ended."""
    env.reset(seed=SEED)
    total, info = 0.0, {}
    while not info:
        _, reward, _, _, info = env.step(policy(env))
        total += reward
    env.save_gif(movie)
    return total, env.timestep, info["cause"]


def learned(model: rddlc.Learner, amount: int) -> tuple[Policy, float]:
    """The policy, and the seconds that it took."""
    begin = time.perf_counter()
    model.learn(amount)
    return lambda env: model.predict(env)[0], time.perf_counter() - begin


def main() -> None:
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else "mountain_car")
    folder.mkdir(parents=True, exist_ok=True)
    list_problems()
    env = rddlc.make(NAME, INSTANCE, render_mode="rgb_array")
    look_at(env)
    env.action_space.seed(SEED)

    cgp = rddlc.CGP(env, seed=SEED)
    policies: dict[str, tuple[Policy, float]] = {
        "random": (lambda env: env.action_space.sample(), 0.0),
        "PPO": learned(rddlc.PPO(env, seed=SEED), 400_000),
        "CGP": learned(cgp, 25),
    }
    print(f"\nCGP found\n  {cgp}\n".replace("\n", "\n  ").rstrip())
    print(f"\n{'policy':10}{'return':>10}{'steps':>8}{'learned in':>12}  ended by")
    for name, (policy, seconds) in policies.items():
        total, steps, cause = play(env, policy, folder / f"{name.lower()}.gif")
        print(f"{name:10}{total:10.2f}{steps:8}{seconds:10.1f} s  {cause}")
    print(f"\nmovies in {folder}/")


if __name__ == "__main__":
    main()
