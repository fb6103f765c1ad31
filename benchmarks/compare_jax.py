"""Our batches against the compiled, vmapped rollouts of pyRDDLGym-jax, on the same processor.

    python3 -m venv .jaxvenv && .jaxvenv/bin/pip install -r benchmarks/requirements-jax.txt
    .venv/bin/python benchmarks/compare_jax.py                 all problems; an hour
    .venv/bin/python benchmarks/compare_jax.py Pendulum_gym    some problems
    .venv/bin/python benchmarks/compare_jax.py --require       and fail below the limits
    .venv/bin/python benchmarks/compare_jax.py --write         and docs/benchmarks.md
    .venv/bin/python benchmarks/compare_jax.py --write Epidemic    and only its row there
    .venv/bin/python benchmarks/compare_jax.py --turns 3       the median of three measurements of each
    .venv/bin/python benchmarks/compare_jax.py --threads 2     with so many instead of one

Measures the instance of median size of each problem of rddlrepository; those that pyRDDLGym-jax does not run are
reported with its reason. Each is a run of `rddl bench --against=jax`: jax after its compilation, then ours in 64
bits, each at its best batch size; and one of ours in 32 bits (--real=float), in which jax computes by default.
With one thread, steps are reported for a second of processor time, which other programs on the machine do
not inflate. jax checks neither ends of episodes nor preconditions; ours ends episodes. The time to the
first step is that of a program that is given the files: for jax to import it (listed separately in the
table), to read the files and to compile a single step; for us to compile, twice. The code that all
simulators link is compiled before, as pyRDDLGym-jax is installed before.

Measurements are kept in a file (--results), so that an interrupted run continues where it was; --fresh
measures everything again. A problem that takes longer than --limit is given up.

Limits, of each problem: a ratio of at least 10, both in 32 bits; and a first step that is sooner.
"""

import argparse
import subprocess
import sys
from dataclasses import dataclass, replace
from pathlib import Path
from statistics import median

from bench import Results, bench, geometric_mean
from document import ROOT, machine_text, markdown_table, parts_around, write_section

sys.path.append(str(ROOT / "tests/conformance"))

from problems import CORE, Case, all_problems, repository_cases, spread_by_size  # noqa: E402

LEAST_RATIO = 10.0
OUR_BATCHES = "64,256,1024,4096"


@dataclass
class Comparison:
    """The figures of one instance."""

    label: str
    threads: int
    jax_version: str
    jax: float  # steps per second of the best batch
    doubles: float  # ours
    floats: float | None  # nothing where --real=float is not possible
    our_first_step: float  # seconds
    jax_first_step: float  # once it is imported
    jax_import: float

    @property
    def is_sooner(self) -> bool:
        return self.our_first_step < self.jax_import + self.jax_first_step

    @property
    def doubles_ratio(self) -> float:
        return self.doubles / self.jax

    @property
    def floats_ratio(self) -> float | None:
        return self.floats and self.floats / self.jax


@dataclass
class NotRun:
    """An instance that pyRDDLGym-jax does not run."""

    label: str
    threads: int
    reason: str


def best_rate(measurements: list[dict], threads: int) -> float:
    """The best rate, with one thread in processor time, which other programs on the machine do not
    inflate."""
    time = "processor_seconds" if threads == 1 else "seconds"
    return max(m["steps"] / m[time] for m in measurements if m["threads"] == threads)


def compare(case: Case, options: argparse.Namespace) -> Comparison | NotRun:
    """The median of each figure, of `--turns` measurements: rates of jax differ by a tenth from run to run."""
    turns = []
    for _ in range(options.turns):
        figures = compare_once(case, options)
        if isinstance(figures, NotRun):
            return figures
        turns.append(figures)
    return median_of(turns)


def median_of(turns: list[Comparison]) -> Comparison:
    measured = ("jax", "doubles", "floats", "our_first_step", "jax_first_step", "jax_import")
    values = {name: [getattr(turn, name) for turn in turns] for name in measured}
    return replace(turns[0], **{name: median(values[name]) for name in measured if values[name][0] is not None})


def compare_once(case: Case, options: argparse.Namespace) -> Comparison | NotRun:
    common = [case.domain_path, case.instance_path, "--batch", OUR_BATCHES]
    common += ["--seconds", options.seconds, "--threads", options.threads]
    peer_options = ["--against=jax", "--python", options.jax_python]
    try:
        doubles = bench(options.rddl, *common, *peer_options, limit=options.limit)
    except RuntimeError as error:
        return NotRun(case.label, options.threads, reason_of(str(error)))
    (peer,) = doubles["peers"]
    return Comparison(
        case.label,
        options.threads,
        peer["version"],
        best_rate(peer["measurements"], options.threads),
        best_rate(doubles["measurements"], options.threads),
        rate_in_floats(common, options),
        doubles["first_step_seconds"],
        peer["first_step_seconds"],
        peer["import_seconds"],
    )


def rate_in_floats(arguments: list, options: argparse.Namespace) -> float | None:
    try:
        figures = bench(options.rddl, *arguments, "--real=float")
    except RuntimeError as error:
        if "--real=float is not possible" in str(error):
            return None
        raise
    return best_rate(figures["measurements"], options.threads)


def reason_of(message: str) -> str:
    """Returns a reason that fits into the table; RuntimeError if pyRDDLGym-jax is not the reason."""
    begin = "pyRDDLGym-jax cannot run this problem: "
    if begin not in message and not message.startswith("no figures within"):
        raise RuntimeError(message)
    lines = message.split(begin)[-1].split("hint:")[0].splitlines()
    words = " ".join(" ".join(lines).replace("|", "/").split())
    return words if len(words) <= 160 else words[:157] + "..."


def prepare(case: Case, options: argparse.Namespace) -> None:
    """The first use of rddl on a machine compiles what is the same for all simulators."""
    command = [options.rddl, "run", case.domain_path, case.instance_path, "--no-cache", "--horizon", "1"]
    subprocess.run(list(map(str, command)), stdout=subprocess.DEVNULL, check=True)


def median_case(problem: str) -> Case:
    cases = spread_by_size(repository_cases(problem), 3)
    return cases[len(cases) // 2]


def saved_results(path: Path, fresh: bool) -> Results:
    def entry_of(**fields) -> Comparison | NotRun:
        return NotRun(**fields) if "reason" in fields else Comparison(**fields)

    return Results(path, fresh, entry_of, lambda entry: (entry.label, entry.threads))


TITLES = ("instance", "jax", "rddlc, doubles", "ratio", "rddlc, floats", "ratio")
TIME_TITLES = ("jax's import", "its first step", "rddlc's")


def row_of(c: Comparison) -> tuple[str, ...]:
    speeds = (f"{c.jax:,.0f}", f"{c.doubles:,.0f}", f"{c.doubles_ratio:.1f}")
    seconds = (c.jax_import, c.jax_first_step, c.our_first_step)
    floats = (f"{c.floats:,.0f}", f"{c.floats_ratio:.1f}") if c.floats else ("-", "-")
    return (c.label, *speeds, *floats, *(f"{value:.2f} s" for value in seconds))


def summary_rows(comparisons: list[Comparison]) -> list[tuple[str, ...]]:
    rows = [("ratio", "geometric mean", "at least 10", "least", "of")]
    for name, ratio in (("floats", "floats_ratio"), ("doubles", "doubles_ratio")):
        measured = [comparison for comparison in comparisons if getattr(comparison, ratio)]
        ordered = sorted(measured, key=lambda comparison: getattr(comparison, ratio))
        ratios = [getattr(comparison, ratio) for comparison in ordered]
        enough = sum(value >= LEAST_RATIO for value in ratios)
        counts = f"{enough} of {len(ratios)}"
        rows.append((name, f"{geometric_mean(ratios):.1f}", counts, f"{ratios[0]:.1f}", ordered[0].label))
    ordered = sorted(comparisons, key=lambda c: (c.jax_import + c.jax_first_step) / c.our_first_step)
    ratios = [(c.jax_import + c.jax_first_step) / c.our_first_step for c in ordered]
    sooner = f"{sum(c.is_sooner for c in comparisons)} of {len(comparisons)} are sooner"
    rows.append(("first step", f"{geometric_mean(ratios):.1f}", sooner, f"{ratios[0]:.1f}", ordered[0].label))
    return rows


def shortfalls(comparisons: list[Comparison]) -> list[str]:
    """Returns the figures below their limit, a line each."""
    slow = [c for c in comparisons if c.floats_ratio and c.floats_ratio < LEAST_RATIO]
    lines = [f"{c.label}: the ratio in floats, {c.floats_ratio:.1f}, is below {LEAST_RATIO:g}" for c in slow]
    return lines + [f"{c.label}: the first step is not sooner" for c in comparisons if not c.is_sooner]


def comparison_of(row: str, jax_version: str) -> Comparison:
    """The figures of a row that `row_of` has written."""
    label, *cells = (cell.strip() for cell in row.strip("| ").split("|"))
    numbers = [None if cell == "-" else float(cell.replace(",", "").removesuffix(" s")) for cell in cells]
    jax, doubles, _, floats, _, jax_import, jax_first_step, our_first_step = numbers
    return Comparison(label, 1, jax_version, jax, doubles, floats, our_first_step, jax_first_step, jax_import)


def not_run_of(line: str) -> NotRun:
    """The instance of a line below the table."""
    label, reason = line.removeprefix("* ").split(": ", 1)
    return NotRun(label, 1, reason)


def documented_comparisons(jax_version: str) -> list[Comparison]:
    """The rows of the document."""
    lines = parts_around("jax by problem")[2].splitlines()
    return [comparison_of(row, jax_version) for row in [line for line in lines if line.startswith("|")][2:]]


def with_kept_lines(new: list[Comparison | NotRun], jax_version: str) -> list[Comparison | NotRun]:
    """What the document says of other instances, and the new entries, by name."""
    lines = parts_around("jax by problem")[2].splitlines()
    kept = documented_comparisons(jax_version)
    kept += [not_run_of(line) for line in lines if line.startswith("* ")]
    labels = {entry.label for entry in new}
    return sorted([*new, *(entry for entry in kept if entry.label not in labels)], key=lambda entry: entry.label)


def write_document(entries: list[Comparison | NotRun]) -> None:
    comparisons = [entry for entry in entries if isinstance(entry, Comparison)]
    not_run = [entry for entry in entries if isinstance(entry, NotRun)]
    about = f"{machine_text()}; pyRDDLGym-jax {comparisons[0].jax_version}; {len(comparisons)} instances"
    write_section("jax", f"{about}:\n\n{markdown_table(summary_rows(comparisons))}")
    table = markdown_table([(*TITLES, *TIME_TITLES), *map(row_of, comparisons)])
    reasons = "".join(f"\n* {entry.label}: {entry.reason}" for entry in not_run)
    write_section("jax by problem", f"{table}\n\nNot run by it:\n{reasons or 'none'}")


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problems", nargs="*", help="names of problems of rddlrepository (all)")
    parser.add_argument("--rddl", type=Path, default=ROOT / "build/bin/rddl", help="our program")
    default = ROOT / ".jaxvenv/bin/python"
    parser.add_argument("--jax-python", type=Path, default=default, help="Python with pyRDDLGym-jax")
    parser.add_argument("--seconds", type=float, default=0.5, help="of each measurement")
    parser.add_argument("--turns", type=int, default=1, help="measurements of each problem, of which the median counts")
    parser.add_argument("--limit", type=float, default=240, help="seconds for a problem, until it is given up")
    parser.add_argument("--threads", type=int, default=1, help="of both")
    default = ROOT / "build/benchmarks/compare_jax.jsonl"
    parser.add_argument("--results", type=Path, default=default, help="file that keeps the figures")
    parser.add_argument("--fresh", action="store_true", help="measure again what the file has")
    parser.add_argument("--require", action="store_true", help="fail below the limits")
    parser.add_argument("--write", action="store_true", help="write docs/benchmarks.md; of named problems, their rows")
    options = parser.parse_args()
    if options.write and options.threads != 1:
        parser.error("--write is for one thread")
    if options.turns < 1:
        parser.error("--turns must be at least 1")
    return options


def measure_missing(cases: list[Case], results: Results, options: argparse.Namespace) -> list[str]:
    """Returns the measurements that failed, a line each."""
    failures = []
    for number, case in enumerate(cases, 1):
        key = (case.label, options.threads)
        if key not in results.entries:
            try:
                results.add(compare(case, options))
            except RuntimeError as error:
                failures.append(f"{case.label}: {error}")
                print(failures[-1], flush=True)
                continue
        entry = results.entries[key]
        text = "  ".join(row_of(entry)) if isinstance(entry, Comparison) else f"{entry.label}: {entry.reason}"
        print(f"{number}/{len(cases)}  {text}", flush=True)
    return failures


def main() -> int:
    options = parse_arguments()
    cases = [median_case(problem) for problem in options.problems or all_problems()]
    results = saved_results(options.results, options.fresh)
    if any((case.label, options.threads) not in results.entries for case in cases):
        prepare(median_case(CORE[0]), options)
    failures = measure_missing(cases, results, options)
    keys = [(case.label, options.threads) for case in cases]
    entries = [results.entries[key] for key in keys if key in results.entries]
    comparisons = [entry for entry in entries if isinstance(entry, Comparison)]
    if not comparisons:
        return 1
    print("", *("  ".join(row) for row in summary_rows(comparisons)), sep="\n")
    short = shortfalls(comparisons)
    print(*short, sep="\n")
    if options.write:
        write_document(with_kept_lines(entries, comparisons[0].jax_version) if options.problems else entries)
    return 1 if failures or (options.require and short) else 0


if __name__ == "__main__":
    sys.exit(main())
