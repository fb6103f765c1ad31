"""Shared parts of several benchmarks: the figures of `rddl bench`, results that outlive a run, and
the options of those that vary a size."""

import argparse
import json
import math
import os
import signal
import statistics
import subprocess
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path

from document import ROOT


def bench(rddl: Path, *arguments: object, limit: float | None = None) -> dict:
    """Returns the figures of `rddl bench ARGUMENTS --json`. RuntimeError with its message if it
    fails, or if it and its processes need more than `limit` seconds."""
    command = list(map(str, [rddl, "bench", *arguments, "--json"]))
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    with subprocess.Popen(command, **pipes, start_new_session=True) as process:
        try:
            output, messages = process.communicate(timeout=limit)
        except BaseException as error:
            os.killpg(process.pid, signal.SIGKILL)
            if isinstance(error, subprocess.TimeoutExpired):
                raise RuntimeError(f"no figures within {limit:g} s") from None
            raise
    if process.returncode != 0:
        raise RuntimeError(messages.strip())
    return json.loads(output)


class Results:
    """Measurements, dataclasses by their keys, in a file; each new one is added at once."""

    def __init__(self, path: Path, fresh: bool, read: Callable, key: Callable):
        """`read` makes an entry of its fields, `key` is that of an entry."""
        self.path, self.key = path, key
        path.parent.mkdir(parents=True, exist_ok=True)
        if fresh:
            path.unlink(missing_ok=True)
        lines = path.read_text().splitlines() if path.exists() else []
        entries = [read(**json.loads(line)) for line in lines]
        self.entries = {key(entry): entry for entry in entries}

    def add(self, entry) -> None:
        self.entries[self.key(entry)] = entry
        with self.path.open("a") as file:
            file.write(json.dumps(asdict(entry)) + "\n")


def geometric_mean(values: list[float]) -> float:
    return math.exp(statistics.fmean(map(math.log, values)))


def size_options(name: str, description: str, sizes: tuple[int, ...], counted: str) -> argparse.ArgumentParser:
    """The options of a benchmark that measures problems of several sizes, has a limit and a section
    of the document."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--sizes", type=int, nargs="+", default=sizes, help=f"numbers of {counted}")
    parser.add_argument("--rddl", type=Path, default=ROOT / "build/bin/rddl", help="our program")
    parser.add_argument("--seconds", type=float, default=0.5, help="of each measurement")
    default = ROOT / f"build/benchmarks/{name}.json"
    parser.add_argument("--results", type=Path, default=default, help="file for the figures")
    parser.add_argument("--require", action="store_true", help="fail above the limit")
    parser.add_argument("--write", action="store_true", help="write docs/benchmarks.md")
    return parser


def print_row(cells: tuple[str, ...]) -> None:
    print("  ".join(cell.rjust(11) for cell in cells), flush=True)


def write_results(results: Path, points: list) -> None:
    """Dataclasses, as JSON."""
    results.parent.mkdir(parents=True, exist_ok=True)
    results.write_text(json.dumps([asdict(point) for point in points], indent=2) + "\n")
