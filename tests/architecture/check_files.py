"""No tracked file is a cache, none is large without a reason, and long sources say why they are one file.

Without git, as in a release that was unpacked, the files of the folder are checked, except those of builds.
"""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LARGEST = 500_000  # bytes
# Larger ones, each with its reason.
REASONS: dict[str, str] = {}
LONGEST = 400  # lines of a source without "Over 400 lines: REASON." at its top
SOURCE = re.compile(r"^(?!generated/).*\.(cpp|hpp|h|py|js|cmake|sh)$")
CACHE = re.compile(r"(^|/)(\.[^/]*_cache|__pycache__|\.cache|\.ccache|node_modules|\.ipynb_checkpoints)/|\.(pyc|pyo|o|gcda|gcno|swp)$")
# Folders of builds and tools.
OWN = re.compile(r"^(\.git|\.venv|build[^/]*|shared)(/|$)")


def tracked(root: Path) -> list[str] | None:
    """Returns None if this is not a checkout."""
    try:
        found = subprocess.run(["git", "-C", str(root), "ls-files", "-z"], capture_output=True, check=True)
        top = subprocess.run(["git", "-C", str(root), "rev-parse", "--show-toplevel"], capture_output=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return None
    if Path(top.stdout.decode().strip()) != root:
        return None  # unpacked within a checkout of something else
    return [name for name in found.stdout.decode().split("\0") if name]


def unpacked(root: Path) -> list[str]:
    """Leaves out the caches that running tests makes here."""
    names = (str(path.relative_to(root)) for path in root.rglob("*") if path.is_file())
    return [name for name in names if not OWN.match(name) and not CACHE.search(name)]


def complaints(names: list[str], size_of) -> list[str]:
    found = [f"{name}: a cache is no part of the sources: git rm --cached" for name in names if CACHE.search(name)]
    for name in names:
        if CACHE.search(name) or (size := size_of(name)) <= LARGEST or name in REASONS:
            continue
        found.append(f"{name}: {size:,} bytes: make it smaller, or by a script, or list a reason in REASONS")
    return found + [f"{name}: is listed as large, and is not there" for name in REASONS if name not in names]


def too_long(name: str, lines: list[str]) -> list[str]:
    reason = f"Over {LONGEST} lines: "
    if not SOURCE.match(name) or len(lines) <= LONGEST or any(reason in line for line in lines[:60]):
        return []
    return [f"{name}: {len(lines)} lines: make two files of two ideas, or say at the top '{reason}REASON.'"]


def test_itself() -> None:
    assert too_long("a.cpp", [""] * 401) and not too_long("a.cpp", ["// Over 400 lines: one table."] + [""] * 400)
    assert not too_long("a.cpp", [""] * 400) and not too_long("generated/a.cpp", [""] * 999)
    sizes = {"a/.mypy_cache/3.11/x.json": 10, "a/__pycache__/b.c": 10, "c.pyc": 1, "big": LARGEST + 1, "ok/cache/x": 5}
    assert [line.split(":")[0] for line in complaints(list(sizes), sizes.get)] == list(sizes)[:4]


def main() -> int:
    test_itself()
    names = tracked(ROOT)
    if names is None:
        names = unpacked(ROOT)
    there = [name for name in names if (ROOT / name).is_file()]
    found = complaints(there, lambda name: (ROOT / name).stat().st_size)
    for name in there:
        if SOURCE.match(name):
            found += too_long(name, (ROOT / name).read_text(errors="replace").splitlines())
    print("\n".join(found))
    print(f"{len(there)} files, {len(found)} complaints")
    assert len(there) > 500, "the check looked at nothing"
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
