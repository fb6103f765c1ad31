"""Wrong command lines are refused, and what cannot be written leaves nothing half-written behind."""

import os
import resource
import subprocess
import unittest
from pathlib import Path

from commands import (DIAGNOSED, EXAMPLES, RDDL, RDDLC, ROOT, SUCCESS, USAGE, CommandTest,
                      no_disk_space)

PROBLEM = EXAMPLES[0] / "domain.rddl", EXAMPLES[0] / "instance.rddl"


class Output(CommandTest):
    def names(self) -> list[str]:
        return sorted(path.name for path in self.folder.iterdir())

    def test_missing_folder(self):
        for name in "nowhere/sim.cpp", "nowhere/sim.hpp", "nowhere/sim.so", "/proc/sim.cpp":
            self.assert_refused(self.run_command(RDDLC, *PROBLEM, "-o", name), "E0902")
        self.assertEqual(self.names(), [])

    def test_folder(self):
        for name in "sim.cpp", "sim.so":
            (self.folder / name).mkdir()
            result = self.run_command(RDDLC, *PROBLEM, "-o", name)
            self.assert_refused(result, "Is a directory [E0902]")
            self.assertEqual(os.listdir(self.folder / name), [])
        self.assertEqual(self.names(), ["sim.cpp", "sim.so"])

    def test_forbidden(self):
        nobody = self.as_nobody()
        self.folder.chmod(0o500)
        self.addCleanup(self.folder.chmod, 0o700)
        for name in "sim.cpp", "sim.so":
            result = self.run_command(RDDLC, *PROBLEM, "-o", name, **nobody)
            self.assert_refused(result, "Permission denied [E0902]")
        self.assertEqual(self.names(), [])

    def test_write_protected(self):
        """A new file of the same name does not replace it."""
        nobody = self.as_nobody()
        self.write("sim.cpp", "mine").chmod(0o444)
        result = self.run_command(RDDLC, *PROBLEM, "-o", "sim.cpp", **nobody)
        self.assert_refused(result, "Permission denied [E0902]")
        self.assertEqual((self.folder / "sim.cpp").read_text(), "mine")

    def test_names_like_options(self):
        (self.folder / "-d").mkdir()
        for name in "-d/sim.so", "./-sim.cpp":
            result = self.run_command(RDDLC, *PROBLEM, f"-o{name}")
            self.assertEqual(result.status, SUCCESS, result)
            self.assertTrue((self.folder / name).exists())

    def test_full_disk(self):
        """An older file stays as it was; a new one does not appear."""
        self.write("old.cpp", "older")
        for name in "old.cpp", "new.cpp", "new.so":
            result = self.run_command(RDDLC, *PROBLEM, "-o", name, preexec_fn=no_disk_space)
            self.assert_refused(result, "File too large [E0902]")
        self.assertEqual(self.names(), ["old.cpp"])
        self.assertEqual((self.folder / "old.cpp").read_text(), "older")

    def test_full_device(self):
        (self.folder / "sim.cpp").symlink_to("/dev/full")
        result = self.run_command(RDDLC, *PROBLEM, "-o", "sim.cpp")
        self.assert_refused(result, "No space left on device [E0902]")
        result = self.run_command("sh", "-c", f'"{RDDLC}" "$@" > /dev/full', "sh", *PROBLEM)
        self.assertEqual(result.status, DIAGNOSED, result)

    def test_errors_write_nothing(self):
        self.write("broken.rddl", "domain d { reward = 1 + ; }")
        for name in "sim.cpp", "sim.so":
            self.assert_refused(self.run_command(RDDLC, "broken.rddl", "-o", name), "E0101")
        self.assertEqual(self.names(), ["broken.rddl"])

    def test_input_as_output(self):
        text = "domain d { reward = 1; }"
        self.write("input.cpp", text)
        self.assert_refused(self.run_command(RDDLC, "input.cpp", "-o", "input.cpp"), "E0906")
        self.assert_refused(self.run_command(RDDLC, "input.cpp", "-o", "./input.cpp"), "E0906")
        (self.folder / "link.cpp").symlink_to("input.cpp")
        self.assert_refused(self.run_command(RDDLC, "input.cpp", "-o", "link.cpp"), "E0906")
        result = self.run_command(RDDLC, "input.cpp", "-o", "sim.cpp", "--MD", "--MF", "input.cpp")
        self.assert_refused(result, "E0906")
        self.assertEqual((self.folder / "input.cpp").read_text(), text)

    def test_unknown_kind(self):
        for name in "sim", "sim.c", "sim.cpp.txt", ".cpp":
            result = self.run_command(RDDLC, *PROBLEM, "-o", name)
            self.assert_refused(result, "E0903")
            self.assertIn(f"'{name}'", result.errors)
        self.assertEqual(self.names(), [])

    def test_no_compiler(self):
        result = self.run_command(RDDLC, *PROBLEM, "-o", "sim.so", environment={"CXX": "no-c++"})
        self.assert_refused(result, "E0905")
        self.assertIn("set CXX", result.errors)
        self.assertEqual(self.names(), [])
        result = self.run_command(RDDL, "run", *PROBLEM, "--engine=compiled",
                                  environment={"CXX": "no-c++", "XDG_CACHE_HOME": str(self.folder)})
        self.assertEqual(result.status, DIAGNOSED, result)
        self.assertIn("no-c++", result.errors)


class Blame(CommandTest):
    """Faults of the machine or the user's settings are reported as such, not as our mistakes."""

    MISTAKE = "echo 'simulator.cpp:3:4: error: nonsense'; exit 1"

    def compile_with(self, compiler: str) -> list:
        """Compiles with a compiler of this name, or one that is a script."""
        if "\n" in compiler:
            self.write("compiler.sh", compiler)
            compiler = "sh compiler.sh"
        environment = {"CXX": compiler, "XDG_CACHE_HOME": str(self.folder / "cache")}
        return [self.run_command(*words, environment=environment) for words in (
            [RDDLC, *PROBLEM, "-o", "sim.so"], [RDDL, "run", *PROBLEM, "--engine=compiled", "--quiet"])]

    def test_compilers_that_fail(self):
        for compiler, says in (
            ("false", "'false' ends with status 1"),
            ("\nkill -9 $$", "is ended by signal 9"),
            ("\necho 'g++: fatal error: Killed signal terminated program cc1plus'; exit 1",
             "more memory"),
            ("\necho 'x.cpp:9:1: fatal error: error writing to /tmp/c.s: No space left on device'; "
             "exit 1", "make room"),
            ("\necho '/usr/bin/ld: final link failed: Disk quota exceeded'; exit 1", "make room"),
            (f"\n{self.MISTAKE}", "set CXX to g++ 12"),  # The runtime's headers also fail: the compiler is too old.
            (f"\ncase $* in *headers.cpp*) exit 0; esac; echo 'virtual memory exhausted'; "
             f"{self.MISTAKE}", "more memory"),
        ):
            for result in self.compile_with(compiler):
                self.assert_refused(result, "E0910")
                self.assertIn(says, result.errors)

    def test_options_of_the_user(self):
        self.write("--script", f"case $* in *headers.cpp*) exit 0; esac; {self.MISTAKE}")
        for result in self.compile_with("sh -- ./--script"):
            self.assert_refused(result, "E0910")
            self.assertIn("leave the options out of CXX, which is 'sh -- ./--script'", result.errors)

    def test_threads_that_cannot_be_created(self):
        limit = 300 * 2**20
        result = self.run_command(
            RDDL, "run", *PROBLEM, "--engine=interpreter", "--episodes=1000", "--threads=600",
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
        self.assertEqual(result.status, SUCCESS, result)
        self.assertRegex(result.errors, "the system gives no more than [0-9]+ of 600 threads")

    def test_a_system_without_threads(self):
        library = os.environ.get("NO_THREADS", Path(RDDLC).parents[1] / "tests/robustness/libno_threads.so")
        for words in ([RDDLC, *PROBLEM, "-o", "sim.so"],
                      [RDDL, "run", *PROBLEM, "--episodes=100", "--threads=2"],
                      [RDDL, "bench", *PROBLEM, "--seconds=0.01", "--threads=2"],
                      [RDDL, "verify", *PROBLEM, "--steps=100", "--no-pyrddlgym"],
                      [RDDL, "check", *PROBLEM]):
            result = self.run_command(*words, environment={
                "LD_PRELOAD": str(library), "NO_THREADS_OF": Path(words[0]).name,
                "XDG_CACHE_HOME": str(self.folder / "cache")})
            self.assertEqual(result.status, SUCCESS, f"{words}\n{result}")

    def test_full_standard_streams(self):
        for words in ([RDDLC, "--help"], [RDDL, "--help"], [RDDL, "run", "--help"],
                      [RDDLC, "--version"], [RDDL, "--version"], [RDDLC, "--explain", "E0101"],
                      [RDDL, "info", *PROBLEM], [RDDLC, *PROBLEM, "--stats"],
                      [RDDL, "fmt", "--stdout", PROBLEM[0]], [RDDLC, *PROBLEM, "--print=cpp"],
                      [RDDL, "--man-page"], [RDDL, "--completions=bash"], [RDDL, "list"]):
            with open("/dev/full", "w") as full:
                result = self.run_command(*words, stdout=full, stderr=subprocess.PIPE,
                                          environment={"RDDL_REPOSITORY": str(ROOT / "examples")})
            self.assertEqual(result.status, DIAGNOSED, f"{words}\n{result}")
            self.assertIn("cannot write to standard output: No space left on device", result.errors)
        for words, status in (([RDDL, "nonsense"], USAGE), ([RDDLC, "--nonsense"], USAGE),
                              ([RDDLC, "no.rddl"], DIAGNOSED), ([RDDL, "run", "no.rddl"], DIAGNOSED),
                              ([RDDLC, *PROBLEM, "--check", "-v"], SUCCESS)):
            with open("/dev/full", "w") as full:
                result = self.run_command(*words, stdout=subprocess.PIPE, stderr=full)
            self.assertEqual(result.status, status, f"{words}\n{result}")


class Externals(CommandTest):
    """External functions that are not what the domain needs."""

    def setUp(self) -> None:
        super().setUp()
        self.write("tank.rddl", """
            domain tank {
                types { pipe : object; };
                pvariables {
                    open(pipe) : { action-fluent, bool, default = false };
                    water : { state-fluent, real, default = 5.0 };
                };
                cpfs { water' = $in-flow[](water, open(_)); };
                reward = water;
            }
            non-fluents two { domain = tank; objects { pipe : {a, b}; }; }
            instance one { domain = tank; non-fluents = two; horizon = 10; discount = 1.0; }""")
        self.cache = {"XDG_CACHE_HOME": str(self.folder / "cache")}

    def run_with(self, *words):
        return self.run_command(RDDL, "run", "tank.rddl", *words, environment=self.cache)

    def test_refused_by_the_compiler(self):
        for text, message in (
            ("double in_flow(double, std::span<const bool>);", "in_flow"),
            ("namespace rddl_extern { double in_flow(int x, std::span<const bool>) { return x; } }",
             "must be callable as double rddl_extern::in_flow(double, std::span<const bool, 2>)"),
            ("namespace rddl_extern { double in_flow(double x) { return x; } }", "$in-flow must be"),
            ("namespace rddl_extern { double in_flow(double x, std::span<const bool, 3>) "
             "{ return x; } }", "$in-flow must be"),
            ("namespace rddl_extern { const char* in_flow(double, std::span<const bool>) "
             "{ return 0; } }", "$in-flow must be"),
            ("gibberish", "gibberish"),
        ):
            with self.subTest(text):
                self.write("functions.hpp", "#include <span>\n" + text)
                # rddl compiles as rddlc does: one of the texts shows that it tells.
                engines = ("compiled", "interpreter") if text == "gibberish" else ("interpreter",)
                results = [self.run_with("--extern=functions.hpp", f"--engine={engine}") for engine in engines]
                results.append(self.run_command(
                    RDDLC, "tank.rddl", "--extern=functions.hpp", "-o", "sim.so"))
                for result in results:
                    self.assert_refused(result, "E0908")
                    self.assertIn(message, result.errors)

    def test_missing(self):
        self.assert_refused(self.run_with(), "E0907")
        self.assert_refused(self.run_with("--engine=interpreter"), "E0907")
        self.assert_refused(self.run_command(RDDLC, "tank.rddl", "-o", "sim.cpp"), "E0907")
        for words in ["--extern=no.hpp"], ["--extern=.", "--engine=interpreter"]:
            self.assert_refused(self.run_with(*words), "E0901")
        self.assert_refused(self.run_command(RDDLC, "tank.rddl", "--extern=no.hpp"), "E0901")
        self.assertEqual(self.run_command(RDDLC, "tank.rddl", "--check").status, SUCCESS)
        self.assertEqual(self.run_command(RDDL, "info", "tank.rddl").status, SUCCESS)

    def test_shared_objects(self):
        self.write("broken.so", "no shared object")
        result = self.run_with("--extern=broken.so", "--engine=interpreter")
        self.assertEqual(result.status, DIAGNOSED)
        self.assertIn("cannot load 'broken.so'", result.errors)
        for refused in (self.run_with("--extern=broken.so", "--engine=compiled"),
                        self.run_command(RDDLC, "tank.rddl", "--extern=broken.so")):
            self.assertEqual(refused.status, USAGE)
            self.assertIn("C++ header", refused.errors)


class Explain(CommandTest):
    def test_every_page(self):
        for page in sorted((ROOT / "docs/diagnostics").glob("*.md")):
            result = self.run_command(RDDLC, "--explain", page.stem)
            self.assertEqual(result.status, SUCCESS, result)
            self.assertTrue(result.output.startswith(f"# {page.stem}: "), result)


class Options(CommandTest):
    def test_floats_in_eight_lanes(self):
        result = self.run_command(RDDLC, *PROBLEM, "--real=float", "--lanes=8")
        self.assert_refused(result, "E0904")
        self.assertEqual(result.output, "")

    def test_lanes_with_a_policy_block(self):
        folder = ROOT / "examples/mountain_car"
        problem = folder / "domain.rddl", folder / "instance.rddl"
        policy = folder / "policy.rddl"
        result = self.run_command(RDDLC, *problem, policy, "--lanes=16")
        self.assertEqual(result.status, 0, result.errors)
        self.assertIn("warning: --lanes=16 has no effect with a policy block [W0901]\n", result.errors)
        for quiet in (["--lanes=1"], [], ["--lanes=16", "-Wno-W0901"]):
            result = self.run_command(RDDLC, *problem, policy, *quiet)
            self.assertEqual((result.status, result.errors), (0, ""), quiet)
        self.assertEqual(self.run_command(RDDLC, *problem, "--lanes=16").errors, "")

    def test_wrong_command_lines(self):
        for words in ([RDDLC], [RDDLC, *PROBLEM, "policy.rddl", "fourth.rddl"],
                      [RDDLC, *PROBLEM, "--nonsense"],
                      [RDDLC, *PROBLEM, "--print=nonsense"], [RDDLC, *PROBLEM, "-o"],
                      [RDDLC, *PROBLEM, "--stop-after=lunch"], [RDDLC, *PROBLEM, "--lanes=x"],
                      [RDDLC, "--explain", "E9999"], [RDDLC, "--explain", "nonsense"],
                      [RDDLC, *PROBLEM, "-Wno-nonsense"],
                      [RDDL], [RDDL, "nonsense"], [RDDL, "run"], [RDDL, "check"],
                      [RDDL, "run", *PROBLEM, "--episodes=-1"], [RDDL, "run", *PROBLEM, "--seed=x"],
                      [RDDL, "run", *PROBLEM, "--engine=steam"]):
            result = self.run_command(*words)
            self.assertEqual(result.status, USAGE, f"{words}\n{result}")
            self.assertNotEqual(result.errors, "", words)

    def test_numbers(self):
        """Every option that takes one refuses what it would have to change, in a sentence."""
        run, replay, bench = ([RDDL, command, *PROBLEM, "--engine=interpreter"]
                              for command in ("run", "replay", "bench"))
        ints = "x", "1e20", "1.5", "0x10", "+1", " 1", "99999999999999999999", "9" * 400, "nan"
        for command, option in ((run, "episodes"), (run, "seed"), (run, "horizon"), (run, "threads"),
                                (run, "batch"), (replay, "seed"), (replay, "horizon"),
                                (bench, "batch"), (bench, "threads")):
            for word in *ints, "-1", "-9223372036854775809":
                self.assert_wrong_number(command, option, word, "is not an int from")
        for word in "nan", "-nan", "inf", "1e999", "-1", "0", "0x1p3", "1,5", "3600.1", "1s":
            self.assert_wrong_number(bench, "seconds", word, "is not a number from 0.01 to 3600")
        for word in *ints, "2", "016", "4294967304", "-8":
            self.assert_wrong_number([RDDLC, *PROBLEM], "lanes", word, "")
        self.assertEqual(self.run_command(
            *run, "--seed=18446744073709551615", "--horizon=0010", "--quiet").status, SUCCESS)

    def assert_wrong_number(self, command, option, word, says) -> None:
        result = self.run_command(*command, f"--{option}={word}")
        self.assertEqual(result.status, USAGE, f"--{option}={word}\n{result}")
        self.assertIn(says, result.errors)
        self.assertLess(len(result.errors), 600)

    def test_warnings(self):
        """Shown, silenced by code or altogether, made errors."""
        self.write("warns.rddl", """
            domain tank {
                pvariables { water : { state-fluent, real, default = 5.0 }; };
                cpfs { water' = water; };
                reward = 0;
                reward = water;
            }
            non-fluents none { domain = tank; }
            instance one { domain = tank; non-fluents = none; horizon = 10; discount = 1.0; }""")
        check = [RDDLC, "warns.rddl", "--check"]
        shown = self.run_command(*check)
        self.assertEqual(shown.status, SUCCESS)
        self.assertIn("warning: this 'reward' is ignored", shown.errors)
        for silence in "-Wno-W0201", "-w":
            result = self.run_command(*check, silence)
            self.assertEqual((result.status, result.errors), (SUCCESS, ""))
        for strict in "-Werror", "-Werror=W0201":
            result = self.run_command(*check, strict)
            self.assertEqual(result.status, DIAGNOSED)
            self.assertIn("[W0201]", result.errors)


if __name__ == "__main__":
    unittest.main()
