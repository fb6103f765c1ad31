"""The measured figures in docs/benchmarks.md, docs/lanes.md, docs/planning.md and docs/results: each benchmark owns its sections,
between markers."""

import os
import platform
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
DOCUMENTS = [ROOT / "docs" / page for page in ("benchmarks.md", "lanes.md", "planning.md", "results/benchmarks.md",
                                                "results/planning.md")]


def machine_text() -> str:
    """Processor and number of cores of this machine, also where this process may use fewer."""
    model = platform.processor() or platform.machine()
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            model = line.split(":", 1)[1].strip()
            break
    cores = os.cpu_count()
    return f"{model}, {cores} core{'' if cores == 1 else 's'}"


def markdown_table(rows: list[tuple[str, ...]]) -> str:
    """The first row is the head; the first column is of names, the others are of numbers."""
    head, *body = rows
    rule = ("---", *("---:" for _ in head[1:]))
    return "\n".join("| " + " | ".join(row) + " |" for row in (head, rule, *body))


def parts_around(name: str) -> tuple[Path, str, str, str]:
    """The document that has that section, and its text before, in and after the section."""
    begin, end = f"<!-- begin of {name} -->", f"<!-- end of {name} -->"
    for document in DOCUMENTS:
        before, found, rest = document.read_text().partition(begin)
        if found:
            return document, before, *rest.split(end)
    names = sorted(name for each in DOCUMENTS for name in re.findall("<!-- begin of (.*) -->", each.read_text()))
    sys.exit(f"no document has a section '{name}'; there are: {', '.join(names)}")


def merged_rows(name: str, rows: list[tuple[str, ...]]) -> list[tuple[str, ...]]:
    """These rows, and the cells of other rows and columns that the table of that section has."""
    lines = [line for line in parts_around(name)[2].splitlines() if line.startswith("|") and not line.startswith("| ---")]
    tables = [[tuple(cell.strip() for cell in line.strip("|").split("|")) for line in lines], rows]
    cells = {(row[0], column): cell for head, *body in tables for row in body for column, cell in zip(head, row)}
    columns = list(dict.fromkeys(column for table in tables for column in table[0]))
    names = dict.fromkeys(row[0] for table in tables for row in table[1:])
    return [tuple(columns), *(tuple(cells.get((each, column), "") for column in columns) for each in names)]


def write_section(name: str, text: str) -> None:
    """Replaces the text between `<!-- begin of NAME -->` and `<!-- end of NAME -->`, in the document that has them."""
    document, before, _, after = parts_around(name)
    begin, end = f"<!-- begin of {name} -->", f"<!-- end of {name} -->"
    document.write_text(f"{before}{begin}\n\n{text}\n\n{end}{after}")
    print(f"written: {name} in {document}")
