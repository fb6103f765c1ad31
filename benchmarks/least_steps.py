"""The least time that a step can take: kernels written by hand, of the work that its values need.

    .venv/bin/python benchmarks/least_steps.py                  some minutes
    .venv/bin/python benchmarks/least_steps.py Pendulum_gym     some problems
    .venv/bin/python benchmarks/least_steps.py --write          and docs/benchmarks.md

benchmarks/least_steps/ holds the kernels: the state after a step and its reward, for 16 environments in
registers. They neither check actions nor end episodes nor begin new ones; states and actions stand in the
nearest cache, as numbers of the type that is computed with. Each is compared with the emitted simulator along
300 steps of 128 environments; all values must be the same.

A simulator with our values cannot be quicker, so where a kernel takes longer than a tenth of jax's time on the same
machine, no such simulator is 10 times as fast. jax's times are those of docs/results/benchmarks.md
(benchmarks/compare_jax.py), which must have been measured on this machine.
"""

import argparse
import json
import os
import sys
from dataclasses import dataclass
from pathlib import Path

from compare_jax import documented_comparisons
from document import ROOT, machine_text, markdown_table, merged_rows, write_section
from handwritten import FLAGS, INLINING, LINKING, build_batches, build_measuring_program, build_simulator, run

FOLDER = ROOT / "benchmarks/least_steps"


@dataclass(frozen=True)
class Kernel:
    """A file of FOLDER and its struct, and the instance that it is written for."""

    instance: str
    header: str
    struct: str


KERNELS = {
    "Acrobot_gym": Kernel("0", "acrobot", "Acrobot"),
    "Bicycle_physics": Kernel("0", "bicycle", "Bicycle"),
    "CartPole_Continuous_gym": Kernel("0", "cart_pole", "ContinuousCartPole"),
    "CartPole_Discrete_gym": Kernel("0", "cart_pole", "DiscreteCartPole"),
    "Epidemic": Kernel("0", "epidemic", "Epidemic"),
    "MarsRover_ippc2023": Kernel("3", "mars_rover", "MarsRover"),
    "MountainCar_Continuous_gym": Kernel("0", "mountain_car", "ContinuousMountainCar"),
    "MountainCar_Discrete_gym": Kernel("0", "mountain_car", "DiscreteMountainCar"),
    "Navigation_Continuous": Kernel("0", "navigation", "Navigation"),
    "Option_or": Kernel("1", "option", "Option"),
    "Pendulum_gym": Kernel("0", "pendulum", "Pendulum"),
    "PowerGen_ippc2023": Kernel("3", "power_gen", "PowerGen"),
    "Reacher_physics": Kernel("1", "reacher", "Reacher"),
    "Reservoir_Continuous": Kernel("1", "reservoir", "SmallContinuousReservoirs"),
    "Reservoir_Discrete": Kernel("1", "reservoir", "SmallDiscreteReservoirs"),
    "Reservoir_ippc2023": Kernel("3", "reservoir", "IppcReservoirs"),
    "UAV_Continuous": Kernel("1", "uav", "OneSteeredAircraft"),
    "UAV_ippc2023": Kernel("3", "uav", "TwoSteeredAircraft"),
    "Zombies_arcade": Kernel("2", "zombies", "Zombies"),
}
REALS = {"float": ["--real=float"], "double": []}


@dataclass
class Least:
    """Nanoseconds of a step for one environment of a batch."""

    kernel: float
    step: float
    compared: int  # values that are the same


def build_kernel(problem: str, real: str, options: argparse.Namespace) -> Path:
    kernel = KERNELS[problem]
    library = options.folder / f"{problem}.{real}.kernel.so"
    what = ["-include", FOLDER / f"{kernel.header}.hpp", f"-DPROBLEM={kernel.struct}", f"-DREAL={real}"]
    run([options.cxx, *FLAGS, *INLINING, *LINKING, *what, f"-I{ROOT / 'runtime'}", FOLDER / "kernel.cpp", "-o", library])
    return library


def measure(problem: str, real: str, program: Path, options: argparse.Namespace) -> Least:
    simulator = build_simulator(problem, KERNELS[problem].instance, REALS[real], options, real)
    kernel = build_kernel(problem, real, options)
    return Least(**json.loads(run([program, simulator, kernel, options.seconds])))


def tenths_of_jax() -> dict[str, float]:
    """By instance: nanoseconds."""
    return {c.label: 1e8 / c.jax for c in documented_comparisons("")}


COLUMNS = ("instance", "a tenth of jax's", "kernel, floats", "step, floats", "kernel, doubles", "step, doubles")


def row_of(problem: str, tenths: dict[str, float], floats: Least, doubles: Least) -> tuple[str, ...]:
    label = f"{problem} {KERNELS[problem].instance}"
    figures = (tenths[label], floats.kernel, floats.step, doubles.kernel, doubles.step)
    return (label, *(f"{value:.1f}" for value in figures))


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problems", nargs="*", help="some of the kernels")
    parser.add_argument("--build", type=Path, default=ROOT / "build", help="our build")
    parser.add_argument("--cxx", default=os.environ.get("CXX", "c++"), help="the C++ compiler")
    parser.add_argument("--folder", type=Path, default=ROOT / "build/benchmarks/least_steps", help="to work in")
    parser.add_argument("--seconds", type=float, default=0.5, help="of each measurement")
    parser.add_argument("--write", action="store_true", help="write docs/benchmarks.md; of named problems, their rows")
    options = parser.parse_args()
    for problem in options.problems:
        if problem not in KERNELS:
            parser.error(f"there is no kernel of '{problem}'; there are {', '.join(KERNELS)}")
    return options


def main() -> int:
    options = parse_arguments()
    program = build_measuring_program(FOLDER / "main.cpp", options.folder / "least_steps", options)
    for real in REALS:
        build_batches(options, real)
    tenths = tenths_of_jax()
    rows = [COLUMNS]
    print(markdown_table(rows), flush=True)
    for problem in options.problems or KERNELS:
        floats, doubles = (measure(problem, real, program, options) for real in REALS)
        rows.append(row_of(problem, tenths, floats, doubles))
        print("| " + " | ".join(rows[-1]) + " |", flush=True)
    if options.write:
        rows = merged_rows("least steps", rows) if options.problems else rows
        write_section("least steps", f"{machine_text()}, nanoseconds:\n\n{markdown_table(rows)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
