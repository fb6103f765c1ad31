"""Gymnasium's check_env on the first instance of every problem of rddlrepository, in each form:

    python python/tests/check_all.py [--engine interpreter] [--forms dict,vectorized,...] [PROBLEM ...]

Prints a line for each that fails, and how many pass. Warnings count as failures, except advice
about bounds (unbounded fluents are unbounded). `--sb3` asks Stable-Baselines3's checker instead, about
`rddlc.sb3.make`, and reports how many problems have which actions there. `--legal` draws and steps 200 random actions
of each problem instead: they satisfy the preconditions, and take less than 2 ms of processor time to draw.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
import traceback
import warnings
from collections import Counter
from collections.abc import Iterator

from gymnasium.utils.env_checker import check_env

import rddlc

os.environ.setdefault("SDL_VIDEODRIVER", "dummy")  # The checker makes an environment with a window, too.

FORMS = {
    "dict": {},
    "vectorized": {"vectorized": True},
    "simplified": {"observations": "flat", "actions": "simplified"},
    "box": {"observations": "flat", "actions": "box", "normalize": True},
}

SB3, LEGAL = "sb3", "legal"  # in place of a form
DRAWS, MOST_SECONDS = 200, 0.002
sb3_actions: Counter[str] = Counter()

ADVICE = (
    "minimum value is -infinity",
    "maximum value is infinity",
    "maximum and minimum values are equal",
    "recommend using a symmetric and normalized space",
    "recommend you to use a symmetric and normalized Box action space",
    "Not able to test alternative render modes",  # without a spec; they are tested here
)


def check(problem: rddlc.Problem, form: str) -> Iterator[str]:
    """Returns the complaints about it."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        if form == SB3:
            check_with_sb3(problem)
        elif form == LEGAL:
            check_draws(problem)
        else:
            for render_mode in ("rgb_array", "ansi"):
                env = rddlc.make(problem, render_mode=render_mode, **FORMS[form])
                check_env(env, skip_close_check=False)
                env.close()
    for warning in caught:
        text = str(warning.message)
        if not any(advice in text for advice in ADVICE):
            yield text


def check_with_sb3(problem: rddlc.Problem) -> None:
    from stable_baselines3.common.env_checker import check_env as check_sb3

    from rddlc import sb3

    env = sb3.make(problem)
    simplified = rddlc.make(problem, actions="simplified").action_space
    is_simplified = env.action_space == simplified
    kind = type(simplified).__name__
    sb3_actions[kind if is_simplified else f"one Box, since simplified actions are {kind}"] += 1
    check_sb3(env)


def check_draws(problem: rddlc.Problem) -> None:
    env = rddlc.make(problem, enforce_action_constraints=True)
    env.reset(seed=1)
    env.action_space.seed(1)
    seconds = 0.0
    for _ in range(DRAWS):
        begin = time.thread_time()
        action = env.action_space.sample()
        seconds += time.thread_time() - begin
        *_, terminated, truncated, _ = env.step(action)  # refuses actions that are not legal
        if terminated or truncated:
            env.reset()
    if seconds / DRAWS > MOST_SECONDS:
        warnings.warn(f"a random action takes {seconds / DRAWS * 1e3:.2f} ms", stacklevel=1)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problems", nargs="*", help="names; default: all")
    parser.add_argument("--engine", default="compiled", choices=("compiled", "interpreter"))
    parser.add_argument("--forms", default=",".join(FORMS), help="comma-separated")
    parser.add_argument("--sb3", action="store_true", help="Stable-Baselines3's checker")
    parser.add_argument("--legal", action="store_true", help="random actions")
    options = parser.parse_args()
    forms = [SB3] if options.sb3 else [LEGAL] if options.legal else options.forms.split(",")
    passed = failed = 0
    for listed in rddlc.problems():
        if options.problems and listed.name not in options.problems:
            continue
        problem = rddlc.Problem(listed.name, listed.instances[0], engine=options.engine)
        for form in forms:
            try:
                complaints = sorted(set(check(problem, form)))
            except Exception as error:  # whatever a checker raises
                place = traceback.extract_tb(error.__traceback__)[-1]
                complaints = [f"{type(error).__name__}: {error} ({place.filename}:{place.lineno})"]
            passed, failed = passed + (not complaints), failed + bool(complaints)
            for complaint in complaints:
                print(f"{listed.name} {form}: {complaint}", flush=True)
    print(f"{passed} checks pass, {failed} fail")
    for actions, count in sb3_actions.items():
        print(f"{count} with {actions}")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
