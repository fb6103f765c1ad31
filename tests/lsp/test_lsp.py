"""`rddl lsp` as an editor sees it.

    RDDLC_BIN=build/bin test_lsp.py
"""

import json
import re
import signal
import tempfile
import time
import unittest
from pathlib import Path

from client import BIN, ROOT, Client, Failed, covered, edited, position

HERE = Path(__file__).parent
MISTAKES = HERE / "first_problem"

DOMAIN = """// Fires spread over a grid.
domain fire {
    types { place : object; wind : {@calm, @storm}; };
    pvariables {
        // How fast a fire spreads.
        RATE(place, place) : { non-fluent, real, default = 0.1 };
        burning(place) : { state-fluent, bool, default = false };  // on fire now
        weather : { state-fluent, wind, default = @calm };
        douse(place) : { action-fluent, bool, default = false };
    };
    cpfs {
        burning'(?p) = if (douse(?p)) then false
                       else burning(?p) | exists_{?q : place} [burning(?q) ^ Bernoulli(RATE(?p, ?q))];
        weather' = if (weather == @storm) then @calm else @storm;
    };
    reward = -sum_{?p : place} burning(?p);
}
"""
INSTANCE = """non-fluents grid {
    domain = fire;
    objects { place : {north, south, east}; };
    non-fluents { RATE(north, south) = 0.5; };
}
instance small {
    domain = fire;
    non-fluents = grid;
    init-state { burning(north); };
    horizon = 10;
    discount = 1.0;
}
"""


class Test(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name).resolve()

    def client(self, *arguments, **options):
        client = Client(self.folder, *arguments, **options)
        self.addCleanup(client.__exit__)
        return client

    def opened(self, *arguments, domain=DOMAIN, instance=INSTANCE):
        client = self.client(*arguments)
        client.open("domain.rddl", domain)
        client.open("instance.rddl", instance)
        return client

    def labels(self, client, name, text, words):
        """What is offered behind some words."""
        client.change(name, text)
        result = client.ask("completion", name, words, len(words))
        return [item["label"] for item in result["items"]]


class FirstProblem(Test):
    """A first problem with eleven mistakes, each found, explained and repaired by its quick fix."""

    def test_every_mistake_is_repaired_by_its_fix(self):
        recorded = json.loads((MISTAKES / "session.json").read_text())
        client = self.client()
        names = ["domain.rddl", "instance.rddl"]
        for name in names:
            client.open(name, (MISTAKES / name).read_text())
        session = []
        for _ in range(20):
            step = self.next_step(client, names)
            if step is None:
                break
            session.append(step)
        self.assertEqual(session, recorded)
        self.assertEqual(len(session), 11)
        for name in names:
            self.assertEqual(client.checked(name), [])
            self.assertEqual(client.texts[name], (MISTAKES / f"repaired_{name}").read_text())

    def next_step(self, client, names):
        """Repairs the first mistake; what it was."""
        for name in names:
            for diagnostic in client.checked(name):
                actions = [each for each in client.actions(name, diagnostic["range"]) if each["kind"] == "quickfix"]
                actions = [each for each in actions if each["diagnostics"] == [diagnostic]]
                self.assertEqual(len(actions), 1, diagnostic)
                place = diagnostic["range"]["start"]
                hover = client.request("textDocument/hover", {"textDocument": {"uri": client.uri(name)}, "position": place})
                self.assertIn(f"# {diagnostic['code']}: ", hover["contents"]["value"], "the mistake is explained")
                client.apply(actions[0]["edit"])
                return {"file": name, "line": place["line"] + 1, "code": diagnostic["code"],
                        "message": diagnostic["message"], "fix": actions[0]["title"]}
        return None

    def test_all_at_once(self):
        client = self.client()
        client.open("domain.rddl", (MISTAKES / "domain.rddl").read_text())
        for _ in range(4):
            whole = {"start": {"line": 0, "character": 0}, "end": {"line": 99, "character": 0}}
            actions = client.actions("domain.rddl", whole) if client.checked("domain.rddl") else []
            if not actions:
                break
            client.apply(actions[-1]["edit"])
        self.assertEqual(client.texts["domain.rddl"], (MISTAKES / "repaired_domain.rddl").read_text())


class Diagnostics(Test):
    def test_places_codes_hints_and_related_places(self):
        client = self.opened(domain=DOMAIN.replace("RATE(?p, ?q)", "RATE(?p)").replace("burning(?p);", "burnin(?p);"))
        by_code = {each["code"]: each for each in client.checked("domain.rddl")}
        self.assertEqual(sorted(by_code), ["E0201", "E0203"])
        text = client.texts["domain.rddl"]
        self.assertEqual(covered(text, by_code["E0201"]["range"]), "burnin")
        self.assertIn("\nhint: did you mean 'burning'?", by_code["E0201"]["message"])
        related = by_code["E0203"]["relatedInformation"][0]
        self.assertEqual(covered(text, related["location"]["range"]), "RATE")
        self.assertEqual(by_code["E0203"]["severity"], 1)
        self.assertEqual(client.checked("instance.rddl"), [])

    def test_a_problem_in_one_file(self):
        client = self.client()
        client.open("both.rddl", DOMAIN + INSTANCE)
        self.assertEqual(client.checked("both.rddl"), [])
        client.change("both.rddl", DOMAIN + INSTANCE.replace("burning(north)", "burning(nort)"))
        self.assertEqual([each["code"] for each in client.checked("both.rddl")], ["E0502"])

    def test_the_domain_is_found_on_the_disk_and_an_open_one_comes_first(self):
        (self.folder / "domain.rddl").write_text(DOMAIN)
        client = self.client()
        client.open("instance.rddl", INSTANCE)
        self.assertEqual(client.checked("instance.rddl"), [])
        client.open("domain.rddl", DOMAIN.replace("burning", "alight"))
        while not client.checked("instance.rddl"):
            client.take(client.read())
        self.assertIn("alight", str(client.checked("domain.rddl")) + client.texts["domain.rddl"])
        self.assertEqual([each["code"] for each in client.checked("instance.rddl")], ["E0501"])

    def test_a_mistake_in_a_file_that_is_not_open_is_shown_and_taken_back(self):
        (self.folder / "instance.rddl").write_text(INSTANCE.replace("north)", "nort)"))
        client = self.client()
        client.open("domain.rddl", DOMAIN)
        self.assertEqual(client.checked("domain.rddl"), [])
        while "instance.rddl" not in client.diagnostics:
            client.take(client.read())
        self.assertEqual([each["code"] for each in client.diagnostics["instance.rddl"][1]], ["E0502"])
        (self.folder / "instance.rddl").write_text(INSTANCE)
        client.notify("workspace/didChangeWatchedFiles", {"changes": []})
        while client.diagnostics["instance.rddl"][1]:
            client.take(client.read())

    def test_without_a_domain_the_syntax_is_checked(self):
        client = self.client()
        client.open("instance.rddl", INSTANCE)
        (found,) = client.checked("instance.rddl")
        self.assertIn("no file here declares the domain 'fire'", found["message"])
        self.assertEqual(found["severity"], 3)
        client.change("instance.rddl", INSTANCE.replace("horizon = 10;", "horizon = ;"))
        self.assertEqual([each.get("code") for each in client.checked("instance.rddl")], ["E0101", None])

    def test_closing_takes_diagnostics_away(self):
        client = self.client()
        client.open("domain.rddl", DOMAIN.replace("burning(?p);", "burnin(?p);"))
        self.assertEqual(len(client.checked("domain.rddl")), 1)
        client.notify("textDocument/didClose", {"textDocument": {"uri": client.uri("domain.rddl")}})
        while client.diagnostics["domain.rddl"][1]:
            client.take(client.read())

    def test_the_dialect(self):
        instance = INSTANCE.replace("discount = 1.0", "discount = 1")
        client = self.opened(instance=instance)
        self.assertEqual([each["code"] for each in client.checked("instance.rddl")], ["E0507"])
        client = self.opened("--std", "rddlc", instance=instance)
        self.assertEqual(client.checked("instance.rddl"), [])

    def test_a_policy(self):
        policy = "policy rain { domain = fire; cpfs { douse(?p) = burnin(?p); }; }"
        client = self.opened()
        client.open("policy.rddl", policy)
        self.assertEqual([each["code"] for each in client.checked("policy.rddl")], ["E0201"])
        client.change("policy.rddl", policy.replace("burnin(", "burning("))
        self.assertEqual(client.checked("policy.rddl"), [])


class Names(Test):
    def places(self, client, locations):
        found = []
        for each in locations:
            name = client.name(each["uri"])
            found.append((name, each["range"]["start"]["line"] + 1, covered(client.texts[name], each["range"])))
        return found

    def test_definition_and_references_across_files(self):
        client = self.opened()
        self.assertEqual(self.places(client, client.ask("definition", "instance.rddl", "burning")), [("domain.rddl", 7, "burning")])
        self.assertEqual(self.places(client, client.ask("definition", "domain.rddl", "north", 0) if "north" in DOMAIN else []), [])
        self.assertEqual(self.places(client, client.ask("definition", "instance.rddl", "north, south)")), [("instance.rddl", 3, "north")])
        uses = self.places(client, client.ask("references", "domain.rddl", "burning", context={"includeDeclaration": True}))
        self.assertEqual([use[:2] for use in uses],
                         [("domain.rddl", 7), ("domain.rddl", 12), ("domain.rddl", 13), ("domain.rddl", 13), ("domain.rddl", 16), ("instance.rddl", 9)])
        self.assertEqual({use[2] for use in uses}, {"burning"})
        uses = client.ask("references", "domain.rddl", "place : object", context={"includeDeclaration": False})
        self.assertEqual(len(uses), 7)
        self.assertEqual(len(client.ask("definition", "domain.rddl", "@storm)", 2)), 1)

    def test_variables_have_scopes(self):
        client = self.opened(domain=DOMAIN.replace("reward = -sum_{?p : place} burning(?p);",
                                                   "reward = (sum_{?p : place} burning(?p)) - sum_{?p : place} douse(?p);"))
        marks = client.ask("documentHighlight", "domain.rddl", "?p : place} burning", 1)
        self.assertEqual(len(marks), 2)
        marks = client.ask("documentHighlight", "domain.rddl", "?p) = if")
        self.assertEqual(len(marks), 4)

    def test_rename(self):
        client = self.opened()
        client.checked("domain.rddl")
        for words, offset, name in [("burning", 3, "alight"), ("place", 0, "cell"), ("?q", 1, "?other"), ("@calm", 1, "@still"), ("RATE", 0, "P-SPREAD")]:
            client.apply(client.ask("rename", "domain.rddl", words, offset, newName=name))
        client.apply(client.ask("rename", "instance.rddl", "north", newName="nord"))
        client.apply(client.ask("rename", "instance.rddl", "= fire", 2, newName="wildfire"))
        self.assertEqual(client.checked("domain.rddl"), [])
        self.assertEqual(client.checked("instance.rddl"), [])
        for word in ["burning", "place", "?q", "calm", "RATE", "domain fire"]:
            self.assertNotIn(word, client.texts["domain.rddl"].replace("Fires spread over", ""))
        self.assertIn("alight(nord)", client.texts["instance.rddl"])
        self.assertEqual(covered(client.texts["domain.rddl"], client.ask("prepareRename", "domain.rddl", "alight'")["range"]), "alight")

    def test_names_that_cannot_be(self):
        client = self.opened()
        for words, name, why in [("burning", "weather", "is there already"), ("burning", "two words", "is no name"), ("burning", "if", "reserved"),
                                 ("burning", "", "is no name"), ("?q : place", "?p", "is there already"), ("= if", "x", "only names")]:
            with self.assertRaises(Failed, msg=name) as failed:
                client.ask("rename", "domain.rddl", words, 2 if words == "= if" else 0, newName=name)
            self.assertIn(why, failed.exception.args[1])
            self.assertEqual(failed.exception.args[0], -32803)

    def test_no_reserved_word_becomes_a_name(self):
        grammar = "".join(line for line in (ROOT / "grammar/RDDL.g4").read_text().splitlines(True) if not line.startswith("//"))
        words = sorted(set(re.findall(r"'([A-Za-z][A-Za-z-]*)'", grammar)))
        self.assertGreater(len(words), 70)
        client = self.opened()
        for word in words:
            with self.assertRaises(Failed, msg=word) as failed:
                client.ask("rename", "domain.rddl", "burning", newName=word)
            self.assertIn("reserved", failed.exception.args[1])

    def test_hover(self):
        client = self.opened()
        text = lambda *where: client.ask("hover", *where)["contents"]["value"]
        self.assertIn("RATE(place, place) : { non-fluent, real, default = 0.1 };", text("instance.rddl", "RATE"))
        self.assertIn("How fast a fire spreads.", text("instance.rddl", "RATE"))
        self.assertIn("9 groundings", text("instance.rddl", "RATE"))
        self.assertIn("on fire now", text("domain.rddl", "burning(?q)"))
        self.assertIn("?q : place", text("domain.rddl", "?q)"))
        self.assertIn("?p : place", text("domain.rddl", "?p) = if"))
        self.assertIn("3 objects: `north`, `south`, `east`", text("domain.rddl", "place} burning"))
        self.assertIn("north : place", text("instance.rddl", "north) ="  if "north) =" in INSTANCE else "north, south)"))
        self.assertIn("0 <= p <= 1", text("domain.rddl", "Bernoulli"))
        self.assertIn("sum_{?x : type}", text("domain.rddl", "sum_"))
        self.assertIn("**3.5**", text("domain.rddl", "if ("))
        self.assertIsNone(client.ask("hover", "domain.rddl", "// Fires", 1))

    def test_symbols(self):
        client = self.opened()
        (block,) = client.request("textDocument/documentSymbol", {"textDocument": {"uri": client.uri("domain.rddl")}})
        self.assertEqual(block["name"], "domain fire")
        sections = {each["name"]: [child["name"] for child in each["children"]] for each in block["children"]}
        self.assertEqual(sections, {"types": ["place", "wind"], "pvariables": ["RATE", "burning", "weather", "douse"],
                                    "cpfs": ["burning", "weather"], "reward": []})

    def test_inlay_hints(self):
        client = self.opened()
        whole = {"start": {"line": 0, "character": 0}, "end": {"line": 99, "character": 0}}
        hints = client.request("textDocument/inlayHint", {"textDocument": {"uri": client.uri("domain.rddl")}, "range": whole})
        self.assertEqual([(each["position"]["line"] + 1, each["label"]) for each in hints],
                         [(3, "3 objects"), (6, "9 groundings"), (7, "3 groundings"), (9, "3 groundings")])

    def test_formatting(self):
        client = self.opened()
        options = {"textDocument": {"uri": client.uri("domain.rddl")}, "options": {"tabSize": 4, "insertSpaces": True}}
        client.apply({"changes": {client.uri("domain.rddl"): client.request("textDocument/formatting", options)}})
        self.assertEqual(client.request("textDocument/formatting", options), [])
        client.change("domain.rddl", DOMAIN.replace("reward", "rewards"))
        self.assertEqual(client.request("textDocument/formatting", options), [])


class Completion(Test):
    def test_places(self):
        client = self.opened()
        offered = lambda text, words, name="domain.rddl": self.labels(client, name, text, words)
        self.assertEqual(offered("\n", ""), ["domain", "non-fluents", "instance", "policy"])
        self.assertIn("pvariables", offered(DOMAIN.replace("reward", "pv\n    reward"), "pv\n"[:2]))
        body = DOMAIN.replace("weather' =", "weather' = bu")
        self.assertIn("burning", offered(body, "weather' = bu"))
        self.assertIn("Bernoulli", offered(DOMAIN.replace("weather' =", "weather' = Ber"), "weather' = Ber"))
        self.assertEqual(offered(DOMAIN.replace("burning(?q) ^", "burning(?"), "[burning(?"), ["?p", "?q"])
        self.assertEqual(offered(DOMAIN.replace("== @storm", "== @"), "== @"), ["@calm", "@storm"])
        self.assertEqual(offered(DOMAIN.replace("{?p : place} burning", "{?p : "), "-sum_{?p : "), ["place", "wind"])
        declared = DOMAIN.replace("weather :", "hot(pl) : { st")
        self.assertEqual(offered(declared, "hot(pl"), ["place"])
        self.assertIn("state-fluent", offered(declared, "{ st"))
        self.assertIn("wind", offered(DOMAIN.replace("state-fluent, wind", "state-fluent, "), "weather : { state-fluent, "))
        self.assertEqual(offered(DOMAIN.replace("wind, default = @calm", "wind, default = "), "wind, default = "), ["@calm", "@storm"])
        self.assertIn("burning'", offered(DOMAIN.replace("weather' =", "b\n weather' ="), "};\n    cpfs {"[:0] + "];\n        b"))
        client.change("domain.rddl", DOMAIN)
        values = lambda text, words: offered(text, words, "instance.rddl")
        self.assertEqual(values(INSTANCE.replace("burning(north);", "b"), "init-state { b"), ["burning"])
        self.assertEqual(values(INSTANCE.replace("burning(north);", "burning("), "init-state { burning("), ["north", "south", "east"])
        self.assertEqual(values(INSTANCE.replace("burning(north);", "weather = "), "weather = "), ["@calm", "@storm"])
        self.assertEqual(values(INSTANCE.replace("RATE(north, south) = 0.5;", ""), "non-fluents { "), ["RATE"])
        self.assertEqual(values(INSTANCE.replace("place : {north", "pl"), "objects { pl"), ["place"])
        self.assertEqual(values(INSTANCE.replace("domain = fire;", "domain = ", 1), "domain = "), ["fire"])
        self.assertEqual(values(INSTANCE.replace("= grid", "= "), "non-fluents = "), ["grid"])
        self.assertIn("horizon", values(INSTANCE.replace("horizon = 10;", "ho"), "ho\n"[:2]))

    def test_text_that_is_broken_in_the_middle(self):
        client = self.opened()
        broken = DOMAIN.replace("burning(?p) | exists_", "bur | ((exists_").replace("douse(place) :", "douse(place :")
        self.assertIn("burning", self.labels(client, "domain.rddl", broken, "else bur"))
        cut = DOMAIN[:DOMAIN.index("exists_")] + "do"
        self.assertIn("douse", self.labels(client, "domain.rddl", cut, "burning(?p) | do"))
        item = next(each for each in client.ask("completion", "domain.rddl", "| do", 4)["items"] if each["label"] == "douse")
        self.assertEqual((item["textEdit"]["newText"], item["insertTextFormat"]), ("douse(${1:?p})", 2))

    def test_nothing_in_comments_numbers_and_new_names(self):
        client = self.opened()
        self.assertEqual(self.labels(client, "domain.rddl", DOMAIN, "// Fi"), [])
        self.assertEqual(self.labels(client, "domain.rddl", DOMAIN, "default = 0.1"), [])
        self.assertEqual(self.labels(client, "domain.rddl", DOMAIN, "domain fi"), [])


class Protocol(Test):
    def test_the_end(self):
        client = self.client()
        self.assertIsNone(client.request("shutdown", None))
        with self.assertRaises(Failed) as failed:
            client.request("textDocument/hover", {})
        self.assertEqual(failed.exception.args[0], -32600)
        client.notify("exit", None)
        self.assertEqual(client.process.wait(10), 0)

    def test_an_end_without_shutdown(self):
        client = self.client()
        client.notify("exit", None)
        self.assertEqual(client.process.wait(10), 1)
        client = self.client()
        client.process.stdin.close()
        self.assertEqual(client.process.wait(10), 1)
        client.process.stdin = open("/dev/null", "rb")  # noqa: SIM115 - closed with the client

    def test_signals_end_it(self):
        for number, status in [(signal.SIGINT, 130), (signal.SIGTERM, 143)]:
            client = self.client("--stdio")
            client.process.send_signal(number)
            self.assertEqual(client.process.wait(10), status)

    def test_nothing_works_before_initialize(self):
        client = self.client(initialize=False)
        client.open("domain.rddl", DOMAIN)
        with self.assertRaises(Failed) as failed:
            client.request("textDocument/documentSymbol", {"textDocument": {"uri": client.uri("domain.rddl")}})
        self.assertEqual(failed.exception.args[0], -32002)
        self.assertIn("capabilities", client.request("initialize", {"capabilities": {}}))
        with self.assertRaises(Failed):
            client.request("initialize", {"capabilities": {}})

    def test_garbage(self):
        client = self.client()
        for garbage in [b"\x00\xff\r\n\r\n", b"Content-Length: x\r\n\r\n", b"Content-Length: 3\r\n\r\n{]}", b"Content-Length: -5\r\n\r\n",
                        b"Content-Length: 99999999999999999999\r\n\r\n", b"a" * 100_000 + b"\n\n", b'Content-Length: 2\r\n\r\n[]',
                        b'Content-Length: 4\r\n\r\nnull', b'Content-Length: 20\r\n\r\n{"id":{},"method":1}',
                        b'Content-Length: 27\r\n\r\n{"id":[1],"method":"shutdown"}'[:-3] + b"",
                        b"Content-Length: 200000\r\n\r\n" + b"[" * 200_000]:
            client.write(garbage)
        client.open("domain.rddl", DOMAIN)
        self.assertEqual(client.checked("domain.rddl"), [])
        self.assertGreater(len([each for each in client.others if "error" in each]), 8)

    def test_a_message_that_is_too_long_is_skipped(self):
        client = self.client()
        length = (1 << 28) + 1
        client.write(b"Content-Length: %d\r\n\r\n" % length)
        block = b" " * (1 << 20)
        for _ in range(length // len(block)):
            client.write(block)
        client.write(b" " * (length % len(block)))
        self.assertIn("capabilities", client.initialized)
        self.assertIsNone(client.request("shutdown", None))

    def test_wrong_parameters_and_methods(self):
        client = self.opened()
        for method, params, code in [
                ("textDocument/hover", {}, -32602), ("textDocument/hover", {"textDocument": 3}, -32602),
                ("textDocument/hover", {"textDocument": {"uri": client.uri("domain.rddl")}, "position": {"line": "a", "character": 0}}, -32602),
                ("textDocument/rename", {"textDocument": {"uri": client.uri("domain.rddl")}, "position": {"line": 1, "character": 8}}, -32602),
                ("textDocument/codeLens", {"textDocument": {"uri": client.uri("domain.rddl")}}, -32601), ("nonsense", {}, -32601)]:
            with self.assertRaises(Failed, msg=method) as failed:
                client.request(method, params)
            self.assertEqual(failed.exception.args[0], code, method)
        for method, params in [("textDocument/didOpen", {}), ("textDocument/didChange", {"textDocument": {"uri": "x"}}), ("$/setTrace", 1),
                               ("textDocument/didClose", {"textDocument": {"uri": "file:///nowhere.rddl"}}), ("$/cancelRequest", {"id": 77}),
                               ("textDocument/didChange", {"textDocument": {"uri": "file:///x.rddl", "version": 3}, "contentChanges": [{"text": "a"}]})]:
            client.notify(method, params)
        self.assertIsNone(client.request("textDocument/hover", {"textDocument": {"uri": "file:///nowhere.rddl"}, "position": {"line": 0, "character": 0}}))
        far = {"textDocument": {"uri": client.uri("domain.rddl")}, "position": {"line": 4_000_000_000, "character": 4_000_000_000}}
        self.assertIsNone(client.request("textDocument/hover", far))

    def test_a_cancelled_request(self):
        client = self.opened()
        hover = {"textDocument": {"uri": client.uri("domain.rddl")}, "position": {"line": 1, "character": 8}}
        frame = lambda message: b"Content-Length: %d\r\n\r\n" % len(body := json.dumps(message).encode()) + body
        client.write(b"".join(frame({"jsonrpc": "2.0", **each}) for each in [
            {"id": "a", "method": "textDocument/hover", "params": hover}, {"id": "b", "method": "textDocument/hover", "params": hover},
            {"method": "$/cancelRequest", "params": {"id": "b"}}]))
        answers = {}
        while len(answers) < 2:
            message = client.read()
            if "id" in message:
                answers[message["id"]] = message
        self.assertIn("result", answers["a"])
        self.assertEqual(answers["b"]["error"]["code"], -32800)

    def test_positions_count_utf16_units(self):
        text = "// 🔥 é 火\r\ndomain d { /* 🔥 */ reward = zzz; }\n"
        client = self.client()
        client.open("d.rddl", text)
        places = [covered(text, each["range"]) for each in client.checked("d.rddl")]
        self.assertIn("/*", places)
        line = "    // 🔥🔥\r\n"
        client.open("both.rddl", line + DOMAIN.replace("weather == @storm", "/*🔥*/ weathr == @storm").replace("/*🔥*/ ", "") + INSTANCE)
        (found,) = client.checked("both.rddl")
        self.assertEqual(covered(client.texts["both.rddl"], found["range"]), "weathr")

    def test_changes_of_ranges(self):
        text = "// 🔥\n" + DOMAIN
        client = self.client()
        client.open("domain.rddl", text)
        begin = text.index("🔥")
        change = lambda where, words: {"range": {"start": position(text, where), "end": position(text, where + len(words[0]))}, "text": words[1]}
        client.versions["domain.rddl"] = 2
        at = text.index("burning(?p);")
        client.notify("textDocument/didChange", {"textDocument": {"uri": client.uri("domain.rddl"), "version": 2}, "contentChanges": [
            change(at, ("burning", "burnin")), change(begin, ("🔥", "fire 🔥"))]})
        client.texts["domain.rddl"] = text.replace("burning(?p);", "burnin(?p);").replace("🔥", "fire 🔥", 1)
        (found,) = client.checked("domain.rddl")
        self.assertEqual(covered(client.texts["domain.rddl"], found["range"]), "burnin")

    def test_texts_of_any_bytes_are_survived(self):
        client = self.client()
        for number, text in enumerate(["", "\u0000", "}}}}", "domain", "domain d", "domain d {", "instance { {", "{" * 5000, "?", "@", "'", "non-fluents = ",
                                       "domain d { cpfs { p'(?x) = sum_{?y : ", "domain d { pvariables { p( : {", "\ud7ff\uffff" * 100, "/*" + DOMAIN, "_{" * 3000]):
            name = f"file{number}.rddl"
            client.open(name, text)
            for offset in {0, len(text) // 2, len(text)}:
                for method in ["hover", "completion", "definition", "references", "prepareRename", "documentHighlight"]:
                    client.request(f"textDocument/{method}", {"textDocument": {"uri": client.uri(name)}, "position": position(text, offset)})
            for method in ["documentSymbol", "formatting", "inlayHint"]:
                client.request(f"textDocument/{method}", {"textDocument": {"uri": client.uri(name)}, "options": {},
                                                          "range": {"start": {"line": 0, "character": 0}, "end": {"line": 9, "character": 0}}})
            client.notify("textDocument/didClose", {"textDocument": {"uri": client.uri(name)}})


class Speed(Test):
    def test_a_file_of_5000_lines_answers_soon(self):
        count = 1600
        lines = ["domain big {", "types { o : object; };", "pvariables {", "    act(o) : { action-fluent, bool, default = false };"]
        lines += [f"    p{i}(o) : {{ state-fluent, bool, default = false }};" for i in range(count)]
        lines += ["};", "cpfs {"]
        for i in range(count):
            lines += [f"    p{i}'(?x) = if (act(?x) ^ p{i * 7 % count}(?x)) then Bernoulli(0.5)", f"        else exists_{{?y : o}} p{i}(?y);"]
        lines += ["};", "reward = sum_{?x : o} p0(?x);", "// the end"] + ["// more"] * 200 + ["}"]
        text = "\n".join(lines) + "\n"
        self.assertGreater(len(lines), 5000)
        client = self.client()
        client.open("domain.rddl", text)
        client.checked("domain.rddl")
        times = {}
        for number in range(5):
            text = text.replace("// the end", f"// the end {number}")
            begin = time.perf_counter()
            client.change("domain.rddl", text)
            for method in ["hover", "completion", "definition", "references", "documentHighlight"]:
                client.ask(method, "domain.rddl", "p800'(?x)")
                times.setdefault(method, []).append(time.perf_counter() - begin)
                begin = time.perf_counter()
        # The limit is 50 ms; a busy machine may take longer now and then.
        slow = {method: sorted(found)[len(found) // 2] for method, found in times.items() if sorted(found)[len(found) // 2] > 0.2}
        self.assertEqual(slow, {})
        print({method: f"{1000 * sorted(found)[len(found) // 2]:.1f} ms" for method, found in times.items()})


if __name__ == "__main__":
    unittest.main()
