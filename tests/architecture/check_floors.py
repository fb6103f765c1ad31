"""Files of runtime/rddl and compiler/passes include what docs/architecture.md says that their folders use, and the tables there
have no circle.

Each of both is one library, whose folders no include path holds apart, as cmake/RddlcStage.cmake does elsewhere.
"""

import re
import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ROW = re.compile(r"^\| `(\w+)/` \|([^|]*)\|", re.M)


@dataclass
class Library:
    path: str
    section: str  # of docs/architecture.md
    include: str
    for_all: set[str]  # headers beside the folders that all of them may include

    def included(self, text: str) -> list[tuple[str, str]]:
        """Folders, "" for none, and headers."""
        return re.findall(rf'#include [<"]{self.include}/(?:(\w+)/)?([\w./]+)[>"]', text)


RUNTIME = Library("runtime/rddl", "The runtime", "rddl", {"simulator.h", "external.h", "export.h"})
PASSES = Library("compiler/passes", "The passes", "passes", {"report.hpp"})


def table(page: str, section: str) -> dict[str, set[str]]:
    """The folders that each folder uses."""
    text = page.split(f"## {section}\n", 1)[1].split("\n## ", 1)[0]
    return {folder: set(re.findall(r"`(\w+)`", uses)) for folder, uses in ROW.findall(text)}


def circles(uses: dict[str, set[str]]) -> list[str]:
    """A folder uses those above it alone."""
    found, above = [], set()
    for folder, used in uses.items():
        found += [f"docs/architecture.md: `{folder}/` uses `{other}`, which does not stand above it" for other in sorted(used - above)]
        above.add(folder)
    return found


def wrong_includes(library: Library, folder: str, text: str, uses: dict[str, set[str]]) -> list[str]:
    return [f"includes {other or 'a header beside the folders'}/{header}, which `{folder}/` does not use"
            for other, header in library.included(text)
            if other != folder and other not in uses[folder] and (other or header not in library.for_all)]


def complaints(library: Library, page: str) -> tuple[int, list[str]]:
    """The number of files, and what is wrong."""
    uses = table(page, library.section)
    there = {path.name for path in (ROOT / library.path).iterdir() if path.is_dir()}
    found = circles(uses) + [f"docs/architecture.md: `{folder}/` is missing, or is not there" for folder in sorted(there ^ set(uses))]
    files = [(folder, path) for folder in sorted(there & set(uses)) for path in sorted((ROOT / library.path / folder).rglob("*.*pp"))]
    for folder, path in files:
        found += [f"{path.relative_to(ROOT)}: {wrong}" for wrong in wrong_includes(library, folder, path.read_text(), uses)]
    return len(files), found


def test_itself() -> None:
    page = "## The runtime\n| `a/` | | x |\n| `b/` | `a` | x |\n## Next\n| `c/` | `b` | x |\n"
    uses = table(page, "The runtime")
    assert uses == {"a": set(), "b": {"a"}} and not circles(uses) and circles({"a": {"b"}, "b": set()})
    for wrong in "b/x.hpp", "simulator.hpp", "b/simulator.h":
        assert wrong_includes(RUNTIME, "a", f"#include <rddl/{wrong}>", uses)
    assert not wrong_includes(RUNTIME, "b", "#include <rddl/a/math/x.hpp>\n#include <rddl/b/y.hpp>\n#include <rddl/simulator.h>", uses)


def main() -> int:
    test_itself()
    page = (ROOT / "docs/architecture.md").read_text()
    status = 0
    for library in RUNTIME, PASSES:
        count, found = complaints(library, page)
        print("\n".join([*found, f"{library.path}: {count} files, {len(found)} complaints"]))
        assert count > 50, "the check looked at nothing"
        status |= bool(found)
    return status


if __name__ == "__main__":
    sys.exit(main())
