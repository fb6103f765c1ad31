"""A client of the Language Server Protocol that drives `rddl lsp` over pipes."""

import json
import os
import select
import subprocess
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BIN = Path(os.environ.get("RDDLC_BIN", ROOT / "build/bin")).resolve()
PATIENCE = 60  # seconds; far above what an answer takes


class Failed(Exception):
    """The server answered with an error: code, message."""


class Client:
    """Texts are by name; those of a folder are files, so that the server finds their neighbours."""

    def __init__(self, folder, *arguments, capabilities=None, initialize=True):
        self.folder = Path(folder)
        self.process = subprocess.Popen([BIN / "rddl", "lsp", *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.buffer = b""
        self.number = 0
        self.texts = {}
        self.versions = {}
        self.diagnostics = {}  # by name: (version, list)
        self.others = []
        if initialize:
            self.initialized = self.request("initialize", {"processId": os.getpid(), "rootUri": None, "capabilities": capabilities or {}})
            self.notify("initialized", {})

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        self.process.stdin.close()
        self.process.stdout.close()

    # ------------------------------------------------------------------------------- messages

    def write(self, data):
        self.process.stdin.write(data)
        self.process.stdin.flush()

    def send(self, message):
        body = json.dumps({"jsonrpc": "2.0", **message}, ensure_ascii=False).encode()
        self.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)

    def notify(self, method, params):
        self.send({"method": method, "params": params})

    def read(self, patience=PATIENCE):
        """The next message; None if none comes."""
        end = time.monotonic() + patience
        while True:
            head, separator, rest = self.buffer.partition(b"\r\n\r\n")
            if separator:
                length = int(head.split(b":")[1])
                if len(rest) >= length:
                    self.buffer = rest[length:]
                    return json.loads(rest[:length])
            ready, _, _ = select.select([self.process.stdout], [], [], max(0, end - time.monotonic()))
            data = os.read(self.process.stdout.fileno(), 1 << 16) if ready else b""
            if not data:
                return None
            self.buffer += data

    def take(self, message):
        if message.get("method") == "textDocument/publishDiagnostics":
            params = message["params"]
            self.diagnostics[self.name(params["uri"])] = (params.get("version"), params["diagnostics"])
        else:
            self.others.append(message)

    def request(self, method, params):
        self.number += 1
        self.send({"id": self.number, "method": method, "params": params})
        while True:
            message = self.read()
            if message is None:
                raise TimeoutError(method)
            if message.get("id") == self.number and "method" not in message:
                if "error" in message:
                    raise Failed(message["error"]["code"], message["error"]["message"])
                return message["result"]
            self.take(message)

    # ---------------------------------------------------------------------------------- texts

    def uri(self, name):
        return (self.folder / name).as_uri()

    def name(self, uri):
        prefix = self.folder.as_uri() + "/"
        return uri[len(prefix):] if uri.startswith(prefix) else uri

    def open(self, name, text):
        self.texts[name] = text
        self.versions[name] = 1
        self.notify("textDocument/didOpen", {"textDocument": {
            "uri": self.uri(name), "languageId": "rddl", "version": 1, "text": text}})

    def change(self, name, text):
        """The whole text."""
        self.texts[name] = text
        self.versions[name] += 1
        self.notify("textDocument/didChange", {
            "textDocument": {"uri": self.uri(name), "version": self.versions[name]}, "contentChanges": [{"text": text}]})

    def checked(self, name, patience=PATIENCE):
        """The diagnostics of the present text."""
        end = time.monotonic() + patience
        while self.diagnostics.get(name, (None,))[0] != self.versions[name]:
            message = self.read(end - time.monotonic())
            if message is None:
                raise TimeoutError(f"no diagnostics of {name}")
            self.take(message)
        return self.diagnostics[name][1]

    def at(self, name, words, offset=0):
        """The parameters of a request at the first place of some words."""
        text = self.texts[name]
        return {"textDocument": {"uri": self.uri(name)}, "position": position(text, text.index(words) + offset)}

    def ask(self, method, name, words, offset=0, **more):
        return self.request(f"textDocument/{method}", {**self.at(name, words, offset), **more})

    def actions(self, name, where):
        return self.request("textDocument/codeAction", {
            "textDocument": {"uri": self.uri(name)}, "range": where, "context": {"diagnostics": []}})

    def apply(self, edit):
        for uri, edits in edit["changes"].items():
            name = self.name(uri)
            self.change(name, edited(self.texts[name], edits))


def position(text, index):
    """Of an index of a text, in UTF-16 units."""
    line = text.count("\n", 0, index)
    begin = text.rfind("\n", 0, index) + 1
    return {"line": line, "character": len(text[begin:index].encode("utf-16-le")) // 2}


def index(text, place):
    begin = 0
    for _ in range(place["line"]):
        begin = text.index("\n", begin) + 1
    end = text.find("\n", begin)
    line = text[begin:] if end < 0 else text[begin:end]
    return begin + len(line.encode("utf-16-le")[:2 * place["character"]].decode("utf-16-le"))


def covered(text, where):
    return text[index(text, where["start"]):index(text, where["end"])]


def edited(text, edits):
    for edit in sorted(edits, key=lambda each: index(text, each["range"]["start"]), reverse=True):
        begin, end = index(text, edit["range"]["start"]), index(text, edit["range"]["end"])
        text = text[:begin] + edit["newText"] + text[end:]
    return text
