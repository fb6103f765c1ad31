"""The rules of docs/semantics.md are numbered, each has a case in docs/semantics-cases.md, and whoever cites one ("Semantics
6.2") cites one that is there. The cases that the page names exist; each case meaning-* is there, and names its rules."""

import re
import sys
from pathlib import Path

NUMBER = r"\d+\.\d+"
CITATION = re.compile(rf"\bSemantics (\d[\d.]*(?:, \d[\d.]*)*)")
FIRST_LINE = re.compile(r"// Semantics \d")
FOLDERS = ["benchmarks", "cli", "compiler", "docs", "grammar", "planners", "python", "render", "runtime", "solvers", "support", "templates", "tests"]
TEXTS = {".cpp", ".hpp", ".h", ".py", ".md", ".rddl", ".g4", ".in", ".txt"}


def first_line(case: Path) -> str:
    """A line of the domain."""
    domain = case / "domain.rddl"
    file = domain if domain.exists() else case / "problem.rddl"
    return file.read_text().splitlines()[0]


def rules(root: Path) -> list[str]:
    return re.findall(rf"^\*\*({NUMBER})\*\* ", (root / "docs/semantics.md").read_text(), re.M)


def citations(root: Path) -> list[tuple[str, str]]:
    """Files and the numbers that they cite."""
    found = []
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in TEXTS and path.is_file():
                text = path.read_text(errors="replace")
                found += [(str(path.relative_to(root)), number.rstrip(".")) for match in CITATION.finditer(text)
                          for number in match[1].split(", ")]
    return found


def complaints_about_rules(root: Path, tested: set[str]) -> list[str]:
    known = rules(root)
    in_order = sorted(known, key=lambda number: [int(part) for part in number.split(".")])
    found = [] if len(known) > 40 else ["docs/semantics.md is not understood"]
    if known != in_order or len(set(known)) < len(known):
        found.append("docs/semantics.md: numbers are not in order")
    found += [f"docs/semantics-cases.md: rule {number} has no case" for number in known if number not in tested]
    found += [f"docs/semantics-cases.md: there is no rule {number}" for number in sorted(tested - set(known))]
    cited = citations(root)
    found += [f"{file}: there is no rule {number}" for file, number in cited if number not in known]
    if len(cited) < 45:
        found.append(f"only {len(cited)} citations were found")
    return found


def complaints(root: Path) -> list[str]:
    page = (root / "docs/semantics-cases.md").read_text()
    rows = re.findall(r"^\| (\d[\d.]*) \|.*\|(.*)\|$", page, re.M)
    named = {name for _, cases in rows for name in re.findall(r"`([\w-]+)`", cases)}
    cases = root / "tests/cases"
    there = {folder.name for folder in cases.glob("meaning-*")}
    found = complaints_about_rules(root, {number for number, cases_of_rule in rows if "`" in cases_of_rule})
    found += [f"docs/semantics-cases.md: there is no case {name}" for name in sorted(named)
              if not (cases / name).is_dir()]
    found += [f"docs/semantics-cases.md: {name} is missing" for name in sorted(there - named)]
    found += [f"tests/cases/{name}: the domain does not begin with '// Semantics N: ...'"
              for name in sorted(there) if not FIRST_LINE.match(first_line(cases / name))]
    if not rows or not there:
        found.append("nothing was looked at")
    return found


if __name__ == "__main__":
    problems = complaints(Path(__file__).resolve().parents[2])
    print("\n".join(problems) or "every rule has its cases")
    sys.exit(1 if problems else 0)
