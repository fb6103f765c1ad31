"""Compiles and runs the clients that docs/c-interface.md prints, as a reader would."""

import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

options = argparse.Namespace()
WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror"]


def block(name: str) -> str:
    """The code behind the comment with its name."""
    page = pathlib.Path(options.page).read_text()
    found = re.search(rf"<!-- file: {re.escape(name)} -->\n```\w+\n(.*?)```", page, re.DOTALL)
    assert found, f"the page has no {name}"
    return found[1]


class Clients(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_in_folder(self, *command) -> str:
        done = subprocess.run([str(word) for word in command], cwd=self.folder, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout

    def compile_problem(self, name: str, *outputs: str):
        problem = pathlib.Path(options.examples) / name
        self.run_in_folder(options.rddlc, problem / "domain.rddl", problem / "instance.rddl",
                           *outputs)

    def test_c(self):
        self.compile_problem("network", "-o", "network.cpp", "--declare", "network.h")
        include = ["-I", options.include, "-I", "."]
        self.run_in_folder(options.cxx, "-std=c++20", "-O1", "-ffp-contract=off", *include, "-c",
                           "network.cpp")
        results = []
        for compiler, standard, name in [(options.cc, "c99", "client.c"),
                                         (options.cxx, "c++11", "client.cpp")]:
            (self.folder / name).write_text(block("client.c"))
            self.run_in_folder(compiler, f"-std={standard}", *WARNINGS, *include, "-c", name, "-o",
                               "client.o")
            self.run_in_folder(options.cxx, "client.o", "network.o", "-o", "client", "-pthread")
            results.append(self.run_in_folder("./client"))
        self.assertRegex(results[0], r"^network_1: 1000 environments, \d+ steps each, "
                         r"mean return \d+\.\d{3}\n$")
        self.assertEqual(results[0], results[1])
        if shutil.which("clang"):  # which warns of other conversions
            self.run_in_folder("clang", "-std=c99", *WARNINGS, *include, "-fsyntax-only", "client.c")

    def test_python(self):
        self.compile_problem("network", "-o", "network.so")
        (self.folder / "client.py").write_text(block("client.py"))
        lines = self.run_in_folder(sys.executable, "client.py", "./network.so").splitlines()
        self.assertEqual(len(lines), 5)
        self.assertEqual(lines[0], "network_1 0 [7.0, 7.0, 7.0, 7.0]")  # one is down at first
        self.assertRegex(lines[4], r"^network_1 4 \[\d\.\d+(, \d\.\d+){3}\]$")
        self.assertNotEqual(lines[4][12:], lines[0][12:], "nothing happens")


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    for option in ("page", "examples", "rddlc", "include", "cc", "cxx"):
        parser.add_argument(f"--{option}", required=True)
    parser.parse_args(namespace=options)
    unittest.main(argv=[sys.argv[0], "-v"])
