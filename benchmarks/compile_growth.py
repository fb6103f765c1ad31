"""How the time of rddlc and rddl grows with the length of the text.

    .venv/bin/python benchmarks/compile_growth.py               some minutes
    .venv/bin/python benchmarks/compile_growth.py --require     and fail where it grows too fast
    .venv/bin/python benchmarks/compile_growth.py --write       and docs/benchmarks.md
    .venv/bin/python benchmarks/compile_growth.py -n 5000 chain_read_once unknown_names

Texts of many shapes (shapes.py), once of n lines and once of 4n. What counts is processor time of the
whole process, which other programs on the machine hardly change. n log n makes the ratio about 4.5, a cost by the
square 16.

Limit: a ratio of 8, or a time that is too short to measure.
"""

import argparse
import os
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from document import ROOT, machine_text, markdown_table, write_section
from shapes import SHAPES

GREATEST_RATIO = 8.0
SHORTEST = 0.2  # the shortest processor time, in seconds, that is measured reliably

RDDLC = Path(os.environ.get("RDDLC", ROOT / "build/bin/rddlc"))
RDDL = Path(os.environ.get("RDDL", ROOT / "build/bin/rddl"))
COMMANDS = {
    "rddlc": [RDDLC, "--stop-after=emit"],
    "check": [RDDL, "check"],
    "fmt": [RDDL, "fmt", "--stdout"],
    "info": [RDDL, "info"],
    "run": [RDDL, "run", "--engine=interpreter", "--quiet", "--threads=1"],
}


@dataclass
class Growth:
    shape: str
    command: str
    lines: int
    seconds: tuple[float, float]  # of processor time, for n and 4n lines

    def ratio(self) -> float:
        return self.seconds[1] / self.seconds[0]

    def is_too_fast(self) -> bool:
        return self.seconds[1] > SHORTEST and self.ratio() > GREATEST_RATIO


def processor_seconds(words: list, text: str) -> float:
    """The processor time of a program that ends by itself, whether it accepts the text or not."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "problem.rddl")
        path.write_text(text)
        process = subprocess.Popen([*map(str, words), str(path)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in (0, 1):
        raise RuntimeError(f"{words[0]} ended with status {process.returncode}")
    return usage.ru_utime + usage.ru_stime


def measure(shape: str, command: str, n: int) -> Growth:
    make, words = SHAPES[shape], COMMANDS[command]
    return Growth(shape, command, n, (processor_seconds(words, make(n)), processor_seconds(words, make(4 * n))))


TITLES = ("shape", "command", "n", "n lines, s", "4n lines, s", "ratio")


def columns(g: Growth) -> tuple[str, ...]:
    return (g.shape, g.command, f"{g.lines:,}", *(f"{s:.3f}" for s in g.seconds), f"{g.ratio():.1f}")


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("shapes", nargs="*", choices=[[], *SHAPES], help="all if none is named")
    parser.add_argument("-n", type=int, default=1000, help="lines of the shorter text (1000)")
    parser.add_argument("--commands", default="rddlc,fmt,run", help=f"some of {','.join(COMMANDS)}")
    parser.add_argument("--require", action="store_true", help="fail where the time grows too fast")
    parser.add_argument("--write", action="store_true", help="write the slowest to docs/benchmarks.md")
    return parser.parse_args()


def main() -> int:
    options = parse_arguments()
    growths = []
    for shape in options.shapes or SHAPES:
        for command in options.commands.split(","):
            growths.append(measure(shape, command, options.n))
            print("  ".join(columns(growths[-1])), "  <- too fast" if growths[-1].is_too_fast() else "", flush=True)
    over = [g for g in growths if g.is_too_fast()]
    print(f"{len(growths) - len(over)} of {len(growths)} grow no faster than they may")
    if options.write:
        slowest = sorted(growths, key=lambda g: -g.seconds[1])[:12]
        table = markdown_table([TITLES, *map(columns, slowest)])
        write_section("growth of compiling", f"{machine_text()}; the 12 slowest of {len(growths)}:\n\n{table}")
    return 1 if options.require and over else 0


if __name__ == "__main__":
    sys.exit(main())
