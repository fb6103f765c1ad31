"""The table of a run, for the terminal and for docs/results/conformance.md."""

from importlib.metadata import version

from problems import ROOT

DOCUMENT = ROOT / "docs/results/conformance.md"
BEGIN, END = "<!-- begin of the table -->", "<!-- end of the table -->"
MOST_FAILURES = 8

HEAD = ("instance", "steps", "values", "worst difference", "draws", "tests", "least p", "faults", "result")
RULE = ("---", *("---:" for _ in HEAD[1:]))
WIDTHS = (34, 5, 7, 16, 8, 6, 8, 6, 10)


def cells(report) -> tuple[str, ...]:
    findings = list(report.findings.values())
    values = max((f.exact_values for f in findings), default=0)
    worst = max((f.worst_difference for f in findings), default=0.0)
    tests = max((len(f.tests) for f in findings), default=0)
    least = min((p for f in findings for p, _ in f.tests), default=1.0)
    return (
        report.case.label,
        str(report.transitions),
        str(values),
        f"{worst:.1e}" if worst else "0",
        f"{report.draw_points} x {report.draws}" if report.draw_points else "-",
        str(tests) if tests else "-",
        f"{least:.0e}" if tests else "-",
        str(report.refusals) if report.refusals else "-",
        "DISAGREES" if report.failures else "agrees",
    )


def line(texts) -> str:
    first, *others = (text for text in texts)
    padded = [first.ljust(WIDTHS[0])]
    padded += [text.rjust(width) for text, width in zip(others, WIDTHS[1:])]
    return "  ".join(padded)


def table_head() -> str:
    return line(HEAD)


def row_text(report) -> str:
    return line(cells(report)) + f"  {report.seconds:.1f} s"


def failure_text(report) -> str:
    shown = report.failures[:MOST_FAILURES]
    if len(report.failures) > len(shown):
        shown = [*shown, f"and {len(report.failures) - len(shown)} more"]
    return "".join(f"    {failure}\n" for failure in shown)


def write_document(reports) -> None:
    """Replaces the rows of these instances and keeps the others."""
    before, rest = DOCUMENT.read_text().split(BEGIN)
    table, after = rest.split(END)
    lines = [line.strip("| ").split(" | ") for line in table.splitlines() if line.startswith("|")]
    rows = {row[0]: row for row in lines[2:]}
    rows |= {report.case.label: cells(report) for report in reports}
    ordered = sorted(rows.values(), key=lambda row: natural_order(row[0]))
    text = "\n".join("| " + " | ".join(row) + " |" for row in (HEAD, RULE, *ordered))
    versions = ", ".join(f"{name} {version(name)}" for name in ("pyRDDLGym", "rddlrepository"))
    DOCUMENT.write_text(f"{before}{BEGIN}\n\n{versions}:\n\n{text}\n\n{END}{after}")
    print(f"written: {len(reports)} of {len(rows)} rows of {DOCUMENT}")


def natural_order(label: str) -> tuple[str, int, str]:
    """Sorts by problem, then by the number of the instance."""
    problem, _, instance = label.rpartition(" ")
    return problem, int(instance) if instance.isdecimal() else 0, instance
