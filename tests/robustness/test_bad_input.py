"""Whatever stands in the files, a diagnostic says so, and nothing crashes."""

import random
import re
import unittest
from pathlib import Path

from commands import EXAMPLES, LOOKING, RDDL, RDDLC, SUCCESS, CommandTest

TEN_MEGABYTES = 10_000_000
PROBLEM = EXAMPLES[1] / "domain.rddl", EXAMPLES[1] / "instance.rddl"
DOMAIN, INSTANCE = (path.read_bytes() for path in PROBLEM)


class Files(CommandTest):
    def test_missing(self):
        self.assert_all_refuse("nowhere.rddl", PROBLEM[1], code="No such file or directory [E0901]")
        self.assert_all_refuse(PROBLEM[0], "nowhere.rddl", code="No such file or directory [E0901]")

    def test_folder(self):
        self.assert_all_refuse(self.folder, PROBLEM[1], code="Is a directory [E0901]")

    def test_forbidden(self):
        nobody = self.as_nobody()
        self.write("secret.rddl", DOMAIN).chmod(0)
        for looking in LOOKING:
            result = self.run_command(*looking, "secret.rddl", PROBLEM[1], **nobody)
            self.assert_refused(result, "Permission denied [E0901]")

    def test_policies_without_one(self):
        for words in ([RDDLC, *PROBLEM, PROBLEM[0]],
                      [RDDL, "run", *PROBLEM, "--engine=interpreter", "--policy", PROBLEM[0]],
                      [RDDL, "info", *PROBLEM, "--policy", PROBLEM[0]]):
            result = self.run_command(*words)
            self.assert_refused(result, "there is no policy block in")
            self.assert_refused(result, "E0911")

    def test_broken_device(self):
        self.assert_all_refuse("/proc/self/mem", PROBLEM[1], code="Input/output error [E0901]")

    def test_endless_device(self):
        self.assert_all_refuse("/dev/zero", PROBLEM[1], code="File too large [E0901]")

    def test_empty(self):
        for text in ["", "\n", "// nothing\n"]:
            self.write("empty.rddl", text)
            self.assert_all_refuse("empty.rddl", PROBLEM[1], code="E0114")
        self.assert_all_refuse("/dev/null", "/dev/null", code="E0114")

    def test_one_file_of_two(self):
        # A domain can be checked alone, and no more.
        for checking in [[RDDL, "check"], [RDDLC, "--check"]]:
            self.assertEqual(self.run_command(*checking, PROBLEM[0]).status, SUCCESS)
        for using in [[RDDL, "info"], [RDDLC, "--print=model"], [RDDLC, "--stop-after=emit"]]:
            self.assert_refused(self.run_command(*using, PROBLEM[0]), "there is no instance block")
        self.assert_all_refuse(PROBLEM[1], code="there is no domain block")

    def test_same_file_twice(self):
        self.assert_all_refuse(PROBLEM[0], PROBLEM[0], code="there is no instance block")
        self.assert_all_refuse(PROBLEM[1], PROBLEM[1], code="there is no domain block")

    def test_any_order(self):
        self.assert_all_accept(PROBLEM[1], PROBLEM[0])

    def test_odd_names(self):
        name = "a b\n\x1b[31m'%s{}\".rddl"
        self.write(name, DOMAIN)
        self.assert_all_accept(name, PROBLEM[1])
        self.write(name, DOMAIN[:-3])
        self.assert_all_refuse(name, PROBLEM[1])


class Bytes(CommandTest):
    def test_truncated(self):
        for name, text in ("domain.rddl", DOMAIN), ("instance.rddl", INSTANCE):
            self.write("domain.rddl", DOMAIN)
            self.write("instance.rddl", INSTANCE)
            for length in range(0, len(text.rstrip()), 50):
                self.write(name, text[:length])
                with self.subTest(name, length=length):
                    self.assert_all_refuse("domain.rddl", "instance.rddl")

    def test_binary(self):
        self.write("sim.rddl", Path(RDDLC).read_bytes()[:200_000])
        self.assert_all_refuse("sim.rddl", PROBLEM[1], code="E0107")

    def test_random_bytes(self):
        generator = random.Random(1)
        for seed in range(5):
            self.write("noise.rddl", generator.randbytes(10_000))
            self.assert_all_refuse("noise.rddl", PROBLEM[1], code="E0107")

    def test_nul(self):
        for text in b"\0" * 1000, DOMAIN + b"\0", DOMAIN.replace(b"reward", b"rew\0ard"):
            self.write("nul.rddl", text)
            self.assert_all_refuse("nul.rddl", PROBLEM[1], code="E0107")

    def test_other_encodings(self):
        text = DOMAIN.decode().replace("reward", "belöhnung")
        for encoding in "latin-1", "utf-16":
            self.write("other.rddl", text.encode(encoding))
            self.assert_all_refuse("other.rddl", PROBLEM[1], code="E0107")
        for bad in b"\xff", b"\xc3", b"\xc3(", b"\xed\xa0\x80", b"\xf8\x88\x80\x80\x80", b"\xc0\x80":
            self.write("bad.rddl", DOMAIN.replace(b"reward", b"re" + bad + b"ward"))
            self.assert_all_refuse("bad.rddl", PROBLEM[1])

    def test_line_ends(self):
        """\\r\\n and \\r are as good as \\n: the same simulator comes out."""
        def emitted(line_end: bytes) -> str:
            self.write("domain.rddl", DOMAIN.replace(b"\n", line_end))
            self.write("instance.rddl", INSTANCE.replace(b"\n", line_end))
            result = self.run_command(RDDLC, "domain.rddl", "instance.rddl")
            self.assertEqual(result.status, SUCCESS, result)
            return result.output

        self.assertIn("struct Simulator", emitted(b"\n"))
        self.assertEqual(emitted(b"\n"), emitted(b"\r\n"))
        self.assertEqual(emitted(b"\n"), emitted(b"\r"))

    def test_byte_order_mark(self):
        self.write("marked.rddl", b"\xef\xbb\xbf" + DOMAIN)
        self.assert_all_accept("marked.rddl", PROBLEM[1])


class Sizes(CommandTest):
    def assert_reward_refused(self, expression: str, code: str = "") -> None:
        self.write("domain.rddl", "domain d { reward = " + expression)
        self.assert_all_refuse("domain.rddl", PROBLEM[1], code=code)

    def test_nested_brackets(self):
        for bracket in "(", "[", "{", "f[", "p(":
            self.assert_reward_refused(bracket * (TEN_MEGABYTES // len(bracket)), "E0115")
        self.write("domain.rddl", "(" * TEN_MEGABYTES)
        self.assert_all_refuse("domain.rddl", PROBLEM[1])

    def test_deep_expressions(self):
        self.assert_reward_refused("~" * TEN_MEGABYTES, "E0116")
        self.assert_reward_refused("1 + " * 300_000 + "1; }", "E0116")
        self.assert_reward_refused("if (true) then 1 else " * 100_000 + "1; }", "E0116")

    def test_many_words(self):
        self.assert_reward_refused(";" * TEN_MEGABYTES, "E0117")

    def test_large_file(self):
        self.write("domain.rddl", b" " * (64 * 2**20 + 1))
        self.assert_all_refuse("domain.rddl", PROBLEM[1], code="E0117")

    def test_long_words(self):
        for word in "x" * TEN_MEGABYTES, "?" + "x" * TEN_MEGABYTES, "@" + "x" * TEN_MEGABYTES:
            self.assert_reward_refused(word + "; }")

    def test_many_errors(self):
        self.assert_reward_refused("+ ; reward = " * 100_000)


class Numbers(CommandTest):
    def problem(self, number: str = "1", horizon: str = "10", discount: str = "1.0",
                actions: str = "1") -> str:
        self.write("problem.rddl", f"""
            domain tank {{
                types {{ lake : object; }};
                pvariables {{
                    water(lake) : {{ state-fluent, real, default = {number} }};
                    drain : {{ action-fluent, bool, default = false }};
                }};
                cpfs {{ water'(?l) = water(?l) * {number} - drain; }};
                reward = sum_{{?l : lake}} water(?l) / {number};
            }}
            non-fluents nf {{ domain = tank; objects {{ lake : {{a, b}}; }}; }}
            instance one {{
                domain = tank; non-fluents = nf; max-nondef-actions = {actions};
                horizon = {horizon}; discount = {discount};
            }}""")
        return "problem.rddl"

    def test_too_large(self):
        for number in "9223372036854775808", "9" * 100, "1" + "0" * 400 + ".0", "9" * 1_000_000:
            self.assert_all_refuse(self.problem(number=number), code="E0112")
        for horizon in "9223372036854775808", "9" * 100_000:
            self.assert_all_refuse(self.problem(horizon=horizon), code="E0112")

    def test_at_the_border(self):
        for number in "9223372036854775807", "0.0", "0." + "0" * 100_000 + "1", "9" * 300 + ".0":
            self.assert_all_accept(self.problem(number=number))
        self.assert_all_accept(self.problem(horizon="9223372036854775807"))
        self.assert_all_accept(self.problem(actions="9223372036854775807"))
        self.assert_all_accept(self.problem(discount="0.0"))

    def test_negative(self):
        self.assert_all_refuse(self.problem(horizon="-1"))


class Mutations(CommandTest):
    """Examples with words exchanged: nearly right, so that they come far into the compiler."""

    WORD = re.compile(rb"[?@$]?[A-Za-z][-A-Za-z0-9_]*'?|[0-9.]+|[^\sA-Za-z0-9]")

    def mutated(self, text: bytes, generator: random.Random) -> bytes:
        text = re.sub(rb"//[^\n]*", b"", text)
        for _ in range(generator.randint(1, 2)):
            words = list(self.WORD.finditer(text))
            old, new = generator.choice(words), generator.choice(words)
            replacement = generator.choice([new[0], new[0], old[0] + b" " + new[0], b""])
            text = text[:old.start()] + replacement + text[old.end():]
        return text

    def test_exchanged_words(self):
        generator = random.Random(2)
        accepted = refused = 0
        for _ in range(40):
            for example in EXAMPLES:
                for name in "domain.rddl", "instance.rddl":
                    text = (example / name).read_bytes()
                    change = name == "domain.rddl" or generator.random() < 0.2
                    self.write(name, self.mutated(text, generator) if change else text)
                result = self.run_command(*LOOKING[0], "domain.rddl", "instance.rddl")
                if result.status == SUCCESS:
                    accepted += 1
                else:
                    self.assert_refused(result)
                    refused += 1
        self.assertGreater(accepted, 0)
        self.assertGreater(refused, 100)


if __name__ == "__main__":
    unittest.main()
