"""Completions of shells and manual pages: their installation, and their use.

    RDDLC_BIN=build/bin RDDLC_BUILD=build test_shell.py

Shells and formatters that are not installed are left out, except bash.
"""

import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BIN = Path(os.environ.get("RDDLC_BIN", ROOT / "build/bin")).resolve()
BUILD = Path(os.environ.get("RDDLC_BUILD", ROOT / "build")).resolve()
PROGRAMS = ("rddl", "rddlc")
# Words become those that bash would hand over, the last one is completed; '=' is a word of its own.
COMPLETE = r"""
source "$1"; shift
COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1))
"_$1"
printf '%s\n' "${COMPREPLY[@]}"
"""


def output(*words, **options) -> str:
    done = subprocess.run([str(word) for word in words], stdout=subprocess.PIPE, check=True, **options)
    return done.stdout.decode()


def ended(*words) -> subprocess.CompletedProcess:
    return subprocess.run([str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def commands() -> list[str]:
    part = output(BIN / "rddl", "--help").split("\nCommands:\n")[1].split("\n\n")[0]
    return [line.split()[0] for line in part.splitlines()]


def inner_commands(command: str) -> list[str]:
    """The commands of a command: ppo and cgp of train."""
    parts = output(BIN / "rddl", command, "--help").split("\nCommands:\n")[1:]
    return [line.split()[0] for part in parts for line in part.split("\n\n")[0].splitlines()]


def options(*words) -> set[str]:
    """The names of the options that --help lists."""
    text = output(BIN / words[0], *words[1:], "--help").split("\nExamples:\n")[0]
    names = re.findall(r"^  (-[^\s,]+(?:, -[^\s,]+)*)", text, re.M)
    return {name for group in names for name in group.split(", ")}


class Help(unittest.TestCase):
    def test_long_lists_have_parts(self):
        for words in ("run", ), ("train", "ppo"), ("train", "cgp"):
            text = output(BIN / "rddl", *words, "--help")
            titles = re.findall(r"^(\S[^:]*):$", text, re.M)
            self.assertLessEqual({"Problem", "Engine", "Other options"}, set(titles), words)
            for part in text.split("\n\n"):
                self.assertLess(len(re.findall(r"^  --", part, re.M)), 17, f"{words}: {part}")

    def test_explanations_begin_with_a_noun_or_a_verb(self):
        for words in ("run", ), ("train", "ppo"), ("train", "cgp"):
            text = output(BIN / "rddl", *words, "--help").split("\nExamples:\n")[0]
            for explanation in re.findall(r"^  -\S.*?(?:\n {20,}| {2,})(\S.*)$", text, re.M):
                self.assertNotRegex(explanation, r"^(Whether|How|What|The same|\w+ \(default\)|[A-Z] )", words)


class Shell(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, name: str, text: str) -> Path:
        path = self.folder / name
        path.write_text(text)
        return path

    def completions(self, program: str, shell: str) -> Path:
        return self.write(f"{program}.{shell}", output(BIN / program, "--completions", shell))

    def complete(self, *words: str) -> list[str]:
        """The offers of bash for the last word."""
        script = self.completions(words[0], "bash")
        offered = output("bash", "--norc", "-c", COMPLETE, "bash", script, *words, cwd=self.folder)
        return offered.split()

    def test_bash_completes_commands(self):
        self.assertEqual(self.complete("rddl", "ru"), ["run"])
        self.assertEqual(self.complete("rddl", "help", "ve"), ["verify"])
        self.assertEqual(self.complete("rddl", "train", "pp"), ["ppo"])
        self.assertEqual(self.complete("rddl", "train", "ppo"), ["ppo"])
        self.assertLessEqual({*commands(), "help", "--version"}, set(self.complete("rddl", "")))

    def test_bash_completes_options(self):
        self.assertEqual(self.complete("rddl", "run", "P", "--ep"), ["--episodes"])
        self.assertEqual(self.complete("rddlc", "domain.rddl", "--exp"), ["--explain"])
        self.assertEqual(self.complete("rddl", "--exp"), ["--explain"])
        self.assertEqual(self.complete("rddl", "--comp"), ["--completions"])
        self.assertEqual(self.complete("rddl", "--completions", ""), ["bash", "zsh", "fish"])
        self.assertEqual(self.complete("rddl", "--completions", "=", "f"), ["fish"])
        self.assertEqual(self.complete("rddlc", "--completions", "z"), ["zsh"])
        self.assertEqual(self.complete("rddl", "fmt", "--ep"), [])

    def test_bash_completes_values(self):
        self.assertEqual(self.complete("rddl", "run", "--std", "py"), ["pyrddlgym"])
        self.assertEqual(self.complete("rddl", "run", "--std", "=", "py"), ["pyrddlgym"])
        self.assertEqual(self.complete("rddl", "run", "--std", "="), ["pyrddlgym", "rddlc"])
        self.assertEqual(self.complete("rddlc", "--print", "ir"), ["ir", "ir-opt"])
        self.assertEqual(self.complete("rddl", "train", "ppo", "P", "--preset", ""), ["fast", "sb3", "rllib"])
        self.assertEqual(self.complete("rddl", "train", "cgp", "P", "--mutation", "=", "g"), ["gene"])
        self.assertIn("share_subexpressions", self.complete("rddl", "bench", "--without", "share"))

    def test_bash_completes_files_where_nothing_else_fits(self):
        self.assertEqual(self.complete("rddl", "run", "--trace", "-"), [])
        self.assertEqual(self.complete("rddl", "run", "dom"), [])
        self.assertIn("-o default", self.completions("rddl", "bash").read_text())

    def test_every_option_is_everywhere(self):
        inner = [("rddl", command, name) for command in commands() for name in inner_commands(command)]
        self.assertIn(("rddl", "train", "ppo"), inner)
        for words in [("rddlc",), *(("rddl", command) for command in commands()), *inner]:
            expected = options(*words)
            self.assertGreater(len(expected), 2, words)
            self.assertEqual(set(self.complete(*words, "-")), expected, words)
            manual = output(BIN / words[0], "--man-page").replace("\\-", "-")
            for name in expected:
                self.assertIn(f"\\fB{name}\\fR", manual, words)

    def test_every_option_of_the_program_is_everywhere(self):
        for name in options("rddl"):
            self.assertIn(name, self.complete("rddl", "-"))
            self.assertRegex(self.completions("rddl", "zsh").read_text(), f"'{name}=?\\[")
            self.assertIn(f"\\fB{name}\\fR", output(BIN / "rddl", "--man-page").replace("\\-", "-"))

    def test_shells_take_their_completions(self):
        for shell in ("bash", "zsh", "fish"):
            for program in PROGRAMS:
                script = self.completions(program, shell)
                self.assertGreater(len(script.read_text().splitlines()), 15)
                if shutil.which(shell):
                    done = ended(shell, "-n", script)
                    self.assertEqual((done.returncode, done.stdout), (0, b""), script)

    @unittest.skipUnless(shutil.which("fish"), "there is no fish")
    def test_fish_completes(self):
        def complete(line: str) -> list[str]:
            script = self.completions("rddl", "fish")
            offered = output("fish", "--no-config", "-c", f"source {script}; complete -C '{line}'", cwd=self.folder)
            return [line.split("\t")[0] for line in offered.splitlines()]
        self.assertEqual(complete("rddl ru")[0], "run")
        self.assertEqual(complete("rddl run --ep"), ["--episodes"])
        self.assertEqual(complete("rddl run --std py"), ["pyrddlgym"])
        self.assertEqual(complete("rddl train c"), ["cgp"])
        self.assertEqual(complete("rddl train ppo --pre"), ["--preset"])
        self.assertEqual(complete("rddl train cgp --pre"), [])
        self.write("policy.rddl", "")
        self.assertEqual(complete("rddl run --policy no"), ["noop"])
        self.assertEqual(complete("rddl run --policy po"), ["policy.rddl"])

    def test_other_shells_are_refused(self):
        for words in (["--completions"], ["--completions", "tcsh"], ["--completions=tcsh"]):
            done = ended(BIN / "rddl", *words)
            self.assertEqual(done.returncode, 2)
            self.assertRegex(done.stdout, rb"bash, zsh(,| or) fish")

    def test_manual_pages_have_no_warnings(self):
        formatters = [["man", "--warnings", "-l"], ["groff", "-man", "-ww", "-Tutf8"]]
        for program in PROGRAMS:
            page = self.write(f"{program}.1", output(BIN / program, "--man-page"))
            self.assertTrue(page.read_text().startswith(f".TH {program.upper()} 1 "))
            self.assertEqual(program == "rddl", "\\fBExploration:\\fR" in page.read_text())
            for formatter in formatters:
                if shutil.which(formatter[0]):
                    done = subprocess.run([*formatter, page], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                    self.assertEqual((done.returncode, done.stderr), (0, b""), formatter)

    def test_files_are_installed_where_shells_look(self):
        output("cmake", "--install", BUILD, "--prefix", self.folder)
        for program in PROGRAMS:
            for name, option in {
                f"share/bash-completion/completions/{program}": ["--completions", "bash"],
                f"share/zsh/site-functions/_{program}": ["--completions", "zsh"],
                f"share/fish/vendor_completions.d/{program}.fish": ["--completions", "fish"],
                f"share/man/man1/{program}.1": ["--man-page"],
            }.items():
                self.assertEqual((self.folder / name).read_text(), output(BIN / program, *option), name)


if __name__ == "__main__":
    unittest.main()
