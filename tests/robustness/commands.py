"""Runs rddlc and rddl as users do, and says what must hold whatever they are given."""

import os
import resource
import signal
import subprocess
import tempfile
import unittest
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = sorted(folder for folder in (ROOT / "examples").iterdir() if folder.is_dir())
RDDLC = os.environ.get("RDDLC", ROOT / "build/bin/rddlc")
RDDL = os.environ.get("RDDL", ROOT / "build/bin/rddl")
# Commands of both programs that check a problem without running it.
LOOKING = [[RDDLC, "--stop-after=emit"], [RDDL, "check"]]

SUCCESS, DIAGNOSED, USAGE = 0, 1, 2
NOBODY = 65534
SECONDS = 600  # Far beyond what any run takes, also with sanitizers on a busy machine: only what hangs fails.


@dataclass
class Result:
    status: int
    output: str
    errors: str

    def __str__(self) -> str:
        return f"status {self.status}\n{self.output[:2000]}\n{self.errors[:2000]}"


def no_disk_space() -> None:
    """Every file of the process is full after 64 bytes."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (64, 64))


class CommandTest(unittest.TestCase):
    """Each test has a folder of its own."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory(prefix="rddlc-robustness-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, name: str, content: bytes | str) -> Path:
        path = self.folder / name
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return path

    def as_nobody(self) -> dict:
        """An argument of run_command: run as a user who may not read or write everything."""
        if os.geteuid() != 0:
            return {}
        os.chown(self.folder, NOBODY, NOBODY)
        return {"user": NOBODY, "group": NOBODY, "extra_groups": []}

    def run_command(self, *words, environment=None, **options) -> Result:
        """Ends by itself and soon, with a status of its own, and finds no mistake in itself."""
        streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
        done = subprocess.run(
            [str(word) for word in words], cwd=self.folder, timeout=SECONDS,
            env={**os.environ, **(environment or {})}, restore_signals=False,
            **{**streams, **options})
        result = Result(done.returncode, (done.stdout or b"").decode(errors="replace"),
                        (done.stderr or b"").decode(errors="replace"))
        self.assertIn(result.status, [SUCCESS, DIAGNOSED, USAGE], f"{words}\n{result}")
        self.assertNotIn("Sanitizer", result.errors)
        self.assertNotIn("runtime error", result.errors)
        return result

    def assert_refused(self, result: Result, code: str = "") -> None:
        self.assertEqual(result.status, DIAGNOSED, result)
        self.assertIn("error: ", result.errors)
        self.assertRegex(result.errors, r"\[E[0-9]{4}\]")
        self.assertIn(code, result.errors)
        self.assertLess(len(result.errors), 20_000, "a screenful of errors is enough")

    def assert_all_refuse(self, *files, code: str = "") -> None:
        """Both programs do."""
        for looking in LOOKING:
            self.assert_refused(self.run_command(*looking, *files), code)

    def assert_all_accept(self, *files) -> None:
        for looking in LOOKING:
            result = self.run_command(*looking, *files)
            self.assertEqual(result.status, SUCCESS, result)
