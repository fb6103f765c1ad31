"""The checks of the documentation find what they are for."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import check_english
import check_lines
import check_text
import run_pages
from comparison import agree
from pages import ROOT, blocks, exchanges


def page_of(text: str, folder: str) -> Path:
    page = Path(folder) / "page.md"
    page.write_text(text)
    return page


class Comparison(unittest.TestCase):
    def test_every_character_counts(self):
        self.assertTrue(agree("return  1.5\n", "return  1.5\n"))
        self.assertFalse(agree("return  1.5\n", "return  1.6\n"))
        self.assertFalse(agree("return  1.5\n", "return 1.5\n"))
        self.assertFalse(agree("", "warning\n"))

    def test_what_is_of_the_machine_does_not(self):
        self.assertTrue(agree("10 steps in 7.4 ms: 27.1 M steps/s with 2 threads", "10 steps in 66 us: 747 k steps/s with 1 thread"))
        self.assertTrue(agree("packs of 16 (AVX-512)", "packs of 16 (SSE2)"))
        self.assertFalse(agree("10 steps in 7.4 ms", "11 steps in 7.4 ms"))

    def test_dots_stand_for_anything(self):
        self.assertTrue(agree("in .../archive", "in /a/b/archive"))
        self.assertTrue(agree("a\n...\nz", "a\nb\nc\nz"))
        self.assertFalse(agree("in .../archive", "in /a/b/other"))

    def test_loosely(self):
        self.assertTrue(agree("emitted  267 lines,\n10.4 kB", "emitted 1,300 lines, 9 kB", loosely=True))
        self.assertFalse(agree("emitted 267 lines", "emitted 267 words", loosely=True))


class Pages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def play(self, text: str) -> run_pages.Session:
        session = run_pages.Session(page_of(text, self.folder), Path(self.folder), {**os.environ, "HOME": self.folder})
        session.play()
        return session

    def test_commands_have_several_lines_and_output(self):
        page = page_of("```console\n$ echo a \\\n  b\na b\n\nc\n$ true\n```\n", self.folder)
        first, second = exchanges(blocks(page)[0])
        self.assertEqual((first.command, first.output), ("echo a \\\n  b", "a b\n\nc\n"))
        self.assertEqual((second.command, second.output), ("true", ""))

    def test_stale_output_is_found_and_corrected(self):
        session = self.play("- list\n\n  ```console\n  $ echo new\n  old\n  older\n  ```\n")
        self.assertEqual(len(session.complaints), 1)
        session.correct()
        self.assertEqual(session.page.read_text(), "- list\n\n  ```console\n  $ echo new\n  new\n  ```\n")

    def test_errors_are_output(self):
        self.assertFalse(self.play("```console\n$ echo bad >&2; false\nbad\n```\n").complaints)

    def test_files_are_written(self):
        text = "<!-- file: a/b.txt -->\n```text\nhello\n```\n\n```console\n$ cat a/b.txt\nhello\n```\n"
        self.assertFalse(self.play(text).complaints)

    def test_blocks_may_name_their_files(self):
        self.assertFalse(self.play("```rddl\n// a.rddl\nhello\n```\n\n```console\n$ tail -n 1 a.rddl\nhello\n```\n").complaints)

    def test_files_of_other_pages_are_written(self):
        (Path(self.folder) / "other.md").write_text("<!-- file: a.txt -->\n```text\nhello\n```\n")
        self.assertFalse(self.play("<!-- files of: other.md -->\n```console\n$ cat a.txt\nhello\n```\n").complaints)

    def test_the_home_folder_has_no_name(self):
        self.assertFalse(self.play("```console\n$ echo $HOME/a\n~/a\n```\n").complaints)

    def test_clones_hold_the_tree_as_it_is(self):
        repository = Path(self.folder) / "tree.git"
        run_pages.make_repository(repository)
        listed = subprocess.run(["git", "--git-dir", repository, "ls-tree", "--name-only", "main"],
                                stdout=subprocess.PIPE, check=True).stdout.decode().split()
        self.assertIn("README.md", listed)
        self.assertNotIn("build", listed)

    def test_commands_of_diagnostics_are_not_hidden(self):
        for text, count in {"```\n$ true\n```\n": 1, "```console\n$ true\n```\n": 0, "```\na = b\n```\n": 0}.items():
            self.assertEqual(len(check_text.complaints_about_hidden_commands(page_of(text, self.folder))), count)

    def test_printed_text_needs_a_reason_or_a_command(self):
        self.assertTrue(self.play("```text\nhello\n```\n").complaints)
        self.assertFalse(self.play("<!-- not run: a drawing -->\n```text\nhello\n```\n").complaints)
        with self.assertRaises(ValueError):
            self.play("```console\nhello\n```\n")
        with self.assertRaises(ValueError):
            self.play("<!-- not run: a drawing -->\nA line between.\n```text\nhello\n```\n")


class Text(unittest.TestCase):
    programs = check_text.Programs(Path(os.environ.get("RDDLC_BIN", ROOT / "build/bin")))

    def test_calls(self):
        for call in ["rddl run P --episodes 3", "$ CXX=g++ rddlc a b -o c.so", "rddl help run", "build/bin/rddl list",
                     "rddl COMMAND --help", "rddlc --explain E0203", "rddler --nonsense", "cmake --build build"]:
            self.assertIsNone(self.programs.complaint(call), call)
        for call in ["rddl runs P", "rddl run P --episode 3", "$ CXX=g++ rddlc a b --explains", "rddl check P --episodes=3"]:
            self.assertIsNotNone(self.programs.complaint(call), call)

    def test_anchors(self):
        with tempfile.TemporaryDirectory() as folder:
            page = page_of("# A title: with `code` & more\n\n## [Link](x.md)\n", folder)
            self.assertEqual(check_text.anchors(page), {"a-title-with-code--more", "link"})


class Lines(unittest.TestCase):
    def test_paragraphs_and_items_break(self):
        words = "word " * 30
        for text, rest in (f"{words}\n", ""), (f"* {words}\n", "  "), (f"  12. {words}\n  {words}\n", "      "):
            lines = check_lines.broken(text).splitlines()
            self.assertLessEqual(max(map(len, lines)), 100)
            self.assertTrue(all(line.startswith(rest + "word") for line in lines[1:]), lines)
            self.assertEqual(check_lines.broken("\n".join(lines) + "\n").splitlines(), lines)

    def test_other_things_stay(self):
        long = "x " * 60
        for text in (f"| {long} |\n", f"# {long}\n", f"```\n{long}\n```\n", f"<!-- {long} -->\n", f"[a]: {long}\n", "short\nlines\n",
                     f"a break  \n{'x' * 120}\n"):
            self.assertEqual(check_lines.broken(text), text)

    def test_code_and_beginnings_are_kept(self):
        code = "`a command  with --options`"
        self.assertIn(code, check_lines.broken(f"{'x' * 90} {code} {'y' * 90}\n"))
        for word in "1.", "#3", "-", "*", ">", "+":  # would begin an item, a heading or a quotation
            lines = check_lines.broken(f"{'x' * 60} {'y' * 38} {word} {'z' * 50}\n").splitlines()
            self.assertFalse(any(line.startswith(word) for line in lines), lines)


class English(unittest.TestCase):
    def habits(self, name: str, text: str) -> list[str]:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / name
            path.write_text(text)
            return [habit for habit, _ in check_english.complaints(path)]

    def test_habits_are_found_in_pages(self):
        self.assertEqual(self.habits("a.md", "Whoever does it, nobody sees it.\n\nA tree, too.\n"), ["Whoever", "nobody", ", too"])
        self.assertEqual(self.habits("a.md", "There is none. It is `is none`, too small.\n\n```text\nnobody\n```\n"), [])

    def test_fragments_are_found_where_comments_begin(self):
        self.assertEqual(self.habits("a.cpp", "// Of a table.\nint a;  // What it is\n"), ["Of", "What"])
        self.assertEqual(self.habits("a.cpp", "// The size\n// Of a table. What is it?\nint a = b(\"// nobody\");\n"), [])


if __name__ == "__main__":
    unittest.main()
