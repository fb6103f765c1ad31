"""Headers of runtime/rddl include what docs/architecture.md says that their folders use, and the table has no circle.

Emitted simulators include them all, so no include path can hold them apart, as cmake/RddlcStage.cmake does elsewhere.
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
RUNTIME = ROOT / "runtime/rddl"
ROW = re.compile(r"^\| `(\w+)/` \|([^|]*)\|", re.M)
INCLUDE = re.compile(r"#include <rddl/(?:(\w+)/)?([\w./]+)>")
# C, without anything of ours: for all folders.
PLAIN_C = {"simulator.h", "external.h", "export.h"}


def table(page: str) -> dict[str, set[str]]:
    """What each folder uses."""
    section = page.split("## The runtime", 1)[1].split("\n## ", 1)[0]
    return {folder: set(re.findall(r"`(\w+)`", uses)) for folder, uses in ROW.findall(section)}


def circles(uses: dict[str, set[str]]) -> list[str]:
    """A folder uses those above it alone."""
    found, above = [], set()
    for folder, used in uses.items():
        found += [f"docs/architecture.md: `{folder}/` uses `{other}`, which does not stand above it" for other in sorted(used - above)]
        above.add(folder)
    return found


def complaints(name: str, folder: str, text: str, uses: dict[str, set[str]]) -> list[str]:
    found = []
    for other, header in INCLUDE.findall(text):
        if other != folder and other not in uses[folder] and header not in PLAIN_C:
            found.append(f"{name}: includes {other or 'a header beside the folders'}/{header}, which `{folder}/` does not use")
    return found


def test_itself() -> None:
    page = "## The runtime\n| `a/` | | x |\n| `b/` | `a` | x |\n## Next\n| `c/` | `b` | x |\n"
    uses = table(page)
    assert uses == {"a": set(), "b": {"a"}} and not circles(uses) and circles({"a": {"b"}, "b": set()})
    assert complaints("", "a", "#include <rddl/b/x.hpp>", uses) and complaints("", "a", "#include <rddl/simulator.hpp>", uses)
    assert not complaints("", "b", "#include <rddl/a/math/x.hpp>\n#include <rddl/b/y.hpp>\n#include <rddl/simulator.h>", uses)


def main() -> int:
    test_itself()
    uses = table((ROOT / "docs/architecture.md").read_text())
    there = {path.name for path in RUNTIME.iterdir() if path.is_dir()}
    found = circles(uses) + [f"docs/architecture.md: `{folder}/` is missing, or is not there" for folder in sorted(there ^ set(uses))]
    count = 0
    for folder in sorted(there & set(uses)):
        for path in sorted((RUNTIME / folder).rglob("*.*pp")):
            count += 1
            found += complaints(str(path.relative_to(ROOT)), folder, path.read_text(), uses)
    print("\n".join(found))
    print(f"{count} files, {len(found)} complaints")
    assert count > 50, "the check looked at nothing"
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
