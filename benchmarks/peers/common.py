"""Shared parts of the programs that measure another simulator."""

import argparse
import importlib
import json
import logging
import os
import sys
import time
import warnings
from importlib.metadata import version
from types import ModuleType
from typing import Callable


def parse_arguments(name: str) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=f"Steps per second of {name}, as a line of JSON.")
    parser.add_argument("domain")
    parser.add_argument("instance")
    parser.add_argument("--seconds", type=float, default=1.0, help="of each measurement")
    parser.add_argument("--cores", type=int, default=1, help="that the process may use")
    return parser.parse_args()


def measured_peer(name: str, measure: Callable[[argparse.Namespace], dict]) -> None:
    """Runs `measure` on no more cores than asked for, and prints what it gives as a line of JSON; or
    what was missing, or went wrong, as {"error": ...}."""
    options = parse_arguments(name)
    os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[: options.cores])
    for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ[variable] = str(options.cores)
    warnings.simplefilter("ignore")
    logging.disable(logging.WARNING)
    try:
        figures = {"name": name, "version": version(name), **measure(options)}
    except Exception as error:
        figures = {"error": f"{type(error).__name__}: {error}", "missing": isinstance(error, ImportError)}
    print(json.dumps(figures))
    sys.exit(1 if "error" in figures else 0)


def timed_import(name: str) -> tuple[ModuleType, float]:
    """A module of this folder, and the seconds that it and all that it needs took to import."""
    begin = time.perf_counter()
    module = importlib.import_module(name)
    return module, time.perf_counter() - begin


def steps_in(seconds: float, run: Callable[[], tuple[int, float]]) -> tuple[int, float]:
    """Repeats `run`, which returns the steps it made and the seconds they took, until the time is
    over."""
    steps, elapsed = 0, 0.0
    while elapsed < seconds:
        more_steps, more_seconds = run()
        steps, elapsed = steps + more_steps, elapsed + more_seconds
    return steps, elapsed
