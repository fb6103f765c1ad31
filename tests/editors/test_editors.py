"""The files for editors: the words of the TextMate grammar are the language's, and the extension works.

    RDDLC_BIN=build/bin test_editors.py
"""

import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BIN = Path(os.environ.get("RDDLC_BIN", ROOT / "build/bin")).resolve()
EXTENSION = ROOT / "editors/vscode"
PACKAGE = json.loads((EXTENSION / "package.json").read_text())
GRAMMAR = json.loads((EXTENSION / "syntaxes/rddl.tmLanguage.json").read_text())

# A rule of words: (?:domain|instance).
WORDS = re.compile(r"\(\?:([A-Za-z][A-Za-z0-9-]*(?:\|[A-Za-z][A-Za-z0-9-]*)*)\)")


def rules() -> list[tuple[str, re.Pattern]]:
    """Scopes and patterns, in the order in which an editor tries them."""
    groups = [include["include"].removeprefix("#") for include in GRAMMAR["patterns"]]
    assert set(groups) == set(GRAMMAR["repository"])
    return [(rule["name"].removesuffix(".rddl"), re.compile(rule["match"]))
            for group in groups for rule in GRAMMAR["repository"][group]["patterns"]]


def scopes(line: str) -> list[tuple[str, str]]:
    """The parts of a line that have a scope, as a TextMate editor finds them."""
    found, at = [], 0
    while at < len(line):
        hits = [(match.start(), order, scope, match) for order, (scope, pattern) in enumerate(rules())
                if (match := pattern.search(line, at))]
        if not hits:
            break
        _, _, scope, match = min(hits, key=lambda hit: hit[:2])
        found.append((match[0], scope))
        at = match.end()
    return found


def highlighted_words() -> set[str]:
    return {word for _, pattern in rules() for match in WORDS.findall(pattern.pattern) for word in match.split("|")}


def reserved_words() -> set[str]:
    grammar = (ROOT / "grammar/RDDL.g4").read_text()
    rules_alone = re.sub(r"^//.*", "", grammar, flags=re.M)
    return set(re.findall(r"'([A-Za-z][A-Za-z-]*)'", rules_alone))


def vocabulary() -> set[str]:
    """Functions, aggregations and distributions, of which not all are reserved."""
    folder = ROOT / "compiler/vocabulary"
    functions = re.findall(r'\.source = "(\w+)", \.form = Form::(?:Function|Extension)', (folder / "operators.cpp").read_text())
    others = re.findall(r'\{Reduction::\w+, "(\w+)"', (folder / "vocabulary.cpp").read_text())
    others += re.findall(r'Distribution::\w+, \.name = "(\w+)"', (folder / "distributions.cpp").read_text())
    assert len(functions) > 25 and len(others) > 25
    return {*functions, *others}


class Grammar(unittest.TestCase):
    def test_words_are_those_of_the_language(self):
        language = reserved_words() | vocabulary()
        self.assertEqual(sorted(highlighted_words() - language), [], "no words of RDDL")
        self.assertEqual(sorted(language - highlighted_words()), [], "words that the grammar lacks")

    def test_every_reserved_word_has_a_scope(self):
        behind = {"det": "_{", "Discrete": "(", "UnnormDiscrete": "(", "forall": "_{", "exists": "_{", "argmax": "_{", "argmin": "_{"}
        for word in reserved_words():
            text, scope = scopes(f" {word}{behind.get(word, ' ')}")[0]
            self.assertEqual(text, word)
            self.assertNotRegex(scope, "^variable", word)

    def test_names_that_hold_words_are_names(self):
        for name in ["if-else", "a-sum", "default-speed", "non-fluents-2", "sum", "min", "exp", "DOMAIN", "real'", "Normal-mean"]:
            self.assertEqual([scope for _, scope in scopes(name + " ")],
                             ["variable.other.next-state" if "'" in name else "variable.other"], name)

    def test_a_line(self):
        line = "p'(?x) = if (~ok(@red)) then -sum_{?y : t} exp[Q-1(?y)] * 0.5 else $f[](a); // sum_{"
        expected = [("p'", "variable.other.next-state"), ("?x", "variable.parameter"), ("=", "keyword.operator"),
                    ("if", "keyword.control"), ("~", "keyword.operator"), ("ok", "variable.other"),
                    ("@red", "constant.other.enumerated"), ("then", "keyword.control"), ("-", "keyword.operator"),
                    ("sum", "keyword.operator.aggregation"), ("?y", "variable.parameter"), ("t", "variable.other"),
                    ("exp", "support.function"), ("Q-1", "variable.other"), ("?y", "variable.parameter"),
                    ("*", "keyword.operator"), ("0.5", "constant.numeric"), ("else", "keyword.control"),
                    ("$f", "entity.name.function.external"), ("a", "variable.other"), ("// sum_{", "comment.line.double-slash")]
        self.assertEqual(scopes(line), expected)

    def test_examples_hold_nothing_illegal(self):
        seen = set()
        for path in sorted((ROOT / "examples").glob("*/*.rddl")):
            for line in path.read_text().splitlines():
                seen |= {scope for _, scope in scopes(line)}
        self.assertNotIn("invalid.illegal.reserved", seen)
        self.assertGreater(len(seen), 12)


class Extension(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_files_are_there_and_valid(self):
        contributes = PACKAGE["contributes"]
        files = [language["configuration"] for language in contributes["languages"]]
        files += [grammar["path"] for grammar in contributes["grammars"]]
        for name in files:
            json.loads((EXTENSION / name).read_text())
        self.assertTrue((EXTENSION / PACKAGE["main"]).is_file())
        self.assertEqual(contributes["grammars"][0]["scopeName"], GRAMMAR["scopeName"])
        for rule in json.loads((EXTENSION / "language-configuration.json").read_text())["indentationRules"].values():
            re.compile(rule)

    def test_names_are_words_of_the_editor(self):
        pattern = json.loads((EXTENSION / "language-configuration.json").read_text())["wordPattern"]
        self.assertEqual(re.findall(pattern, "p-1'(?x, @red) - $f"), ["p-1'", "?x", "@red", "$f"])

    def test_the_version_is_that_of_rddlc(self):
        version = subprocess.run([BIN / "rddl", "--version"], stdout=subprocess.PIPE, check=True).stdout.decode()
        self.assertEqual(version, f"rddl {PACKAGE['version']}\n")

    def test_the_problem_matcher_reads_diagnostics(self):
        (self.folder / "p.rddl").write_text(
            "domain d {\n"
            "    pvariables { x : { state-fluent, real, default = 0.0 }; };\n"
            "    cpfs { x' = x; };\n"
            "    reward = y;\n"
            "}\n"
            "non-fluents n { domain = d; }\n"
            "instance i { domain = d; non-fluents = n; horizon = 1; discount = 1.0; }\n")
        done = subprocess.run([BIN / "rddl", "check", "p.rddl"], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        pattern = PACKAGE["contributes"]["problemMatchers"][0]["pattern"]
        hits = [match for line in done.stdout.decode().splitlines() if (match := re.search(pattern["regexp"], line))]
        self.assertTrue(hits, done.stdout)
        first = hits[0]
        self.assertEqual(first[pattern["file"]], "p.rddl")
        self.assertEqual((first[pattern["line"]], first[pattern["column"]]), ("4", "14"))
        self.assertEqual(first[pattern["severity"]], "error")
        self.assertRegex(first[pattern["code"]], r"^E\d{4}$")
        self.assertNotIn("[E", first[pattern["message"]])

    @unittest.skipUnless(shutil.which("node"), "there is no node")
    def test_the_code_speaks_to_the_server(self):
        done = subprocess.run(["node", Path(__file__).parent / "run_extension.js", EXTENSION, BIN / "rddl"],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertEqual((done.returncode, done.stdout.decode()), (0, "ok\n"))


if __name__ == "__main__":
    unittest.main()
