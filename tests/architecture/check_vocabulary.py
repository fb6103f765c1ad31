"""What cannot be made from the tables of operators and distributions, because it is read by people, by other
programs or before they exist, says what the tables say: the grammar's reserved words, the editors' words, the page of
distributions, and what the fuzzer draws from."""

import json
import re
import sys
from pathlib import Path

ROW = re.compile(r'\{\.distribution = Distribution::\w+, \.name = "(\w+)".*?(?=\n    \{\.dist|\n\};)', re.S)
# Their result is their parameter: the fuzzer has no use for them.
DELTAS = {"KronDelta", "DiracDelta"}


def distributions(root: Path) -> dict[str, bool]:
    """Whether each is an extension."""
    text = (root / "compiler/vocabulary/distributions.cpp").read_text()
    return {row[1]: ".extension = true" in row[0] for row in ROW.finditer(text)}


def enumerators(root: Path, enumeration: str) -> list[str]:
    header = (root / "compiler/vocabulary/vocabulary.hpp").read_text()
    body = re.search(rf"enum class {enumeration} : [\w:]+ \{{(.*?)\}};", header, re.S)[1]
    return re.findall(r"\w+", re.sub(r"//.*", "", body))


def complaints(root: Path) -> list[str]:
    table = distributions(root)
    found = [] if len(table) > 20 else ["distributions.cpp is not understood"]
    for enumeration, file in [("Operator", "operators.cpp"), ("Distribution", "distributions.cpp")]:
        text = (root / "compiler/vocabulary" / file).read_text()
        rows = re.findall(rf"^    \{{\.\w+ = {enumeration}::(\w+),", text, re.M)
        if rows != enumerators(root, enumeration):
            found.append(f"compiler/vocabulary/{file}: the rows are not the enumerators of {enumeration}, in their order")
    grammar = (root / "grammar/RDDL.g4").read_text()
    reserved = set(re.findall(r"'(\w+)'", re.search(r"\nDISTRIBUTION\n(.*?);", grammar, re.S)[1]))
    for name in sorted(reserved ^ {name for name, extension in table.items() if not extension}):
        found.append(f"grammar/RDDL.g4: DISTRIBUTION and the table differ in {name}")
    places = {
        "docs/distributions.md": lambda name: rf"\| `{name}\(",
        "tests/fuzz/distributions.py": lambda name: rf"\b{name}\b",
        "editors/vscode/syntaxes/rddl.tmLanguage.json": lambda name: rf"[|:]{name}[|)]",
    }
    for place, form in places.items():
        text = (root / place).read_text()
        for name in table:
            is_needed = name not in DELTAS or place.startswith("editors")
            if is_needed and not re.search(form(name), text):
                found.append(f"{place}: {name} is missing")
    json.loads((root / "editors/vscode/syntaxes/rddl.tmLanguage.json").read_text())
    return found


if __name__ == "__main__":
    problems = complaints(Path(__file__).resolve().parents[2])
    print("\n".join(problems) or "the vocabulary is the same everywhere")
    sys.exit(1 if problems else 0)
