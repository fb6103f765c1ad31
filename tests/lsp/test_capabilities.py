"""What `rddl lsp` says of names, and what it completes.

    RDDLC_BIN=build/bin test_capabilities.py
"""

import re
import unittest

from client import ROOT, Failed, covered
from sessions import DOMAIN, INSTANCE, Test


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

    def test_first_instance_of_a_domain(self):
        """Before its first 'domain =' is whole, a file belongs to no domain."""
        client = self.opened()
        self.assertEqual(self.labels(client, "instance.rddl", "non-fluents n { domain = ", "domain = "), ["fire"])
        sections = self.labels(client, "instance.rddl", "non-fluents n { domain = fire; ", "fire; ")
        self.assertEqual(sections, ["domain", "objects", "non-fluents"])
        own = next(each for each in client.ask("completion", "instance.rddl", "fire; ", 6)["items"] if each["label"] == "non-fluents")
        self.assertTrue(own["textEdit"]["newText"].startswith("non-fluents {"))
        sections = self.labels(client, "instance.rddl", "instance i { domain = fire; ", "fire; ")
        self.assertEqual(sections[:3], ["domain", "non-fluents", "init-state"])

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


if __name__ == "__main__":
    unittest.main()
