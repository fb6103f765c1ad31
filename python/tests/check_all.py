"""Gymnasium's check_env on the first instance of every problem of rddlrepository, in each form:

    python python/tests/check_all.py [--engine interpreter] [--forms dict,vectorized,...] [PROBLEM ...]

Prints a line for each that fails, and how many pass. Warnings count as failures, but for advice
about bounds (unbounded fluents are unbounded). `--sb3` asks Stable-Baselines3's checker, too.
"""

from __future__ import annotations

import argparse
import sys
import traceback
import warnings
from collections.abc import Iterator

import gymnasium
from gymnasium.utils.env_checker import check_env

import rddlc

FORMS = {
    "dict": {},
    "vectorized": {"vectorized": True},
    "simplified": {"observations": "flat", "actions": "simplified"},
    "box": {"observations": "flat", "actions": "box", "normalize": True},
}

ADVICE = (
    "minimum value is -infinity",
    "maximum value is infinity",
    "maximum and minimum values are equal",
    "recommend using a symmetric and normalized space",
    "Not able to test alternative render modes",  # without a spec; they are tested here
)


def check(problem: rddlc.Problem, form: str, with_sb3: bool) -> Iterator[str]:
    """What is wrong with it."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        for render_mode in ("rgb_array", "ansi"):
            env = rddlc.make(problem, render_mode=render_mode, **FORMS[form])
            check_env(env, skip_close_check=False)
            env.close()
        if with_sb3 and form in ("simplified", "box"):
            from stable_baselines3.common.env_checker import check_env as check_sb3

            env = rddlc.make(problem, **FORMS[form])
            if not isinstance(env.action_space, gymnasium.spaces.Dict):
                check_sb3(env, warn=False)
    for warning in caught:
        text = str(warning.message)
        if not any(advice in text for advice in ADVICE):
            yield text


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problems", nargs="*", help="names; default: all")
    parser.add_argument("--engine", default="compiled", choices=("compiled", "interpreter"))
    parser.add_argument("--forms", default=",".join(FORMS), help="comma-separated")
    parser.add_argument("--sb3", action="store_true")
    options = parser.parse_args()
    passed = failed = 0
    for listed in rddlc.problems():
        if options.problems and listed.name not in options.problems:
            continue
        problem = rddlc.Problem(listed.name, listed.instances[0], engine=options.engine)
        for form in options.forms.split(","):
            try:
                complaints = sorted(set(check(problem, form, options.sb3)))
            except Exception as error:  # whatever a checker raises
                place = traceback.extract_tb(error.__traceback__)[-1]
                complaints = [f"{type(error).__name__}: {error} ({place.filename}:{place.lineno})"]
            passed, failed = passed + (not complaints), failed + bool(complaints)
            for complaint in complaints:
                print(f"{listed.name} {form}: {complaint}", flush=True)
    print(f"{passed} checks pass, {failed} fail")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
