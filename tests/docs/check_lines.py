"""Finds lines of the pages that are longer than 100 columns. With RDDLC_UPDATE=1 it breaks them.

    check_lines.py [FILE...]

Only paragraphs and items of lists are read. A row of a table, a heading, a block of code and a long word do not break.
CHANGELOG.md has one fact in one line, so that changes of several people merge.
"""

import argparse
import os
import re
import sys
from pathlib import Path

from pages import ROOT, pages, pages_of_diagnostics

WIDTH = 100
ITEM = re.compile(r"( *)(?:[*+-]|\d+[.)]) +")
# The beginnings of lines that do not continue a paragraph.
OTHER = re.compile(r" *(?:\||#|<|>|\[[^\]]+\]: |```|$)")
# The words that would begin something else at the beginning of a line.
BEGINS = re.compile(r"(?:[#>|*+=<:-].*|\d+[.)]|\[[^\]]+\]:.*|[`~]{3}.*)$")
CODE = re.compile(r"(`+)(?!`).+?(?<!`)\1(?!`)")
KEPT = "\0"  # a blank that stays


def words_of(text: str) -> list[str]:
    """Returns the words of a paragraph. Code is one word, with what touches it."""
    return [word.replace(KEPT, " ") for word in CODE.sub(lambda code: code[0].replace(" ", KEPT), text).split()]


def wrapped(lines: list[str]) -> list[str]:
    """Returns a paragraph, or an item, in lines that fit."""
    item = ITEM.match(lines[0])
    first = item[0] if item else re.match(" *", lines[0])[0]
    rest = " " * len(first)
    words = words_of(" ".join([lines[0][len(first):], *(line.strip() for line in lines[1:])]))
    out, line = [], [words[0]]
    for word in words[1:]:
        if len(first) + len(" ".join([*line, word])) <= WIDTH or BEGINS.match(word):
            line.append(word)
            continue
        # A word that was added beyond the width, since it begins something else, takes one along.
        begin = [word]
        while len(first) + len(" ".join(line)) > WIDTH and len(line) > 1 and not BEGINS.match(line[-1]):
            begin.insert(0, line.pop())
        out.append(line)
        line = begin
    out.append(line)
    return [(rest if k else first) + " ".join(each) for k, each in enumerate(out)]


def paragraphs(text: str) -> list[tuple[int, list[str], bool]]:
    """Returns the first line, the lines, and whether they may break, of each part of a page."""
    found: list[tuple[int, list[str], bool]] = []
    inside = comment = False
    for number, line in enumerate(text.splitlines()):
        fence = line.strip().startswith("```")
        is_other = inside or fence or comment or bool(OTHER.match(line))
        inside ^= fence
        comment = "<!--" in line and "-->" not in line or comment and "-->" not in line
        breaks = found[-1][1][-1].endswith(("  ", "\\")) if found else False  # a line break that is meant
        if is_other or not found or not found[-1][2] or ITEM.match(line) or breaks:
            found.append((number, [line], not is_other))
        else:
            found[-1][1].append(line)
    return found


def broken(text: str) -> str:
    lines = []
    for _, part, may_break in paragraphs(text):
        is_long = max(map(len, part)) > WIDTH
        lines += wrapped(part) if may_break and is_long else part
    return "\n".join(lines) + "\n"


def complaints(page: Path) -> list[str]:
    name = page.relative_to(ROOT) if page.is_relative_to(ROOT) else page
    found = []
    for number, part, may_break in paragraphs(page.read_text()):
        if may_break and max(map(len, part)) > WIDTH and wrapped(part) != part:
            found.append(f"{name}:{number + 1}: longer than {WIDTH} columns; RDDLC_UPDATE=1 breaks it")
    return found


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("files", nargs="*", type=Path)
    files = parser.parse_args().files or [*pages(), *pages_of_diagnostics()]
    if os.environ.get("RDDLC_UPDATE"):
        for page in files:
            page.write_text(broken(page.read_text()))
    found = [each for page in files for each in complaints(page.resolve())]
    print("\n".join(found))
    print(f"{len(files)} pages, {len(found)} complaints")
    return 1 if found or not files else 0


if __name__ == "__main__":
    sys.exit(main())
