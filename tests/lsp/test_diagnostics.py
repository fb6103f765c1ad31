"""What `rddl lsp` finds in texts, and how its quick fixes repair them.

    RDDLC_BIN=build/bin test_diagnostics.py
"""

import json
import unittest
from pathlib import Path

from client import covered
from sessions import DOMAIN, INSTANCE, Test

MISTAKES = Path(__file__).parent / "first_problem"


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

    def test_instance_of_a_domain_that_was_renamed(self):
        client = self.opened(domain=DOMAIN.replace("domain fire", "domain forest"))
        (note,) = client.checked("instance.rddl")
        self.assertIn("no file here declares the domain 'fire'", note["message"])
        (fix,) = [each for each in client.actions("instance.rddl", note["range"]) if each["kind"] == "quickfix"]
        self.assertEqual(fix["title"], "Replace 'fire' by 'forest'")
        client.apply(fix["edit"])
        self.assertEqual(client.texts["instance.rddl"], INSTANCE.replace("domain = fire", "domain = forest"))
        self.assertEqual(client.checked("instance.rddl"), [])

    def test_text_that_is_written_from_the_top_down(self):
        """Mistakes above the cursor are found before the brackets are closed; what is not there yet is not missed."""
        client = self.client()
        begun = DOMAIN[:DOMAIN.index("cpfs")]
        client.open("domain.rddl", begun)
        self.assertEqual([each["code"] for each in client.checked("domain.rddl")], ["E0103"])
        client.change("domain.rddl", begun.replace("burning(place)", "burning(plce)") + "cpfs {\n")
        found = {each["code"]: each for each in client.checked("domain.rddl")}
        self.assertEqual(sorted(found), ["E0103", "E0213"])
        (fix,) = [each for each in client.actions("domain.rddl", found["E0213"]["range"]) if each["kind"] == "quickfix"]
        client.apply(fix["edit"])
        self.assertEqual([each["code"] for each in client.checked("domain.rddl")], ["E0103"])
        # The instance of a domain that is whole.
        client.change("domain.rddl", DOMAIN)
        client.open("instance.rddl", INSTANCE[:INSTANCE.index("horizon")])
        self.assertEqual([each["code"] for each in client.checked("instance.rddl")], ["E0103"])
        client.change("instance.rddl", INSTANCE[:INSTANCE.index("horizon")].replace("burning(north)", "burnt(north)"))
        self.assertEqual(sorted(each["code"] for each in client.checked("instance.rddl")), ["E0103", "E0501"])
        self.assertEqual(client.checked("domain.rddl"), [])

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

    def test_a_policy_without_a_domain(self):
        client = self.client()
        policy = "policy rain {\n cpfs { douse(?p) = burnin(?p); };\n}\n"
        places = "the open files and the folder of this one"
        client.open("policy.rddl", policy)
        (note,) = client.checked("policy.rddl")
        self.assertEqual(covered(policy, note["range"]), "policy rain {")
        self.assertEqual(note["severity"], 3)
        self.assertEqual(note["message"], "this file names no domain, so the syntax alone is checked\n"
                         f"hint: write 'domain = NAME;' in the block: it is looked for in {places}")
        (self.folder / "domain.rddl").write_text(DOMAIN)
        client.change("policy.rddl", policy + "// one domain is here\n")
        (note,) = client.checked("policy.rddl")
        self.assertIn("write 'domain = fire;'", note["message"])
        client.change("policy.rddl", policy.replace("{\n", "{ domain = fire;\n", 1))
        self.assertEqual([each["code"] for each in client.checked("policy.rddl")], ["E0201"])
        client.change("policy.rddl", policy.replace("{\n", "{ domain = water;\n", 1))
        (note,) = client.checked("policy.rddl")
        self.assertIn(f"the domain 'water', so the syntax alone is checked ({places})", note["message"])
        client.change("policy.rddl", policy.replace("burnin(?p);", ";"))
        self.assertEqual([each.get("code") for each in client.checked("policy.rddl")], ["E0101", None])

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


if __name__ == "__main__":
    unittest.main()
