"""The target `rddlc_installed`, which scripts/quickstart.sh builds, makes all that `cmake --install` needs: each thing
that is built and installed is part of it.

    check_installed.py BUILD_FOLDER
"""

import re
import subprocess
import sys
from pathlib import Path

build = Path(sys.argv[1])


def asked(tool: str) -> set[Path]:
    """Files that a tool of ninja names, which are inputs of the target: of its own, or those below."""
    text = subprocess.run(["ninja", "-C", build, "-t", tool, "rddlc_installed"], check=True, capture_output=True,
                          text=True).stdout
    return {(build / line.strip()).resolve() for line in text.splitlines()}


def install_scripts(script: Path) -> list[Path]:
    """A script of `cmake --install` and those that it includes. Other build folders may lie in this one."""
    below = re.findall(r'include\("([^"]+/cmake_install\.cmake)"\)', script.read_text())
    return [script] + [found for path in below for found in install_scripts(Path(path))]


built = asked("query") | asked("inputs")
installed = set()
for script in install_scripts(build / "cmake_install.cmake"):
    for component in script.read_text().split("if(CMAKE_INSTALL_COMPONENT ")[1:]:
        if "OR NOT CMAKE_INSTALL_COMPONENT)" not in component.splitlines()[0]:
            continue  # a component for those who name it
        for files in re.findall(r"TYPE (?:EXECUTABLE|STATIC_LIBRARY|MODULE) FILES (.*?)\)", component):
            installed |= {Path(name).resolve() for name in re.findall('"([^"]+)"', files)}
missing = sorted(str(path) for path in installed - built if path.is_relative_to(build.resolve()))
if not installed:
    sys.exit("no installed program or library was found")
if missing:
    sys.exit("installed, but not part of the target rddlc_installed: " + ", ".join(missing))
