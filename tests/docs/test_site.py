"""The pages of the documentation site (scripts/site.sh) are complete, before MkDocs sees them: a second's work."""

import os
import re
import sys
import tempfile
import unittest
from pathlib import Path

import check_text
from pages import DIAGNOSTICS, ROOT

sys.path.insert(0, str(ROOT / "scripts/site"))
import command_pages  # noqa: E402
import diagrams  # noqa: E402
import make_pages  # noqa: E402
import python_pages  # noqa: E402

PROGRAMS = Path(os.environ.get("RDDLC_BIN", ROOT / "build/bin"))


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.site = make_pages.make(cls.folder, PROGRAMS)
        cls.pages = cls.folder / "pages"

    def test_the_navigation_has_every_page(self):
        self.assertEqual(self.site.complaints, [])
        listed = re.findall(r"(?:: |- )(\S+\.md)$", (self.folder / "mkdocs.yml").read_text(), re.M)
        self.assertEqual([name for name in listed if not (self.pages / name).is_file()], [])
        self.assertGreater(len(listed), 50)

    def test_links_lead_to_files(self):
        dead, links = [], 0
        for page in self.pages.rglob("*.md"):
            for line in check_text.without_code(page):
                for link in check_text.LINK.findall(line):
                    links += 1
                    name = link.partition("#")[0]
                    if name and not re.match(r"[a-z]+:", link) and not (page.parent / name).is_file():
                        dead.append(f"{page.relative_to(self.pages)}: {link}")
        self.assertEqual(dead, [])
        self.assertGreater(links, 500)

    def test_every_command_has_a_page_with_its_options(self):
        programs = check_text.Programs(PROGRAMS)
        names = {path.stem for path in (self.pages / "commands").glob("*.md")}
        self.assertLessEqual({"rddl", "rddlc", "rddl-train-ppo", "rddl-run"}, names)
        for program, command in ("rddl", "run"), ("rddl", "train ppo"), ("rddl", "bench"), ("rddlc", ""):
            page = (self.pages / "commands" / command_pages.Command(f"{program} {command}".strip(), "").file).read_text()
            for option in programs.options(program, command) - {"--version"}:
                self.assertIn(option, page, f"{program} {command}")

    def test_every_option_has_a_heading_in_their_index(self):
        index = (self.pages / "commands/options.md").read_text()
        self.assertIn("\n## --clip\n\n* [rddl train ppo](rddl-train-ppo.md): `--clip C` ", index)
        for option in check_text.Programs(PROGRAMS).options("rddl", "run") - {"--version"}:
            self.assertIn(f"\n## {option}\n", index)

    def test_every_diagnostic_is_listed(self):
        listed = (self.pages / "diagnostics/index.md").read_text()
        self.assertEqual([page.stem for page in DIAGNOSTICS.glob("*.md") if f"[{page.stem}]" not in listed], [])

    def test_public_names_of_python_have_a_text(self):
        text = (ROOT / "python/rddlc/__init__.py").read_text()
        public = re.findall(r'^    "([A-Za-z]\w*)",$', text.split("__all__ = [")[1].split("]")[0], re.M)
        headings = {line.split(" ", 1)[1].removeprefix("rddlc.") for page in (self.pages / "api").glob("*.md")
                    for line in page.read_text().splitlines() if line.startswith(("# ", "## "))}
        errors = (self.pages / "api/errors.md").read_text()
        self.assertEqual([name for name in public if name not in headings and f"* `{name}`: " not in errors], [])


class Pieces(unittest.TestCase):
    def test_a_help_becomes_tables(self):
        text = "Do it\n\nUsage: rddl do [OPTIONS]\n\nOptions:\n  --a N                     First\n" + " " * 28 + \
               "words\n  --long-name VALUE,...\n" + " " * 28 + "Second\n\nMore text.\n\nExamples:\n  rddl do --a 3\n"
        page = command_pages.page(command_pages.Command("rddl do", text))
        self.assertIn("| `--a N` | First words |\n| `--long-name VALUE,...` | Second |", page)
        self.assertIn("## Examples\n\n```console\nrddl do --a 3\n```", page)

    def test_flowcharts_become_pictures(self):
        text = "flowchart TD\n    a --> b\n    a --> c\n    b --> c\n"
        picture = diagrams.drawn(f"Before\n\n```mermaid\n{text}```\n\nafter")
        self.assertEqual(re.findall(r"<text[^>]*>(\w)</text>", picture), ["a", "b", "c"])
        self.assertEqual(picture.count("marker-end"), 3)
        self.assertNotIn("mermaid", picture)
        rows = diagrams.graph_of(diagrams.edges_of(text))
        diagrams.arrange(rows)
        self.assertEqual([[node.label for node in row] for row in rows[:1]], [["a"]])
        self.assertEqual(sorted(node.label for node in rows[1]), ["", "b"])  # the edge from a to c passes beside b
        left, right = rows[1]
        self.assertGreaterEqual(right.x - right.width / 2, left.x + left.width / 2)

    def test_other_charts_are_refused(self):
        for text in "flowchart LR\n    a --> b\n", "flowchart TD\n    a -->|x| b\n", "flowchart TD\n    a --> b\n    b --> a\n":
            with self.assertRaises(ValueError):
                diagrams.svg(text)

    def test_docstrings_list_their_options(self):
        self.assertEqual(python_pages.prose("A text.\n\nseed: the\n    seed"), ["A text.", "", "* `seed`: the", "    seed", ""])

    def test_dead_links_are_reported(self):
        with tempfile.TemporaryDirectory() as folder:
            site = make_pages.Site(Path(folder))
            site.target(ROOT / "README.md", "docs/nowhere.md", "index.md")
            self.assertEqual(site.complaints, ["README.md: there is no docs/nowhere.md"])


if __name__ == "__main__":
    unittest.main()
