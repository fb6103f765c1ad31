"""engine="auto": steps at once, and the change to the compiled simulator without a different bit."""

from __future__ import annotations

import copy
import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import uuid
from pathlib import Path
from typing import Any

import numpy as np
from start import Courses
from support import COUNTERS, problem_of_text

import rddlc

WORDS = """
import os, signal, sys, time
import rddlc
from test_start import is_running, new_problem
"""


def new_problem(engine: str = "auto") -> rddlc.Problem:
    """One whose text nothing has compiled before."""
    number = f"0.{uuid.uuid4().int % 10**15}"
    text = COUNTERS.replace("filled + push - pull;", f"filled + push - pull + Normal(0, 1) * {number};")
    return problem_of_text(text, "counters", engine)


def run(program: str, **variables: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", WORDS + program],
        env={**os.environ, **variables},
        cwd=Path(__file__).parent,
        text=True,
        capture_output=True,
        timeout=300,
    )


def script(folder: str, text: str) -> str:
    """A compiler."""
    file = Path(folder) / "compiler"
    file.write_text("#!/bin/sh\n" + text)
    file.chmod(0o755)
    return str(file)


def is_running(pid: str) -> bool:
    try:
        return Path("/proc", pid, "stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


class Change(unittest.TestCase):
    def test_an_episode_changes_no_bit(self) -> None:
        courses = Courses(new_problem(), lambda problem: rddlc.make(problem, horizon=0))
        self.assertFalse(courses.problem.is_compiled)
        courses.run_until_compiled()
        self.assertTrue(courses.problem.is_compiled)
        courses.run(50)

    def test_a_vector_changes_no_bit(self) -> None:
        def make(problem: rddlc.Problem) -> rddlc.RDDLVectorEnv:
            return rddlc.make_vec(problem, num_envs=13, threads=2, autoreset_mode="SameStep")

        courses = Courses(new_problem(), make)
        courses.run_until_compiled()
        courses.run(50)

    def test_copies_and_pickles_change_on_their_own(self) -> None:
        problem = new_problem()
        env = rddlc.make(problem, horizon=0)
        env.reset(seed=1)
        env.step({})
        others = [copy.deepcopy(env), pickle.loads(pickle.dumps(env))]
        self.assertTrue(problem.wait(120))
        expected = [env.step({})[:2] for _ in range(20)]
        for other in others:
            self.assertEqual([other.step({})[:2] for _ in range(20)], expected)

    def test_a_forked_process_changes_by_itself(self) -> None:
        problem = new_problem()
        env = rddlc.make(problem, horizon=0)
        env.reset(seed=1)
        queue = multiprocessing.get_context("fork").Queue()

        def child() -> None:
            rewards = [env.step({})[1] for _ in range(1000)]
            queue.put((rewards, problem.wait(120), [env.step({})[1] for _ in range(5)]))

        process = multiprocessing.get_context("fork").Process(target=child)
        process.start()
        rewards, is_compiled, more = queue.get(timeout=200)
        process.join()
        self.assertTrue(is_compiled)
        self.assertEqual(rewards + more, [env.step({})[1] for _ in range(1005)])

    def test_learners_go_on_across_the_change(self) -> None:
        options: dict[str, Any] = {"environments": 8, "rollout": 20, "minibatch": 80, "seed": 3}
        problem = new_problem()
        interpreted = rddlc.Problem(*problem.files, engine="interpreter")
        learned = [
            rddlc.PPO(each, **options).learn(1600).policy_text for each in (problem, interpreted)
        ]
        self.assertEqual(*learned)


class Start(unittest.TestCase):
    def test_nothing_waits_for_the_compiler(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            result = run(
                "begin = time.monotonic()\n"
                "env = rddlc.make(new_problem())\n"
                "env.reset(seed=1); env.step({})\n"
                "print(env.problem.is_compiled, time.monotonic() - begin < 5)",
                CXX=script(folder, "sleep 1013"),
                XDG_CACHE_HOME=folder,
            )
            self.assertEqual((result.stdout, result.stderr), ("False True\n", ""))
            # The compiler has ended with the process, and so has all that it was to make.
            left = [each.name for each in Path(folder, "rddlc").iterdir()]
            self.assertEqual([each for each in left if not each.endswith(".lock")], [])
            self.assertNotIn(
                "sleep 1013", subprocess.run(["ps", "ax"], capture_output=True, text=True).stdout
            )

    def test_without_a_compiler_it_stays_interpreted_and_says_so_once(self) -> None:
        result = run(
            "for _ in range(2):\n    env = rddlc.make(new_problem()); env.reset(seed=1); env.step({})\n"
            "print(env.problem.engine)",
            CXX="/missing/compiler",
        )
        self.assertEqual(result.stdout, "interpreter\n")
        self.assertEqual(result.stderr.count("there is no C++ compiler '/missing/compiler'"), 1)

    def test_a_compiler_that_fails_is_told(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            result = run(
                "problem = new_problem(); env = rddlc.make(problem); env.reset(seed=1)\n"
                "print(problem.wait(), env.step({})[2:4], problem.is_compiled)",
                CXX=script(folder, 'echo "no room"; exit 1'),
                XDG_CACHE_HOME=folder,
            )
        self.assertEqual(result.stdout, "False (False, False) False\n")
        self.assertRegex(result.stderr, "^warning: .*counters")
        self.assertEqual(result.stderr.count("is interpreted, which is slower"), 1)

    def test_a_cache_that_cannot_be_written_is_told(self) -> None:
        with tempfile.NamedTemporaryFile() as file:
            result = run(
                "problem = new_problem(); print(problem.wait())\n"
                "env = rddlc.make(problem); env.reset(seed=1); env.step({})",
                XDG_CACHE_HOME=file.name,
            )
        self.assertEqual(result.stdout, "False\n")
        self.assertIn("cannot make the folder", result.stderr)

    def test_interrupts_leave_the_build_alone(self) -> None:
        result = run(
            "os.setpgrp()\n"
            "problem = new_problem()\n"
            "for _ in range(3):\n"
            "    try:\n"
            "        time.sleep(0.3); os.killpg(0, signal.SIGINT); time.sleep(1)\n"
            "    except KeyboardInterrupt:\n"
            "        print('interrupted')\n"
            "print(problem.wait())"
        )
        self.assertEqual((result.stdout, result.stderr), ("interrupted\n" * 3 + "True\n", ""))

    def test_close_and_deletion_end_the_build(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            compiler = script(folder, f"echo $$ >> {folder}/started; exec sleep 1013")
            result = run(
                "env = rddlc.make(new_problem()); env.reset(seed=1)\n"
                f"while not os.path.exists('{folder}/started'): time.sleep(0.01)\n"
                "env.close(); del env\n"
                f"pids = open('{folder}/started').read().split()\n"
                "time.sleep(0.5)\n"
                "print([pid for pid in pids if is_running(pid)])",
                CXX=compiler,
                XDG_CACHE_HOME=folder,
            )
        self.assertEqual((result.stdout, result.stderr), ("[]\n", ""))

    def test_a_killed_process_leaves_no_compiler_and_no_half_files(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            compiler = script(folder, f"echo $$ >> {folder}/started; exec sleep 1013")
            program = WORDS + "problem = new_problem(); time.sleep(1000)"
            with subprocess.Popen(
                [sys.executable, "-c", program],
                env={**os.environ, "CXX": compiler, "XDG_CACHE_HOME": folder},
                cwd=Path(__file__).parent,
            ) as child:
                while not Path(folder, "started").exists():
                    time.sleep(0.01)
                child.send_signal(signal.SIGKILL)
            time.sleep(0.5)
            pids = Path(folder, "started").read_text().split()
            self.assertEqual([pid for pid in pids if is_running(pid)], [])
            self.assertEqual(list(Path(folder, "rddlc").glob("*.so")), [])

    def test_the_compiled_engine_says_what_it_waits_for(self) -> None:
        result = run("new_problem(engine='compiled')")
        self.assertRegex(result.stderr, r"^rddlc: compiling .*counters.*, once")

    def test_a_name_that_is_no_engine_is_refused(self) -> None:
        with self.assertRaisesRegex(rddlc.ArgumentError, "auto.*compiled.*interpreter"):
            new_problem(engine="quick")


if __name__ == "__main__":
    unittest.main()
