#!/usr/bin/env python3
"""The return of JaxPlan on an instance, as a line of JSON; run by a Python that has pyRDDLGym-jax and rddlrepository.

    PYTHON benchmarks/solvers/jaxplan.py HVAC_ippc2023 1 --seconds 45 --episodes 10

All configurations that pyRDDLGym-jax has for the problem are tried, a straight-line plan and a deep reactive policy, else its
default for a straight-line plan; each trains for its part of --seconds. The best counts. Returns are discounted by the
instance, as in JaxPlan's own evaluation.
"""

import argparse
import json
import statistics
import sys
from pathlib import Path

import pyRDDLGym
import pyRDDLGym_jax.examples
from pyRDDLGym_jax.core.planner import JaxBackpropPlanner, JaxOfflineController, load_config

T_95 = (12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262)  # quantiles of Student's distribution, from one degree on


def configurations(problem):
    folder = Path(pyRDDLGym_jax.examples.__file__).parent / "configs"
    tuned = [file for kind in ("slp", "drp") if (file := folder / f"{problem}_{kind}.cfg").exists()]
    return tuned or [folder / "default_slp.cfg"]


def evaluated(configuration, arguments, seconds):
    env = pyRDDLGym.make(arguments.problem, arguments.instance, vectorized=True)
    planner_options, _, training = load_config(str(configuration))
    planner_options.pop("dashboard", None)
    planner = JaxBackpropPlanner(rddl=env.model, **planner_options)
    controller = JaxOfflineController(planner, **training | {"train_seconds": seconds, "print_summary": False,
                                                             "print_progress": False})
    returns = [controller.evaluate(env, episodes=1, seed=arguments.seed + episode)["mean"]
               for episode in range(arguments.episodes)]
    error = statistics.stdev(returns) / len(returns) ** 0.5 * T_95[min(len(returns) - 2, len(T_95) - 1)] if len(returns) > 1 else 0
    return {"mean": float(statistics.mean(returns)), "half_width": float(error), "episodes": len(returns),
            "configuration": configuration.stem}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("problem")
    parser.add_argument("instance")
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--episodes", type=int, default=10)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    files = configurations(arguments.problem)
    print(json.dumps(max((evaluated(file, arguments, arguments.seconds / len(files)) for file in files),
                         key=lambda result: result["mean"])))


if __name__ == "__main__":
    sys.exit(main())
