"""The measured figures in docs/benchmarks.md, docs/lanes.md, docs/planning.md and docs/results: each benchmark owns its sections,
between markers."""

import os
import platform
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
DOCUMENTS = [ROOT / "docs" / page for page in ("benchmarks.md", "lanes.md", "planning.md", "results/benchmarks.md",
                                                "results/planning.md")]


def machine_text() -> str:
    """Processor and number of its cores that this process may use."""
    model = platform.processor() or platform.machine()
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            model = line.split(":", 1)[1].strip()
            break
    return f"{model}, {len(os.sched_getaffinity(0))} cores"


def markdown_table(rows: list[tuple[str, ...]]) -> str:
    """The first row is the head; the first column is of names, the others are of numbers."""
    head, *body = rows
    rule = ("---", *("---:" for _ in head[1:]))
    return "\n".join("| " + " | ".join(row) + " |" for row in (head, rule, *body))


def write_section(name: str, text: str) -> None:
    """Replaces the text between `<!-- begin of NAME -->` and `<!-- end of NAME -->`, in the document that has them."""
    begin, end = f"<!-- begin of {name} -->", f"<!-- end of {name} -->"
    (document,) = (each for each in DOCUMENTS if begin in each.read_text())
    before, rest = document.read_text().split(begin)
    after = rest.split(end)[1]
    document.write_text(f"{before}{begin}\n\n{text}\n\n{end}{after}")
    print(f"written: {name} in {document}")
