"""Every example runs on the interpreter, which the sanitizers watch in their build."""

import json
import unittest

from commands import EXAMPLES, RDDL, SUCCESS, CommandTest


class Interpreter(CommandTest):
    def test_examples(self):
        for example in EXAMPLES:
            for instance in sorted(example.glob("instance*.rddl")):
                for policy in "random", "noop":
                    with self.subTest(example.name, instance=instance.name, policy=policy):
                        self.assert_runs(example / "domain.rddl", instance, policy)

    def assert_runs(self, domain, instance, policy) -> None:
        functions = domain.with_name("functions.hpp")
        result = self.run_command(
            RDDL, "run", domain, instance, "--engine=interpreter", f"--policy={policy}",
            *(["--extern", functions] if functions.exists() else []),
            "--episodes=3", "--seed=7", "--horizon=50", "--json", "--trace=trace.jsonl")
        self.assertEqual(result.status, SUCCESS, result)
        summary = json.loads(result.output)
        steps = (self.folder / "trace.jsonl").read_text().splitlines()
        self.assertEqual(summary["episodes"], 3)
        self.assertGreaterEqual(len(steps), 3)
        for step in steps:
            json.loads(step)


if __name__ == "__main__":
    unittest.main()
