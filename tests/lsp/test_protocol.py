"""`rddl lsp` and messages of any kind, and how soon it answers.

    RDDLC_BIN=build/bin test_protocol.py
"""

import json
import signal
import unittest

from client import Failed, covered, position
from sessions import DOMAIN, INSTANCE, Test


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
            begin = self.seconds_of_main_thread(client)
            client.change("domain.rddl", text)
            for method in ["hover", "completion", "definition", "references", "documentHighlight"]:
                client.ask(method, "domain.rddl", "p800'(?x)")
                end = self.seconds_of_main_thread(client)
                times.setdefault(method, []).append(1000 * (end - begin))
                begin = end
        medians = {method: round(sorted(found)[len(found) // 2], 1) for method, found in times.items()}
        print("ms of processor time, the edit included in the first:", medians)
        self.assertEqual({method: took for method, took in medians.items() if took > 50}, {})

    @staticmethod
    def seconds_of_main_thread(client):
        """Processor time: that a machine is busy does not count. The checks run in another thread."""
        number = client.process.pid
        with open(f"/proc/{number}/task/{number}/schedstat", encoding="ascii") as file:
            return int(file.read().split()[0]) / 1e9


if __name__ == "__main__":
    unittest.main()
