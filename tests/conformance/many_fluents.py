"""Problems with many fluents and conditions: what compiling them costs, and that it is right.

    .venv/bin/python tests/conformance/many_fluents.py                   120 of each kind, in every compiler
    .venv/bin/python tests/conformance/many_fluents.py --growth 10 100 1000 5000     seconds of the processor

The compiled simulator makes the same steps as the interpreter, byte for byte. Exit status: 0 if so; 77 if a
compiler is not there.
"""

import argparse
import os
import resource
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SKIPPED = 77
KINDS = ("fluents", "terminations", "invariants", "preconditions")


def problem(counts: dict[str, int]) -> str:
    """A problem with so many fluents of both roles and conditions; the types of the fluents vary."""
    fluents = range(max(2, counts.get("fluents", 0)))
    lines = ["domain many { pvariables {"]
    kinds = ["real, default = 0.5", "real, default = 1.5", "int, default = 3", "bool, default = true"]
    kind = {i: kinds[i // 5 % 4] for i in fluents}
    lines += [f"x{i} : {{ state-fluent, {kind[i]} }};" for i in fluents]
    lines += [f"a{i} : {{ action-fluent, {kinds[i // 7 % 4]} }};" for i in fluents]
    lines += ["}; cpfs {"]
    for i in fluents:
        other = (7 * i + 1) % len(fluents)
        if kind[i].startswith("real"):
            lines.append(f"x{i}' = max[-9, min[9, 0.9 * x{i} + 0.1 * x{other} + 0.25 * a{i}]];")
        elif kind[i].startswith("int"):
            lines.append(f"x{i}' = if (x{other} > a{other}) then x{i} + 1 else x{i};")
        else:
            lines.append(f"x{i}' = if (Bernoulli(0.25)) then a{i} > 0 else x{i};")
    lines += ["}; reward = x0 + x1;", "action-preconditions {"]
    lines += [f"a{i % 2} <= {i}.5 + 4 + x{(i + 1) % 2};" for i in range(counts.get("preconditions", 0))]
    lines += ["}; state-invariants {"]
    lines += [f"x{i % 2} < {i}.25 + 10 + x{(i + 1) % 2};" for i in range(counts.get("invariants", 0))]
    lines += ["}; termination {"]
    lines += [f"x{i % 2} > {i}.75 + x{(i + 1) % 2};" for i in range(counts.get("terminations", 0))]
    lines += ["}; } non-fluents n { domain = many; }"]
    lines += ["instance i { domain = many; non-fluents = n; max-nondef-actions = pos-inf;"]
    return "\n".join([*lines, "horizon = 20; discount = 1.0; }"]) + "\n"


def run(options, folder: Path, text: str, engine: str, compiler: str) -> tuple[bytes, float]:
    """The trace, and the seconds of the processor."""
    file = folder / "problem.rddl"
    file.write_text(text)
    command = [options.rddl, "run", file, "--episodes", "40", "--threads", "1", "--quiet"]
    command += ["--seed", "3", "--trace", "-", f"--engine={engine}"]
    environment = os.environ | {"CXX": compiler, "XDG_CACHE_HOME": str(folder)}
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    result = subprocess.run(list(map(str, command)), capture_output=True, env=environment)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if result.returncode != 0:
        raise SystemExit(f"{compiler}, {engine}: {result.stderr.decode()[-3000:]}")
    trace = result.stdout.partition(b"\n")[2]  # the first line names the engine
    return trace, after.ru_utime - before.ru_utime


def compare(options, folder: Path) -> int:
    text = problem({kind: options.count for kind in KINDS})
    expected, _ = run(options, folder, text, "interpreter", "c++")
    differing = 0
    for compiler in options.compilers:
        found, _ = run(options, folder, text, "compiled", compiler)
        same = found == expected and found.count(b"\n") > 40
        print(f"{compiler}: {len(found.splitlines())} lines of a trace, {'equal' if same else 'DIFFERENT'}")
        differing += not same
    return 1 if differing else 0


def show_growth(options, folder: Path) -> int:
    print("| compiler | kind | " + " | ".join(map(str, options.growth)) + " |")
    print("|---|---|" + "---|" * len(options.growth))
    for compiler in options.compilers:
        run(options, folder, problem({}), "compiled", compiler)  # and with it the runtime
        for kind in KINDS:
            seconds = [
                run(options, folder, problem({kind: count}), "compiled", compiler)[1]
                for count in options.growth
            ]
            print(f"| {compiler} | {kind} | " + " | ".join(f"{s:.1f}" for s in seconds) + " |", flush=True)
    return 0


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--count", type=int, default=120)
    parser.add_argument("--growth", type=int, nargs="+", default=[])
    parser.add_argument("--compilers", nargs="+", default=["g++", "clang++"])
    parser.add_argument("--rddl", type=Path, default=ROOT / "build/bin/rddl")
    options = parser.parse_args()
    missing = [compiler for compiler in options.compilers if not shutil.which(compiler.split()[0])]
    if missing:
        print(f"skipped: this machine has no {', '.join(missing)}")
        return SKIPPED
    with tempfile.TemporaryDirectory(prefix="many-fluents-") as folder:
        return (show_growth if options.growth else compare)(options, Path(folder))


if __name__ == "__main__":
    sys.exit(main())
