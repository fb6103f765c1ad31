"""Runs the commands that the documentation shows, and compares what they print with what it shows.

    run_pages.py --bin build/bin [--build build] [--cache FOLDER] [--python PYTHON] [PAGE...]

Each page is a session in a folder of its own, in which examples/ lies and what the page writes; for the
page of a diagnostic, also the files of a problem. With RDDLC_UPDATE=1 in the environment, outputs that
differ are written into the page: read the difference.
"""

import argparse
import difflib
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from comparison import agree
from pages import DIAGNOSTICS, PRINTED, ROOT, RUN, Block, blocks, exchanges, files, pages, pages_of_diagnostics

SECONDS = 600  # Far beyond what any command takes on a busy machine: only what hangs fails.
INSTALLED = "~/rddlc"  # The folder in which docs/getting-started.md installs rddlc.
CLONED = "$REPOSITORY"  # The repository that readers clone: this tree with all changes, whether it is under git or not.
REPOSITORY = "repository.git"


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser()
    parser.add_argument("--bin", type=Path, default=ROOT / "build/bin", help="folder of rddlc and rddl")
    parser.add_argument("--build", type=Path, default=ROOT / "build", help="what is installed from")
    parser.add_argument("--cache", type=Path, help="kept from one test run to the next")
    parser.add_argument("--python", type=Path, default=ROOT / ".venv/bin/python", help="one with pyRDDLGym and rddlrepository")
    parser.add_argument("pages", nargs="*", type=Path)
    return parser.parse_args()


def environment(options: argparse.Namespace, home: Path) -> dict[str, str]:
    values = {
        **os.environ, "HOME": str(home), "TMPDIR": str(home),
        "PATH": f"{options.bin.resolve()}:{options.python.absolute().parent}:{os.environ['PATH']}",
        "XDG_CACHE_HOME": str((options.cache or home / "cache").absolute()),
        "PYTHONPATH": str(options.build.resolve() / "python"),
        "VIRTUAL_ENV": str(options.python.absolute().parents[1]), "REPOSITORY": str(home / REPOSITORY),
    }
    for name in "RDDL_REPOSITORY", "RDDLC_INCLUDE", "CXX", "MAKEFLAGS":
        values.pop(name, None)
    return values


def write(block: Block, folder: Path) -> None:
    path = folder / block.marks["file"]
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(block.text)


def run(command: str, folder: Path, variables: dict[str, str]) -> str:
    done = subprocess.run(["bash", "-c", command], cwd=folder, env=variables, timeout=SECONDS,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return done.stdout.decode().replace(variables["HOME"], "~")


def difference(written: str, printed: str) -> str:
    lines = difflib.unified_diff(written.splitlines(), printed.splitlines(), "the page", "the program", lineterm="")
    return "\n".join(lines)


class Session:
    """A page, from its first block to its last."""

    def __init__(self, page: Path, folder: Path, variables: dict[str, str]):
        self.page, self.folder, self.variables = page, folder, variables
        self.commands = 0
        self.complaints: list[str] = []
        self.corrections: list[tuple[int, int, list[str]]] = []  # lines of the page, from and to

    def play(self) -> None:
        for block in blocks(self.page):
            if "files of" in block.marks:
                for file in files(self.page.parent / block.marks["files of"]):
                    write(file, self.folder)
            if "file" in block.marks:
                write(block, self.folder)
            elif block.language == PRINTED and "not run" not in block.marks:
                self.complaints.append(f"{block.place}: is this printed? Show the command in a '{RUN}' block, or say '<!-- not run: why -->'")
            elif block.language == RUN and "not run" not in block.marks:
                self.type_in(block)

    def type_in(self, block: Block) -> None:
        for exchange in exchanges(block):
            self.commands += 1
            printed = run(exchange.command, self.folder, self.variables)
            if agree(exchange.output, printed, "loosely" in block.marks):
                continue
            place = f"{block.place}: $ {exchange.command}"
            self.complaints.append(f"{place}\n{difference(exchange.output, printed)}")
            lines = [(block.indentation + line).rstrip() for line in printed.splitlines()]
            self.corrections.append((block.line + exchange.begin, block.line + exchange.end, lines))

    def correct(self) -> None:
        lines = self.page.read_text().splitlines()
        for begin, end, printed in reversed(self.corrections):
            lines[begin:end] = printed
        self.page.write_text("\n".join(lines) + "\n")


def make_repository(folder: Path) -> None:
    def git(*words: str) -> None:
        settings = ["-c", "user.name=test", "-c", "user.email=test", "-c", "commit.gpgSign=false"]
        subprocess.run(["git", *settings, "--git-dir", folder, "--work-tree", ROOT, *words], check=True)
    subprocess.run(["git", "init", "--quiet", "--bare", "--initial-branch=main", folder], check=True)
    git("add", "--all")
    git("commit", "--quiet", "--message=As it is now")


def prepare(page: Path, folder: Path, options: argparse.Namespace, variables: dict[str, str]) -> None:
    """Creates what the page needs before it begins."""
    shutil.copytree(ROOT / "examples", folder / "examples")
    if page.parent == DIAGNOSTICS:
        shutil.copytree(ROOT / "examples/mountain_car", folder, dirs_exist_ok=True)
    text = page.read_text()
    if INSTALLED in text:
        subprocess.run(["cmake", "--install", options.build, "--prefix", f"{variables['HOME']}/rddlc"],
                       check=True, stdout=subprocess.DEVNULL)
    if CLONED in text:
        make_repository(Path(variables["REPOSITORY"]))


def session_of(page: Path, options: argparse.Namespace) -> Session:
    with tempfile.TemporaryDirectory(prefix="rddlc-docs-") as name:
        home = Path(name)
        variables = environment(options, home)
        prepare(page, home / "clone", options, variables)
        session = Session(page, home / "clone", variables)
        session.play()
    if os.environ.get("RDDLC_UPDATE"):
        session.correct()
    return session


def main() -> int:
    options = arguments()
    sessions = [session_of(page.resolve(), options) for page in options.pages or pages() + pages_of_diagnostics()]
    complaints = [complaint for session in sessions for complaint in session.complaints]
    print("\n\n".join(complaints))
    commands = sum(session.commands for session in sessions)
    print(f"{len(sessions)} pages, {commands} commands, {len(complaints)} complaints")
    if complaints:
        print("If the programs are right: RDDLC_UPDATE=1 ctest --test-dir build -R docs.pages")
    assert commands > 0, "nothing was run"
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
