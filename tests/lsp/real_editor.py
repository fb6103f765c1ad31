"""The first problem of test_diagnostics.py, repaired in an editor that is set up by the lines of editors/README.md."""

import json
import os
import re
import shutil
import subprocess
import tempfile
from pathlib import Path

HERE = Path(__file__).parent
BIN = Path(os.environ.get("RDDLC_BIN", HERE.parents[1] / "build/bin")).resolve()
SKIPPED = 77


def repair_in(editor: str, package: str, language: str, *arguments) -> int:
    """Runs an editor that prints what it did as JSON. `language`: that of its block in editors/README.md."""
    if not shutil.which(editor):
        print(f"skipped: there is no {editor} (Debian's package {package})")
        return SKIPPED
    mistakes = HERE / "first_problem"
    with tempfile.TemporaryDirectory() as folder:
        for name in ["domain.rddl", "instance.rddl"]:
            shutil.copy(mistakes / name, folder)
        setup = Path(folder, "setup")
        setup.write_text(re.search(rf"```{language}\n(.*?)```", (HERE.parents[1] / "editors/README.md").read_text(), flags=re.S)[1])
        environment = {**os.environ, "PATH": f"{BIN}:{os.environ['PATH']}", "FOLDER": folder, "SETUP": str(setup), "HOME": folder,
                       "XDG_STATE_HOME": folder}
        done = subprocess.run([editor, *map(str, arguments)], env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              timeout=240)
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
    print(f"{len(recorded)} mistakes repaired in {editor}")
    return 0
