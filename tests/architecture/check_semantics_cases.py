"""docs/semantics-cases.md names cases that exist; each case meaning-* is there, and names its rule."""

import re
import sys
from pathlib import Path

RULE = re.compile(r"// Semantics \d")


def first_line(case: Path) -> str:
    """A line of the domain."""
    domain = case / "domain.rddl"
    file = domain if domain.exists() else case / "problem.rddl"
    return file.read_text().splitlines()[0]


def complaints(root: Path) -> list[str]:
    page = (root / "docs/semantics-cases.md").read_text()
    rows = re.findall(r"^\| \d.*\|(.*)\|$", page, re.M)
    named = {name for row in rows for name in re.findall(r"`([\w-]+)`", row)}
    cases = root / "tests/cases"
    there = {folder.name for folder in cases.glob("meaning-*")}
    found = [f"docs/semantics-cases.md: there is no case {name}" for name in sorted(named)
             if not (cases / name).is_dir()]
    found += [f"docs/semantics-cases.md: {name} is missing" for name in sorted(there - named)]
    found += [f"tests/cases/{name}: the domain does not begin with '// Semantics N: ...'"
              for name in sorted(there) if not RULE.match(first_line(cases / name))]
    if not rows or not there:
        found.append("nothing was looked at")
    return found


if __name__ == "__main__":
    problems = complaints(Path(__file__).resolve().parents[2])
    print("\n".join(problems) or "every rule has its cases")
    sys.exit(1 if problems else 0)
