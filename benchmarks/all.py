"""The whole suite, into docs/benchmarks.md and its pictures: three hours on a machine that does nothing else.

    .venv/bin/python benchmarks/all.py             continue where a run was interrupted
    .venv/bin/python benchmarks/all.py --fresh     measure everything again
    .venv/bin/python benchmarks/all.py --require   fail below the limits of the parts

Needs what `scripts/test.sh` sets up, and pyRDDLGym-jax (requirements-jax.txt) at .jaxvenv.
"""

import argparse
import subprocess
import sys

from document import ROOT

# The programs, and whether they know --fresh and --require.
PARTS = (
    ("cliffs.py", True, True),
    ("compare.py", True, True),
    ("compare_jax.py", True, True),
    ("least_steps.py", False, False),
    ("handwritten.py", False, True),
    ("lanes.py", True, True),
    ("growth.py", False, True),
    ("segments.py", False, True),
    ("compile_cost.py", False, True),
    ("compile_growth.py", False, True),
)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--fresh", action="store_true", help="measure again what is measured already")
    parser.add_argument("--require", action="store_true", help="fail below the limits")
    options = parser.parse_args()

    def run(program: str, *arguments: str) -> int:
        print(f"\n---- {program}", flush=True)
        return subprocess.run([sys.executable, ROOT / "benchmarks" / program, *arguments]).returncode

    failed = []
    for program, knows_fresh, knows_require in PARTS:
        arguments = ["--write"]
        arguments += ["--fresh"] if options.fresh and knows_fresh else []
        arguments += ["--require"] if options.require and knows_require else []
        if run(program, *arguments) != 0:
            failed.append(program)
    failed += [program for program in ("batches.py", "plots.py") if run(program) != 0]
    print(f"\nfailed: {', '.join(failed)}" if failed else "\nall is well")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
