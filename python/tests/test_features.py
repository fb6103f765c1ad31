"""docs/python.md, "Beside other packages": what the last column names is there."""

from __future__ import annotations

import ast
import re
import unittest
from pathlib import Path

TESTS = Path(__file__).parent
PAGE = TESTS.parents[1] / "docs" / "python.md"


def definitions(file: str) -> set[str]:
    """Functions, classes, and Class.function of a module, which is not imported: its packages may be missing."""
    found = set()
    for node in ast.parse((TESTS / f"{file}.py").read_text()).body:
        if isinstance(node, ast.ClassDef | ast.FunctionDef):
            found.add(node.name)
        if isinstance(node, ast.ClassDef):
            found |= {f"{node.name}.{each.name}" for each in node.body if isinstance(each, ast.FunctionDef)}
    return found


class Table(unittest.TestCase):
    def test_each_of_our_features_is_tried(self) -> None:
        section = PAGE.read_text().split("## Beside other packages")[1].split("\n## ")[0]
        rows = [line.strip("|").split("|") for line in section.splitlines() if line.startswith("| ")]
        self.assertGreater(len(rows), 20)
        for feature, ours, *_, tests in rows[1:]:
            with self.subTest(feature=feature.strip()):
                named = re.findall(r"`(\w+)\.([\w.]+)`", tests)
                self.assertTrue(named or ours.strip() == "no" or feature.strip() == "platforms")
                for file, name in named:
                    self.assertIn(name, definitions(file))


if __name__ == "__main__":
    unittest.main()
