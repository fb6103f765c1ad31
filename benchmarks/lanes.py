"""How many environments a pack should hold, problem by problem, against the number that rddlc chooses.

    .venv/bin/python benchmarks/lanes.py             half an hour, most of it for compiling
    .venv/bin/python benchmarks/lanes.py --require   and fail if a choice loses
    .venv/bin/python benchmarks/lanes.py --write     and docs/lanes.md

Batches of 1,024 environments, one thread, by `rddl bench --lanes`. The numbers that rddlc chooses from take
turns; the times are those of the processor, medians of the rounds. What is measured is kept in a file, and only
what is missing there is measured again (--fresh: all).

Limit: choices take less than 1.05 times as long as the best number in the geometric mean, and none more than 1.6
times.
"""

import argparse
import re
import statistics
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from bench import Results, bench, geometric_mean
from document import ROOT, machine_text, markdown_table, write_section

sys.path.append(str(ROOT / "tests/conformance"))

from problems import repository_cases  # noqa: E402

NUMBERS = (16, 64)  # ir::suitable_lane_counts
MOST_LOSS, MOST_MEAN_LOSS = 1.6, 1.05
PROBLEMS = {
    "AcademicAdvising_MDP_ippc2014": "10",
    "Acrobot_gym": "0",
    "BinPacking_or": "0",
    "CartPole_Continuous_gym": "0",
    "CooperativeRecon_MDP_ippc2011": "5",
    "CrossingTraffic_MDP_ippc2014": "10",
    "CrossingTraffic_POMDP_ippc2014": "5",
    "EarthObservation_ippc2018": "1",
    "Elevators_MDP_ippc2014": "10",
    "Elevators_POMDP_ippc2011": "5",
    "Epidemic": "0",
    "GameOfLife_MDP_ippc2011": "10",
    "GameOfLife_POMDP_ippc2011": "5",
    "HVAC_ippc2023": "3",
    "Intruders_Discrete": "0",
    "Knapsack_or": "0",
    "Logistics_rddlsim": "0",
    "MarsRover_ippc2023": "3",
    "MountainCar_ippc2023": "1",
    "Navigation_MDP_ippc2011": "10",
    "Pizza_rddlsim": "0",
    "PowerGen_ippc2023": "5",
    "RaceCar_ippc2023": "3",
    "RecSim_ippc2023": "1",
    "Reservoir_ippc2023": "5",
    "SkillTeaching_MDP_ippc2014": "10",
    "SupplyChain_or": "0",
    "SysAdmin_MDP_ippc2011": "10",
    "SysAdmin_POMDP_ippc2011": "5",
    "TSP_or": "0",
    "Tamarisk_MDP_ippc2014": "10",
    "Traffic_MDP_ippc2014": "10",
    "Traffic_CTM_POMDP_ippc2011": "5",
    "TriangleTireworld_MDP_ippc2014": "5",
    "UAV_ippc2023": "3",
    "Wildfire_MDP_ippc2014": "10",
    "Wildfire_POMDP_ippc2014": "5",
}


@dataclass
class Speed:
    """Nanoseconds of a step of one environment in packs of so many, round by round."""

    problem: str
    lanes: int
    nanoseconds: list[float]

    @property
    def median(self) -> float:
        return statistics.median(self.nanoseconds)


def measure(problem: str, lanes: int, options: argparse.Namespace) -> float:
    arguments = [problem, PROBLEMS[problem], "--lanes", lanes, "--threads", 1, "--seconds", options.seconds]
    (packs,) = [m for m in bench(options.build / "bin/rddl", *arguments)["measurements"] if m["lanes"] == lanes]
    return packs["processor_seconds"] / packs["steps"] * 1e9


def chosen(problem: str, options: argparse.Namespace) -> int:
    """The number in the text that rddlc makes."""
    (case,) = [case for case in repository_cases(problem) if case.instance == PROBLEMS[problem]]
    command = [options.build / "bin/rddlc", "-w", case.domain_path, case.instance_path]
    text = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=True).stdout
    return int(re.search(r"rddl::Packed<[^;]*, (\d+)(?:, float)?>", text).group(1))


@dataclass
class Choice:
    problem: str
    nanoseconds: dict[int, float]  # by the number of lanes
    chosen: int

    @property
    def loss(self) -> float:
        return self.nanoseconds[self.chosen] / min(self.nanoseconds.values())

    @property
    def columns(self) -> tuple[str, ...]:
        times = (f"{self.nanoseconds[number]:,.1f}" for number in NUMBERS)
        gain = self.nanoseconds[16] / self.nanoseconds[64]
        return (f"{self.problem} {PROBLEMS[self.problem]}", *times, f"{gain:.2f}", str(self.chosen), f"{self.loss:.2f}")


TITLES = ("instance", *(f"{number} lanes, ns" for number in NUMBERS), "gain of 64", "chosen", "loss")


def choice_of(problem: str, known: Results, options: argparse.Namespace) -> Choice:
    missing = [number for number in NUMBERS if f"{problem} {number}" not in known.entries]
    rounds = [{number: measure(problem, number, options) for number in missing} for _ in range(options.rounds)]
    for number in missing:
        known.add(Speed(problem, number, [times[number] for times in rounds]))
    times = {number: known.entries[f"{problem} {number}"].median for number in NUMBERS}
    return Choice(problem, times, chosen(problem, options))


def complaints(choices: list[Choice]) -> list[str]:
    mean = geometric_mean([choice.loss for choice in choices])
    lines = [
        f"{choice.problem}: {choice.chosen} lanes take {choice.loss:.2f} times as long as the best number"
        for choice in choices
        if choice.loss > MOST_LOSS
    ]
    return [*lines, f"the mean loss is {mean:.3f}"] if mean > MOST_MEAN_LOSS else lines


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problems", nargs="*", help="some of the problems")
    parser.add_argument("--build", type=Path, default=ROOT / "build", help="our build")
    parser.add_argument("--seconds", type=float, default=0.4, help="of each measurement")
    parser.add_argument("--rounds", type=int, default=3, help="turns of each number")
    default = ROOT / "build/benchmarks/lanes.jsonl"
    parser.add_argument("--results", type=Path, default=default, help="file for the figures")
    parser.add_argument("--fresh", action="store_true", help="measure all again")
    parser.add_argument("--require", action="store_true", help="fail if a choice loses")
    parser.add_argument("--write", action="store_true", help="write docs/lanes.md")
    return parser.parse_args()


def main() -> int:
    options = parse_arguments()
    known = Results(options.results, options.fresh, Speed, lambda speed: f"{speed.problem} {speed.lanes}")
    choices = []
    for problem in options.problems or PROBLEMS:
        choices.append(choice_of(problem, known, options))
        print(*(cell.rjust(12) for cell in choices[-1].columns), flush=True)
    wrong = complaints(choices)
    print("", *wrong, sep="\n")
    if options.write:
        table = markdown_table([TITLES, *(choice.columns for choice in choices)])
        write_section("lanes", f"{machine_text()}:\n\n{table}")
    return 1 if wrong and options.require else 0


if __name__ == "__main__":
    sys.exit(main())
