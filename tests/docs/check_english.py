"""Finds habits of English over which readers stumble, in the pages and in the comments of the sources.

    check_english.py [--count] [FILE...]

CONTRIBUTING.md asks for whole short sentences with the subject first. HABITS is the list of what breaks that most
often. Code, output and quotations are not read.
"""

import argparse
import os
import re
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from pages import ROOT

# What to look for, and what to write in its place. A pattern is matched within a line.
HABITS = {
    r"\b[Ww]ho(m|so)?ever\b": "name the subject: 'a user that', 'each'",
    r"\b[Nn]obody\b": "use a verb with 'not', or the passive",
    r"(?<![Tt]here )\b(is|are|was|were) none\b": "'is not one', 'means no'",
    r", too\b(?! (?:many|much|few|little|large|small|long|short|slow|far|late|early|big|deep|high|low|old|new))": "'also'",
    r"\bbut for\b": "'except'",
    r"\bby heart\b": "'memorise'",
    r"\bin vain\b": "'without success'",
}
# The first words of a comment or of a cell that leave its noun to the line above. Only comments are read for it.
FRAGMENT = re.compile(r"^(Of|Those|That of|What|Whom)\b(?! (?:is|are|does|do|if)\b.*\?)")

# Folders with files that programs have written.
NOT_WRITTEN = {"generated", "parser", "node_modules"}
SOURCES = {".cpp", ".hpp", ".h"}
COMMENT = re.compile(r"(?:^|\s)//+ ?(.*)$")


@dataclass
class Line:
    place: str
    text: str
    begins: bool  # whether a comment begins here


def files_of_ours() -> list[Path]:
    found = []
    for folder, inner, names in os.walk(ROOT):
        inner[:] = sorted(name for name in inner if not name.startswith((".", "build", "runs")) and name not in NOT_WRITTEN)
        found += [Path(folder) / name for name in sorted(names) if Path(name).suffix in {*SOURCES, ".md"}]
    return found


def lines_of_page(path: Path, name: str) -> Iterator[Line]:
    inside = False
    for number, line in enumerate(path.read_text().splitlines(), 1):
        fence = line.strip().startswith("```")
        if not inside and not fence:
            yield Line(f"{name}:{number}", re.sub(r'`[^`]*`|"[^"]*"', "", line), False)
        inside ^= fence


def lines_of_source(path: Path, name: str) -> Iterator[Line]:
    before = False
    for number, line in enumerate(path.read_text().splitlines(), 1):
        comment = COMMENT.search(line)
        if comment and line.count('"', 0, comment.start()) % 2 == 0:
            own = line.strip().startswith("//")
            yield Line(f"{name}:{number}", comment[1], not (own and before))
            before = own
        else:
            before = False


def complaints(path: Path) -> list[tuple[str, str]]:
    """Pairs of a habit and of the line that has it."""
    name = str(path.relative_to(ROOT)) if path.is_relative_to(ROOT) else str(path)
    found = []
    for line in (lines_of_page if path.suffix == ".md" else lines_of_source)(path, name):
        for pattern, better in HABITS.items():
            if match := re.search(pattern, line.text):
                found.append((match[0].strip(), f"{line.place}: '{match[0].strip()}': {better}\n    {line.text.strip()}"))
        if line.begins and (match := FRAGMENT.match(line.text)):
            found.append((match[0], f"{line.place}: a fragment that begins with '{match[0]}': name the thing\n    {line.text.strip()}"))
    return found


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", action="store_true", help="only count each habit")
    parser.add_argument("files", nargs="*", type=Path)
    options = parser.parse_args()
    files = [path.resolve() for path in options.files] or files_of_ours()
    found = [each for path in files for each in complaints(path)]
    if options.count:
        print("\n".join(f"{count:5} {habit}" for habit, count in Counter(habit for habit, _ in found).most_common()))
        folders = Counter(text.split("/")[0] for _, text in found)
        print("\n".join(f"{count:5} {folder}" for folder, count in folders.most_common()))
    else:
        print("\n".join(text for _, text in found))
    print(f"{len(files)} files, {len(found)} complaints")
    assert len(files) > 0, "nothing was read"
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
