"""No command destroys a file that it reads, nor a pipe or device, whatever names it is given."""

import json
import os
import resource
import stat
import threading
import unittest

from commands import DIAGNOSED, EXAMPLES, RDDL, RDDLC, SUCCESS, CommandTest

DOMAIN, INSTANCE = ((EXAMPLES[0] / name).read_text() for name in ("domain.rddl", "instance.rddl"))
INTERPRET = "--engine=interpreter"
STEP = '{"repeat": 2}\n'


class Replacing(CommandTest):
    def setUp(self) -> None:
        super().setUp()
        self.write("domain.rddl", DOMAIN)
        self.write("instance.rddl", INSTANCE)
        self.write("steps.jsonl", STEP)
        # Other names of what is read.
        for name in "domain.rddl", "instance.rddl", "steps.jsonl":
            os.link(self.folder / name, self.folder / f"hard-{name}")
            (self.folder / f"soft-{name}").symlink_to(name)
        self.before = self.contents()

    def contents(self) -> dict[str, str]:
        return {path.name: path.read_text() for path in self.folder.iterdir() if path.is_file()}

    def assert_refuses_to_overwrite(self, *words) -> None:
        result = self.run_command(*words)
        self.assertEqual(result.status, DIAGNOSED, result)
        self.assertIn("would overwrite a file of this very command", result.errors)
        self.assertEqual(self.contents(), self.before)

    def names_of(self, name: str) -> list[str]:
        return [name, f"./{name}", f"hard-{name}", f"soft-{name}"]

    def test_what_was_read_is_not_replaced(self):
        problem = "domain.rddl", "instance.rddl"
        for name in self.names_of("steps.jsonl") + self.names_of("instance.rddl"):
            self.assert_refuses_to_overwrite(
                RDDL, "replay", *problem, INTERPRET, "--input=steps.jsonl", "--output", name)
        for name in self.names_of("domain.rddl"):
            self.assert_refuses_to_overwrite(
                RDDL, "run", *problem, INTERPRET, "--trace", name)
            self.assert_refuses_to_overwrite(RDDL, "fmt", "domain.rddl", "-o", name)
            self.assert_refuses_to_overwrite(
                RDDLC, *problem, "-o", "sim.cpp", "-MD", "-MF", name)
        self.assert_refuses_to_overwrite(
            "sh", "-c", f'"{RDDL}" replay {" ".join(problem)} {INTERPRET} --input steps.jsonl '
            ">>steps.jsonl")

    def test_headers_are_read_too(self):
        self.write("functions.hpp", '#include "tools.hpp"\n')
        self.write("tools.hpp", "")
        self.before = self.contents()
        for name in "functions.hpp", "tools.hpp":
            self.assert_refuses_to_overwrite(
                RDDL, "run", "domain.rddl", "instance.rddl", INTERPRET,
                "--extern=functions.hpp", "--trace", name)
            self.assert_refuses_to_overwrite(
                RDDLC, "domain.rddl", "instance.rddl", "--extern=functions.hpp", "-o", name)

    def test_two_outputs_of_one_name(self):
        (self.folder / "link").symlink_to("sim.cpp")
        for name in "sim.cpp", "./sim.cpp", "link":
            self.assert_refuses_to_overwrite(
                RDDLC, "domain.rddl", "instance.rddl", "-o", "sim.cpp", "-MD", "-MF", name)

    def test_pipes_are_written_to(self):
        for name, words in (("pipe", [RDDL, "fmt", "domain.rddl", "-o"]),
                            ("pipe.cpp", [RDDLC, "domain.rddl", "instance.rddl", "-o"]),
                            ("pipe.jsonl", [RDDL, "run", "domain.rddl", "instance.rddl",
                                            INTERPRET, "--trace"])):
            pipe = self.folder / name
            os.mkfifo(pipe)
            received = []
            reader = threading.Thread(target=lambda: received.append(pipe.read_text()), daemon=True)
            reader.start()
            result = self.run_command(*words, name)
            self.assertEqual(result.status, SUCCESS, result)
            reader.join(timeout=30)
            self.assertGreater(len(received[0]), 100)
            self.assertTrue(stat.S_ISFIFO(pipe.stat().st_mode))

    def test_devices_are_written_to(self):
        full = self.folder / "full.cpp"
        try:
            os.mknod(full, stat.S_IFCHR | 0o666, os.stat("/dev/full").st_rdev)
            full.write_text("")
        except OSError:  # Only root may; a link shows that it stays one.
            full.unlink(missing_ok=True)
            full.symlink_to("/dev/full")
        kind = stat.S_IFMT(os.lstat(full).st_mode)
        for words in ([RDDL, "fmt", "domain.rddl", "-o"],
                      [RDDLC, "domain.rddl", "instance.rddl", "-o"],
                      [RDDL, "run", "domain.rddl", "instance.rddl", INTERPRET, "--trace"],
                      [RDDL, "replay", "domain.rddl", "instance.rddl", INTERPRET,
                       "--input=steps.jsonl", "--output"]):
            result = self.run_command(*words, "full.cpp")
            self.assertEqual(result.status, DIAGNOSED, result)
            self.assertIn("cannot write 'full.cpp': No space left on device", result.errors)
            self.assertEqual(stat.S_IFMT(os.lstat(full).st_mode), kind)

    def test_only_files_are_rewritten(self):
        os.mkfifo(self.folder / "pipe.rddl")
        writer = threading.Thread(
            target=lambda: (self.folder / "pipe.rddl").write_text("domain d{reward=1;}"))
        writer.start()
        result = self.run_command(RDDL, "fmt", "pipe.rddl")
        writer.join()
        self.assertEqual(result.status, DIAGNOSED, result)
        self.assertIn("'pipe.rddl' is not a regular file", result.errors)

    def test_descriptors_are_written_to(self):
        """Earlier text in the same file stays."""
        self.run_command("sh", "-c", f'(echo before; "{RDDL}" fmt instance.rddl -o /dev/stdout; '
                         "echo after) >all")
        lines = (self.folder / "all").read_text().splitlines()
        self.assertEqual((lines[0], lines[-1]), ("before", "after"))
        self.assertGreater(len(lines), 3)

    def test_links_and_permissions_stay(self):
        self.write("sim.cpp", "older").chmod(0o640)
        (self.folder / "link.cpp").symlink_to("sim.cpp")
        result = self.run_command(RDDLC, "domain.rddl", "instance.rddl", "-o", "link.cpp")
        self.assertEqual(result.status, SUCCESS, result)
        self.assertTrue((self.folder / "link.cpp").is_symlink())
        self.assertIn("Simulator", (self.folder / "sim.cpp").read_text())
        self.assertEqual(stat.S_IMODE((self.folder / "sim.cpp").stat().st_mode), 0o640)

    def test_closed_standard_output(self):
        """A file that is opened does not become standard output."""
        result = self.run_command(
            "sh", "-c", f'"{RDDL}" run domain.rddl instance.rddl {INTERPRET} --trace t.jsonl >&-')
        self.assertEqual(result.status, DIAGNOSED, result)
        self.assertIn("cannot write", result.errors)
        for line in (self.folder / "t.jsonl").read_text().splitlines():
            self.assertTrue(line.startswith("{"), line)


class Reading(CommandTest):
    def test_folder_as_input(self):
        self.write("domain.rddl", DOMAIN)
        self.write("instance.rddl", INSTANCE)
        replay = [RDDL, "replay", "domain.rddl", "instance.rddl", INTERPRET, "--output=out"]
        result = self.run_command(*replay, "--input=.")
        self.assertEqual(result.status, DIAGNOSED, result)
        self.assertIn("cannot read '.': Is a directory", result.errors)
        self.assertFalse((self.folder / "out").exists())
        for words in replay, [RDDL, "fmt", "-"]:
            descriptor = os.open(self.folder, os.O_RDONLY)
            result = self.run_command(*words, stdin=descriptor)
            os.close(descriptor)
            self.assertEqual(result.status, DIAGNOSED, result)
            self.assertIn("cannot read 'standard input': Is a directory", result.errors)

    def test_names_that_lead_nowhere(self):
        self.write("domain.rddl", DOMAIN)
        self.write("instance.rddl", INSTANCE)
        (self.folder / "loop").symlink_to("loop")
        problem = "domain.rddl", "instance.rddl"
        for name, why in ("loop", "Too many levels of symbolic links"), ("x" * 300, "File name too long"):
            for words in ([RDDLC, name], [RDDLC, *problem, "--extern", name], [RDDL, "check", name],
                          [RDDL, "run", name], [RDDL, "run", "domain.rddl", name],
                          [RDDL, "check", *problem, "--extern", name],
                          [RDDL, "run", *problem, "--policy", f"./{name}"]):
                self.assert_refused(self.run_command(*words), f"{why} [E0901]")
            for words in ([RDDL, "fmt", name], [RDDL, "replay", *problem, INTERPRET, "--input", name],
                          [RDDL, "verify", *problem, "--states", name, "--no-pyrddlgym"]):
                result = self.run_command(*words, environment={"CXX": "false"})
                self.assertEqual(result.status, DIAGNOSED, result)
                self.assertNotIn("filesystem error", result.errors)
                self.assertNotIn("cannot write", result.errors)
        self.assert_refused(self.run_command(RDDL, "check", *problem, "--extern", ""), "E0901")

    def test_devices_have_no_end(self):
        self.write("domain.rddl", DOMAIN)
        self.write("instance.rddl", INSTANCE)
        problem = "domain.rddl", "instance.rddl"
        self.assert_refused(self.run_command(RDDLC, *problem, "--extern=/dev/zero"), "E0901")
        with open("/dev/zero") as zeros:
            result = self.run_command(RDDL, "fmt", "-", stdin=zeros)
        self.assertEqual(result.status, DIAGNOSED, result)

    def test_long_lines_are_left_out(self):
        self.write("domain.rddl", DOMAIN)
        self.write("instance.rddl", INSTANCE)
        self.write("steps.jsonl", "{}\n" + "x" * 2**24 + "\n{}" + " " * 2**19 + "\n" + "[" * 2**24)
        result = self.run_command(RDDL, "replay", "domain.rddl", "instance.rddl", INTERPRET,
                                  "--input=steps.jsonl", "--horizon=0")
        self.assertEqual(result.status, SUCCESS, result)
        answers = [json.loads(line) for line in result.output.splitlines()]
        self.assertEqual([(answer.get("line"), "state" in answer) for answer in answers],
                         [(None, True), (2, False), (None, True), (4, False)])


class LittleMemory(CommandTest):
    """Endless files are not read. Not for the sanitizers, which ask for terabytes of addresses."""

    def test_a_line_without_end(self):
        self.write("domain.rddl", DOMAIN)
        self.write("instance.rddl", INSTANCE)
        result = self.run_command(RDDL, "replay", "domain.rddl", "instance.rddl", INTERPRET,
                                  "--input=/dev/zero", preexec_fn=self.limit_memory)
        self.assertEqual(result.status, DIAGNOSED, result)
        self.assertIn("it has a line without end", result.errors)
        self.assertIn('{"error":"the line has more than ', result.output)

    def limit_memory(self) -> None:
        limit = 2**28
        resource.setrlimit(resource.RLIMIT_AS, (limit, limit))


if __name__ == "__main__":
    unittest.main()
