"""No switch over an enumeration of ours has a default: what is added to the enumeration would pass unseen.

The compiler complains of a forgotten enumerator (-Wswitch, an error in tests) only where there is no default. Switches
over the token types of the generated parser are left alone: they are numbers, and what is not named is meant.
"""

import re
import sys
from pathlib import Path

FOLDERS = ["compiler", "cli", "planners", "python", "render", "runtime", "solvers", "support", "workbench"]
OURS = re.compile(r"^\s*case (?!Parser::|Lexer::|Token::)(?:[A-Za-z_]+::)*[A-Za-z_]\w*:")


def complaints_in(path: Path, name: str) -> tuple[int, list[str]]:
    """How many switches there are, and which are wrong."""
    switches, found = [], []
    seen = 0
    for number, line in enumerate(path.read_text().splitlines(), 1):
        indent = len(line) - len(line.lstrip())
        while switches and line.strip() and indent <= switches[-1][0] and not line.lstrip().startswith(("case", "default")):
            switches.pop()
        if re.match(r"\s*switch \(", line):
            switches.append([indent, False])
            seen += 1
        elif OURS.match(line) and switches:
            switches[-1][1] = True
        elif re.match(r"\s*default:", line) and switches and switches[-1][1]:
            found.append(f"{name}:{number}: a switch over an enumeration has a default; name the enumerators")
    return seen, found


def main() -> int:
    root = Path(__file__).resolve().parents[2]
    seen, found = 0, []
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in {".cpp", ".hpp", ".h"}:
                count, complaints = complaints_in(path, str(path.relative_to(root)))
                seen += count
                found += complaints
    if seen < 50:
        found.append(f"only {seen} switches were looked at")
    print("\n".join(found) or f"none of {seen} switches has such a default")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
