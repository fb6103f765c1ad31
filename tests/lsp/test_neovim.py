"""The first problem of test_diagnostics.py in a headless Neovim.

    RDDLC_BIN=build/bin test_neovim.py
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).parent
BIN = Path(os.environ.get("RDDLC_BIN", HERE.parents[1] / "build/bin")).resolve()
SKIPPED = 77


def main():
    if not shutil.which("nvim"):
        print("skipped: there is no nvim (Debian's package neovim)")
        return SKIPPED
    mistakes = HERE / "first_problem"
    with tempfile.TemporaryDirectory() as folder:
        for name in ["domain.rddl", "instance.rddl"]:
            shutil.copy(mistakes / name, folder)
        setup = Path(folder, "setup.lua")
        setup.write_text(re.search(r"```lua\n(.*?)```", (HERE.parents[1] / "editors/README.md").read_text(), flags=re.S)[1])
        environment = {**os.environ, "PATH": f"{BIN}:{os.environ['PATH']}", "FOLDER": folder, "SETUP": str(setup), "HOME": folder,
                       "XDG_STATE_HOME": folder}
        done = subprocess.run(["nvim", "--headless", "-u", "NONE", "-n", "-c", f"luafile {HERE / 'neovim.lua'}"], env=environment,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=240)
    if done.returncode != 0:
        print(done.stdout.decode(), done.stderr.decode())
        return 1
    result = json.loads(done.stdout)
    recorded = json.loads((mistakes / "session.json").read_text())
    assert all(step.pop("is_explained") for step in result["steps"]), result["steps"]
    assert result["steps"] == recorded, result["steps"]
    for name, text in result["repaired"].items():
        assert text == (mistakes / f"repaired_{name}").read_text(), text
    assert result["completes"] and result["clean_after_rename"], result
    print(f"{len(recorded)} mistakes repaired in Neovim")
    return 0


if __name__ == "__main__":
    sys.exit(main())
