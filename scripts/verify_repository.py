#!/usr/bin/env python3
"""`rddl verify` on the first instance of every problem of rddlrepository, with a table.

    scripts/verify_repository.py [--rddl build/bin/rddl] [--out build/verify] [NAME...] [-- OPTIONS]

OPTIONS are those of `rddl verify`. Results are kept in the folder --out, a file for each problem: an interrupted
run continues later; problems that agreed with this very program are not verified again. Status 0: all agree.
"""

import argparse
import hashlib
import json
import subprocess
import sys
from pathlib import Path

from repository import add_problems, problems, split_options


def main():
    words, options = split_options(sys.argv[1:])
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=Path("build/verify"))
    parser.add_argument("--anew", action="store_true", help="verify all again")
    parser.add_argument(
        "--need-pyrddlgym", action="store_true", help="fail where pyRDDLGym is not compared"
    )
    add_problems(parser)
    arguments = parser.parse_args(words)
    arguments.out.mkdir(parents=True, exist_ok=True)

    print("| problem | steps | values | pyRDDLGym | result |\n| --- | ---: | ---: | --- | --- |")
    reports = []
    program = hashlib.sha256(arguments.rddl.read_bytes()).hexdigest()
    asked = {"options": options, "program": program}
    for problem in problems(arguments):
        name, instance = problem["name"], problem["instances"][0]
        report = report_of(arguments, name, instance, asked)
        reports.append(report)
        print(row(f"{name} {instance}", report), flush=True)
    wrong = sum(not report.get("agree") for report in reports)
    alone = sum("values" not in report.get("pyrddlgym", {}) for report in reports)
    print(f"\n{len(reports)} problems, {wrong} of them do not agree;", totals(reports))
    return 1 if wrong or not reports or (arguments.need_pyrddlgym and alone) else 0


def report_of(arguments, name, instance, asked):
    kept = arguments.out / f"{name}.json"
    if kept.exists() and not arguments.anew:
        report = json.loads(kept.read_text())
        if report.get("agree") and report["asked"] == asked:
            return report
    command = [arguments.rddl, "verify", name, instance, "--json", *asked["options"]]
    result = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    if result.returncode == 130:
        sys.exit(130)
    try:
        report = json.loads(result.stdout)
    except ValueError:
        report = {"agree": False, "failure": (result.stderr.strip() or "no output").splitlines()[0]}
    if "complaint" in report:
        report["failure"] = f"{report['pass']}: {report['complaint']}"
    report["asked"] = asked
    kept.write_text(json.dumps(report, indent=2) + "\n")
    return report


def row(problem, report):
    if "failure" in report:
        return f"| {problem} | | | | {report['failure']} |"
    compared = report.get("pyrddlgym")
    if compared is None:
        other = "-"
    elif "not_compared" in compared:
        other = "not compared: " + compared["not_compared"]
    else:
        other = f"{compared['values']['total']:,} values of {compared['steps']} steps"
        left_out = compared["left_out"]
        other += f", {left_out} left out" if left_out else ""
    result = "agrees"
    if not report["agree"]:
        difference = report["difference"]
        found, expected = difference["found"], difference["expected"]
        result = f"{difference['what']}: {expected['value']} ({expected['engine']}), "
        result += f"{found['value']} ({found['engine']})"
    return f"| {problem} | {report['steps']:,} | {report['values']['total']:,} | {other} | {result} |"


def totals(reports):
    told = [report for report in reports if "failure" not in report]
    steps = sum(report["steps"] for report in told)
    values = sum(report["values"]["total"] for report in told)
    others = [r["pyrddlgym"] for r in told if "values" in r.get("pyrddlgym", {})]
    text = f"{values:,} values of {steps:,} steps"
    if others:
        count = sum(other["values"]["total"] for other in others)
        text += f"; {count:,} values of {len(others)} problems with pyRDDLGym"
    return text


if __name__ == "__main__":
    sys.exit(main())
