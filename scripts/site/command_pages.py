"""A page for each command, from its --help, which the programs print from the data of their options."""

import re
import subprocess
from dataclasses import dataclass
from pathlib import Path

TITLE = re.compile(r"^(\S[^:]*):$")
ENTRY = re.compile(r"^  (\S.*?)(?:  +(\S.*))?$")
TEXT_COLUMN = 28


@dataclass
class Command:
    name: str  # "rddl train ppo"
    help: str

    @property
    def file(self) -> str:
        return self.name.replace(" ", "-") + ".md"

    @property
    def summary(self) -> str:
        return self.help.splitlines()[0].rstrip(".")


def commands(folder: Path, name: str) -> list[Command]:
    """Returns a program, or a command of one, and all commands below it."""
    words = name.split()
    text = subprocess.run([folder / words[0], *words[1:], "--help"], stdout=subprocess.PIPE, check=True).stdout.decode()
    found = [Command(name, text)]
    for title, body in sections(text):
        if title == "Commands":
            for inner, _ in entries(body):
                found += commands(folder, f"{name} {inner}")
    return found


def sections(text: str) -> list[tuple[str, list[str]]]:
    """Splits a help into its parts. The first has no title."""
    found: list[tuple[str, list[str]]] = [("", [])]
    for line in text.splitlines():
        if title := TITLE.match(line):
            found.append((title[1], []))
        elif not line.strip() and found[-1][0]:
            found.append(("", []))
        else:
            found[-1][1].append(line)
    return [(title, lines) for title, lines in found if any(map(str.strip, lines))]


def entries(lines: list[str]) -> list[tuple[str, str]]:
    """Returns names and explanations of a list of options."""
    found: list[tuple[str, str]] = []
    for line in lines:
        if line.startswith(" " * TEXT_COLUMN) and found:
            name, text = found[-1]
            found[-1] = name, f"{text} {line.strip()}".strip()
        elif entry := ENTRY.match(line):
            found.append((entry[1], entry[2] or ""))
    return found


def escaped(text: str) -> str:
    return re.sub(r"([|<>*_])", r"\\\1", text)


def table(title: str, lines: list[str]) -> list[str]:
    rows = [f"| `{name.replace('|', '&#124;')}` | {escaped(text)} |" for name, text in entries(lines)]
    head = {"Commands": "command", "Arguments": "argument"}.get(title, "option")
    return [f"| {head} | meaning |", "|---|---|", *rows, ""]


def is_list(title: str, lines: list[str]) -> bool:
    return bool(title) and title != "Examples" and any(line.startswith(" " * TEXT_COLUMN) or
                                                       len(line) > TEXT_COLUMN for line in lines)


def page(command: Command) -> str:
    out = [f"# {command.name}", ""]
    for title, lines in sections(command.help):
        if title:
            out += [f"## {title}", ""]
        if is_list(title, lines):
            out += table(title, lines)
        elif title or lines[0].startswith(("Usage", " ")):
            out += ["```console", *(line.removeprefix("  ") for line in lines), "```", ""]
        else:
            usage = [line for line in lines if line.startswith("Usage")]
            out += [re.sub(r"([<>*_])", r"\\\1", line) for line in lines if line not in usage] + [""]
            out += ["```console", *usage, "```", ""] if usage else []
    return "\n".join(out)


def options_page(all_commands: list[Command]) -> str:
    """Returns an index of all options, each with the commands that have it."""
    found: dict[str, list[str]] = {}
    for command in all_commands:
        for title, lines in sections(command.help):
            for name, text in entries(lines) if is_list(title, lines) else []:
                for option in re.findall(r"--[\w-]+", name):
                    found.setdefault(option, []).append(f"* [{command.name}]({command.file}): `{name}` {escaped(text)}")
    out = ["---", "search: {boost: 5}", "---", "# All options", "", "Each option of the programs, with the commands that have it.", ""]
    for option in sorted(found):
        out += [f"## {option}", "", *found[option], ""]
    return "\n".join(out)
