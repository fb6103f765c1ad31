"""No text makes the compiler take more than about n log n: four times the text, not sixteen times the time. And no small
text makes it take much memory."""

import resource
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "benchmarks"))

from commands import DIAGNOSED, RDDL, RDDLC, SUCCESS, CommandTest  # noqa: E402
from compile_growth import SHAPES, measure  # noqa: E402
from shapes import lines, objects_of, problem  # noqa: E402

# Small enough for seconds, large enough that a cost by the square shows: the test of 4n lines takes
# over 0.2 s then.
LINES = 500
ATTEMPTS = 3  # what is slow by chance is not slow three times
# Cases that may take a fixed number of operations or bytes still grow towards that limit.
WITH_LIMITS = {"member_conditions", "non_fluent_values"}
# Each took a cost by the square once; they are fast enough to be tested always.
FORMER_SQUARES = {"aggregations", "switch_cases", "unknown_names", "chain_read_once"}


class GrowthTest(unittest.TestCase):
    def assert_grows_slowly(self, command: str, shapes: set[str]) -> None:
        for shape in sorted(shapes):
            with self.subTest(shape, command=command):
                for attempt in range(ATTEMPTS):
                    growth = measure(shape, command, LINES)
                    if not growth.is_too_fast():
                        break
                else:
                    self.fail(f"{growth.seconds[0]:.2f} s, and {growth.seconds[1]:.2f} s for four times the text")


class Growth(GrowthTest):
    def test_compiling(self):
        self.assert_grows_slowly("rddlc", SHAPES.keys() - WITH_LIMITS)

    def test_formatting(self):
        self.assert_grows_slowly("fmt", SHAPES.keys() - WITH_LIMITS)


class Squares(GrowthTest):
    """Compares processor time, three times if need be, so that a busy machine does no harm."""

    def test_compiling(self):
        self.assert_grows_slowly("rddlc", FORMER_SQUARES)


def little_stack() -> None:
    """An eighth of what is usual, so that an eighth of the text is enough to overflow it."""
    resource.setrlimit(resource.RLIMIT_STACK, (1 << 20, 1 << 20))


class Depth(CommandTest):
    """A long text of little depth must not become an expression that overflows the stack."""

    def test_many_cases(self):
        self.write("problem.rddl", SHAPES["switch_cases"](2_500))
        for words in [RDDLC, "--stop-after=emit"], [RDDL, "run", "--engine=interpreter", "--quiet"]:
            result = self.run_command(*words, "problem.rddl", preexec_fn=little_stack)
            self.assertEqual(result.status, SUCCESS, result)


def a_gigabyte() -> None:
    resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30))


class Room(CommandTest):
    """These inputs once took 12 to 16 GB."""

    def run_small(self, *words):
        return self.run_command(*words, "problem.rddl", preexec_fn=a_gigabyte)

    def test_one_value_among_a_trillion(self):
        for variables in "?w, ?x, ?y, ?z", "?z, ?y, ?x, ?w":
            self.write("problem.rddl", problem(
                "K(o, o, o, o) : { non-fluent, bool, default = false };", reward=f"sum_{{?w : o, ?x : o, ?y : o, ?z : o}} [K({variables}) * s]",
                types="o : object;", objects=objects_of(1000), values="K(o1, o2, o3, o4);"))
            for words in [RDDLC, "--stop-after=emit"], [RDDL, "info"], [RDDL, "run", "--engine=interpreter"]:
                self.assertEqual(self.run_small(*words).status, SUCCESS)

    def test_many_large_fluents(self):
        self.write("problem.rddl", problem(
            lines(40, "p{i}(o, o) : {{ state-fluent, real, default = 0.0 }};"), lines(40, "p{i}'(?x, ?y) = p{i}(?x, ?y) + 1;"),
            types="o : object;", objects=objects_of(5700)))
        for words in [RDDLC, "--stop-after=emit"], [RDDL, "info"], [RDDL, "run"]:
            result = self.run_small(*words)
            self.assertEqual(result.status, DIAGNOSED, result)
            self.assertIn("'p0' alone takes 992 MiB [E0604]", result.errors)

    def test_large_batch(self):
        self.write("problem.rddl", problem(
            "p(o, o) : { state-fluent, real, default = 0.0 };", "p'(?x, ?y) = p(?x, ?y) + 1;", types="o : object;", objects=objects_of(100)))
        result = self.run_small(RDDL, "run", "--engine=interpreter", "--episodes=1000000", "--batch=1000000")
        self.assertEqual(result.status, DIAGNOSED, result)
        self.assertIn("more than the limit of 4 GiB", result.errors)
        result = self.run_small(RDDL, "run", "--engine=interpreter", "--episodes=100", "--memory-limit=1M")
        self.assertEqual(result.status, SUCCESS, result)
        result = self.run_small(RDDL, "run", "--engine=interpreter", "--memory-limit=100K")
        self.assertIn("--memory-limit=1G allows it", result.errors)


if __name__ == "__main__":
    unittest.main()
