"""The comparison itself: pyRDDLGym agrees with itself, and not with a changed problem."""

import tempfile
import unittest
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np

from compare import Findings, compare_draws, compare_transitions, judge_draws
from model import REWARD, stack
from problems import Case, example_cases
from reference import Plan, Recording, Reference, record

PLAN = Plan(transitions=20, stride=5, draw_points=2)


def example(name: str) -> Case:
    return next(case for case in example_cases() if case.problem == name)


@cache
def recorded(name: str) -> Recording:
    """All tests share it, since recording takes most of their time. They must not change it."""
    return record(example(name), PLAN)


def findings_against(recording: Recording, other: Case) -> Findings:
    """Compares with what pyRDDLGym makes of the other case under other random numbers."""
    reference = Reference(other)
    reference.simulator.seed(12345)
    walk, problem = recording.walk, recording.problem
    found = [reference.step(state, action) for state, action in walk.starts(len(walk))]
    findings = Findings()
    compare_transitions(problem, walk, stack(found), findings)
    for point in recording.points:
        draws = reference.draw(point.state, point.action, point.count())
        compare_draws(problem, point, draws.outcomes, findings)
    judge_draws(findings, 1e-6)
    return findings


class CompareTest(unittest.TestCase):
    def assert_agrees(self, name: str):
        case = example(name)
        findings = findings_against(recorded(name), case)
        self.assertEqual(findings.disagreements, [])
        self.assertGreater(findings.exact_values + len(findings.tests), 30)

    def assert_disagrees(self, name: str, old: str, new: str, where: str):
        """Replaces `old` by `new` in the domain; then `where` is in the findings."""
        case = example(name)
        text = case.domain_path.read_text()
        self.assertIn(old, text)
        with tempfile.TemporaryDirectory() as folder:
            changed = Path(folder, "domain.rddl")
            changed.write_text(text.replace(old, new))
            findings = findings_against(recorded(name), replace(case, domain_path=changed))
        self.assertTrue(any(where in text for text in findings.disagreements), findings.disagreements)

    def test_agrees_with_itself(self):
        for name in ("mountain_car", "network", "robot", "delivery"):
            with self.subTest(name):
                self.assert_agrees(name)

    def test_finds_a_wrong_reward(self):
        self.assert_disagrees("network", "REBOOT-COST * (", "1.000001 * REBOOT-COST * (", "reward")

    def test_finds_a_wrong_state(self):
        self.assert_disagrees("cart_pole", "4.0 / 3.0", "4.00000001 / 3.0", "angle-change")

    def test_finds_a_wrong_chance(self):
        self.assert_disagrees("network", "REPAIR    : { non-fluent, real, default = 0.05 }",
                              "REPAIR    : { non-fluent, real, default = 0.15 }", "running")

    def test_finds_a_deviation_taken_for_a_variance(self):
        self.assert_disagrees("robot", "TURN-VARIANCE * abs[turn]", "pow[TURN-VARIANCE, 2]",
                              "heading")

    def test_finds_draws_that_should_be_shared(self):
        # Each value by itself stays the same; they no longer come together.
        self.assert_disagrees("robot", "echo(?b)  = answers(?b);",
                              "echo(?b)  = Bernoulli(exp[-range-to(?b) / REACH]);", "joint")

    def test_takes_rounding_for_no_difference(self):
        recording = recorded("network")
        problem = replace(recording.problem, random_reward=True)  # a constant where it might vary
        for point in recording.points:
            rounded = dict(point.outcomes)
            rounded[REWARD] = np.nextafter(rounded[REWARD], np.inf)
            findings = Findings()
            compare_draws(problem, point, rounded, findings)
            judge_draws(findings, 1e-6)
            self.assertEqual(findings.disagreements, [])

    def test_a_walk_is_the_same_every_time(self):
        case = example("delivery")
        first, second = (Reference(case).walk(10, 3) for _ in range(2))
        for name, values in first.outcomes.items():
            np.testing.assert_array_equal(values, second.outcomes[name])


if __name__ == "__main__":
    unittest.main()
