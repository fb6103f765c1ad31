#!/usr/bin/env python3
"""Simulated steps a second inside each planner, beside those of the engine's batch: processor time counts, on one core.

    benchmarks/solvers/planner_speed.py [--rddl PROGRAM] [--repetitions 3] [--only uct] [--write]
    benchmarks/solvers/planner_speed.py --prost FOLDER [--instances 1 5 10] [--only SysAdmin] [--write]

Steps are those that the planner reports (--explain-decisions). The time is that of decisions with many steps less that of decisions
with few, in some episodes, since plans of one episode may end early more often than those of another; the best of some repetitions
counts. The engine's batch has as many environments as those of planners: a larger one reads its random actions from memory that other
programs also use, and is up to 1.5 times as slow where they do. --prost FOLDER, which is PROST after its build.py, compares trials of
plan:uct with those of PROST instead: decisions of the same seconds, both on one thread, counted by processor time. --write puts the
table into docs/planning.md, beside the rows and columns there that were not measured.
"""

import argparse
import json
import re
import resource
import subprocess
import tempfile
from pathlib import Path

from compare_all import prost_session
from document import markdown_table, merged_rows, write_section

ROOT = Path(__file__).resolve().parents[2]
DISCRETE = ["Elevators_MDP_ippc2011", "GameOfLife_MDP_ippc2011", "SysAdmin_MDP_ippc2011"]
REAL = ["HVAC_ippc2023", "UAV_ippc2023", "Reservoir_ippc2023"]
PLANNERS = [
    ("plan:cem", DISCRETE + REAL),
    ("plan:rollout,policy=noop", DISCRETE + REAL),
    ("plan:rollout,policy=random", DISCRETE + REAL),
    ("plan:uct", DISCRETE),
    ("plan:gradient", REAL),
]
IPPC_2011 = ["CooperativeRecon", "CrossingTraffic", "Elevators", "GameOfLife", "Navigation", "SkillTeaching", "SysAdmin",
             "Traffic_CTM"]
SECONDS = 0.05, 0.25  # of a decision, beside PROST
HORIZON = 40
EPISODES = 20
BATCH = 256
FEW, MANY = 5_000, 45_000


def processor_seconds(words):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([str(w) for w in words], check=True, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def engine_rate(rddl, problem, repetitions):
    """Steps of the faster way to step a batch."""
    def measurements():
        words = [rddl, "bench", problem, "1", "--threads", "1", "--batch", BATCH, "--seconds", "0.3", "--json"]
        return json.loads(subprocess.run([str(w) for w in words], check=True, capture_output=True, text=True).stdout)["measurements"]

    return max(each["steps"] / each["processor_seconds"] for _ in range(repetitions) for each in measurements())


def played(rddl, problem, policy, episodes=1):
    """Processor seconds of episodes, and the sums of trials and steps of its decisions."""
    with tempfile.TemporaryDirectory() as folder:
        thoughts = Path(folder) / "thoughts.jsonl"
        seconds = processor_seconds([rddl, "evaluate", *problem, "--policy", policy, "--episodes", episodes, "--horizon", HORIZON,
                                     "--threads", "1", "--engine", "compiled", "--explain-decisions", thoughts])
        decisions = [json.loads(line) for line in thoughts.read_text().splitlines()]
        return seconds, *(sum(decision[counted] for decision in decisions) for counted in ("iterations", "steps"))


def planner_rate(rddl, problem, planner, repetitions):
    few, many = (min(played(rddl, (problem, "1"), f"{planner},steps={steps}", EPISODES) for _ in range(repetitions))
                 for steps in (FEW, MANY))
    return (many[2] - few[2]) / (many[0] - few[0])


def steps_table(arguments):
    engine, shares = {}, {}
    planners = [(planner, problems) for planner, problems in PLANNERS if arguments.only in planner]
    for planner, problems in planners:
        for problem in problems:
            engine.setdefault(problem, engine_rate(arguments.rddl, problem, arguments.repetitions))
            rate = planner_rate(arguments.rddl, problem, planner, arguments.repetitions)
            shares[problem, planner] = f"{rate / 1e6:.3g} M ({100 * rate / engine[problem]:.2g} %)"
            print(problem, planner, shares[problem, planner], sep="  ", flush=True)
    rows = [(f"{problem} 1", *(shares.get((problem, planner), "") for planner, _ in planners)) for problem in engine]
    return [("problem", *(f"`{planner}`" for planner, _ in planners)), *rows]


def trial_rate(few, many):
    """Trials a second of processor time; None where a search ends early, so that more time has no more trials."""
    return (many[1] - few[1]) / (many[0] - few[0]) if many[1] > 1.5 * few[1] else None


def played_by_prost(arguments, problem, seconds):
    """As played(), without steps, which PROST does not report."""
    described = subprocess.run([str(arguments.rddl), "info", *problem, "--json"], check=True, capture_output=True, text=True).stdout
    name = json.loads(described)["instance"]
    _, printed, used = prost_session(arguments, problem, name, 1, 2 * HORIZON * seconds, f"IPC2014 -t {seconds}")
    return used, sum(int(count) for count in re.findall(r"Performed trials: (\d+)", printed))


def trials_table(arguments):
    def text(rate):
        return f"{rate / 1e3:,.{0 if rate > 1e5 else 1}f} k" if rate else ""

    rows = [("problem (IPPC 2011)", "steps of a trial", "`plan:uct`", "PROST", "ratio")]
    for domain in IPPC_2011:
        for instance in arguments.instances:
            problem = f"{domain}_MDP_ippc2011", instance
            if arguments.only not in problem[0]:
                continue
            played(arguments.rddl, problem, "plan:uct,steps=1")  # compiles the simulator
            ours = [played(arguments.rddl, problem, f"plan:uct,plans=no,seconds={seconds}") for seconds in SECONDS]
            theirs = [played_by_prost(arguments, problem, seconds) for seconds in SECONDS]
            rates = trial_rate(*ours), trial_rate(*theirs)
            ratio = f"{rates[0] / rates[1]:.1f}" if all(rates) else ""
            rows.append((f"{domain} {instance}", f"{ours[1][2] / ours[1][1]:.1f}", *map(text, rates), ratio))
            print(*rows[-1], sep="  ", flush=True)
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rddl", type=Path, default=ROOT / "build/bin/rddl")
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--only", default="", help="a part of the planner's name; with --prost, of the domain's")
    parser.add_argument("--prost", type=Path, help="folder of PROST, after its build.py")
    parser.add_argument("--instances", nargs="+", default=["1", "5", "10"], help="beside PROST")
    parser.add_argument("--write", action="store_true", help="put the table into docs/planning.md")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    if options.prost:
        name, rows = "trials", trials_table(options)
    else:
        name, rows = "steps of planners", steps_table(options)
    if options.write:
        write_section(name, markdown_table(merged_rows(name, rows)))
    else:
        print(markdown_table(rows))


if __name__ == "__main__":
    main()
