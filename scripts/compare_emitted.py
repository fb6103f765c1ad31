#!/usr/bin/env python3
"""Compares what two versions of rddlc emit for rddlrepository: the tokens, not layout or comments.

    scripts/compare_emitted.py OLD_RDDLC [--new build/bin/rddlc] [--kept FILE] [NAME...] [-- OPTIONS]

OPTIONS are those of rddlc. Hashes of the old text are kept in FILE, so that the old version runs once, and again only
to show a difference. Status 0: all tokens are equal.
"""

import argparse
import difflib
import hashlib
import json
import re
import subprocess
import sys
import time
from pathlib import Path

from repository import add_problems, problems, split_options

LEXEME = re.compile(
    r"//[^\n]*|/\*.*?\*/|\s+"
    r'|(?P<string>"(?:[^"\\\n]|\\.)*")'
    r"|(?P<token>[A-Za-z_]\w*|\.?\d(?:[eE][+-]|[\w.])*|::|->|\+\+|--|&&|\|\||[=!<>]=|<<|.)",
    re.DOTALL,
)


def main():
    words, options = split_options(sys.argv[1:])
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("old", type=Path)
    parser.add_argument("--new", type=Path, default=Path("build/bin/rddlc"))
    parser.add_argument("--kept", type=Path, help="hashes of the old text")
    parser.add_argument("--lines", type=int, default=12, help="of each difference")
    add_problems(parser)
    arguments = parser.parse_intermixed_args(words)

    kept = json.loads(arguments.kept.read_text()) if arguments.kept and arguments.kept.exists() else {}
    count, different, seconds = 0, 0, {"old": 0.0, "new": 0.0}
    for label, folder, files in instances(arguments):
        count += 1
        key = " ".join([label, *options])
        old = None
        if key not in kept:
            old = emitted(arguments.old, folder, files, options, seconds, "old")
            kept[key] = hash_of(old)
        new = emitted(arguments.new, folder, files, options, seconds, "new")
        if hash_of(new) == kept[key]:
            continue
        different += 1
        old = old or emitted(arguments.old, folder, files, options, seconds, "old")
        print(f"{label}:", *difference(old, new, arguments.lines), sep="\n    ", flush=True)
    if arguments.kept:
        arguments.kept.write_text(json.dumps(kept, indent=1) + "\n")
    print(f"{count} instances, {different} of them differ; seconds of rddlc: {seconds}")
    return 1 if different or count == 0 else 0


def instances(arguments):
    for problem in problems(arguments):
        for instance in problem["instances"]:
            folder = Path(problem["folder"])
            yield f"{problem['name']} {instance}", folder, ["domain.rddl", f"instance{instance}.rddl"]


def emitted(rddlc, folder, files, options, seconds, version):
    start = time.monotonic()
    command = [rddlc.resolve(), *files, "-w", *options]
    text = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True).stdout
    seconds[version] += time.monotonic() - start
    return tokens(text)


def tokens(text):
    found = []
    for lexeme in LEXEME.finditer(text):
        if lexeme["string"] and found and found[-1].startswith('"'):
            found[-1] = found[-1][:-1] + lexeme["string"][1:]  # neighbours are one string
        elif lexeme[0] == "}" and found and found[-1] == ",":
            found[-1] = "}"  # the comma means nothing
        elif lexeme["string"] or lexeme["token"]:
            found.append(lexeme[0])
    return found


def hash_of(found):
    return hashlib.sha256("\n".join(found).encode()).hexdigest()[:16]


def difference(old, new, most):
    """Statements that differ, each on a line."""
    lines = [re.sub(r"([;{}]) ", r"\1\n", " ".join(found)).split("\n") for found in (old, new)]
    changed = [line for line in difflib.unified_diff(*lines, lineterm="", n=0) if line[:3] not in ("---", "+++") and not line.startswith("@@")]
    return changed[:most] + ([f"... {len(changed) - most} more"] if len(changed) > most else [])


if __name__ == "__main__":
    sys.exit(main())
