"""What a road of many segments costs the mountain car: a binary search, not a sum over segments.

    .venv/bin/python benchmarks/segments.py             a minute
    .venv/bin/python benchmarks/segments.py --require   and fail above the limit
    .venv/bin/python benchmarks/segments.py --write     and docs/benchmarks.md

The car of examples/mountain_car on a valley drawn with 1 to 1,000 segments. `rddl bench` with one thread,
for one environment and for a batch. For comparison, the same without the pass that makes the search.
"""

import argparse
import json
import math
import subprocess
import sys
import tempfile
from dataclasses import asdict, dataclass
from pathlib import Path

from document import ROOT, machine_text, markdown_table, write_section

DOMAIN = ROOT / "examples/mountain_car/domain.rddl"
SIZES = (1, 10, 99, 400, 1000)
PASS = "search_intervals"
MOST_SECONDS = 3.0  # of a step with 99 segments, as a multiple of one with a single segment


@dataclass
class Cost:
    """Seconds of a step of one environment."""

    alone: float
    in_batch: float


@dataclass
class Point:
    segments: int
    searching: Cost
    summing: Cost


def instance_text(segments: int) -> str:
    """The road sin(3 x) from -1.2 to 0.6 as straight pieces."""
    places = [-1.2 + 1.8 * i / segments for i in range(segments + 1)]
    ends = [(round(x, 6), round(math.sin(3 * x), 6)) for x in places]
    names = [f"s{i}" for i in range(segments)]
    lines = [
        f"LEFT-X({name}) = {x}; LEFT-Y({name}) = {y}; RIGHT-X({name}) = {next_x}; RIGHT-Y({name}) = {next_y};"
        for name, (x, y), (next_x, next_y) in zip(names, ends, ends[1:])
    ]
    newline = "\n        "
    return f"""non-fluents valley {{
    domain = mountain_car;
    objects {{ segment : {{ {", ".join(names)} }}; }};
    non-fluents {{
        {newline.join(lines)}
    }};
}}

instance drive {{
    domain = mountain_car;
    non-fluents = valley;
    max-nondef-actions = 1;
    horizon = 200;
    discount = 1.0;
}}
"""


def measure(instance: Path, options: argparse.Namespace, *more: str) -> Cost:
    command = [options.rddl, "bench", DOMAIN, instance, "--json", "--threads", 1]
    command += ["--batch", 1024, "--seconds", options.seconds, *more]
    result = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    if result.returncode != 0:
        raise RuntimeError(result.stderr.strip())
    alone, *batches = json.loads(result.stdout)["measurements"]
    fastest = max(batch["steps_per_second"] for batch in batches)
    return Cost(1 / alone["steps_per_second"], 1 / fastest)


def measure_segments(segments: int, options: argparse.Namespace) -> Point:
    with tempfile.TemporaryDirectory() as folder:
        instance = Path(folder, "instance.rddl")
        instance.write_text(instance_text(segments))
        searching = measure(instance, options)
        return Point(segments, searching, measure(instance, options, f"--without={PASS}"))


TITLES = ("segments", "one environment, ns", "in a batch, ns", "one, without the search", "batch, without")


def columns(point: Point) -> tuple[str, ...]:
    costs = (point.searching, point.summing)
    figures = [f"{seconds * 1e9:,.1f}" for cost in costs for seconds in (cost.alone, cost.in_batch)]
    return (f"{point.segments:,}", *figures)


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=SIZES, help="numbers of segments")
    parser.add_argument("--rddl", type=Path, default=ROOT / "build/bin/rddl", help="our program")
    parser.add_argument("--seconds", type=float, default=0.5, help="of each measurement")
    default = ROOT / "build/benchmarks/segments.json"
    parser.add_argument("--results", type=Path, default=default, help="file for the figures")
    parser.add_argument("--require", action="store_true", help="fail above the limit")
    parser.add_argument("--write", action="store_true", help="write docs/benchmarks.md")
    return parser.parse_args()


def main() -> int:
    options = parse_arguments()
    points = []
    for segments in options.sizes:
        points.append(measure_segments(segments, options))
        print("  ".join(cell.rjust(11) for cell in columns(points[-1])), flush=True)
    options.results.parent.mkdir(parents=True, exist_ok=True)
    options.results.write_text(json.dumps([asdict(point) for point in points], indent=2) + "\n")
    if options.write:
        table = markdown_table([TITLES, *map(columns, points)])
        write_section("segments", f"{machine_text()}:\n\n{table}")
    by_count = {point.segments: point.searching for point in points}
    if not options.require or not {1, 99} <= by_count.keys():
        return 0
    one, many = by_count[1], by_count[99]
    over = many.alone > MOST_SECONDS * one.alone or many.in_batch > MOST_SECONDS * one.in_batch
    if over:
        print(f"99 segments cost more than {MOST_SECONDS:g} times what one costs")
    return 1 if over else 0


if __name__ == "__main__":
    sys.exit(main())
