#!/usr/bin/env python3
"""The picture of the house in docs/architecture.md, drawn from the build files.

    scripts/house.py            writes it
    scripts/house.py --check    status 1 if it is not what the build files say

An arrow leads from a folder to one that it uses. An arrow is left out where a longer way shows it.
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs/architecture.md"
FOLDERS = ("support", "runtime", "grammar", "compiler", "render", "solvers", "planners", "workbench", "cli", "python")
BEGIN, END = "<!-- drawn by scripts/house.py: {} -->\n", "<!-- end -->\n"

CALL = re.compile(r"^\s*(rddlc_stage|rddl_solver_library|target_link_libraries)\(([^)]*)\)", re.M)
COMMENT = re.compile(r"#.*")
WORDS = {"FAST", "SOURCES", "FOLDERS", "USES", "LIBRARIES", "PUBLIC", "PRIVATE", "INTERFACE"}


def libraries():
    """The folder of each library, and the libraries that each folder uses: a folder of a stage, as compiler/check."""
    folder_of, uses = {"rddlc_workbench": "workbench"}, {}
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("CMakeLists.txt")):
            place = str(path.parent.relative_to(ROOT))
            for call, text in CALL.findall(COMMENT.sub("", path.read_text())):
                name, *words = text.replace("$<BUILD_INTERFACE:", "").replace(">", "").split()
                prefix = {"rddlc_stage": "rddlc_", "rddl_solver_library": "rddl_"}.get(call, "")
                folder_of.setdefault(prefix + name, place)
                if call == "rddlc_stage":
                    words = words[words.index("USES") + 1 :] if "USES" in words else []
                names = [re.sub(r"^rddl::", "rddl_", word) for word in words if word not in WORDS]
                known = uses.setdefault(place, set())
                known |= {n if n.startswith(("rddl_", "rddlc_")) else f"rddlc_{n}" for n in names}
    return folder_of, uses


def graph(key):
    """{node: the nodes that it uses}, where `key` gives the node of a folder, or None."""
    folder_of, uses = libraries()
    nodes = {}
    for folder, names in uses.items():
        if (node := key(folder)) is None:
            continue
        found = {key(folder_of[name]) for name in names if name in folder_of}
        nodes.setdefault(node, set()).update(found - {node, None})
    for used in [each for found in nodes.values() for each in found]:
        nodes.setdefault(used, set())
    return nodes


def reduced(nodes):
    """Without the arrows that a longer way shows."""

    def below(node):
        return nodes[node].union(*(below(used) for used in nodes[node]))

    return {node: used - set().union(*(below(each) for each in used)) for node, used in nodes.items()}


def drawn(nodes):
    arrows = [f"    {node} --> {used}\n" for node in sorted(nodes) for used in sorted(nodes[node])]
    return "```mermaid\nflowchart TD\n" + "".join(arrows) + "```\n"


def house(folder):
    return folder.split("/")[0]


def stages(top):
    return lambda folder: folder.split("/")[1] if folder.startswith(top + "/") else None


PICTURES = {"the house": house, "the compiler": stages("compiler"), "the workbench": stages("workbench")}


def main():
    page = new = PAGE.read_text()
    for name, key in PICTURES.items():
        begin = BEGIN.format(name)
        before, rest = new.split(begin, 1)
        new = before + begin + drawn(reduced(graph(key))) + END + rest.split(END, 1)[1]
    if "--check" not in sys.argv[1:]:
        PAGE.write_text(new)
    elif new != page:
        print("docs/architecture.md: scripts/house.py draws other pictures")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
