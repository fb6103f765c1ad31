"""How the time of a step grows with the number of objects, where tables are sparse.

    .venv/bin/python benchmarks/growth.py             some minutes
    .venv/bin/python benchmarks/growth.py --require   and fail if it grows faster than linearly
    .venv/bin/python benchmarks/growth.py --write     and docs/benchmarks.md

A network of computers, a fire on a grid and a recommender (benchmarks/growth/) with 10, 100, 1,000
and 10,000 objects: each object has a few entries in the tables, so the number of entries that are not
zero is proportional to that of objects. `rddl bench` with one thread, a single environment.

Limit: over all sizes the time may grow with the power 1.25 of the entries at most (the slope of a straight
line through the logarithms of both); a cost by the square would be the power 2.
"""

import argparse
import math
import statistics
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from bench import bench, print_row, size_options, write_results
from document import ROOT, machine_text, markdown_table, write_section

FOLDER = ROOT / "benchmarks/growth"
sys.path.insert(0, str(FOLDER))

from instances import GENERATORS  # noqa: E402

SIZES = (10, 100, 1000, 10000)
GREATEST_POWER = 1.25  # of the number of entries, that the time grows with


@dataclass
class Point:
    domain: str
    objects: int
    entries: int
    seconds: float  # of a step
    rddlc_seconds: float
    emitted_bytes: int


def measure(domain: str, objects: int, options: argparse.Namespace) -> Point:
    made = GENERATORS[domain](objects)
    with tempfile.TemporaryDirectory() as folder:
        instance = Path(folder, "instance.rddl")
        instance.write_text(made.text)
        arguments = ["--threads", 1, "--batch", 16, "--seconds", options.seconds]
        figures = bench(options.rddl, FOLDER / f"{domain}.rddl", instance, *arguments)
    seconds = 1 / figures["measurements"][0]["steps_per_second"]
    return Point(domain, objects, made.entries, seconds, figures["rddlc_seconds"], figures["emitted_bytes"])


TITLES = ("domain", "objects", "entries", "a step, us", "ns an entry", "rddlc, s", "emitted, kB")


def columns(p: Point) -> tuple[str, ...]:
    return (
        p.domain,
        f"{p.objects:,}",
        f"{p.entries:,}",
        f"{p.seconds * 1e6:,.2f}",
        f"{p.seconds / p.entries * 1e9:.1f}",
        f"{p.rddlc_seconds:.2f}",
        f"{p.emitted_bytes / 1000:,.0f}",
    )


def power_of_growth(points: list[Point]) -> float:
    """The power of the number of entries that the time of a step grows with."""
    entries, times = ([math.log(value) for value in values] for values in zip(*((p.entries, p.seconds) for p in points)))
    return statistics.linear_regression(entries, times).slope


def excesses(points: list[Point]) -> list[str]:
    """Returns the times that grow faster than they may, a line each."""
    lines = []
    for domain in dict.fromkeys(p.domain for p in points):
        of_domain = [p for p in points if p.domain == domain]
        if len(of_domain) > 1 and (power := power_of_growth(of_domain)) > GREATEST_POWER:
            lines.append(f"{domain}: the time grows with the power {power:.2f} of the entries")
    return lines


def parse_arguments() -> argparse.Namespace:
    parser = size_options("growth", __doc__.splitlines()[0], SIZES, "objects")
    parser.add_argument("domains", nargs="*", choices=[[], *GENERATORS], help="all three if none is named")
    return parser.parse_args()


def main() -> int:
    options = parse_arguments()
    points, failures = [], []
    for domain in options.domains or GENERATORS:
        for size in options.sizes:
            try:
                points.append(measure(domain, size, options))
            except RuntimeError as error:
                failures.append(f"{domain} {size}: {error}")
                print(failures[-1], flush=True)
                continue
            print_row(columns(points[-1]))
    write_results(options.results, points)
    over = excesses(points)
    print(*over, sep="\n")
    if options.write:
        write_section("growth", f"{machine_text()}:\n\n{markdown_table([TITLES, *map(columns, points)])}")
    return 1 if failures or (options.require and over) else 0


if __name__ == "__main__":
    sys.exit(main())
