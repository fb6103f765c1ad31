"""Checks the documentation without running it: fails for

* a block without a language, or with an unknown one (CONTRIBUTING.md lists them); pages of
  diagnostics may hold pieces of RDDL without one, but no commands, which would not be run;
* a command of rddl, or an option of rddlc or rddl, that does not exist, in blocks and in `code`;
* a link to a file, or to a heading, that is not there;
* a page of docs/ that the index, docs/README.md, does not list.

    check_text.py --bin build/bin
"""

import argparse
import functools
import re
import subprocess
import sys
from pathlib import Path

from pages import COMMAND, PRINTED, ROOT, RUN, blocks, pages, pages_of_diagnostics

COMMANDS = "sh"
LANGUAGES = {RUN, PRINTED, COMMANDS, "rddl", "c++", "c", "cmake", "python", "ebnf", "json", "lua", "elisp", "toml", "mermaid"}

CODE = re.compile(r"`([^`\n]+)`")
LINK = re.compile(r"\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#+ (.+)$")
PROGRAM = re.compile(r"^(?:\$ )?(?:[A-Z_]+=\S+ )*(?:\S*/)?(rddlc?)( .*)?$")


def pages_with_links() -> list[Path]:
    return [*pages(), *pages_of_diagnostics(), ROOT / "CHANGELOG.md", ROOT / "generated/README.md"]


def complaints_about_languages(page: Path) -> list[str]:
    return [f"{block.place}: '{block.language}' is no language of ours: {', '.join(sorted(LANGUAGES))}"
            for block in blocks(page) if block.language not in LANGUAGES]


def complaints_about_hidden_commands(page: Path) -> list[str]:
    return [f"{block.place}: commands stand in a '{RUN}' block, so that they are run"
            for block in blocks(page) if block.language != RUN and any(map(COMMAND.match, block.lines))]


class Programs:
    """Returns the --help of rddlc and rddl."""

    def __init__(self, folder: Path):
        self.folder = folder

    @functools.cache
    def help(self, program: str, command: str = "") -> str:
        words = [self.folder / program, *command.split(), "--help"]
        return subprocess.run(words, stdout=subprocess.PIPE, check=True).stdout.decode()

    @functools.cache
    def commands(self) -> set[str]:
        part = self.help("rddl").split("\nCommands:\n")[1].split("\n\n")[0]
        return {line.split()[0] for line in part.splitlines()} | {"help"}

    @functools.cache
    def options(self, program: str, command: str = "") -> set[str]:
        listed = re.findall(r"^  (?:-\w, )?(--[\w-]+)", self.help(program, command), re.M)
        return {*listed, "--version", "--help"}

    def complaint(self, call: str) -> str | None:
        """Returns the error in the call of a program, if it is one of ours."""
        match = PROGRAM.match(call.strip())
        if not match:
            return None
        program, words = match[1], (match[2] or "").split()
        command = ""
        if program == "rddl" and words and re.fullmatch(r"[a-z-]+", words[0]) and not words[0].startswith("-"):
            command = words[0]
            if command not in self.commands():
                return f"rddl has no command '{command}'"
            command = "" if command == "help" else command
            if "\nCommands:\n" in self.help(program, command) and command and len(words) > 1:
                command += " " + words[1].split("|")[0]  # train ppo
        for word in words:
            option = word.split("=")[0].rstrip(",.;:)")
            if re.fullmatch(r"--[a-z][a-z-]*", option) and option not in self.options(program, command):
                return f"{program} {command} has no option '{option}'"
        return None


def calls(page: Path) -> list[tuple[str, str]]:
    """Places and texts that may call a program."""
    found = []
    for block in blocks(page):
        if block.language in (RUN, COMMANDS):
            text = block.text.replace("\\\n", " ")
            found += [(block.place, part) for line in text.splitlines() for part in re.split(r"\||&&|;", line)]
    for number, line in enumerate(page.read_text().splitlines(), 1):
        found += [(f"{page.relative_to(ROOT)}:{number}", code) for code in CODE.findall(line)]
    return found


def complaints_about_calls(page: Path, programs: Programs) -> list[str]:
    judged = [(place, programs.complaint(call)) for place, call in calls(page)]
    return [f"{place}: {complaint}" for place, complaint in judged if complaint]


def without_code(page: Path) -> list[str]:
    lines, inside = [], False
    for line in page.read_text().splitlines():
        fence = line.strip().startswith("```")
        lines.append("" if inside or fence else CODE.sub("`code`", line))
        inside ^= fence
    return lines


@functools.cache
def anchors(page: Path) -> set[str]:
    """GitHub's names of the headings."""
    names = set()
    for line in page.read_text().splitlines():
        if match := HEADING.match(line):
            text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", match[1]).lower()
            names.add(re.sub(r"[^\w\- ]", "", text).replace(" ", "-"))
    return names


def complaints_about_links(page: Path) -> list[str]:
    found = []
    for number, line in enumerate(without_code(page), 1):
        for target in LINK.findall(line):
            if re.match(r"[a-z]+:", target):
                continue
            name, _, anchor = target.partition("#")
            path = (page.parent / name).resolve() if name else page
            place = f"{page.relative_to(ROOT)}:{number}"
            if not path.exists():
                found.append(f"{place}: there is no {target}")
            elif anchor and path.suffix == ".md" and anchor not in anchors(path):
                found.append(f"{place}: {name or 'this page'} has no heading #{anchor}")
    return found


def complaints_about_the_index() -> list[str]:
    index = ROOT / "docs/README.md"
    listed = {(index.parent / target.partition("#")[0]).resolve() for target in LINK.findall(index.read_text())}
    return [f"docs/README.md: there is no row for {page.relative_to(ROOT)}"
            for page in pages() if page.parent == index.parent and page not in listed | {index}]


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--bin", type=Path, default=ROOT / "build/bin", help="folder of rddlc and rddl")
    programs = Programs(parser.parse_args().bin)
    found = []
    for page in pages():
        found += complaints_about_languages(page) + complaints_about_calls(page, programs)
    for page in pages_of_diagnostics():
        found += complaints_about_hidden_commands(page) + complaints_about_calls(page, programs)
    for page in pages_with_links():
        found += complaints_about_links(page)
    found += complaints_about_the_index()
    print("\n".join(found))
    looked_at = sum(len(calls(page)) for page in pages())
    print(f"{len(pages_with_links())} pages, {looked_at} pieces of code, {len(found)} complaints")
    assert looked_at > 100, "the check looked at nothing"
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
