"""Tests of the fuzzer itself: that it is repeatable, that it notices, that it reduces."""

import argparse
import itertools
import tempfile
import unittest
import unittest.mock
from pathlib import Path

import differential
from fuzz_models import Task, judge
from generate import generate
from reduce import reduce

OPTIONS = argparse.ArgumentParser()
OPTIONS.add_argument("--rddl", type=Path)
OPTIONS.add_argument("rest", nargs="*")
arguments = OPTIONS.parse_args()


def counting_problem():
    """The first random problem with a sum."""
    return next(p for p in map(generate, itertools.count()) if "sum_{" in p.domain_text())


def judged(problem):
    options = argparse.Namespace(rddl=arguments.rddl, exercise=None, steps=20, compiled_every=0)
    with tempfile.TemporaryDirectory() as folder:
        return judge(Task(0, options), problem, Path(folder), ["interpreter"])


def replay_wrong(replay):
    """An engine that gets rewards wrong where the problem counts anything."""

    def wrong(rddl, case, *rest):
        answers = replay(rddl, case, *rest)
        if "sum_{" in case.domain_path.read_text():
            for answer in answers:
                answer["reward"] = 12345.0
        return answers

    return wrong


class FuzzTest(unittest.TestCase):
    def test_a_seed_is_a_problem(self):
        self.assertEqual(generate(5).text(), generate(5).text())
        self.assertNotEqual(generate(5).text(), generate(6).text())

    def test_nothing_differs(self):
        verdict = judged(counting_problem())
        self.assertEqual(verdict.kind, "", verdict.text)
        self.assertGreater(verdict.values, 0)

    def test_notices_and_reduces_a_difference(self):
        problem = counting_problem()
        with unittest.mock.patch("differential.replay", replay_wrong(differential.replay)):
            self.assertEqual(judged(problem).kind, "reference")
            smaller = reduce(problem, lambda p: judged(p).kind == "reference", seconds=300)
        self.assertIn("sum_{", smaller.domain_text())
        self.assertLess(len(smaller.domain_text()), len(problem.domain_text()) / 2)


if __name__ == "__main__":
    unittest.main(argv=["test_fuzz.py", *arguments.rest])
