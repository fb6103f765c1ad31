"""The pages of the documentation, and the fenced blocks in them with their marks.

CONTRIBUTING.md ("a page") says what languages and marks mean.
"""

import re
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DIAGNOSTICS = ROOT / "docs/diagnostics"

# The languages of commands and of their output. Other languages are quoted.
RUN, PRINTED = "console", "text"
MARKS = ("file", "files of", "not run", "loosely")

FENCE = re.compile(r"^( *)```(.*)$")
MARK = re.compile(rf"^ *<!-- ({'|'.join(MARKS)}): (.+) -->$")
COMMAND = re.compile(r"^\$ ")
# The first line of a block that is a file, where a page is printed as it stands.
NAMED = re.compile(r"^// ([\w-]+\.(?:rddl|hpp))$")


@dataclass
class Block:
    page: Path
    line: int  # of the opening fence
    indentation: str
    language: str
    lines: list[str] = field(default_factory=list)
    marks: dict[str, str] = field(default_factory=dict)

    @property
    def place(self) -> str:
        return f"{self.page.relative_to(ROOT) if self.page.is_relative_to(ROOT) else self.page}:{self.line}"

    @property
    def text(self) -> str:
        return "".join(line + "\n" for line in self.lines)


@dataclass
class Exchange:
    """One command of a session, and what the page says that it prints."""

    command: str
    first: int  # lines of the block: the command's, and from the first to the last of its output
    begin: int
    end: int
    output: str


def pages() -> list[Path]:
    others = ["README.md", "CONTRIBUTING.md", "examples/README.md", "editors/README.md"]
    return [*(ROOT / name for name in others), *sorted((ROOT / "docs").glob("*.md")),
            *sorted((ROOT / "docs/results").glob("*.md"))]


def pages_of_diagnostics() -> list[Path]:
    """--explain prints them as they stand, so they have no marks."""
    return sorted(DIAGNOSTICS.glob("*.md"))


def files(page: Path) -> list[Block]:
    """The blocks that are files."""
    return [block for block in blocks(page) if "file" in block.marks]


def blocks(page: Path) -> list[Block]:
    found: list[Block] = []
    marks: dict[str, str] = {}
    inside = None
    for number, line in enumerate(page.read_text().splitlines(), 1):
        fence = FENCE.match(line)
        if inside and fence and fence[1] == inside.indentation and not fence[2]:
            inside = None
        elif inside:
            inside.lines.append(line.removeprefix(inside.indentation))
            if len(inside.lines) == 1 and (name := NAMED.match(line)):
                inside.marks.setdefault("file", name[1])
        elif fence:
            inside = Block(page, number, fence[1], fence[2].strip(), marks=marks)
            found.append(inside)
            marks = {}
        elif mark := MARK.match(line):
            marks[mark[1]] = mark[2]
        elif line.strip() and marks:
            raise ValueError(f"{page}:{number}: a mark stands above a block, not above '{line}'")
    assert inside is None, f"{page}: the last block has no end"
    return found


def exchanges(block: Block) -> list[Exchange]:
    """Returns the commands of a session, each with its output. Lines that end in a backslash
    continue."""
    found: list[Exchange] = []
    at = 0
    while at < len(block.lines):
        first = at
        if not COMMAND.match(block.lines[at]):
            raise ValueError(f"{block.place}: a session begins with '$ ', not with '{block.lines[at]}'")
        while block.lines[at].endswith("\\"):
            at += 1
        at += 1
        begin = at
        while at < len(block.lines) and not COMMAND.match(block.lines[at]):
            at += 1
        command = "\n".join(block.lines[first:begin])[2:]
        output = "".join(line + "\n" for line in block.lines[begin:at])
        found.append(Exchange(command, first, begin, at, output))
    return found
