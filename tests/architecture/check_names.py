"""General code knows no RDDL problem: fails when one's name occurs where design forbids it.

The names are those of the problems in examples/ and, where it is installed, of rddlrepository.
"""

import re
import sys
from pathlib import Path

GENERAL_FOLDERS = ["support", "compiler", "runtime/rddl", "solvers", "planners", "grammar", "templates"]
# Words of the language or of everyday English that also name a problem.
COMMON_WORDS = {"network", "fire", "robot", "delivery", "elevators", "navigation", "traffic", "option"}


def problem_names(root: Path) -> set[str]:
    names = {folder.name for folder in (root / "examples").iterdir() if folder.is_dir()}
    try:
        from rddlrepository.core.manager import RDDLRepoManager

        names |= set(RDDLRepoManager().list_problems())
    except ImportError:
        print("rddlrepository is not installed: only the names of examples/ are checked")
    stems = {re.split(r"_(ippc|gym|or|rddlsim|arcade|physics|MDP|POMDP)", name)[0] for name in names}
    return {name.lower() for name in names | stems} - COMMON_WORDS


def spellings(name: str) -> str:
    """mountain_car also as MountainCar, mountain-car and 'mountain car'."""
    return r"[-_ ]?".join(re.escape(part) for part in name.split("_"))


def main() -> int:
    root = Path(__file__).resolve().parents[2]
    names = sorted(problem_names(root))
    pattern = re.compile(r"\b(" + "|".join(map(spellings, names)) + r")(?:_?\w*)?\b", re.IGNORECASE)
    found = 0
    checked = 0
    for folder in GENERAL_FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if not path.is_file():
                continue
            checked += 1
            for number, line in enumerate(path.read_text(errors="replace").splitlines(), start=1):
                if match := pattern.search(line):
                    print(f"{path.relative_to(root)}:{number}: names the problem '{match.group(0)}'")
                    found += 1
    print(f"{checked} files, {len(names)} names, {found} found")
    assert checked > 50 and len(names) >= 4, "the check looked at nothing"
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
