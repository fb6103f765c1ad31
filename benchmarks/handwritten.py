"""Emitted simulators against C++ written by hand for the same instances, with the same random numbers.

    .venv/bin/python benchmarks/handwritten.py             some minutes
    .venv/bin/python benchmarks/handwritten.py --require   and fail below the limit
    .venv/bin/python benchmarks/handwritten.py --write     and docs/benchmarks.md

benchmarks/handwritten/ holds the references; both sides are compiled with the same options. They
first play the same course and must agree; then they take turns, with one thread, a single environment
and a batch of 1,024. The ratios are those of the medians, of steps for a second of processor time.

The references round as they like: with reciprocals, in another order. So ours is measured as it is by
default, all bits as without optimisation, and with --fast-math, like with like.

Limits: where the table below says so, ours with --fast-math has at least 0.9 of the speed. The aim for all, a
geometric mean of 0.8 by default and 0.5 at least, is reported and not required, since it is not reached.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from document import ROOT, machine_text, markdown_table, parts_around, write_section

sys.path.append(str(ROOT / "tests/conformance"))

from problems import repository_cases  # noqa: E402

FOLDER = ROOT / "benchmarks/handwritten"


@dataclass(frozen=True)
class Reference:
    """A file of FOLDER and its struct, and the instance that it is written for."""

    family: str
    instance: str
    header: str
    struct: str
    is_required: bool = False  # to reach LEAST_RATIO
    is_chaotic: bool = False  # steps enlarge the least errors, so those of --fast-math are not compared


GRIDS = "grids of bools"
NETWORKS = "networks of bools"
QUEUES = "queues and counters"
CONTROL = "continuous control"
RESOURCES = "resource networks"
OBJECTS = "many objects"

REFERENCES = {
    "Wildfire_MDP_ippc2014": Reference(GRIDS, "10", "wildfire", "Wildfire", True),
    "GameOfLife_MDP_ippc2011": Reference(GRIDS, "10", "game_of_life", "GameOfLife"),
    "Navigation_MDP_ippc2011": Reference(GRIDS, "10", "navigation", "Navigation"),
    "CrossingTraffic_MDP_ippc2014": Reference(GRIDS, "10", "crossing_traffic", "CrossingTraffic"),
    "EarthObservation_ippc2018": Reference(GRIDS, "17", "earth_observation", "EarthObservation"),
    "SysAdmin_MDP_ippc2011": Reference(NETWORKS, "10", "sysadmin", "SysAdmin", True),
    "AcademicAdvising_MDP_ippc2014": Reference(NETWORKS, "10", "academic_advising", "AcademicAdvising"),
    "AcademicAdvising_ippc2018": Reference(NETWORKS, "10", "academic_advising_2018", "AcademicAdvising2018"),
    "SkillTeaching_MDP_ippc2014": Reference(NETWORKS, "10", "skill_teaching", "SkillTeaching"),
    "TriangleTireworld_MDP_ippc2014": Reference(NETWORKS, "10", "triangle_tireworld", "TriangleTireworld"),
    "Tamarisk_MDP_ippc2014": Reference(NETWORKS, "10", "tamarisk", "Tamarisk"),
    "Traffic_MDP_ippc2014": Reference(QUEUES, "10", "traffic", "Traffic"),
    "Traffic_CTM_MDP_ippc2011": Reference(QUEUES, "10", "traffic_ctm", "TrafficCtm"),
    "Elevators_MDP_ippc2014": Reference(QUEUES, "10", "elevators", "Elevators"),
    "Knapsack_or": Reference(QUEUES, "0", "knapsack", "Knapsack"),
    "PushYourLuck_ippc2018": Reference(QUEUES, "11", "push_your_luck", "PushYourLuck"),
    "ChromaticDice_ippc2018": Reference(QUEUES, "10", "chromatic_dice", "ChromaticDice"),
    "BinPacking_or": Reference(QUEUES, "0", "bin_packing", "BinPacking"),
    "MountainCar_ippc2023": Reference(CONTROL, "1", "mountain_car", "MountainCar", True),
    "CartPole_Continuous_gym": Reference(CONTROL, "0", "cart_pole", "CartPole", True),
    "Pendulum_gym": Reference(CONTROL, "0", "pendulum", "Pendulum", True),
    "Option_or": Reference(CONTROL, "1", "option", "Option"),
    "Acrobot_gym": Reference(CONTROL, "0", "acrobot", "Acrobot"),
    "MarsRover_ippc2023": Reference(CONTROL, "3", "mars_rover", "MarsRover"),
    "UAV_ippc2023": Reference(CONTROL, "5", "uav", "Uav"),
    "RaceCar_ippc2023": Reference(CONTROL, "5", "race_car", "RaceCar"),
    "Quadcopter_physics": Reference(CONTROL, "1", "quadcopter", "Quadcopter", is_chaotic=True),
    "Reservoir_ippc2023": Reference(RESOURCES, "5", "reservoir", "Reservoir", True),
    "HVAC_ippc2023": Reference(RESOURCES, "5", "hvac", "Hvac"),
    "PowerGen_ippc2023": Reference(RESOURCES, "5", "power_gen", "PowerGen"),
    "Epidemic": Reference(RESOURCES, "0", "epidemic", "Epidemic"),
    "TrafficBLX_SimplePhases": Reference(RESOURCES, "0", "traffic_blx", "TrafficBlx"),
    "RecSim_ippc2023": Reference(OBJECTS, "1", "recsim", "RecSim"),
    "Pizza_rddlsim": Reference(OBJECTS, "0", "pizza", "Pizza"),
    "Intruders_Discrete": Reference(OBJECTS, "0", "intruders", "Intruders"),
    "SupplyChain_or": Reference(OBJECTS, "0", "supply_chain", "SupplyChain"),
    "WildlifePreserve_p10_ippc2018": Reference(OBJECTS, "10", "wildlife_preserve", "WildlifePreserve"),
    "Manufacturer_ippc2018": Reference(OBJECTS, "13", "manufacturer", "Manufacturer"),
    "CooperativeRecon_ippc2018": Reference(OBJECTS, "11", "cooperative_recon", "CooperativeRecon"),
    "Logistics_rddlsim": Reference(OBJECTS, "0", "logistics", "Logistics"),
    "RedFinnedBlueEye_ippc2018": Reference(OBJECTS, "20", "red_finned_blue_eye", "RedFinnedBlueEye"),
    "Tetris_arcade": Reference(GRIDS, "0", "tetris", "Tetris"),
    "Sokoban_arcade": Reference(GRIDS, "0", "sokoban", "Sokoban"),
    "Blackjack_arcade": Reference(QUEUES, "0", "blackjack", "Blackjack"),
    "Zombies_arcade": Reference(OBJECTS, "2", "zombies", "Zombies"),
}
LEAST_RATIO = 0.9
LEAST_MEAN, LEAST_OF_ALL = 0.8, 0.5  # by default, the aim for all
GREATEST_DIFFERENCE = 1e-9  # of reals, relative; the order of sums is not the same


@dataclass
class Comparison:
    """The figures of one instance and size of batch."""

    problem: str
    environments: int
    difference: float
    emitted: float  # steps per second
    handwritten: float
    ratio: float
    fast_ratio: float  # with --fast-math

    @property
    def label(self) -> str:
        return f"{self.problem} {REFERENCES[self.problem].instance}"


# GCC would put halves of one environment's polynomials into registers together, and lose half of its speed;
# and keep coefficients that are used twice in registers, and numbers elsewhere. GCC 12 makes wrong copies of
# constants (rddl/values/tables.hpp).
NO_PASSES = ["-fno-tree-slp-vectorize", "-fno-gcse", "-fno-tree-loop-distribute-patterns"]
# The flags of rddl (compiler/driver/shared_object.cpp).
INLINE_MORE = ["--param", "max-inline-insns-single=400"]
FLAGS = ["-std=c++20", "-O3", "-march=native", "-ffp-contract=off", *NO_PASSES, *INLINE_MORE]
# Each reference as if it were alone in its program.
INLINING = ["--param", "inline-unit-growth=1000"]


def run(command: list) -> str:
    result = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    if result.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))}\n{result.stdout}{result.stderr}")
    return result.stdout


def build_program(options: argparse.Namespace) -> Path:
    """The program that compares; and the tables of the references."""
    options.folder.mkdir(parents=True, exist_ok=True)
    (options.folder / "tables.hpp").write_text(run([sys.executable, FOLDER / "tables.py"]))
    return build_measuring_program(FOLDER / "main.cpp", options.folder / "handwritten", options)


def build_measuring_program(main: Path, program: Path, options: argparse.Namespace) -> Path:
    """Of `main` and of what measures in rddl."""
    program.parent.mkdir(parents=True, exist_ok=True)
    measuring = ("terminal/interrupt", "measure/measurement", "measure/random_course", "formats/records_json")
    sources = [main, *(ROOT / f"workbench/{name}.cpp" for name in measuring)]
    libraries = [options.build / "solvers/librddl_solvers.a", options.build / "support/librddlc_support.a",
                 "-lfmt", "-lutf8proc", "-ldl", "-pthread"]
    folders = [ROOT / "runtime", ROOT / "workbench", ROOT]
    run([options.cxx, *FLAGS, *(f"-I{folder}" for folder in folders), *sources, *libraries, "-o", program])
    return program


LINKING = ["-shared", "-fPIC", "-fvisibility=hidden"]


def build_reference(problem: str, options: argparse.Namespace) -> Path:
    reference = REFERENCES[problem]
    library = options.folder / f"{problem}.by_hand.so"
    header = FOLDER / f"{reference.header}.hpp"
    what = ["-include", header, f"-DREFERENCE={reference.struct}", f"-I{options.folder}", f"-I{ROOT / 'runtime'}"]
    run([options.cxx, *FLAGS, *INLINING, *LINKING, *what, FOLDER / "reference.cpp", "-o", library])
    return library


def build_batches(options: argparse.Namespace, real: str = "double") -> Path:
    """The code of batches that all simulators of rddl link."""
    batches = options.folder / f"batches.{real}.o"
    source = ROOT / "runtime/rddl/batches.cpp"
    run([options.cxx, *FLAGS, "-fPIC", f"-DRDDL_BATCHES_OF={real}", f"-I{ROOT / 'runtime'}", "-c", source, "-o", batches])
    return batches


def build_simulator(
    problem: str, instance: str, rddlc_options: list[str], options: argparse.Namespace, real: str = "double"
) -> Path:
    """What rddlc emits, with the batches of build_batches for the same reals."""
    (case,) = [c for c in repository_cases(problem) if c.instance == instance]
    source = options.folder / f"{problem}.{real}.cpp"
    simulator = source.with_suffix(".so")
    run([options.build / "bin/rddlc", *rddlc_options, case.domain_path, case.instance_path, "-o", source])
    links = ["-DRDDL_ENTRY=rddl_simulator_entry", "-DRDDL_LINKS_BATCHES", options.folder / f"batches.{real}.o"]
    run([options.cxx, *FLAGS, *LINKING, *links, f"-I{ROOT / 'runtime'}", source, "-o", simulator])
    return simulator


def measure(
    problem: str, rddlc_options: list[str], reference: Path, program: Path, options: argparse.Namespace
) -> list[dict]:
    """By size of batch: differences, and the median speeds of both sides."""
    simulator = build_simulator(problem, REFERENCES[problem].instance, rddlc_options, options)
    sizes = json.loads(run([program, simulator, reference, options.seconds, options.rounds]))["sizes"]
    for size in sizes:
        size["difference"] = float("inf") if size["difference"] is None else size["difference"]
        size["emitted"] = statistics.median(size["emitted"])
        size["handwritten"] = statistics.median(size["handwritten"])
        size["ratio"] = size["emitted"] / size["handwritten"]
    return sizes


def compare(problem: str, program: Path, options: argparse.Namespace) -> list[Comparison]:
    reference = build_reference(problem, options)
    exact = measure(problem, [], reference, program, options)
    fast = measure(problem, ["--fast-math"], reference, program, options)
    return [
        Comparison(
            problem,
            e["environments"],
            e["difference"] if REFERENCES[problem].is_chaotic else max(e["difference"], f["difference"]),
            e["emitted"],
            e["handwritten"],
            e["ratio"],
            f["ratio"],
        )
        for e, f in zip(exact, fast, strict=True)
    ]


TITLES = ("instance", "environments", "emitted", "by hand", "ratio", "with --fast-math")


def columns(c: Comparison) -> tuple[str, ...]:
    speeds = (f"{c.emitted:,.0f}", f"{c.handwritten:,.0f}", f"{c.ratio:.2f}", f"{c.fast_ratio:.2f}")
    return (c.label, f"{c.environments:,}", *speeds)


def row_text(row: tuple[str, ...]) -> str:
    return row[0].ljust(28) + "".join(f"  {cell:>16}" for cell in row[1:])


def disagreements(comparisons: list[Comparison]) -> list[str]:
    return [
        f"{c.label}, {environments_text(c.environments)}: the results differ by {c.difference:.2g}"
        for c in comparisons
        if not c.difference <= GREATEST_DIFFERENCE
    ]


def shortfalls(comparisons: list[Comparison]) -> list[str]:
    return [
        f"{c.label}, {environments_text(c.environments)}: the ratio {c.fast_ratio:.2f} is below {LEAST_RATIO:g}"
        for c in comparisons
        if REFERENCES[c.problem].is_required and c.fast_ratio < LEAST_RATIO
    ]


def environments_text(count: int) -> str:
    return f"{count:,} environment{'' if count == 1 else 's'}"


def means(comparisons: list[Comparison]) -> list[str]:
    """How near all are to the aim, for single environments and for batches."""
    lines = []
    for environments in sorted({c.environments for c in comparisons}):
        ratios = [c.ratio for c in comparisons if c.environments == environments]
        below = sum(r < LEAST_OF_ALL for r in ratios)
        lines.append(
            f"{environments_text(environments)}: the geometric mean of the ratios is {statistics.geometric_mean(ratios):.2f} "
            f"(aim {LEAST_MEAN:g}), the least {min(ratios):.2f} (aim {LEAST_OF_ALL:g}); "
            f"{below} of {len(ratios)} {'is' if below == 1 else 'are'} below {LEAST_OF_ALL:g}"
        )
    return lines


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problems", nargs="*", help="some of the references")
    parser.add_argument("--build", type=Path, default=ROOT / "build", help="our build")
    parser.add_argument("--cxx", default=os.environ.get("CXX", "c++"), help="the C++ compiler")
    parser.add_argument("--folder", type=Path, default=ROOT / "build/benchmarks/handwritten", help="to work in")
    parser.add_argument("--seconds", type=float, default=0.5, help="of each measurement")
    parser.add_argument("--rounds", type=int, default=5, help="turns of each side")
    parser.add_argument("--require", action="store_true", help="fail below the limit")
    parser.add_argument("--write", action="store_true", help="write docs/benchmarks.md; of named problems, their rows")
    options = parser.parse_args()
    for problem in options.problems:
        if problem not in REFERENCES:
            parser.error(f"there is no reference of '{problem}'; there are {', '.join(REFERENCES)}")
    return options


def with_kept_rows(new: list[Comparison]) -> list[Comparison]:
    """The new figures, and those of the document for all others, in the order of the references."""
    problems = {c.problem for c in new}
    rows = [line for line in parts_around("handwritten")[2].splitlines() if line.startswith("|")][2:]
    kept = [c for c in map(comparison_of, rows) if c.problem not in problems]
    order = list(REFERENCES)
    return sorted([*new, *(c for c in kept if c.problem in order)], key=lambda c: (order.index(c.problem), c.environments))


def comparison_of(row: str) -> Comparison:
    """The figures of a row that `columns` has written."""
    label, environments, *figures = (cell.strip().replace(",", "") for cell in row.strip("| ").split("|"))
    return Comparison(label.split()[0], int(environments), 0.0, *map(float, figures))


def write_document(comparisons: list[Comparison]) -> None:
    table = markdown_table([TITLES, *map(columns, comparisons)])
    aims = "\n".join(f"* {line}" for line in means(comparisons))
    write_section("handwritten", f"{machine_text()}:\n\n{table}\n\n{aims}")


def main() -> int:
    options = parse_arguments()
    program = build_program(options)
    build_batches(options)
    print(row_text(TITLES))
    comparisons: list[Comparison] = []
    for problem in options.problems or REFERENCES:
        comparisons += compare(problem, program, options)
        print(*(row_text(columns(c)) for c in comparisons[-2:]), sep="\n", flush=True)
    different, slow = disagreements(comparisons), shortfalls(comparisons)
    print("", *means(comparisons), *different, *slow, sep="\n")
    if options.write:
        write_document(with_kept_rows(comparisons))
    return 1 if different or (options.require and slow) else 0


if __name__ == "__main__":
    sys.exit(main())
