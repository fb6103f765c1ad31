"""Training on several processes of MPI.

    test_ranks.py --rddl PROGRAM --mpirun PROGRAM --examples FOLDER --cache FOLDER
"""

import argparse
import csv
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

PPO = ["--steps", "12000", "--envs", "8", "--rollout", "50", "--minibatch", "100", "--evaluations", "4", "--seed", "3"]
CGP = ["--gens", "120", "--lambda", "4", "--cols", "20", "--islands", "3", "--seed", "5"]


class Ranks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def words(self, solver, out, options, ranks, program=None):
        start = [OPTIONS.mpirun, "--oversubscribe", "--bind-to", "none", "-np", str(ranks)] if ranks else []
        return [*start, str(program or OPTIONS.rddl), "train", solver, *PROBLEM, "--out", str(self.folder / out), *options]

    def train(self, solver, out, options, ranks, **others):
        return subprocess.run(self.words(solver, out, options, ranks, **others), env=ENVIRONMENT, cwd=self.folder,
                              capture_output=True, text=True, timeout=300)

    def file(self, out, name):
        return (self.folder / out / name).read_bytes()

    def test_a_recurrent_policy_gives_the_same_bytes_and_goes_on(self):
        options = [*PPO, "--recurrent", "6", "--segment", "9"]
        for out, more in ("whole", []), ("parts", ["--time", "0.01"]), ("parts", ["--resume"]):
            done = self.train("ppo", out, [*options, *more], 2)
            self.assertEqual(done.returncode, 0, done.stderr)
        for name in "policy.json", "last.json":
            self.assertEqual(self.file("parts", name), self.file("whole", name))
        self.assertIn(b'"recurrent":{"units":6,', self.file("whole", "last.json"))

    def test_the_same_ranks_give_the_same_bytes(self):
        for out in "a", "b":
            done = self.train("ppo", out, PPO, 2)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stdout.count("best return"), 1, "one rank tells")
        for name in "policy.json", "last.json":
            self.assertEqual(self.file("a", name), self.file("b", name))
        # Twice as many environments: another run than that of one process, and half of the updates.
        self.assertEqual(self.train("ppo", "one", PPO, 0).returncode, 0)
        self.assertNotEqual(self.file("a", "last.json"), self.file("one", "last.json"))
        rows = {out: list(csv.DictReader(self.file(out, "progress.csv").decode().splitlines())) for out in ("a", "one")}
        self.assertEqual([len(rows["a"]), len(rows["one"])], [15, 30])
        self.assertEqual(rows["a"][-1]["time/total_timesteps"], rows["one"][-1]["time/total_timesteps"])

    def test_a_run_of_ranks_goes_on(self):
        self.assertEqual(self.train("ppo", "whole", PPO, 2).returncode, 0)
        self.assertEqual(self.train("ppo", "parts", [*PPO, "--time", "0.01"], 2).returncode, 0)
        self.assertNotEqual(self.file("parts", "last.json"), self.file("whole", "last.json"))
        alone = self.train("ppo", "parts", [*PPO, "--resume"], 0)
        self.assertEqual(alone.returncode, 1)
        self.assertIn("it is of a run of 2 ranks, and this has 1", alone.stderr)
        self.assertEqual(self.train("ppo", "parts", [*PPO, "--resume"], 2).returncode, 0)
        self.assertEqual(self.file("parts", "last.json"), self.file("whole", "last.json"))

    def test_islands_are_the_same_on_any_ranks(self):
        self.assertEqual(self.train("cgp", "one", CGP, 0).returncode, 0)
        for ranks in 2, 3:
            out = f"ranks{ranks}"
            done = self.train("cgp", out, [*CGP, "--time", "0.01"], ranks)
            self.assertEqual(done.returncode, 0, done.stderr)
            # A run of one number of ranks resumes with another.
            self.assertEqual(self.train("cgp", out, [*CGP, "--resume"], 5 - ranks).returncode, 0)
            for name in "policy.cgp", "last.cgp":
                self.assertEqual(self.file(out, name), self.file("one", name), ranks)

    def test_a_mistake_is_told_once(self):
        done = self.train("cgp", "few", [*CGP[:-4], "--islands", "1"], 2)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.count("2 ranks need as many islands, and --islands is 1"), 1, done.stderr)

    def test_ranks_that_read_different_problems_are_refused(self):
        other = self.folder / "other.rddl"
        other.write_text(Path(PROBLEM[1]).read_text().replace("horizon = 200", "horizon = 201"))
        script = self.folder / "rddl"  # one rank has another instance
        script.write_text(f"""#!/bin/sh
test "$OMPI_COMM_WORLD_RANK" = 1 && shift 4 && set -- train "$SOLVER" "{PROBLEM[0]}" "{other}" "$@"
exec "{OPTIONS.rddl}" "$@"
""")
        script.chmod(0o755)
        for solver, options in ("ppo", PPO), ("cgp", CGP):
            ENVIRONMENT["SOLVER"] = solver
            done = self.train(solver, solver, options, 2, program=script)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn("the ranks have read different problems", done.stderr)
            self.assertRegex(done.stderr, "the horizon was 20[01] and is 20[01]")
            self.assertFalse((self.folder / solver / "checkpoint").exists())

    def test_a_rank_that_dies_ends_the_run(self):
        options = [*PPO[2:], "--steps", "1e12"]
        self.assertEqual(self.train("ppo", "killed", [*options, "--time", "0.01"], 2).returncode, 0)
        before = self.file("killed", "checkpoint")
        run = subprocess.Popen(self.words("ppo", "killed", [*options, "--resume"], 2), env=ENVIRONMENT,
                               cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        time.sleep(3)
        os.kill(self.last_rank(run.pid), signal.SIGKILL)
        told = run.communicate(timeout=60)[0]
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("lost contact with another rank, which has ended", told)
        self.assertIn("the last checkpoint is whole", told)
        self.assertEqual(self.file("killed", "checkpoint"), before)
        self.assertEqual(self.train("ppo", "killed", [*options, "--resume", "--time", "1"], 2).returncode, 0)

    def last_rank(self, parent):
        children = [int(word) for task in Path(f"/proc/{parent}/task").iterdir()
                    for word in (task / "children").read_text().split()]
        ranks = [child for child in children if b"rddl" in Path(f"/proc/{child}/cmdline").read_bytes()]
        self.assertEqual(len(ranks), 2)
        return max(ranks)

    def test_a_program_without_mpi_says_so(self):
        alone = self.folder / "bin/rddl"
        alone.parent.mkdir()
        shutil.copy2(OPTIONS.rddl, alone)
        done = self.train("ppo", "alone", PPO, 2, program=alone)
        self.assertEqual(done.returncode, 2)
        self.assertIn("was built without MPI", done.stderr)
        self.assertEqual(self.train("ppo", "alone", PPO, 0, program=alone).returncode, 0)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--rddl", type=Path, required=True)
    parser.add_argument("--mpirun", required=True)
    parser.add_argument("--examples", type=Path, required=True)
    parser.add_argument("--cache", required=True)
    OPTIONS, rest = parser.parse_known_args()
    PROBLEM = [str(OPTIONS.examples / "mountain_car" / f"{name}.rddl") for name in ("domain", "instance")]
    PROBLEM += ["--engine", "interpreter"]
    # Tests may be run by root, in containers; mpirun requires these variables.
    ENVIRONMENT = {**os.environ, "XDG_CACHE_HOME": OPTIONS.cache, "OMPI_ALLOW_RUN_AS_ROOT": "1",
                   "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    unittest.main(argv=[sys.argv[0], *rest])
