#!/usr/bin/env python3
"""No-op, random actions, learners, planners and the optimum on many problems, side by side.

    benchmarks/solvers/compare_all.py --out results.jsonl                   all problems, first instance
    benchmarks/solvers/compare_all.py --out ippc2023.jsonl --context ippc2023 --without 0 --instances 5
    benchmarks/solvers/compare_all.py --out ippc2011.jsonl --context ippc2011 --only _MDP_ --instances 10
    benchmarks/solvers/compare_all.py --out results.jsonl --table           the table of what is there, and what it shows

It can be interrupted at any time: what is in the file already is not done again. --methods names what is played; a learner
trains for --seconds, a planner's decision simulates --steps. The learners' runs are kept in a folder beside the file, and
rollout improves the best policy that the file has by then. --prost FOLDER is PROST after its build.py, which plays against
`rddl serve` with --prost-seconds for each decision; --jax-python PYTHON has pyRDDLGym-jax, whose JaxPlan trains for --seconds
of processor time, once for each of --jax-kinds.
Times are of a processor, so that a busy machine says much the same. --check fails where the results miss the aims.
"""

import argparse
import json
import math
import os
import re
import resource
import signal
import subprocess
import sys
import tempfile
import time
from functools import partial
from pathlib import Path

from comparison_tables import COLUMNS, LEARNERS, PLANNERS, document, has_value, shortfalls
from sweep import ROOT, add_options, add_results, chosen_instances, read_results

sys.path.append(str(ROOT / "benchmarks"))

from document import write_section  # noqa: E402

METHODS = ("noop", "random", *LEARNERS, *PLANNERS, "optimum", "jaxplan", "prost")
assert set(METHODS) == set(COLUMNS)


class Failure(Exception):
    """A method cannot be had for a problem; its text says why."""


def run(words, seconds, folder=None):
    """What a program prints, and its seconds of processor time, children included.

    It has so many seconds of processor time. One that waits for ever is ended by the clock.
    """
    def limit_processor_time():
        resource.setrlimit(resource.RLIMIT_CPU, 2 * (math.ceil(seconds),))

    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as err:
        process = subprocess.Popen([str(word) for word in words], stdout=out, stderr=err, start_new_session=True, cwd=folder,
                                   preexec_fn=limit_processor_time)
        end = time.monotonic() + 20 * seconds + 60
        pid = 0
        try:
            while not pid:
                if time.monotonic() > end:
                    raise Failure(f"longer than {seconds:.0f} s")
                time.sleep(0.02)
                pid, status, usage = os.wait4(process.pid, os.WNOHANG)
        finally:  # also after Ctrl-C
            if not pid:
                os.killpg(process.pid, signal.SIGKILL)
                os.wait4(process.pid, 0)
                process.returncode = -signal.SIGKILL
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode in (-signal.SIGXCPU, -signal.SIGKILL) and usage.ru_utime + usage.ru_stime > 0.9 * seconds:
            raise Failure(f"longer than {seconds:.0f} s")
        out.seek(0)
        err.seek(0)
        if process.returncode != 0:
            lines = [line for line in err.read().splitlines() if line.strip()]
            raise Failure(next((line for line in lines if "error" in line), lines[-1] if lines else "failed"))
        return out.read(), usage.ru_utime + usage.ru_stime


def evaluated(policy, problem, arguments, training=0.0):
    printed, seconds = run([arguments.rddl, "evaluate", *problem, "--policy", policy, "--episodes", arguments.episodes,
                            "--seed", arguments.seed + 1000, "--threads", 1, "--json", "--cheat"], arguments.limit)
    of = json.loads(printed)["policies"][0]
    return {"mean": of["return"]["mean"], "half_width": of["return"]["half_width_95"], "episodes": of["episodes"],
            "decisions": of["steps"], "illegal": of["illegal_actions"], "seconds": seconds, "training_seconds": training}


def run_folder(solver, problem, arguments):
    """Where a learner's policy is kept."""
    return arguments.out.with_suffix(".runs") / "_".join((*problem, solver))


def trained(solver, folder, options, problem, arguments):
    _, seconds = run([arguments.rddl, "train", solver, *problem, "--out", folder, "--seed", arguments.seed, "--time",
                      arguments.seconds, "--memory-limit", "8G", "--quiet", *options], arguments.seconds + 600)
    return evaluated(folder, problem, arguments, seconds)


def learned(solver, problem, arguments):
    folder = run_folder(solver, problem, arguments)
    if solver != "drp":
        options = ["--steps", "1e12"] if solver == "ppo" else ["--gens", "100000000"]
        return trained(solver, folder, ["--threads", 1, *options], problem, arguments)
    # Which relaxation is better depends on the problem.
    folders = {kind: folder.with_name(f"{folder.name}_{kind}") for kind in ("soft", "exact")}
    results = {kind: trained(solver, of, ["--steps", "1e12", "--relax", kind], problem, arguments) for kind, of in folders.items()}
    best = max(results, key=lambda kind: results[kind]["mean"])
    folders[best].rename(folder)
    return results[best] | {"relax": best, "training_seconds": sum(of["training_seconds"] for of in results.values())}


def best_policy(problem, arguments):
    """The policy with the best return so far that roll-outs can follow."""
    name, instance = problem
    results = [result for result in read_results(arguments) if has_value(result) and
               (result["problem"], result["instance"]) == (name, instance)]
    policies = {"noop": "noop", "random": "random"} | {solver: run_folder(solver, problem, arguments) for solver in LEARNERS
                                                       if run_folder(solver, problem, arguments).exists()}
    best = max((result for result in results if result["method"] in policies), key=lambda result: result["mean"],
               default={"method": "random"})
    return best["method"], policies[best["method"]]


def planned(planner, problem, arguments):
    policy = f"plan:{planner},steps={arguments.steps}"
    result = {"steps": arguments.steps}
    if arguments.options:
        policy += f",{arguments.options}"
        result["options"] = arguments.options
    if planner == "rollout":
        result["policy"], base = best_policy(problem, arguments)
        policy += f",policy={base}"
    return evaluated(policy, problem, arguments) | result


def optimum(problem, arguments):
    printed, seconds = run([arguments.rddl, "solve", *problem, "--json", "--threads", 1, "--cheat"], arguments.limit)
    of = json.loads(printed)
    return {"mean": of["optimum"], "half_width": of["error"], "states": of["states"], "seconds": seconds}


def prost_session(arguments, problem, instance_name, rounds, seconds, engine="IPC2014"):
    """PROST plays rounds against `rddl serve`: what the server prints, what PROST prints, and its seconds of processor time."""
    with tempfile.TemporaryDirectory() as name_of_folder:
        work = Path(name_of_folder)
        (work / "rddl-parser-release").symlink_to(arguments.prost / "builds/release/rddl_parser/rddl-parser")
        with (work / "serve").open("w+") as log:
            server = subprocess.Popen([str(word) for word in (
                arguments.rddl, "serve", *problem, "--port", 0, "--rounds", rounds, "--time", seconds,
                "--seed", arguments.seed + 1000, "--sessions", 1)], stdout=log, stderr=subprocess.STDOUT)
            try:
                while " at " not in (said := (work / "serve").read_text()):
                    if server.poll() is not None:
                        raise Failure(said.strip())
                    time.sleep(0.05)
                port = said.rsplit(":", 1)[1].split()[0]
                management = "NONE" if " -t " in engine else "UNI"  # the engine has a time of its own, or PROST divides that of rounds
                printed, used = run([arguments.prost / "builds/release/search/search", instance_name, "-p", port,
                                     f"[PROST -s 1 -tm {management} -se [{engine}]]"], 2 * seconds + 300, folder=work)
                server.wait(10)
            finally:
                server.kill()
        return (work / "serve").read_text(), printed, used


def prost(problem, details, arguments):
    """PROST by the protocol of the competitions; its return is that which the server prints."""
    name, instance = problem
    folder = Path(details["folder"])
    text = (folder / f"instance{instance}.rddl").read_text()
    instance_name = re.search(r"\binstance\s+(\w+)", text)[1]
    horizon = int(re.search(r"\bhorizon\s*=\s*(\d+)", text)[1])
    seconds = arguments.episodes * horizon * arguments.prost_seconds
    said, _, used = prost_session(arguments, problem, instance_name, arguments.episodes, seconds)
    found = re.search(r"return (-?[\d.e+]+)(?: ± ([\d.e+]+))?", said)
    if not found:
        raise Failure(said.strip().splitlines()[-1])
    return {"mean": float(found[1]), "half_width": float(found[2] or 0), "episodes": arguments.episodes, "seconds": used}


def jaxplan(problem, arguments):
    printed, seconds = run([arguments.jax_python, Path(__file__).with_name("jaxplan.py"), *problem, "--seconds",
                            arguments.seconds, "--episodes", arguments.episodes, "--seed", arguments.seed,
                            "--kinds", *arguments.jax_kinds], len(arguments.jax_kinds) * arguments.seconds + arguments.limit)
    return json.loads(printed.splitlines()[-1]) | {"seconds": seconds}


def played(method, problem, details, arguments):
    if method in PLANNERS:
        return planned(method, problem, arguments)
    if method in LEARNERS:
        return learned(method, problem, arguments)
    if method == "optimum":
        return optimum(problem, arguments)
    if method == "prost":
        return prost(problem, details, arguments)
    if method == "jaxplan":
        return jaxplan(problem, arguments)
    return evaluated(method, problem, arguments)


def result_or_failure(arguments, job):
    method, name, instance, details = job
    result = {"problem": name, "instance": instance, "method": method}
    try:
        return result | played(method, (name, instance), details, arguments)
    except Failure as failure:
        return result | {"failure": str(failure)}


def jobs_of(problems, done, arguments):
    """What is to be done, method after method, so that every column grows from the top."""
    for method in arguments.methods:
        for problem, instance in chosen_instances(problems, arguments):
            if (problem["name"], instance, method) not in done:
                yield method, problem["name"], instance, problem


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    add_options(parser)
    parser.add_argument("--methods", nargs="*", default=METHODS[:-2], choices=METHODS)
    parser.add_argument("--episodes", type=int, default=10)
    parser.add_argument("--steps", type=int, default=20000, help="simulated steps of a planner's decision")
    parser.add_argument("--options", metavar="KEY=VALUE,...", help="further options of planners")
    parser.add_argument("--seconds", type=float, default=60, help="a learner's time")
    parser.add_argument("--limit", type=float, default=300, help="seconds of processor time after which a method is given up")
    parser.add_argument("--prost", type=Path, help="folder of PROST, after its build.py")
    parser.add_argument("--prost-seconds", type=float, default=0.05)
    parser.add_argument("--jax-python", type=Path, help="Python that has pyRDDLGym-jax")
    parser.add_argument("--jax-kinds", nargs="*", default=("slp", "drp"), help="straight-line plan and deep reactive policy")
    parser.add_argument("--write", metavar="NAME", help="put the table into that section of docs/results/planning.md")
    parser.add_argument("--check", action="store_true", help="fail where the results miss the aims")
    arguments = parser.parse_args()
    results = read_results(arguments)
    if arguments.table or arguments.write or arguments.check:
        if arguments.table:
            print(document(results))
        if arguments.write:
            write_section(arguments.write, document(results))
        missing = shortfalls(results) if arguments.check else []
        print(*missing, sep="\n", end="\n" if missing else "")
        return 1 if missing else 0
    if "prost" in arguments.methods and not arguments.prost:
        parser.error("--methods prost needs --prost FOLDER")
    if "jaxplan" in arguments.methods and not arguments.jax_python:
        parser.error("--methods jaxplan needs --jax-python PYTHON")
    done = {(result["problem"], result["instance"], result["method"]) for result in results}
    problems = json.loads(run([arguments.rddl, "list", "--json"], 600)[0])
    add_results(partial(result_or_failure, arguments), jobs_of(problems, done, arguments), arguments)
    return 0


if __name__ == "__main__":
    sys.exit(main())
