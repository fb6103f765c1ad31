"""Ctrl-C within one native call: KeyboardInterrupt comes within about a second, and what is left can
be used."""

from __future__ import annotations

import signal
import subprocess
import sys
import threading
import time
import unittest
from pathlib import Path

import numpy as np
from support import problem_of_text

import rddlc

SLOW = """
domain slow {
    types { place : object; };
    pvariables {
        height : { state-fluent, real, default = 1.0 };
        push : { action-fluent, real, default = 0.0 };
    };
    cpfs {
        height' = height + push * Uniform(0.5, 1.0) +
                 (sum_{?p : place, ?q : place, ?r : place} exp[-abs[height]]) / 1000000;
    };
    reward = -height;
    action-preconditions { push >= -1; push <= 1; };
}
non-fluents many { domain = slow; objects { place : {PLACES}; }; }
instance slow_1 { domain = slow; non-fluents = many; max-nondef-actions = pos-inf; horizon = 40; discount = 1.0; }
""".replace("PLACES", ", ".join(f"p{i}" for i in range(10)))

COINS = """
domain coins {
    types { coin : object; };
    pvariables {
        heads(coin) : { state-fluent, bool, default = false };
        toss : { action-fluent, bool, default = false };
    };
    cpfs { heads'(?c) = Bernoulli(0.25); };
    reward = toss;
}
non-fluents many { domain = coins; objects { coin : {PLACES}; }; }
instance coins_1 { domain = coins; non-fluents = many; max-nondef-actions = 1; horizon = 3; discount = 1.0; }
""".replace("PLACES", ", ".join(f"c{i}" for i in range(25)))

# The program before the signal and after it; {WORK} is the call that it meets.
PROGRAM = """
import numpy as np
import rddlc
from support import problem_of_text
from test_interrupts import COINS, SLOW
from rddlc.transitions import Transitions

def begins():
    print("begins", flush=True)

def announce(model):
    # When learn() has made what learns.
    make = model._new_native
    def announced(options):
        native = make(options)
        begins()
        return native
    model._new_native = announced

{BEFORE}
try:
    {WORK}
    print("was not interrupted", flush=True)
except KeyboardInterrupt:
    print("interrupted", flush=True)
{AFTER}
"""

STEP = (
    "envs = rddlc.make_vec(problem_of_text(SLOW), num_envs=40_000, threads=1)\n"
    "envs.reset(seed=1)\npush = np.ones((40_000, 1), np.float32)\nbegins()",
    "envs.step(push)",
    # The step is made nevertheless: with the next one there are two.
    "envs.step(push)\nprint(envs._batch.progress(0)[0], envs._batch.progress(39_999)[0])",
    "2 2\n",
)
PPO = (
    "model = rddlc.PPO(problem_of_text(SLOW), environments=64, rollout=2000)\nannounce(model)",
    "model.learn(1_000_000)",
    "print(model.steps, model.policy_text[:1])",
    "0 {\n",
)
CGP = (
    "model = rddlc.CGP(problem_of_text(SLOW), children=8, episodes=4, tune_every=0)\nannounce(model)",
    "model.learn(1_000_000)",
    "print(model.policy_text != '')",
    "True\n",
)
EVALUATION = (
    "model = rddlc.CGP(problem_of_text(SLOW), children=1, episodes=1, tune_every=0).learn(1)\n"
    "begins()",
    "model.evaluate(episodes=10_000, threads=1)",
    "print(model.evaluate(episodes=2).episodes)",
    "2\n",
)
DISTRIBUTION = (
    "transitions = Transitions(problem_of_text(COINS), most_outcomes=1 << 26)\n"
    "start = transitions.start()\nbegins()",
    "transitions.outcomes(start, 0)",
    "print(len(transitions.applicable(start)))",
    "2\n",
)


class Interrupts(unittest.TestCase):
    def check(self, before: str, work: str, after: str, expected: str) -> None:
        program = PROGRAM.replace("{BEFORE}", before).replace("{WORK}", work).replace("{AFTER}", after)
        with subprocess.Popen(
            [sys.executable, "-c", program], stdout=subprocess.PIPE, text=True, cwd=Path(__file__).parent
        ) as child:
            assert child.stdout is not None
            try:
                self.assertEqual(child.stdout.readline(), "begins\n")
                time.sleep(0.7)
                sent = time.monotonic()
                child.send_signal(signal.SIGINT)
                self.assertEqual(child.stdout.readline(), "interrupted\n")
                self.assertLess(time.monotonic() - sent, 4)  # of a busy machine
                self.assertEqual(child.stdout.read(), expected)
            finally:
                child.kill()

    def test_a_step_of_many_environments(self) -> None:
        self.check(*STEP)

    def test_an_update_of_ppo(self) -> None:
        self.check(*PPO)

    def test_an_update_of_cgp(self) -> None:
        self.check(*CGP)

    def test_an_evaluation(self) -> None:
        self.check(*EVALUATION)

    def test_a_list_of_all_outcomes(self) -> None:
        self.check(*DISTRIBUTION)

    def test_two_threads_in_one_environment_are_refused(self) -> None:
        envs = rddlc.make_vec(problem_of_text(SLOW), num_envs=400, threads=1)
        envs.reset(seed=1)
        push = np.ones((400, 1), np.float32)
        refused: list[str] = []

        def step() -> None:
            try:
                envs.step(push)
            except rddlc.Error as error:
                refused.append(str(error))

        threads = [threading.Thread(target=step) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(refused, ["another thread is in a call of this environment or learner"])
        self.assertEqual(envs._batch.progress(0)[0], 1)


if __name__ == "__main__":
    unittest.main()
