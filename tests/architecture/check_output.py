"""Texts reach people, and numbers become texts and are read, by functions that respect terminals
and locales.

Names, paths and messages may come from strangers: print() and tell() of
support/program.hpp leave nothing in them that drives a terminal. Applications set a
locale, where printf and strtod write and read 0,5: std::to_chars, std::from_chars and fmt ignore
locales.
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ["support", "compiler", "runtime", "render", "solvers", "planners", "workbench", "cli", "python/native", "templates"]
PRINTS = re.compile(r"\bfmt::print\(|\bstd::c(out|err|log)\b|\b(std::)?(puts|fputs|putchar|printf|fprintf|perror)\(")
KNOWS_LOCALE = re.compile(r"\b(v?s?n?printf|strto(d|f|ld)|atof|setlocale|imbue)\(|\bstd::sto(d|f|ld)\b"
                          r"|\{:[^}\"]*L\}")
# Each with its reason.
PRINTERS = {
    "support/program.cpp": "print() and tell() themselves",
    "compiler/ir/verify.cpp": "a mistake of our own, before the program ends",
    "workbench/pictures/watch.cpp": "escape codes that move a terminal's cursor; its texts are printable",
}


def complaints(name: str, text: str) -> list[str]:
    found = []
    for number, line in enumerate(text.splitlines(), 1):
        code = line.split("//")[0]
        if PRINTS.search(code) and name not in PRINTERS:
            found.append(f"{name}:{number}: prints by itself: print() and tell() of support/program.hpp do that")
        if KNOWS_LOCALE.search(code):
            found.append(f"{name}:{number}: depends on the locale: std::to_chars, std::from_chars and fmt do not")
    return found


def test_itself() -> None:
    bad = ['fmt::print("{}", x);', "std::cout << x;", "std::snprintf(text, 4, form, x);", "strtod(text, nullptr)", "std::stod(x)"]
    assert all(complaints("x.cpp", line) for line in bad)
    assert not complaints("x.cpp", 'print("{}", x); // not printf(')


def main() -> int:
    test_itself()
    found, count = [], 0
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix not in {".cpp", ".hpp", ".h", ".in"} or not path.is_file():
                continue
            count += 1
            found += complaints(str(path.relative_to(ROOT)), path.read_text(errors="replace"))
    print("\n".join(found))
    print(f"{count} files, {len(found)} complaints")
    assert count > 300, "the check looked at nothing"
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
