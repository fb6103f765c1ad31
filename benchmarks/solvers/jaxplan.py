#!/usr/bin/env python3
"""The return of JaxPlan on an instance, as a line of JSON; run by a Python that has pyRDDLGym-jax and rddlrepository.

    PYTHON benchmarks/solvers/jaxplan.py HVAC_ippc2023 1 --seconds 45 --episodes 10

A straight-line plan (slp) and a deep reactive policy (drp) train for --seconds each, by the configuration that pyRDDLGym-jax
has for the problem, else by its default. The better one counts. The seconds are processor time of this process, whose
computations run on one thread, so that a busy machine gives the same training. Compiling is included. Returns are not
discounted, like those of the other methods.
"""

import argparse
import json
import os
import resource
import statistics
import sys
import time
from collections import Counter
from pathlib import Path
from types import SimpleNamespace

# Both are read when JAX starts.
os.environ |= {"NPROC": "1", "XLA_FLAGS": "--xla_cpu_multi_thread_eigen=false"}

import pyRDDLGym  # noqa: E402
import pyRDDLGym_jax.core.planner  # noqa: E402
import pyRDDLGym_jax.examples  # noqa: E402
from pyRDDLGym_jax.core.planner import JaxBackpropPlanner, JaxOfflineController, load_config  # noqa: E402

sys.path.append(str(Path(__file__).resolve().parents[2] / "tests/conformance"))

from problems import repository_cases  # noqa: E402

# The optimizer asks this clock whether its seconds have passed, and how far its schedules are.
pyRDDLGym_jax.core.planner.time = SimpleNamespace(time=time.process_time)

KINDS = ("slp", "drp")
NO_LIMIT = 1_000_000_000
T_95 = (12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262)  # quantiles of Student's distribution, from one degree on


def configuration_of(problem, kind):
    """The file for the problem, whose name it has with other capitals now and then, else the default."""
    folder = Path(pyRDDLGym_jax.examples.__file__).parent / "configs"
    name = f"{problem}_{kind}.cfg".lower()
    return next((path for path in folder.iterdir() if path.name.lower() == name), folder / f"default_{kind}.cfg")


def count_illegal_steps(env):
    """Counts the steps whose actions break preconditions. pyRDDLGym plays them all the same."""
    check = env.sampler.check_action_preconditions
    counted = Counter()

    def count(actions, silent):
        counted["illegal"] += not check(actions, silent=True)

    env.sampler.check_action_preconditions = count
    env.enforce_action_constraints = True
    return counted


def case_of(problem, instance):
    """By its files: rddlrepository does not know all of its problems by name."""
    cases = {case.instance: case for case in repository_cases(problem)}
    if instance not in cases:
        sys.exit(f"jaxplan.py: error: {problem} has no instance {instance}; it has {', '.join(cases) or 'none'}")
    return cases[instance]


def evaluated(configuration, arguments):
    case = case_of(arguments.problem, arguments.instance)
    env = pyRDDLGym.make(str(case.domain_path), str(case.instance_path), vectorized=True)
    steps = count_illegal_steps(env)
    env.discount = 1  # of the evaluation; the planner has that of the instance
    begin = time.process_time()
    planner_options, _, training = load_config(str(configuration))
    planner_options.pop("dashboard", None)
    planner = JaxBackpropPlanner(rddl=env.model, **planner_options)
    controller = JaxOfflineController(planner, **training | {"train_seconds": arguments.seconds, "epochs": NO_LIMIT,
                                                             "print_summary": False, "print_progress": False})
    trained = time.process_time() - begin
    returns = [controller.evaluate(env, episodes=1, seed=arguments.seed + episode)["mean"]
               for episode in range(arguments.episodes)]
    error = statistics.stdev(returns) / len(returns) ** 0.5 * T_95[min(len(returns) - 2, len(T_95) - 1)] if len(returns) > 1 else 0
    return {"mean": float(statistics.mean(returns)), "half_width": float(error), "episodes": len(returns),
            "illegal_steps": steps["illegal"], "configuration": configuration.stem, "gradients": controller.callback["iteration"] + 1,
            "training_seconds": trained}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("problem")
    parser.add_argument("instance")
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--kinds", nargs="*", default=KINDS, choices=KINDS)
    parser.add_argument("--memory-gigabytes", type=int, default=8)
    parser.add_argument("--episodes", type=int, default=10)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_DATA, 2 * (arguments.memory_gigabytes << 30,))
    print(json.dumps(max((evaluated(configuration_of(arguments.problem, kind), arguments) for kind in arguments.kinds),
                         key=lambda result: result["mean"])))


if __name__ == "__main__":
    sys.exit(main())
