"""How the time of a step grows with the number of objects, where tables are sparse.

    .venv/bin/python benchmarks/growth.py             some minutes
    .venv/bin/python benchmarks/growth.py --require   and fail if it grows faster than linearly
    .venv/bin/python benchmarks/growth.py --write     and docs/benchmarks.md

A network of computers, a fire on a grid and a recommender (benchmarks/growth/) with 10, 100, 1,000
and 10,000 objects: each object has a few entries in the tables, so the number of entries that are not
zero is proportional to that of objects. `rddl bench` with one thread, a single environment.

Limit: ten times the objects may cost twenty times the time at most; a cost by the square would be a
hundred times.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from dataclasses import asdict, dataclass
from pathlib import Path

from document import ROOT, machine_text, markdown_table, write_section

FOLDER = ROOT / "benchmarks/growth"
sys.path.insert(0, str(FOLDER))

from instances import GENERATORS  # noqa: E402

SIZES = (10, 100, 1000, 10000)
MOST_GROWTH = 2.0  # of the time, as a multiple of the growth of the number of objects


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
        command = [options.rddl, "bench", FOLDER / f"{domain}.rddl", instance, "--json"]
        command += ["--threads", 1, "--batch", 16, "--seconds", options.seconds]
        result = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    if result.returncode != 0:
        raise RuntimeError(f"{domain} {objects}: {result.stderr.strip()}")
    figures = json.loads(result.stdout)
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


def excesses(points: list[Point]) -> list[str]:
    """Where the time grows faster than it may, a line each."""
    lines = []
    for less, more in zip(points, points[1:]):
        if less.domain != more.domain:
            continue
        growth, objects = more.seconds / less.seconds, more.objects / less.objects
        if growth > MOST_GROWTH * objects:
            lines.append(f"{more.domain}: {objects:g} times the objects cost {growth:.1f} times the time")
    return lines


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("domains", nargs="*", choices=[[], *GENERATORS], help="all three if none is named")
    parser.add_argument("--sizes", type=int, nargs="+", default=SIZES, help="numbers of objects")
    parser.add_argument("--rddl", type=Path, default=ROOT / "build/bin/rddl", help="our program")
    parser.add_argument("--seconds", type=float, default=0.5, help="of each measurement")
    default = ROOT / "build/benchmarks/growth.json"
    parser.add_argument("--results", type=Path, default=default, help="file for the figures")
    parser.add_argument("--require", action="store_true", help="fail above the limit")
    parser.add_argument("--write", action="store_true", help="write docs/benchmarks.md")
    return parser.parse_args()


def main() -> int:
    options = parse_arguments()
    points, failures = [], []
    for domain in options.domains or GENERATORS:
        for size in options.sizes:
            try:
                points.append(measure(domain, size, options))
            except RuntimeError as error:
                failures.append(str(error))
                print(failures[-1], flush=True)
                continue
            print("  ".join(cell.rjust(11) for cell in columns(points[-1])), flush=True)
    options.results.parent.mkdir(parents=True, exist_ok=True)
    options.results.write_text(json.dumps([asdict(point) for point in points], indent=2) + "\n")
    over = excesses(points)
    print(*over, sep="\n")
    if options.write:
        write_section("growth", f"{machine_text()}:\n\n{markdown_table([TITLES, *map(columns, points)])}")
    return 1 if failures or (options.require and over) else 0


if __name__ == "__main__":
    sys.exit(main())
