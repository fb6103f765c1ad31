"""Builds without ANTLR's tool, by a parser that it made before, and what CMake says where something is missing.

    test_parser.py --build build --cxx c++
"""

import argparse
import shutil
import subprocess
import sys
import tarfile
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
NO_TOOL = "-DANTLR4="  # what find_program would find is not looked for
options = argparse.Namespace()


class Parser(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def output(self, *words, status: int = 0) -> str:
        done = subprocess.run([str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertEqual(done.returncode, status, done.stdout.decode())
        return done.stdout.decode()

    def configure(self, *arguments, source: Path = ROOT, status: int = 0) -> str:
        said = self.output("cmake", "-S", source, "-B", self.folder / "build", "-G", "Ninja", "-DRDDLC_BUILD_TESTS=OFF",
                           "-DCMAKE_BUILD_TYPE=None", "-DCMAKE_CXX_FLAGS=-O0",
                           f"-DCMAKE_CXX_COMPILER={options.cxx}", *arguments, status=status)
        return " ".join(said.split())  # CMake breaks lines as it likes

    def parser(self) -> Path:
        """Returns the version of the build that is tested."""
        made = next(path for name in ("generated", "ready") if (path := options.build / "grammar" / name / "grammar").exists())
        folder = self.folder / "parser"
        folder.mkdir()
        for name in "RDDLLexer.cpp", "RDDLLexer.h", "RDDLParser.cpp", "RDDLParser.h":
            shutil.copy(made / name, folder)
        shutil.copy(ROOT / "grammar/RDDL.g4", folder)
        return folder

    def test_a_parser_that_is_ready_needs_no_tool(self):
        parser = self.parser()
        self.assertIn(f"The parser is that in {parser}", self.configure(NO_TOOL, f"-DRDDLC_PARSER={parser}"))
        self.output("cmake", "--build", self.folder / "build", "--target", "rddlc_grammar")
        self.assertTrue((self.folder / "build/grammar/librddlc_grammar.a").exists())

    @unittest.skipUnless((ROOT / ".git").exists() and shutil.which("git"), "releases are made of commits")
    def test_releases_hold_a_parser(self):
        archive = self.output(ROOT / "scripts/release.sh", self.folder / "release").splitlines()[-1]
        with tarfile.open(archive) as packed:
            packed.extractall(self.folder)
        source = self.folder / Path(archive).name.removesuffix(".tar.gz")
        self.assertIn(f"The parser is that in {source}/grammar/parser", self.configure(NO_TOOL, source=source))

    def test_a_parser_of_another_grammar_is_refused(self):
        parser = self.parser()
        with (parser / "RDDL.g4").open("a") as grammar:
            grammar.write("// changed\n")
        said = self.configure(NO_TOOL, f"-DRDDLC_PARSER={parser}", status=1)
        self.assertIn("was made of another grammar", said)

    def test_a_parser_must_be_all_there(self):
        parser = self.parser()
        (parser / "RDDLLexer.h").unlink()
        said = self.configure(f"-DRDDLC_PARSER={parser}", status=1)
        self.assertIn(f"there is no RDDLLexer.h in {parser}", said)

    def test_a_parser_must_fit_the_runtime(self):
        parser, include = self.parser(), self.folder / "include"
        include.mkdir()
        (include / "Version.h").touch()
        source = (parser / "RDDLParser.cpp").read_text().split("\n", 2)
        source[1] = "// Generated from RDDL.g4 by ANTLR 4.9.3"
        (parser / "RDDLParser.cpp").write_text("\n".join(source))
        said = self.configure(f"-DRDDLC_PARSER={parser}", f"-DANTLR4_INCLUDE={include}", status=1)
        self.assertIn("ANTLR 4.9.3 made the parser", said)
        self.assertIn("do not fit", said)

    def test_what_is_missing_is_named_with_its_package(self):
        for variable, package in {"ANTLR4": "antlr4 (Debian", "ANTLR4_RUNTIME": "libantlr4-runtime-dev (Debian",
                                  "UTF8PROC": "libutf8proc-dev (Debian"}.items():
            said = self.configure(f"-D{variable}=", status=1)
            self.assertIn(f"is missing. Install {package}", said)
            self.assertIn(f"-D{variable}=...", said)
            shutil.rmtree(self.folder / "build")


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", type=Path, required=True)
    parser.add_argument("--cxx", required=True)
    options, rest = parser.parse_known_args()
    unittest.main(argv=[sys.argv[0], *rest])
