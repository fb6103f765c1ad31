"""Every diagnostic code has a page and a test, and no page or test has a code that does not exist.

The tests of a code are the case folders that mark it, and the tests in tests/robustness if RDDL
alone cannot cause it: files that are missing, too large, not writable.
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CODE = re.compile(r"\b([EW][0-9]{4})\b")
# "inline constexpr Code wrong_arity{'E', 203};"
CONSTANT = re.compile(r"\bCode\s+(\w+)\{'([EW])',\s*([0-9]+)\}")
# Codes in tests/robustness that do not exist: explaining them is refused.
NO_CODES = {"E9999"}


def declared() -> dict[str, str]:
    """Each code's constant."""
    codes: dict[str, str] = {}
    for header in sorted((ROOT / "compiler").glob("*/codes.hpp")):
        for name, letter, number in CONSTANT.findall(header.read_text()):
            code = f"{letter}{int(number):04}"
            place = f"{header.relative_to(ROOT)}: {name}"
            assert code not in codes, f"{code} is both {codes[code]} and {place}"
            codes[code] = place
    return codes


def pages() -> dict[str, str]:
    return {page.stem: str(page.relative_to(ROOT)) for page in (ROOT / "docs/diagnostics").glob("*.md")
            if page.name != "README.md"}


def tested() -> dict[str, str]:
    """Each code's last test."""
    codes: dict[str, str] = {}
    for path in sorted((ROOT / "tests/cases").glob("*/*.rddl")):
        for code in re.findall(r"// (?:error|warning) ([EW][0-9]{4}): ", path.read_text(errors="replace")):
            codes[code] = str(path.relative_to(ROOT))
    for path in sorted((ROOT / "tests/robustness").glob("test_*.py")):
        for code in CODE.findall(path.read_text()):
            codes[code] = str(path.relative_to(ROOT))
    return {code: path for code, path in codes.items() if code not in NO_CODES}


def main() -> int:
    codes, documented, covered = declared(), pages(), tested()
    complaints = []
    for code, place in sorted(codes.items()):
        if code not in documented:
            complaints.append(f"{place}: {code} has no page docs/diagnostics/{code}.md")
        if code not in covered:
            complaints.append(f"{place}: {code} has no case in tests/cases")
    for kind in documented, covered:
        complaints += [f"{path}: there is no diagnostic {code}"
                       for code, path in sorted(kind.items()) if code not in codes]
    for page in sorted((ROOT / "docs/diagnostics").glob("*.md")):
        for code in sorted(set(CODE.findall(page.read_text())) - set(codes)):
            complaints.append(f"{page.relative_to(ROOT)}: there is no diagnostic {code}")
    print("\n".join(complaints))
    print(f"{len(codes)} codes, {len(documented)} pages, {len(covered)} tested, {len(complaints)} complaints")
    assert len(codes) > 50, "the check looked at nothing"
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
