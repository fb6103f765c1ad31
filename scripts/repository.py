"""The command line that the scripts on rddlrepository share, and the problems that they run on."""

import json
import subprocess
from pathlib import Path


def split_options(words):
    """Returns the words before a `--`, and those behind it, which are options of another program."""
    place = words.index("--") if "--" in words else len(words)
    return words[:place], words[place + 1 :]


def add_problems(parser):
    parser.add_argument("--rddl", type=Path, default=Path("build/bin/rddl"), help="lists the problems")
    parser.add_argument("names", nargs="*", metavar="NAME", help="of problems; none: all")


def problems(arguments):
    """Yields the entries of `rddl list --json`: {"name", "folder", "instances", ...}."""
    for problem in json.loads(subprocess.check_output([arguments.rddl, "list", "--json"])):
        if not arguments.names or problem["name"] in arguments.names:
            yield problem
