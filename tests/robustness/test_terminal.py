"""Texts of others do not drive the terminal: whatever files and paths hold, no control character, no mark that turns the
direction of a line and no byte that is not UTF-8 comes out of a command."""

import json
import os
import re
import subprocess
import unicodedata
import unittest

from commands import RDDL, RDDLC, SECONDS, CommandTest

# Escape codes that set a color, in seven bits and in eight; a mark that turns lines round; DEL; a zero-width space.
CODES = "\x1b[31m\u009b31m\u202e\x7f\u200b"
BYTES = b"\x1b[31m\x9b31m\xff\xc2\x9b31m\xe2\x80\xae\x7f"  # and as no UTF-8

DOMAIN = """domain d%s {
    types { cell : object; };
    pvariables {
        depth(cell) : { state-fluent, real, default = 0.0 };
        pour(cell) : { action-fluent, real, default = 0.0 };
    };
    cpfs { depth'(?c) = max[0.0, depth(?c) + pour(?c)]; };
    reward = sum_{?c : cell} [depth(?c)];
    action-preconditions { forall_{?c : cell} [pour(?c) >= 0.0]; forall_{?c : cell} [pour(?c) <= 1.0]; };
}
"""
INSTANCE = """non-fluents n { domain = d; objects { cell : { left%s, right }; }; }
instance i {
    domain = d;
    non-fluents = n;
    horizon = 3;
    discount = 1.0;
}
"""
STEP = {"episode": 0, "step": 0, "action": {"pour___left": 0.5}, "reward": 1.0,
        "next_state": {"depth___left": 0.5}, "terminated": True, "truncated": False, "causes": ["horizon"]}


def drives_terminal(output: bytes) -> str:
    """The first character that should not be there."""
    try:
        text = output.decode()
    except UnicodeDecodeError as error:
        return f"{output[error.start:error.end]!r} is no UTF-8"
    for c in text:
        if c not in "\n\t" and unicodedata.category(c) in ("Cc", "Cf", "Zl", "Zp", "Cs"):
            return f"U+{ord(c):04X}"
    return ""


class Terminal(CommandTest):
    def setUp(self):
        super().setUp()
        self.write("d.rddl", DOMAIN % "")
        self.write("i.rddl", INSTANCE % "")

    def speaks(self, *words, program=RDDL, input=b"", environment=None) -> bytes:
        """Both streams of a command, which says something and nothing that drives a terminal."""
        words = [os.fsencode(word) for word in words]
        result = subprocess.run([os.fsencode(program), *words], cwd=self.folder, input=input, capture_output=True,
                                timeout=SECONDS, env={**os.environ, "RDDL_CACHE": str(self.folder / "cache"), **(environment or {})})
        output = result.stdout + result.stderr
        self.assertIn(result.returncode, (0, 1, 2), (words, output))
        self.assertTrue(output, words)
        self.assertEqual(drives_terminal(output), "", (words, output))
        return output

    def on_problem(self, command, *options, **more) -> bytes:
        return self.speaks(command, "d.rddl", "i.rddl", *options, "--engine=interpreter", **more)

    def test_the_test(self):
        for words in ("check", "d.rddl", "i.rddl"), ("run", "d.rddl", "i.rddl", "--engine=interpreter"):
            subprocess.run([RDDL, *words], cwd=self.folder, check=True, capture_output=True)
        for bad in b"\x1b", b"\x9b", b"\xc2\x9b", b"\xe2\x80\xae", b"\x7f", b"\r":
            self.assertNotEqual(drives_terminal(b"a" + bad + b"b"), "")
        self.assertEqual(drives_terminal("a\tä水\ufffd\n".encode()), "")

    def test_paths_that_are_not_there(self):
        path = b"no/" + BYTES + b".rddl"
        for command in ("check", "info", "run", "verify", "bench", "fmt", "replay", "train"):
            more = [b"ppo"] if command == "train" else []
            self.speaks(command, *more, path)
        self.speaks(path, program=RDDLC)
        self.speaks(BYTES)
        self.speaks("run", "d.rddl", "i.rddl", b"--" + BYTES)
        for option in ("--policy", "--trace", "--gif", "--scene", "--seed", "--policy-block", "--visualizer"):
            self.on_problem("run", os.fsencode(option) + b"=no/" + BYTES + b".json")
        self.speaks("plot", path)
        self.speaks("render", path, "--gif", "a.gif")
        self.speaks("--explain", BYTES)

    def test_paths_that_are_there(self):
        folder = os.path.join(os.fsencode(self.folder), BYTES)
        os.mkdir(folder)
        for name in (b"domain.rddl", b"instance1.rddl"):
            with open(os.path.join(folder, name), "wb") as file:
                file.write((DOMAIN % "" if name == b"domain.rddl" else INSTANCE % "").encode())
        for command in ("check", "info", "run", "fmt"):
            files = [BYTES + b"/domain.rddl", BYTES + b"/instance1.rddl"]
            options = {"run": ["--engine=interpreter", "--trace=-"], "fmt": ["--diff"], "info": ["--json"]}
            self.speaks(command, *files, *options.get(command, []))
            if command != "fmt":
                self.speaks(command, BYTES, "1")
        broken = os.path.join(folder, b"broken.rddl")
        with open(broken, "wb") as file:
            file.write(b"domain d { types { ;")
        self.speaks("check", BYTES + b"/broken.rddl")
        self.speaks("fmt", "--check", BYTES + b"/domain.rddl", BYTES + b"/broken.rddl")
        diagnostics = json.loads(self.speaks("--diagnostics-format=json", BYTES + b"/broken.rddl", program=RDDLC))
        self.assertIn("31m", diagnostics[0]["file"])

    def test_texts_of_rddl(self):
        for codes in CODES.encode(), BYTES:
            self.write("d.rddl", (DOMAIN % "%").encode().replace(b"%", codes))
            self.speaks("check", "d.rddl", "i.rddl")
            self.speaks("d.rddl", "i.rddl", program=RDDLC)
            self.write("d.rddl", (DOMAIN % "").encode().replace(b"max[", b"unheard-of[" + codes))
            self.speaks("check", "d.rddl", "i.rddl")
            self.write("d.rddl", (DOMAIN % "").encode().replace(b"reward =", b"reward = 1 + // " + codes + b"\n"))
            self.speaks("run", "d.rddl", "i.rddl", "--engine=interpreter")
            self.write("d.rddl", DOMAIN % "")
            for name in b"left", b"i {", b"horizon":
                self.write("j.rddl", (INSTANCE % "").encode().replace(name, name + codes))
                for command in "check", "info", "run", "verify":
                    self.speaks(command, "d.rddl", "j.rddl")

    def test_policies(self):
        subprocess.run([RDDL, "train", "ppo", "d.rddl", "i.rddl", "--engine=interpreter", "--steps=64", "--envs=4",
                        "--rollout=4", "--minibatch=16", "--out=ppo", "--quiet"], cwd=self.folder, check=True)
        subprocess.run([RDDL, "train", "cgp", "d.rddl", "i.rddl", "--engine=interpreter", "--gens=2", "--out=cgp",
                        "--quiet"], cwd=self.folder, check=True)
        whole = json.loads((self.folder / "ppo/policy.json").read_text())
        for member in ("format", "solver", "version", "domain", "instance", "noise", "activation", "hidden", CODES):
            self.write("p.json", json.dumps({**whole, member: CODES}))
            self.on_problem("evaluate", "p.json")
            self.on_problem("run", "--policy=p.json")
            self.speaks("export", "p.json", "d.rddl", "i.rddl", "--as=cpp", "--engine=interpreter")
        self.write("p.json", json.dumps(whole)[:-1] + ', "' + CODES.replace("\x1b", "\\u001b") + '": 1, "domain": 2}')
        self.on_problem("run", "--policy=p.json")
        lines = (self.folder / "cgp/policy.cgp").read_bytes().split(b"\n")
        for number in range(len(lines)):
            for codes in CODES.encode(), BYTES:
                for place in b" ", b"":
                    changed = [*lines]
                    changed[number] += place + codes
                    self.write("p.cgp", b"\n".join(changed))
                    self.on_problem("run", "--policy=p.cgp")
        self.write("ppo/run.json", json.dumps({"solver": CODES, "domain": CODES, "instance": CODES, "seed": 1}))
        self.speaks("plot", "ppo", "--svg=a.svg")
        self.write("ppo/run.json", "{" + CODES)
        self.speaks("plot", "ppo", "--svg=a.svg")
        rows = (self.folder / "ppo/progress.csv").read_bytes()
        for codes in CODES.encode(), BYTES:
            self.write("ppo/progress.csv", codes + rows)
            self.speaks("plot", "ppo", "--y=none", "--svg=a.svg")
            self.write("ppo/progress.csv", rows.replace(b"\n", b"\n" + codes))
            self.speaks("plot", "ppo", "--svg=a.svg")
        for damaged in BYTES, b"rddl checkpoint 1\n" + BYTES:
            self.write("ppo/checkpoint", damaged)
            self.speaks("train", "ppo", "d.rddl", "i.rddl", "--engine=interpreter", "--steps=64", "--out=ppo", "--resume")

    def test_traces(self):
        header = {"rddl_trace": 1, "domain": "d", "instance": "i", "horizon": 3, "policy": CODES, "problem": CODES,
                  "files": [{"path": CODES, "sha256": CODES}], "engine": CODES, "seed": 3}
        for member, value in (("policy", CODES), ("domain", CODES), ("instance", CODES), ("rddl_trace", CODES), ("horizon", CODES)):
            self.trace({**header, member: value}, STEP)
        for changed in ({"causes": [CODES]}, {CODES: 1}, {"action": {CODES: 1}}, {"action": {"pour___left": CODES}},
                        {"next_state": {CODES: 1}}, {"next_state": {"depth___left": CODES}}, {"reward": CODES},
                        {"fault": CODES}, {"episode": CODES}, {"state": {CODES: 2}}):
            self.trace(header, {**STEP, **changed})
        for codes in CODES.encode(), BYTES:
            self.write("t.jsonl", b'{"action": {"' + codes + b'": 1}}\n')
            self.all_readers()

    def trace(self, header, step):
        self.write("t.jsonl", json.dumps(header) + "\n" + json.dumps(step) + "\n")
        self.all_readers()
        self.write("u.jsonl", json.dumps(step, ensure_ascii=False) + "\n")
        self.on_problem("replay", "--input=u.jsonl")

    def all_readers(self):
        self.on_problem("run", "--policy=t.jsonl")
        for line in self.on_problem("run", "--policy=t.jsonl", "--json").splitlines()[:1]:
            self.assertTrue(line)
        self.on_problem("replay", "--input=t.jsonl")
        self.speaks("render", "t.jsonl", "--html=a.html")
        self.speaks("render", "t.jsonl", "d.rddl", "i.rddl", "--svg=a.svg")
        self.speaks("render", "t.jsonl", "d.rddl", "i.rddl", "--watch")

    def test_scenes(self):
        circle = {"shape": "circle", "x": 0, "y": 0, "radius": 1}
        for shape in ({**circle, "shape": CODES}, {**circle, CODES: 1}, {**circle, "x": CODES}, {**circle, "color": CODES},
                      {**circle, "for": {"?c": CODES}}, {**circle, "for": {CODES: "cell"}}, {**circle, "x": "depth(" + CODES},
                      {**circle, "shape": "text", "text": "{" + CODES + "}"}, {**circle, "align": CODES}):
            for ascii in True, False:
                self.write("s.json", json.dumps({"shapes": [shape]}, ensure_ascii=ascii))
                self.on_problem("run", "--scene=s.json", "--svg=a.svg")
        for codes in CODES.encode(), BYTES:
            self.write("s.json", b'{"shapes": [], ' + codes)
            self.on_problem("run", "--scene=s.json", "--svg=a.svg")
        twice = '{"shapes": [], "C": 1, "C": 2}'.replace("C", "\\u001b[31m\\u009b")
        self.write("s.json", twice)
        self.on_problem("run", "--scene=s.json", "--svg=a.svg")

    def test_repositories(self):
        folder = self.folder / "repository/P"
        folder.mkdir(parents=True)
        (folder / "domain.rddl").write_text(DOMAIN % "")
        (folder / "instance1.rddl").write_text(INSTANCE % "")
        (folder / "__init__.py").write_bytes(
            b"info = {'name': 'P" + BYTES + b"', 'description': 'it " + BYTES + b" is', 'context': '" + BYTES + b"'}\n")
        environment = {"RDDL_REPOSITORY": str(self.folder / "repository")}
        for words in (["list"], ["list", "--verbose"], ["list", "--json"], ["list", BYTES], ["info", b"P" + BYTES, "1"],
                      ["info", b"Q" + BYTES, "1"], ["run", b"P" + BYTES, BYTES]):
            output = self.speaks(*words, environment=environment)
            if "--json" in words:
                json.loads(output)

    def test_json_says_the_same(self):
        """Escapes in JSON are the characters themselves."""
        path = self.folder / ("d" + CODES + ".rddl")
        path.write_text(DOMAIN % "")
        found = json.loads(self.speaks("info", path.name, "i.rddl", "--json"))
        self.assertIn(path.name, found["files"][0])


if __name__ == "__main__":
    unittest.main()
