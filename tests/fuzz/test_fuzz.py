"""Tests of the fuzzer itself: it is repeatable, notices differences, reduces, resumes, and draws
enough."""

import argparse
import itertools
import subprocess
import tempfile
import types
import unittest
import unittest.mock
from collections import Counter
from pathlib import Path

import differential
import domains
import fuzz_models
from flavours import FLAVOURS
from generate import GENERATORS, generate
from passes_check import PassChecker
from reduce import reduce

ARGUMENTS = argparse.ArgumentParser()
ARGUMENTS.add_argument("--bin", type=Path)
ARGUMENTS.add_argument("rest", nargs="*")
arguments = ARGUMENTS.parse_args()


def counting_problem():
    """The first random problem with a sum that pyRDDLGym runs."""
    problems = (p for p in map(generate, itertools.count()) if "sum_{" in p.domain_text())
    return next(p for p in problems if compared(p).values > 0)


def compared(problem):
    with tempfile.TemporaryDirectory() as folder:
        return differential.compare_with_reference(problem, Path(folder), arguments.bin / "rddl", 0, 20)


def replay_wrong(replay):
    """An engine that gets rewards wrong where the problem counts anything."""

    def wrong(rddl, case, *rest):
        answers = replay(rddl, case, *rest)
        if "sum_{" in case.domain_path.read_text():
            for answer in answers:
                answer["reward"] = 12345.0
        return answers

    return wrong


class OfProblems(unittest.TestCase):
    def test_a_seed_and_a_flavour_are_a_problem(self):
        for make, flavour in itertools.product(GENERATORS.values(), FLAVOURS):
            self.assertEqual(make(5, flavour).text(), make(5, flavour).text())
            self.assertNotEqual(make(5, flavour).text(), make(6, flavour).text())

    def test_seeds_make_domains_that_differ(self):
        """Two in a thousand at most are alike."""
        texts = {domains.generate(seed, "wild").domain_text() for seed in range(2000)}
        self.assertGreaterEqual(len(texts), 1996)

    def test_types_have_the_sizes_at_which_code_changes(self):
        sizes = {len(t.members) for seed in range(3000) for t in generate(seed).types}
        self.assertLessEqual({1, 8, 16, 17, 63, 64, 65, 128, 512, 513}, sizes)
        sizes = {len(t.members) for seed in range(1000) for t in domains.generate(seed).types}
        self.assertLessEqual({1, 8, 16, 17, 63, 64, 65}, sizes)


class OfComparisons(unittest.TestCase):
    def test_nothing_differs(self):
        verdict = compared(counting_problem())
        self.assertEqual(verdict.kind, "", verdict.text)
        self.assertGreater(verdict.values, 0)

    def test_notices_and_reduces_a_difference(self):
        problem = counting_problem()
        with unittest.mock.patch("differential.replay", replay_wrong(differential.replay)):
            self.assertEqual(compared(problem).kind, "reference")
            smaller = reduce(problem, lambda p: compared(p).kind == "reference", seconds=300)
        self.assertIn("sum_{", smaller.domain_text())
        self.assertLess(len(smaller.domain_text()), len(problem.domain_text()) / 2)


class OfPasses(unittest.TestCase):
    def setUp(self):
        self.checker = PassChecker(arguments.bin / "fuzz_passes")
        self.addCleanup(self.checker.close)

    def test_goes_on_after_a_crash(self):
        self.checker.ask({"text": "domain"})
        self.checker.process.kill()
        self.checker.process.wait()  # else the next request may still reach it
        self.assertEqual(self.checker.ask({"text": "domain"}).outcome, "crashed")
        self.assertEqual(self.checker.ask({"text": "domain"}).outcome, "rejected")

    def test_knows_constraints_that_exclude_each_other(self):
        text = """domain d {
            pvariables { x : { state-fluent, real, default = 0.0 }; };
            cpfs { x' = x; };
            reward = x;
            state-invariants { x >= 2; x <= MOST; };
        }
        non-fluents n { domain = d; }
        instance i { domain = d; non-fluents = n; horizon = 3; discount = 1.0; }"""
        for most, outcome in ("3", "accepted"), ("1", "contradictory"), ("nobody", "rejected"):
            self.assertEqual(self.checker.ask({"text": text.replace("MOST", most)}).outcome, outcome)

    def test_each_pass_changes_something_in_a_model_of_a_hundred(self):
        """With slack: in one of 200 at least, of one generator at least."""
        shares = [self.shares_changed(generator, 600) for generator in GENERATORS]
        for name, only_fast_math in self.passes():
            with self.subTest(name=name):
                share = max(changed[name] / models["finite" if only_fast_math else "all"] for changed, models in shares)
                self.assertGreaterEqual(share, 1 / 200)

    def shares_changed(self, generator, count):
        """The number of models that each pass changes, and the number of those in which it runs."""
        changed, models = Counter(), Counter()
        for seed in range(count):
            problem = fuzz_models.problem_of("passes", seed, generator)
            answer = self.checker.check(problem, seed)
            self.assertNotEqual(answer.outcome, "rejected", answer.findings)
            changed.update(answer.changed.keys())
            models.update(["all", problem.flavour])
        return changed, models

    def passes(self):
        lines = subprocess.run([self.checker.program, "--list"], capture_output=True, text=True, check=True)
        for line in lines.stdout.splitlines():
            name, *only_fast_math = line.split()
            yield name, bool(only_fast_math)


class OfRuns(unittest.TestCase):
    def options(self, folder, models):
        options = argparse.Namespace(first=100, models=models, state=Path(folder), workers=1)
        return argparse.Namespace(**vars(options), generator="expressions", passes=arguments.bin / "fuzz_passes", without=[], reduce_seconds=0)

    def test_goes_on_where_it_was(self):
        with tempfile.TemporaryDirectory() as folder:
            for models, done in ((3, 3), (5, 5)):
                run = fuzz_models.Run("passes", self.options(folder, models))
                run.run(types.SimpleNamespace(imap=map))
                self.assertEqual(run.next, 100 + done)
            counts = fuzz_models.Run("passes", self.options(folder, 5)).result.counts
            self.assertEqual(sum(n for name, n in counts.items() if name.startswith("flavour")), 5)


if __name__ == "__main__":
    unittest.main(argv=["test_fuzz.py", *arguments.rest])
