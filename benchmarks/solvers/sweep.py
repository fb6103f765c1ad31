"""Which problems are played, and results that outlive a run."""

import json
from multiprocessing import Pool
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def add_options(parser):
    parser.add_argument("--rddl", default=ROOT / "build/bin/rddl")
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--context", nargs="*", help="only problems of these contexts, such as ippc2023")
    parser.add_argument("--only", help="only problems whose names contain this")
    parser.add_argument("--instances", type=int, default=1, help="so many of each problem")
    parser.add_argument("--without", default=[], nargs="*", help="instances that are left out: 0 is not one of the competition's")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=1, help="problems at the same time")
    parser.add_argument("--table", action="store_true", help="print what is there")


def chosen_instances(problems, arguments):
    """Yields what `rddl list --json` says of a problem, and the instance, for each that the options ask for."""
    for problem in problems:
        if arguments.context and problem["context"] not in arguments.context:
            continue
        if arguments.only and arguments.only not in problem["name"]:
            continue
        instances = [instance for instance in problem["instances"] if instance not in arguments.without]
        for instance in instances[:arguments.instances]:
            yield problem, instance


def read_results(arguments):
    lines = arguments.out.read_text().splitlines() if arguments.out.exists() else []
    return list(map(json.loads, lines))


def add_results(result_of, jobs, arguments):
    """Adds the result of each job to the file at once, and prints it."""
    # Processes, not threads, which Ctrl-C would wait for.
    with Pool(arguments.jobs) as pool:
        for result in pool.imap_unordered(result_of, jobs):
            line = json.dumps(result)
            with arguments.out.open("a") as file:
                file.write(line + "\n")
            print(line, flush=True)


def interval_text(mean, half_width):
    """A mean, which may be "inf" or "nan", and its half width, which may be none."""
    if not isinstance(mean, (int, float)):
        return str(mean)
    return f"{mean:.4g} ± {half_width:.2g}" if half_width else f"{mean:.4g}"

