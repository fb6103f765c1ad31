"""The tutorial of ICAPS 2024, "Implementing a scikit-decide domain for RDDL problems", with rddlc: list problems, make
a mountain car, inspect it, solve it with five learners, and compare.

    pip install . -r python/examples/requirements.txt
    python python/examples/mountain_car.py [FOLDER]

Movies of all policies go into the folder (mountain_car/). Learners whose package is not installed are
left out.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

from learners import LEARNERS, SEED, Policy

import rddlc

NAME, INSTANCE = "MountainCar_ippc2023", "1"


def list_problems() -> None:
    problems = rddlc.problems()
    instances = sum(len(problem.instances) for problem in problems)
    print(f"{len(problems)} problems with {instances} instances, such as")
    for problem in problems[:3]:
        print(f"  {problem.name}: {problem.description}")


def look_at(env: rddlc.RDDLEnv) -> None:
    print(f"\n{env.problem.name}: {env.model.domain}, {env.horizon} steps, discount {env.discount}")
    print(f"  observes {env.observation_space}")
    print(f"  acts by  {env.action_space}\n")


def play(env: rddlc.RDDLEnv, policy: Policy, movie: Path) -> tuple[float, int, str]:
    """Return, steps, and why the episode ended."""
    env.reset(seed=SEED)
    total, over, info = 0.0, False, {}
    while not over:
        _, reward, terminated, truncated, info = env.step(policy(env))
        total, over = total + reward, terminated or truncated
    env.save_gif(movie)
    return total, env.timestep, info["cause"]


def main() -> None:
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else "mountain_car")
    folder.mkdir(parents=True, exist_ok=True)
    list_problems()
    env = rddlc.make(NAME, INSTANCE, render_mode="rgb_array")
    look_at(env)
    env.action_space.seed(SEED)

    rows = []
    for name, learn in LEARNERS.items():
        begin = time.perf_counter()
        try:
            policy = learn(env.problem)
        except ImportError as missing:
            rows.append(f"{name:24}  left out: {missing}")
            continue
        seconds = time.perf_counter() - begin
        movie = folder / f"{name.lower().replace(' ', '_')}.gif"
        total, steps, cause = play(env, policy, movie)
        rows.append(f"{name:24}{total:10.2f}{steps:8}{seconds:10.1f} s  {cause}")
    print(f"\n{'policy':24}{'return':>10}{'steps':>8}{'learned in':>12}  ended by")
    print("\n".join(rows))
    print(f"\nmovies in {folder}/")


if __name__ == "__main__":
    main()
