"""Commands that are ended: what is finished is kept, and nothing else is left, neither files nor processes."""

import os
import random
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from commands import EXAMPLES, RDDL, RDDLC, SECONDS, SUCCESS, CommandTest

PROBLEM = EXAMPLES[0] / "domain.rddl", EXAMPLES[0] / "instance.rddl"
LONG_RUN = [RDDL, "run", *PROBLEM, "--engine=interpreter", "--episodes=1000000", "--threads=1"]

# Writes its number and that of what it starts, which ends by itself only after the test.
SLOW_COMPILER = """
case "$*" in *--version*|*-fsyntax-only*) exit 0 ;; esac
sleep 1000 &
echo $$ $! >> processes
wait
"""

# A compiler that takes its time for the shared code, and no time for a simulator, which was
# compiled before.
COMPILER = """
case "$*" in *--version*|*-fsyntax-only*) exit 0 ;; *batches.cpp*) echo batches >> log; sleep 0.3 ;; esac
while [ $# -gt 0 ]; do
    case $1 in -o) output=$2; shift ;; -shared) shared=yes ;; esac
    shift
done
if [ "$shared" ]; then cat "$SIMULATOR" > "$output"; else echo object > "$output"; fi
"""


def wait_until(condition) -> None:
    end = time.monotonic() + SECONDS
    while not condition():
        if time.monotonic() > end:
            raise TimeoutError(condition)
        time.sleep(0.02)


def runs(process: int) -> bool:
    try:
        return Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


class ProcessTest(CommandTest):
    def start(self, *words, environment=None, **options) -> subprocess.Popen:
        streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
        process = subprocess.Popen([str(word) for word in words], cwd=self.folder,
                                   env={**os.environ, **(environment or {})},
                                   **{**streams, **options})
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        return process


class Signals(ProcessTest):
    def start_tracing(self, *words) -> subprocess.Popen:
        """Once the trace has been written to."""
        process = self.start(*words, "--trace", "t.jsonl")
        files = Path(f"/proc/{process.pid}/fd")

        def has_written() -> bool:
            return any(os.readlink(file).startswith(str(self.folder)) and file.stat().st_size > 0
                       for file in list(files.iterdir()) if file.exists())
        wait_until(has_written)
        return process

    def test_what_is_finished_is_kept(self):
        for number in signal.SIGHUP, signal.SIGINT, signal.SIGTERM:
            process = self.start_tracing(*LONG_RUN)
            process.send_signal(number)
            errors = process.communicate(timeout=SECONDS)[1].decode()
            self.assertEqual(process.returncode, 128 + number, errors)
            self.assertIn("interrupted after", errors)
            lines = (self.folder / "t.jsonl").read_text().splitlines()
            self.assertGreater(len(lines), 1)
            self.assertTrue(lines[-1].endswith("}"))
            self.assertEqual(os.listdir(self.folder), ["t.jsonl"])
            (self.folder / "t.jsonl").unlink()

    def test_hangups_may_be_ignored(self):
        process = self.start_tracing("nohup", *LONG_RUN)
        process.send_signal(signal.SIGHUP)
        time.sleep(0.2)
        self.assertIsNone(process.poll())
        process.terminate()
        process.communicate(timeout=SECONDS)
        self.assertEqual(process.returncode, 128 + signal.SIGTERM)

    @unittest.skipUnless(hasattr(os, "O_TMPFILE"), "files have names here")
    def test_nothing_is_left_of_a_killed_run(self):
        try:
            os.close(os.open(self.folder, os.O_TMPFILE | os.O_WRONLY))
        except OSError:
            self.skipTest("files have names on this file system")
        process = self.start_tracing(*LONG_RUN)
        process.kill()
        process.communicate()
        self.assertEqual(os.listdir(self.folder), [])

    def test_compilers_end_with_those_who_wait_for_them(self):
        self.write("compiler.sh", SLOW_COMPILER)
        environment = {"CXX": "sh compiler.sh", "XDG_CACHE_HOME": str(self.folder / "cache")}
        for words in [RDDL, "run", *PROBLEM, "--engine=compiled", "--quiet"], [RDDLC, *PROBLEM, "-o", "sim.so"]:
            for number in signal.SIGKILL, signal.SIGTERM:
                if words[0] == RDDL and number == signal.SIGTERM:
                    continue  # It waits for its compilers.
                with self.subTest(words=words, number=number):
                    log = self.write("processes", "")
                    process = self.start(*words, environment=environment)
                    wait_until(lambda: len(log.read_text().splitlines()) >= 2)
                    process.send_signal(number)
                    process.communicate()
                    numbers = [int(word) for word in log.read_text().split()]
                    wait_until(lambda: not any(map(runs, numbers)))

    def test_compilers_read_nothing(self):
        """The lines of replay are not theirs."""
        self.write("compiler.sh", "cat > read; exit 1")
        self.run_command(RDDL, "replay", *PROBLEM, "--engine=compiled", input=b"{}\n", environment={
            "CXX": "sh compiler.sh", "XDG_CACHE_HOME": str(self.folder / "cache")})
        self.assertEqual((self.folder / "read").read_text(), "")


class Stampede(ProcessTest):
    """Many first runs at the same time, some of which are killed."""

    RUN = [RDDL, "run", *PROBLEM, "--engine=compiled", "--quiet"]

    @classmethod
    def setUpClass(cls) -> None:
        cache = tempfile.TemporaryDirectory(prefix="rddlc-robustness-")
        cls.addClassCleanup(cache.cleanup)
        subprocess.run([str(word) for word in cls.RUN], check=True, timeout=SECONDS,
                       env={**os.environ, "XDG_CACHE_HOME": cache.name})
        [cls.simulator] = Path(cache.name, "rddlc").glob("*.so")

    def setUp(self) -> None:
        super().setUp()
        self.write("compiler.sh", COMPILER)
        self.environment = {"CXX": "sh compiler.sh", "XDG_CACHE_HOME": str(self.folder / "cache"),
                            "SIMULATOR": str(self.simulator)}

    def runtimes_made(self) -> int:
        log = self.folder / "log"
        return len(log.read_text().splitlines()) if log.exists() else 0

    def assert_cache_is_right(self) -> None:
        made = self.runtimes_made()
        self.assertEqual(self.run_command(*self.RUN, environment=self.environment).status, SUCCESS)
        self.assertEqual(self.runtimes_made(), made)
        names = sorted(path.suffix for path in (self.folder / "cache/rddlc").iterdir())
        self.assertEqual(names, [".runtime", ".so"])

    def test_one_compiles_and_the_others_wait(self):
        all_of_them = [self.start(*self.RUN, environment=self.environment) for _ in range(10)]
        for process in all_of_them:
            self.assertEqual((process.communicate(timeout=SECONDS)[1], process.returncode), (b"", 0))
        self.assertEqual(self.runtimes_made(), 1)
        self.assert_cache_is_right()

    def test_some_are_killed(self):
        seed = random.randrange(2**32)
        chance = random.Random(seed)
        all_of_them = [self.start(*self.RUN, environment=self.environment) for _ in range(10)]
        for process in chance.sample(all_of_them, 5):
            time.sleep(chance.uniform(0, 0.2))
            process.kill()
        for process in all_of_them:
            errors = process.communicate(timeout=SECONDS)[1]
            self.assertIn(process.returncode, [0, -signal.SIGKILL], f"seed {seed}: {errors}")
        # The next compilation removes what killed processes have left.
        self.assertEqual(self.run_command(
            *self.RUN, "--no-cache", environment=self.environment).status, SUCCESS)
        self.assert_cache_is_right()


if __name__ == "__main__":
    unittest.main()
