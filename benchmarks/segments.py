"""The cost of a road of many segments for the mountain car: a binary search, not a sum over
segments.

    .venv/bin/python benchmarks/segments.py             a minute
    .venv/bin/python benchmarks/segments.py --require   and fail above the limit
    .venv/bin/python benchmarks/segments.py --write     and docs/benchmarks.md

The car of examples/mountain_car on a valley drawn with 1 to 1,000 segments. `rddl bench` with one thread,
for one environment and for a batch. For comparison, the same without the pass that makes the search.
"""

import argparse
import math
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from bench import bench, print_row, size_options, write_results
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
    arguments = ["--threads", 1, "--batch", 1024, "--seconds", options.seconds, *more]
    alone, *batches = bench(options.rddl, DOMAIN, instance, *arguments)["measurements"]
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


def main() -> int:
    options = size_options("segments", __doc__.splitlines()[0], SIZES, "segments").parse_args()
    points = []
    for segments in options.sizes:
        points.append(measure_segments(segments, options))
        print_row(columns(points[-1]))
    write_results(options.results, points)
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
