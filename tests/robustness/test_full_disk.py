"""A disk that fills up at any moment: each call that needs space fails in turn, and all later ones.

Every output is there as a whole, or as it was before; a sentence says why; and no message says
that rddlc or rddl were wrong.
"""

import os
import resource
import shutil
import signal
import unittest
from pathlib import Path

from commands import DIAGNOSED, EXAMPLES, RDDL, RDDLC, ROOT, SUCCESS, CommandTest

LIBRARY = os.environ.get("FULL_DISK", Path(RDDLC).parents[1] / "tests/robustness/libfull_disk.so")
PROBLEM = EXAMPLES[0] / "domain.rddl", EXAMPLES[0] / "instance.rddl"
INTERPRET = "--engine=interpreter"
MOST_CALLS = 200  # Each command makes far fewer; a test that does not end would show nothing.

# Takes no time: the simulator is compiled once, and everything else is empty.
COMPILER = """
while [ $# -gt 0 ]; do
    case $1 in -o) output=$2; shift ;; -shared) shared=yes ;; --version) exit 0 ;; esac
    shift
done
if [ "$shared" ]; then cat "$SIMULATOR" > "$output"; else echo object > "$output"; fi
"""


# The real one, which leaves out what takes it long.
QUICK_COMPILER = 'exec c++ "$@" -O0 -DRDDL_LINKS_BATCHES\n'


class FullDisk(CommandTest):
    def setUp(self) -> None:
        super().setUp()
        for name, path in zip(("domain.rddl", "instance.rddl"), PROBLEM):
            shutil.copy(path, self.folder / name)
        self.write("untidy.rddl", "domain d{reward=1;}")
        self.write("steps.jsonl", '{"repeat": 300}\n{}\n')
        self.write("compiler.sh", COMPILER)
        self.write("quick_compiler.sh", QUICK_COMPILER)
        self.environment = {"CXX": "sh compiler.sh", "SIMULATOR": str(self.folder / "simulator.so"),
                            "XDG_CACHE_HOME": str(self.folder / "cache"),
                            "TMPDIR": str(self.folder / "tmp")}

    def fill_at_each_call(self, outputs, *words, of=None) -> int:
        """The number of calls of the program that need room. Each failed call leaves older files, or
        complete ones."""
        older = "older\n"
        complete = self.complete(outputs, older, *words)
        for call in range(1, MOST_CALLS):
            self.start_with(outputs, older)
            result = self.run_command(*words, environment={
                **self.environment, "LD_PRELOAD": str(LIBRARY), "FULL_DISK_AT": str(call),
                "FULL_DISK_OF": of or Path(words[0]).name})
            if result.status == SUCCESS:
                self.assertEqual(self.contents(outputs), complete)
                return call - 1
            self.assertEqual(result.status, DIAGNOSED, result)
            self.assertIn("No space left on device", result.errors)
            self.assertNotIn("mistake", result.errors)
            for name, text in self.contents(outputs).items():
                self.assertIn(text, (older, complete[name]), f"{name} after call {call}")
            self.assertEqual(self.left_behind(), [])
        self.fail("the command has no end")

    def start_with(self, outputs, older) -> None:
        for name in "cache", "tmp":
            shutil.rmtree(self.folder / name, ignore_errors=True)
            (self.folder / name).mkdir()
        for name in outputs:
            self.write(name, older)

    def contents(self, outputs) -> dict:
        paths = {name: self.folder / name for name in outputs}
        return {name: path.read_text(errors="replace") if path.exists() else None
                for name, path in paths.items()}

    def complete(self, outputs, older, *words) -> dict:
        self.start_with(outputs, older)
        result = self.run_command(*words, environment=self.environment)
        self.assertEqual(result.status, SUCCESS, result)
        return self.contents(outputs)

    def left_behind(self) -> list[str]:
        found = [path.name for path in self.folder.rglob("*")]
        return [name for name in found if name.startswith((".rddlc-", "building-", "rddlc-"))]

    def test_texts(self):
        self.assertGreater(self.fill_at_each_call(
            ["sim.cpp", "sim.cpp.d"], RDDLC, "domain.rddl", "instance.rddl", "-o", "sim.cpp",
            "-MD"), 5)
        self.assertGreater(self.fill_at_each_call(
            ["tidy.rddl"], RDDL, "fmt", "untidy.rddl", "-o", "tidy.rddl"), 2)

    def test_file_in_place(self):
        untidy = "domain d{reward=2;}"
        self.write("file.rddl", untidy)
        for call in range(1, 4):
            result = self.run_command(RDDL, "fmt", "file.rddl", environment={
                "LD_PRELOAD": str(LIBRARY), "FULL_DISK_AT": str(call), "FULL_DISK_OF": "rddl"})
            self.assertEqual(result.status, DIAGNOSED, result)
            self.assertEqual((self.folder / "file.rddl").read_text(), untidy)
        self.assertEqual(self.left_behind(), [])

    def test_lines(self):
        problem = "domain.rddl", "instance.rddl", INTERPRET
        self.assertGreater(self.fill_at_each_call(
            ["t.jsonl"], RDDL, "run", *problem, "--episodes=20", "--quiet", "--trace=t.jsonl"), 2)
        self.assertGreater(self.fill_at_each_call(
            ["t.jsonl"], RDDL, "replay", *problem, "--input=steps.jsonl", "--output=t.jsonl"), 2)

    def test_pictures(self):
        problem = "domain.rddl", "instance.rddl", INTERPRET
        self.assertGreater(self.fill_at_each_call(
            ["a.gif", "a.png", "a.svg", "a.html"], RDDL, "run", *problem, "--horizon=3", "--quiet",
            "--size=60x40", "--gif=a.gif", "--png=a.png", "--svg=a.svg", "--html=a.html"), 10)

    def test_folders_of_pictures(self):
        """Files that were drawn before stay; each is complete."""
        problem = "domain.rddl", "instance.rddl", INTERPRET
        for kind in "png", "svg":
            (self.folder / kind).mkdir()
            self.assertGreater(self.fill_at_each_call(
                [f"{kind}/{step:06}.{kind}" for step in range(3)], RDDL, "run", *problem, "--horizon=2",
                "--quiet", "--size=60x40", f"--{kind}={kind}"), 5)

    @unittest.skipUnless(shutil.which("ffmpeg"), "videos are made by ffmpeg")
    def test_videos(self):
        for of in "rddl", "ffmpeg":
            self.assertGreater(self.fill_at_each_call(
                ["a.mp4"], RDDL, "run", "domain.rddl", "instance.rddl", INTERPRET, "--horizon=2",
                "--quiet", "--size=60x40", "--video=a.mp4", of=of), 2)

    def test_checkpoints(self):
        """The earlier files of a run are whole at any time, and it resumes when there is space
        again."""
        ppo = "train", "ppo", "--steps=3000", "--envs=4", "--rollout=50", "--minibatch=100", "--hidden=8", "--evaluations=2"
        cgp = "train", "cgp", "--gens=40", "--lambda=2", "--cols=10", "--evaluations=2"
        for policy, words in (("last.json", ppo), ("last.cgp", cgp)):
            def train(folder, *more, words=words, **environment):
                return self.run_command(RDDL, *words, "domain.rddl", "instance.rddl", INTERPRET, "--quiet", "--out",
                                        folder, *more, environment={**self.environment, **environment})
            self.assertEqual(train("whole").status, SUCCESS)
            self.assertEqual(train("first", "--time=0.001").status, SUCCESS)
            names = {path.name for path in (self.folder / "first").iterdir()}
            # The last call fails that is one of the run's: the one after it is never made.
            for call in range(1, MOST_CALLS):
                shutil.rmtree(self.folder / "run", ignore_errors=True)
                shutil.copytree(self.folder / "first", self.folder / "run")
                result = train("run", "--resume", LD_PRELOAD=str(LIBRARY), FULL_DISK_AT=str(call), FULL_DISK_OF="rddl")
                if result.status == SUCCESS:
                    break
                self.assertEqual(result.status, DIAGNOSED, result)
                self.assertIn("No space left on device", result.errors)
                self.assertEqual({path.name for path in (self.folder / "run").iterdir()}, names)
                self.assertEqual((self.folder / "run/checkpoint").read_bytes(),
                                 (self.folder / "first/checkpoint").read_bytes())
                self.assertEqual(train("run", "--resume").status, SUCCESS)
                self.assertEqual((self.folder / "run" / policy).read_bytes(), (self.folder / "whole" / policy).read_bytes())
            else:
                self.fail("the command has no end")
            self.assertGreater(call, 5)
            for folder in "whole", "first", "run":
                shutil.rmtree(self.folder / folder)

    def test_compiled_simulators(self):
        for words in ([RDDLC, "domain.rddl", "instance.rddl", "-o", "simulator.cpp"],
                      ["c++", "-std=c++20", "-O0", "-shared", "-fPIC", "-I", ROOT / "runtime",
                       "-DRDDL_ENTRY=rddl_simulator_entry", "simulator.cpp", "-o", "simulator.so"]):
            self.assertEqual(self.run_command(*words).status, SUCCESS)
        self.assertGreater(self.fill_at_each_call(
            ["sim.so"], RDDLC, "domain.rddl", "instance.rddl", "-o", "sim.so"), 5)
        self.assertGreater(self.fill_at_each_call(
            [], RDDL, "run", "domain.rddl", "instance.rddl", "--engine=compiled", "--quiet"), 10)

    def test_compilers_that_find_no_room(self):
        """The real compiler, at limits of which the smallest stop ourselves."""
        self.start_with([], None)
        rddlc = [RDDLC, "domain.rddl", "instance.rddl", "-o", "sim.so"]
        rddl = [RDDL, "run", "domain.rddl", "instance.rddl", "--engine=compiled", "--quiet"]
        for most, words in (100, rddlc), (100, rddl), (20_000, rddlc):
            def limit_files(most=most):
                signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
                resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))
            result = self.run_command(
                *words, environment={**self.environment, "CXX": "sh quick_compiler.sh"},
                preexec_fn=limit_files)
            self.assertEqual(result.status, DIAGNOSED, result)
            self.assertRegex(result.errors, "File too large|File size limit|E0910")
            self.assertFalse((self.folder / "sim.so").exists())
            self.assertEqual(self.left_behind(), [])


if __name__ == "__main__":
    unittest.main()
