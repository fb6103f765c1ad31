"""Tests of the programs in benchmarks/. Over 400 lines: a class for each program.

    test_benchmarks.py RDDL
"""

import argparse
import contextlib
import io
import json
import os
import sys
import tempfile
import unittest
from collections import Counter
from pathlib import Path
from unittest.mock import patch

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "benchmarks"), str(ROOT / "benchmarks/solvers")]

import bench  # noqa: E402
import cliffs  # noqa: E402
import compare  # noqa: E402
import compare_all  # noqa: E402
import compare_jax  # noqa: E402
import comparison_tables  # noqa: E402
import document  # noqa: E402
import growth  # noqa: E402
import handwritten  # noqa: E402
import lanes  # noqa: E402
import least_steps  # noqa: E402
import plots  # noqa: E402
import pyRDDLGym  # noqa: E402
import segments  # noqa: E402
from random_actions import RandomActions, draw_course  # noqa: E402

RDDL = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "build/bin/rddl")
PROBLEM = "Pendulum_gym"


def run_program(main, *arguments: object) -> tuple[int, str]:
    """Exit status and what it printed."""
    printed = io.StringIO()
    with patch.object(sys, "argv", ["program", *map(str, arguments)]), contextlib.redirect_stdout(printed):
        status = main()
    return status, printed.getvalue()


def case_of(problem: str) -> compare.Case:
    return compare.repository_cases(problem)[0]


class Compare(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.results = Path(folder.name) / "results" / "compare.jsonl"

    def run_compare(self, *arguments: object) -> tuple[int, str]:
        options = ["--seconds", 0.02, "--rounds", 1, "--results", self.results]
        return run_program(compare.main, PROBLEM, *options, *arguments)

    def test_measures_and_goes_on(self):
        status, text = self.run_compare("--rddl", RDDL)
        self.assertEqual(status, 0, text)
        self.assertIn("geometric mean", text)
        # Results in the file are not measured again: no program is needed.
        again, same_text = self.run_compare("--rddl", "/nowhere/rddl")
        self.assertEqual((again, same_text), (status, text))
        status, text = self.run_compare("--rddl", "/nowhere/rddl", "--fresh")
        self.assertEqual(status, 1)
        self.assertIn(f"{PROBLEM} 0: ", text)

    def test_limits(self):
        slow = compare.Comparison("p", "1", [10.0, 30.0, 20.0], [2e4], [800.0])
        fast = compare.Comparison("p", "2", [1.0], [1e6], [1e9])
        self.assertEqual(slow.single_ratio, 1000)
        self.assertEqual(slow.batch_ratio, 40)
        self.assertEqual(compare.shortfalls([fast]), [])
        self.assertEqual(compare.shortfalls([slow, fast]), ["p 1: the ratio 40 is below 50"])
        self.assertEqual(compare.shortfalls([slow])[0], "batch: the geometric mean 40 is below 3,000")

    def test_takes_the_smallest_and_the_largest_instance(self):
        cases = compare.repository_cases("SysAdmin_MDP_ippc2011")
        sizes = sorted(c.instance_path.stat().st_size for c in cases)
        for count, wanted in (1, sizes[:1]), (2, [sizes[0], sizes[-1]]), (3, [sizes[0], sizes[5], sizes[-1]]), (None, sizes):
            spread = [c.instance_path.stat().st_size for c in compare.spread_by_size(cases, count)]
            self.assertEqual(spread if count else sorted(spread), wanted)
        self.assertEqual(len(compare.spread_by_size(compare.repository_cases(PROBLEM), 2)), 1)


class CompareJax(unittest.TestCase):
    def comparison(self, floats: float | None, first_step: float) -> compare_jax.Comparison:
        return compare_jax.Comparison("p 1", 1, "3.1", 10.0, 50.0, floats, first_step, 1.0, 0.5)

    def test_limits(self):
        self.assertEqual(compare_jax.shortfalls([self.comparison(100, 1.4)]), [])
        late_and_slow = compare_jax.shortfalls([self.comparison(90, 1.6)])
        self.assertEqual(
            late_and_slow,
            ["p 1: the ratio in floats, 9.0, is below 10", "p 1: the first step is not sooner"],
        )

    def test_summary(self):
        rows = compare_jax.summary_rows([self.comparison(100, 1.0), self.comparison(400, 3.0)])
        self.assertEqual(
            rows[1:],
            [
                ("floats", "20.0", "2 of 2", "10.0", "p 1"),
                ("doubles", "5.0", "0 of 2", "5.0", "p 1"),
                ("first step", "0.9", "1 of 2 are sooner", "0.5", "p 1"),
            ],
        )

    def test_summary_without_floats(self):
        without = self.comparison(None, 1.0)
        self.assertEqual(compare_jax.row_of(without)[:6], ("p 1", "10", "50", "5.0", "-", "-"))
        rows = compare_jax.summary_rows([without, self.comparison(400, 1.0)])
        self.assertEqual(rows[1], ("floats", "40.0", "1 of 1", "40.0", "p 1"))

    def test_median_of_turns(self):
        turns = [self.comparison(floats, first_step) for floats, first_step in ((70, 3.0), (90, 1.0), (80, 9.0))]
        self.assertEqual(compare_jax.median_of(turns), self.comparison(80, 3.0))
        self.assertIsNone(compare_jax.median_of([self.comparison(None, 1.0)]).floats)

    def test_takes_the_best_batch_with_these_threads(self):
        measurements = [
            {"threads": 1, "steps": 10, "seconds": 3.0, "processor_seconds": 2.0},
            {"threads": 2, "steps": 70, "seconds": 5.0, "processor_seconds": 10.0},
            {"threads": 1, "steps": 12, "seconds": 2.0, "processor_seconds": 2.0},
        ]
        self.assertEqual(compare_jax.best_rate(measurements, 1), 6.0)
        self.assertEqual(compare_jax.best_rate(measurements, 2), 14.0)

    def test_reasons(self):
        reason = "rddl: pyRDDLGym-jax cannot run this problem: KeyError: 'a|b'\n  more\nhint: none\n"
        self.assertEqual(compare_jax.reason_of(reason), "KeyError: 'a/b' more")
        self.assertEqual(len(compare_jax.reason_of(reason.replace("more", "x" * 300))), 160)
        with self.assertRaises(RuntimeError):
            compare_jax.reason_of("rddl: no such problem")

    def test_goes_on_where_it_was(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "results.jsonl"
            results = compare_jax.saved_results(file, fresh=False)
            results.add(compare_jax.NotRun(f"{PROBLEM} 0", 1, "why"))
            results.add(self.comparison(100, 1.0))
            self.assertEqual(compare_jax.saved_results(file, fresh=False).entries, results.entries)
            # Neither program is needed for what the file has.
            status, text = run_program(compare_jax.main, PROBLEM, "--rddl", "/nowhere/rddl", "--results", file)
            self.assertEqual((status, text), (1, f"1/1  {PROBLEM} 0: why\n"))
            self.assertEqual(compare_jax.saved_results(file, fresh=True).entries, {})

    def test_says_what_is_missing(self):
        with tempfile.TemporaryDirectory() as folder:
            options = ["--rddl", RDDL, "--jax-python", "/nowhere/python", "--results", Path(folder) / "r.jsonl"]
            status, text = run_program(compare_jax.main, PROBLEM, *options)
        self.assertEqual(status, 1)
        self.assertIn("cannot run '/nowhere/python'", text)

    def test_gives_up_after_the_limit(self):
        with self.assertRaisesRegex(RuntimeError, "no figures within 0.01 s"):
            bench.bench(Path(RDDL), PROBLEM, "--seconds", 5, limit=0.01)


class CompareAll(unittest.TestCase):
    """Returns of all methods on many problems."""

    def result(self, problem: str, method: str, mean: float, half_width: float = 0, **more) -> dict:
        return {"problem": problem, "instance": "1", "method": method, "mean": mean, "half_width": half_width} | more

    def floors(self, problem: str) -> list[dict]:
        return [self.result(problem, "noop", 0), self.result(problem, "random", -5, 2)]

    def test_plays_and_goes_on(self):
        with tempfile.TemporaryDirectory() as folder:
            options = ["--out", Path(folder) / "r.jsonl", "--only", "Navigation_MDP", "--steps", 100, "--episodes", 2]
            options += ["--seconds", 0.1, "--methods", "noop", "random", "cgp", "rollout"]
            status, text = run_program(compare_all.main, "--rddl", RDDL, *options)
            self.assertEqual(status, 0, text)
            results = {result["method"]: result for result in map(json.loads, text.splitlines())}
            self.assertEqual(set(results), {"noop", "random", "cgp", "rollout"})
            self.assertIn(results["rollout"]["policy"], ("noop", "random", "cgp"))
            self.assertEqual(results["rollout"]["steps"], 100)

    def test_better_than_floors(self):
        better = self.floors("a") + [self.result("a", "cem", 1), self.result("a", "uct", -9)]
        equal = self.floors("b") + [self.result("b", "cem", 0)]
        by_chance = self.floors("c") + [self.result("c", "cem", 1, 4)]
        rows = comparison_tables.rows_of(better + equal + by_chance)
        self.assertEqual([row.name for row in comparison_tables.rows_like_floors(rows)], ["b 1", "c 1"])
        self.assertEqual(comparison_tables.shortfalls(better + equal + by_chance), [])

    def test_shortfalls(self):
        found_by_them = self.floors("a") + [self.result("a", "cem", 0), self.result("a", "prost", 3)]
        possible = self.floors("b") + [self.result("b", "cem", 0), self.result("b", "optimum", 3)]
        discounted = self.floors("c") + [self.result("c", "cem", 0), self.result("c", "optimum", 3, discount=0.9)]
        within_errors = self.floors("d") + [self.result("d", "uct", 4, 2), self.result("d", "prost", 7, 3)]
        self.assertEqual(
            comparison_tables.shortfalls(found_by_them + possible + discounted + within_errors),
            [
                "a 1: some method is better than no-op and random, and no method of rddlc is",
                "b 1: some method is better than no-op and random, and no method of rddlc is",
                "ours is worse than theirs on 1 of 2: a 1",
            ],
        )
        text = comparison_tables.summary(comparison_tables.rows_of(within_errors))  # lists no rows
        self.assertRegex(text, "at least one of them 1.\n.* within errors, on 1 of 1.$")

    def test_table(self):
        failure = {"problem": "a", "instance": "1", "method": "cgp", "failure": "longer than 60 s"}
        effort = {"seconds": 0.3, "decisions": 100, "steps": 2000, "options": "horizon=2"}
        cem = self.result("a", "cem", 2, 0.5, episodes=3, **effort)
        ppo = self.result("a", "ppo", 1.5, training_seconds=10, episodes=3)
        rows = comparison_tables.rows_of([ppo, failure, cem, self.result("a", "optimum", 2.2)])
        self.assertEqual(
            comparison_tables.table(rows).splitlines()[::2],
            [
                "| problem | | PPO | CGP | `plan:cem` | optimum | effort |",
                "| a | 1 | 1.5 | time | **2 ± 0.5** | 2.2 | 10 s, -, 3 |",
            ],
        )
        self.assertEqual(
            comparison_tables.settings_text(rows),
            "Episodes: PPO 3, `plan:cem` 3 (2,000 steps a decision; `horizon=2` on a 1).",
        )


class Cliffs(unittest.TestCase):
    def test_measures_and_goes_on(self):
        with tempfile.TemporaryDirectory() as folder:
            options = [PROBLEM, "--seconds", 0.02, "--results", Path(folder) / "cliffs.jsonl", "--require"]
            status, text = run_program(cliffs.main, "--rddl", RDDL, *options)
            self.assertEqual(status, 0, text)
            self.assertIn(f"{PROBLEM} 0", text)
            # Results in the file are not measured again: no program is needed.
            self.assertEqual(run_program(cliffs.main, "--rddl", "/nowhere/rddl", *options), (status, text))

    def test_tells_what_is_slower_in_a_batch(self):
        slow = cliffs.Entry("p", "1", 16, 100.0, 40.0)
        fast = cliffs.Entry("p", "2", 16, 100.0, 900.0)
        self.assertEqual(slow.ratio, 0.4)
        self.assertIn("* p 1: 0.40, 16 lanes", cliffs.text_of([slow, fast]))
        self.assertNotIn("* p", cliffs.text_of([fast]))


class LegalActions(unittest.TestCase):
    """Legal actions of pyRDDLGym, as the peers' programs draw them."""

    def environment(self, problem: str):
        case = case_of(problem)
        env = pyRDDLGym.make(str(case.domain_path), str(case.instance_path), vectorized=True)
        env.reset(seed=0)
        return env

    def is_legal(self, env, action: dict) -> bool:
        prepared = env.sampler.prepare_actions_for_sim(action)
        env.sampler.check_default_action_count(prepared, env.enforce_count_non_bool)
        return env.sampler.check_action_preconditions(prepared, silent=True)

    def test_are_legal_and_differ(self):
        env = self.environment("WildlifePreserve_p4_ippc2018")
        actions = RandomActions(env)
        drawn = [actions.draw() for _ in range(20)]
        self.assertTrue(all(self.is_legal(env, action) for action in drawn))
        self.assertGreater(len({str(action) for action in drawn}), 1)

    def test_a_course_can_be_played_again(self):
        env = self.environment("SysAdmin_MDP_ippc2011")
        course = draw_course(env, 0.2)

        def rewards() -> list[float]:
            env.reset(seed=0)
            all_rewards = []
            for action in course[: env.horizon]:
                self.assertTrue(self.is_legal(env, action))
                all_rewards.append(env.step(action)[1])
            return all_rewards

        self.assertEqual(rewards(), rewards())


class Handwritten(unittest.TestCase):
    # benchmarks/handwritten.py compares all: too long for each run of the tests.
    FEW = ("CrossingTraffic_MDP_ippc2014", "Knapsack_or", "PowerGen_ippc2023")

    def test_agrees_with_what_is_emitted(self):
        with tempfile.TemporaryDirectory() as folder:
            build = Path(RDDL).parents[1]
            options = ["--build", build, "--folder", folder, "--seconds", 0.01, "--rounds", 1]
            status, text = run_program(handwritten.main, *self.FEW, *options)
        self.assertEqual(status, 0, text)  # not if a result differs
        self.assertEqual(text.count(" 1,024  "), len(self.FEW), text)
        self.assertIn("1,024 environments: the geometric mean of the ratios is ", text)

    def test_references_are_there(self):
        problems = handwritten.REFERENCES
        for reference in problems.values():
            self.assertIn(f"struct {reference.struct} ", (handwritten.FOLDER / f"{reference.header}.hpp").read_text())
        families = Counter(reference.family for reference in problems.values())
        self.assertEqual(len(families), 6)
        self.assertGreaterEqual(min(families.values()), 4)

    def test_means(self):
        comparisons = [
            handwritten.Comparison("Pendulum_gym", n, 0.0, 1.0, 1.0, ratio, 1.0)
            for n, ratio in ((1, 0.4), (1, 1.6), (1024, 1.0))
        ]
        self.assertEqual(
            handwritten.means(comparisons),
            [
                "1 environment: the geometric mean of the ratios is 0.80 (aim 0.8), the least 0.40 (aim 0.5); "
                "1 of 2 is below 0.5",
                "1,024 environments: the geometric mean of the ratios is 1.00 (aim 0.8), the least 1.00 (aim 0.5); "
                "0 of 1 are below 0.5",
            ],
        )

    def test_limits(self):
        good = handwritten.Comparison("Pendulum_gym", 1, 1e-12, 8.0, 10.0, 0.8, 0.9)
        slow = handwritten.Comparison("Pendulum_gym", 1024, 1e-12, 9.0, 10.0, 0.9, 0.8)
        wrong = handwritten.Comparison("Knapsack_or", 1, float("inf"), 9.0, 1.0, 9.0, 9.0)
        not_required = handwritten.Comparison("Knapsack_or", 1024, 0.0, 1.0, 9.0, 0.1, 0.1)
        alone = [good, slow, wrong, not_required]
        self.assertEqual(
            handwritten.shortfalls(alone), ["Pendulum_gym 0, 1,024 environments: the ratio 0.80 is below 0.9"]
        )
        self.assertEqual(
            handwritten.disagreements(alone), ["Knapsack_or 0, 1 environment: the results differ by inf"]
        )


class LeastSteps(unittest.TestCase):
    # benchmarks/least_steps.py compares all: too long for each run of the tests.
    FEW = ("Option_or", "MountainCar_Discrete_gym")

    def test_kernels_have_the_values_of_what_is_emitted(self):
        with tempfile.TemporaryDirectory() as folder:
            build = Path(RDDL).parents[1]
            options = ["--build", build, "--folder", folder, "--seconds", 0.01]
            status, text = run_program(least_steps.main, *self.FEW, *options)
        self.assertEqual(status, 0, text)  # an error if a value differs
        for problem in self.FEW:
            self.assertIn(f"| {problem} {least_steps.KERNELS[problem].instance} | ", text)

    def test_kernels_are_there(self):
        for kernel in least_steps.KERNELS.values():
            header = (least_steps.FOLDER / f"{kernel.header}.hpp").read_text()
            self.assertRegex(header, rf"(struct|using) {kernel.struct} ")


class Lanes(unittest.TestCase):
    def test_the_number_is_that_of_the_emitted_text(self):
        options = argparse.Namespace(build=Path(RDDL).parents[1])
        self.assertEqual(lanes.chosen("Navigation_MDP_ippc2011", options), 64)
        self.assertEqual(lanes.chosen("Knapsack_or", options), 16)

    def test_limits(self):
        good = lanes.Choice("good", {16: 10.0, 64: 10.2}, 64)
        bad = lanes.Choice("bad", {16: 10.0, 64: 20.0}, 64)
        self.assertEqual(lanes.complaints([good] * 9), [])
        self.assertEqual(
            lanes.complaints([bad, good]),
            ["bad: 64 lanes take 2.00 times as long as the best number", "the mean loss is 1.428"],
        )


class Growth(unittest.TestCase):
    def point(self, objects: int, seconds: float) -> growth.Point:
        return growth.Point("fire", objects, 8 * objects, seconds, 0.0, 0)

    def test_limit(self):
        linear = [self.point(objects, 0.5 * objects) for objects in (10, 100, 1000)]
        self.assertAlmostEqual(growth.power_of_growth(linear), 1.0)
        self.assertEqual(growth.excesses(linear), [])
        square = [self.point(objects, 0.5 * objects**2) for objects in (10, 100, 1000)]
        self.assertEqual(growth.excesses(square), ["fire: the time grows with the power 2.00 of the entries"])
        self.assertEqual(growth.excesses(square[:1]), [])

    def test_measures_and_draws(self):
        with tempfile.TemporaryDirectory() as folder:
            results = Path(folder, "growth.json")
            options = ["--sizes", 10, "--seconds", 0.01, "--rddl", RDDL, "--results", results]
            status, text = run_program(growth.main, "fire", *options)
            self.assertEqual(status, 0, text)
            status, text = run_program(plots.main, "--results", folder, "--images", folder)
            self.assertEqual(status, 0, text)
            self.assertTrue(Path(folder, "growth.png").read_bytes().startswith(b"\x89PNG"))
            self.assertIn("there is no", text)  # of the other plots' figures

    def test_tables_are_sparse(self):
        for generate in growth.GENERATORS.values():
            few, many = generate(100).entries, generate(1000).entries
            self.assertLess(many, 12 * few)


class Segments(unittest.TestCase):
    def test_measures(self):
        with tempfile.TemporaryDirectory() as folder:
            results = Path(folder, "segments.json")
            options = ["--sizes", 3, "--seconds", 0.01, "--rddl", RDDL, "--results", results]
            status, text = run_program(segments.main, *options)
            self.assertEqual(status, 0, text)
            (point,) = json.loads(results.read_text())
            self.assertEqual(point["segments"], 3)
            self.assertGreater(point["searching"]["in_batch"], 0)


class Document(unittest.TestCase):
    def test_names_the_machine(self):
        """All its cores count, also those that this process may not use."""
        for cores, text in (1, ", 1 core"), (8, ", 8 cores"):
            with patch.object(os, "cpu_count", return_value=cores), \
                    patch.object(os, "sched_getaffinity", return_value={0}):
                self.assertTrue(document.machine_text().endswith(text), document.machine_text())

    def test_replaces_a_section(self):
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder) / "page.md"
            page.write_text("a\n<!-- begin of x -->\nold\n<!-- end of x -->\nb\n")
            with patch.object(document, "DOCUMENTS", [page]), contextlib.redirect_stdout(io.StringIO()):
                document.write_section("x", "new")
            self.assertEqual(page.read_text(), "a\n<!-- begin of x -->\n\nnew\n\n<!-- end of x -->\nb\n")

    def test_keeps_cells_that_were_not_measured(self):
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder) / "page.md"
            table = document.markdown_table([("name", "a", "b"), ("p", "1", "2"), ("q", "3", "")])
            page.write_text(f"<!-- begin of x -->\n\n{table}\n\n<!-- end of x -->\n")
            with patch.object(document, "DOCUMENTS", [page]):
                merged = document.merged_rows("x", [("name", "b"), ("p", "5"), ("r", "6")])
                self.assertEqual(merged, [("name", "a", "b"), ("p", "1", "5"), ("q", "3", ""), ("r", "", "6")])
                with self.assertRaisesRegex(SystemExit, "no document has a section 'y'; there are: x"):
                    document.write_section("y", "new")

    def test_sections_of_the_pages_exist(self):
        text = "".join(page.read_text() for page in document.DOCUMENTS)
        benchmarks = ("comparison", "comparison by problem", "jax", "jax by problem", "handwritten", "lanes", "growth", "compile cost")
        for name in (*benchmarks, "all problems", "IPPC 2023", "IPPC 2011"):
            self.assertEqual(text.count(f"<!-- begin of {name} -->"), 1, name)
            self.assertEqual(text.count(f"<!-- end of {name} -->"), 1, name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
