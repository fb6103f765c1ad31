"""Makes the pages of the documentation site, and its mkdocs.yml, from README.md, docs/, the programs' --help and
the package's docstrings.

    make_pages.py --bin build/bin FOLDER

The navigation is docs/README.md: its headings are the groups, the rows of its tables the pages. Files of the
repository to which pages link get pages of their own, so that no link leads nowhere. Complains about links that
do, and about pages that no group has.
"""

import argparse
import os
import re
import shutil
import sys
from pathlib import Path

import command_pages
import diagrams
import python_pages

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
INDEX = DOCS / "README.md"
# Pages outside docs/, and the index, under the names that they have in the site.
PLACES = {"README.md": "index.md", "docs/README.md": "pages.md", "CONTRIBUTING.md": "contributing.md",
          "CHANGELOG.md": "changelog.md", "examples/README.md": "examples.md", "editors/README.md": "editors.md",
          "docs/diagnostics": "diagnostics/index.md"}
LANGUAGES = {".cpp": "c++", ".hpp": "c++", ".h": "c++", ".py": "python", ".sh": "sh", ".json": "json", ".cmake": "cmake"}

LINK = re.compile(r"(`[^`\n]+`)|(\]\()([^)\s]+)(\))")
ROW = re.compile(r"^\| \[([^\]]+)\]\(([^)\s]+)\)")
Nav = dict[str, list[tuple[str, str]]]


def pages() -> list[Path]:
    outside = [ROOT / name for name in PLACES if name.endswith(".md") and not name.startswith("docs/")]
    return [*outside, *sorted(DOCS.rglob("*.md"))]


def place(path: Path) -> str | None:
    """Where a file of the repository is in the site. None: it has to get a page."""
    name = str(path.relative_to(ROOT))
    if name in PLACES:
        return PLACES[name]
    in_site = name.startswith("docs/images/") or name.startswith("docs/") and path.suffix == ".md"
    return name.removeprefix("docs/") if in_site else None


class Site:
    def __init__(self, folder: Path):
        self.folder = folder
        self.sources: set[Path] = set()
        self.complaints: list[str] = []

    def write(self, name: str, text: str) -> None:
        path = self.folder / "pages" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def target(self, page: Path, link: str, from_place: str) -> str:
        """What the link of a page is in the site."""
        name, mark, anchor = link.partition("#")
        if re.match(r"[a-z]+:", link) or not name:
            return link
        path = (page.parent / name).resolve()
        if not path.exists():
            self.complaints.append(f"{page.relative_to(ROOT)}: there is no {link}")
            return link
        to = place(path)
        if to is None:
            self.sources.add(path)
            to = f"source/{path.relative_to(ROOT)}.md"
        return os.path.relpath(to, os.path.dirname(from_place) or ".") + mark + anchor

    def linked(self, page: Path, to: str) -> str:
        """The text of a page, with its links as the site has them."""
        def of(match: re.Match[str]) -> str:
            return match[1] or match[2] + self.target(page, match[3], to) + match[4]
        lines, inside = [], False
        for line in page.read_text().splitlines():
            fence = line.strip().startswith("```")
            lines.append(line if inside or fence else LINK.sub(of, line))
            inside ^= fence
        return diagrams.drawn("\n".join(lines) + "\n")

    def write_source(self, path: Path) -> None:
        name = str(path.relative_to(ROOT))
        if path.is_dir():
            listed = sorted(inner.name + "/" * inner.is_dir() for inner in path.iterdir() if inner.name[0] not in "._")
            body = [f"* `{inner}`" for inner in listed]
        else:
            body = [f"````{LANGUAGES.get(path.suffix, 'text')}", path.read_text().rstrip(), "````"]
        head = ["---", "search: {exclude: true}", "---", f"# {name}", "", "A file of the repository." if path.is_file() else
                "A folder of the repository:", ""]
        self.write(f"source/{name}.md", "\n".join([*head, *body]) + "\n")


def navigation() -> Nav:
    groups: Nav = {}
    for line in INDEX.read_text().splitlines():
        if line.startswith("## "):
            group = groups[line[3:]] = []
        elif row := ROW.match(line):
            to = place((DOCS / row[2]).resolve())
            assert to, f"{INDEX}: {row[2]} is not a page"
            group.append((row[1], to))
    return groups


def title(page: Path) -> str:
    return page.read_text().split("\n", 1)[0].lstrip("# ")


def write_diagnostics(site: Site) -> None:
    rows = [f"| [{page.stem}]({page.name}) | {title(page)} |" for page in sorted((DOCS / "diagnostics").glob("*.md"))]
    site.write("diagnostics/index.md", "\n".join(
        ["# Diagnostics", "", "`rddlc --explain CODE` prints these pages.", "", "| code | meaning |", "|---|---|", *rows, ""]))


def write_commands(site: Site, programs: Path) -> list[tuple[str, str]]:
    found = [command for name in ("rddl", "rddlc") for command in command_pages.commands(programs, name)]
    for command in found:
        site.write(f"commands/{command.file}", command_pages.page(command))
    site.write("commands/options.md", command_pages.options_page(found))
    return [("All options", "commands/options.md"), *((command.name, f"commands/{command.file}") for command in found)]


def write_python(site: Site) -> list[tuple[str, str]]:
    for module in python_pages.MODULES:
        site.write(f"api/{python_pages.file(module)}", python_pages.page(ROOT / "python/rddlc", module))
    return [(python_pages.file(module).removesuffix(".md"), f"api/{python_pages.file(module)}") for module in python_pages.MODULES]


def configuration(groups: Nav, commands: list[tuple[str, str]], python: list[tuple[str, str]]) -> str:
    lines = [(Path(__file__).parent / "mkdocs.yml").read_text(), "docs_dir: pages", "site_dir: html", "nav:", "  - index.md"]
    for group, rows in groups.items():
        lines.append(f"  - {group}:")
        lines += ["      - pages.md"] if group == "Start" else []
        lines += [f'      - "{name}": {to}' for name, to in rows]
        for name, inner in (("Each command", commands), ("The Python package", python)):
            if group == "Reference":
                lines += [f'      - "{name}":', *(f'          - "{title}": {to}' for title, to in inner)]
    return "\n".join([*lines, "  - changelog.md", ""])


def complaints_about_navigation(site: Site, groups: Nav) -> list[str]:
    listed = {to for rows in groups.values() for _, to in rows} | {"index.md", "pages.md", "changelog.md"}
    missing = [page for page in pages() if page.parent.name != "diagnostics" and place(page) not in listed]
    return [f"docs/README.md: there is no row for {page.relative_to(ROOT)}" for page in missing]


def make(folder: Path, programs: Path) -> Site:
    site = Site(folder)
    shutil.rmtree(folder / "pages", ignore_errors=True)
    for page in pages():
        to = place(page)
        assert to
        site.write(to, site.linked(page, to))
    shutil.copytree(DOCS / "images", folder / "pages/images")
    for name in "site.css", "search.js":
        shutil.copy(Path(__file__).parent / name, folder / "pages")
    write_diagnostics(site)
    for path in sorted(site.sources):
        site.write_source(path)
    groups = navigation()
    site.complaints += complaints_about_navigation(site, groups)
    (folder / "mkdocs.yml").write_text(configuration(groups, write_commands(site, programs), write_python(site)))
    return site


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--bin", type=Path, default=ROOT / "build/bin", help="folder of rddlc and rddl")
    parser.add_argument("folder", type=Path, help="gets pages/ and mkdocs.yml")
    options = parser.parse_args()
    site = make(options.folder, options.bin)
    print("\n".join(site.complaints))
    print(f"{len(list(options.folder.rglob('*.md')))} pages, {len(site.complaints)} complaints")
    return 1 if site.complaints else 0


if __name__ == "__main__":
    sys.exit(main())
