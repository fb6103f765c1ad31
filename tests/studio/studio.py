"""`rddl studio` as a test drives it: the program, requests without a browser, and tabs of a headless Chromium."""

import atexit
import base64
import functools
import http.client
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/render"))
from browser import Browser, find_browser  # noqa: E402, F401

RDDL = Path(os.environ.get("RDDLC_BIN", ROOT / "build/bin")) / "rddl"


class Program:
    """The program at a port that is free."""

    def __init__(self, *words, folder=None, port=0) -> None:
        self.process = subprocess.Popen(
            [RDDL, "studio", *map(str, words), "--no-browser", f"--port={port}"], cwd=folder,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.address = self.process.stdout.readline().strip()
        found = re.fullmatch(r"http://127\.0\.0\.1:(\d+)/#([0-9a-f]{64})", self.address)
        if not found:
            raise RuntimeError(self.address + self.process.communicate()[1])
        self.port, self.token = int(found[1]), found[2]

    def end(self) -> tuple[int, float]:
        """Ctrl-C: the status, and how many seconds it took."""
        begin = time.monotonic()
        self.process.send_signal(signal.SIGINT)
        status = self.process.wait(timeout=60)
        return status, time.monotonic() - begin

    def close(self) -> None:
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()

    def send(self, method: str, path: str, body=None, **headers) -> tuple[int, dict, bytes]:
        """As any program would; a header of None is left out."""
        usual = {"Host": f"127.0.0.1:{self.port}", "Content-Type": "application/json", "X-Rddl-Token": self.token}
        usual |= {name.replace("_", "-"): value for name, value in headers.items()}
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        connection.putrequest(method, path, skip_host=True, skip_accept_encoding=True)
        data = b"" if body is None else body if isinstance(body, bytes) else json.dumps(body).encode()
        for name, value in usual.items():
            if value is not None:
                connection.putheader(name, value)
        connection.putheader("Content-Length", str(len(data)))
        connection.endheaders(data)
        answer = connection.getresponse()
        result = answer.status, dict(answer.getheaders()), answer.read()
        connection.close()
        return result

    def ask(self, request: str, tab="t", status=200, **members):
        found, headers, body = self.send("POST", f"/api/{request}", {"tab": tab, **members})
        assert found == status, (request, found, body)
        return json.loads(body) if headers["Content-Type"] == "application/json" else body


class Window:
    """A tab of the browser."""

    def __init__(self, browser: Browser, address: str, width=1280, height=900) -> None:
        self.browser = browser
        browser.session = None
        self.target = browser.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = browser.call("Target.attachToTarget", targetId=self.target, flatten=True)["sessionId"]
        for domain in "Page", "Runtime", "Log", "Network":
            self.call(f"{domain}.enable")
        self.resize(width, height)
        self.go(address)

    def call(self, method: str, **parameters) -> dict:
        self.browser.session = self.session
        return self.browser.call(method, **parameters)

    def close(self) -> None:
        self.browser.session = None
        self.browser.call("Target.closeTarget", targetId=self.target)

    def resize(self, width: int, height: int) -> None:
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def go(self, address: str) -> None:
        self.call("Page.navigate", url=address)
        self.wait("document.body?.dataset.ready === 'yes' || "
                  "document.readyState === 'complete' && location.href !== 'about:blank' && !document.getElementById('gone')")

    def reload(self) -> None:
        self.evaluate("document.body.dataset.ready = 'no'")
        self.call("Page.reload")
        self.wait("document.body?.dataset.ready === 'yes'")

    def ping(self) -> None:
        """What the page does every three seconds: asks whether the program is there."""
        self.evaluate("import('/server.js').then(({ ask }) => ask('ping')).catch(() => 0).then(() => 0)")

    def evaluate(self, expression: str):
        self.browser.session = self.session
        return self.browser.evaluate(expression)

    def wait(self, expression: str, seconds=30.0):
        """Until the expression holds; its value."""
        end = time.monotonic() + seconds
        while True:
            try:
                value = self.evaluate(expression)
            except RuntimeError:  # between two pages
                value = None
            if value:
                return value
            if time.monotonic() > end:
                raise AssertionError(f"never: {expression}; {self.complaints()}; {self.shown()}")
            time.sleep(0.05)

    def shown(self) -> str:
        return self.evaluate("document.body.innerText")[:3000]

    def text(self, selector: str) -> str:
        return self.evaluate(f"document.querySelector({json.dumps(selector)})?.textContent ?? ''")

    def click(self, selector: str) -> None:
        self.evaluate(f"document.querySelector({json.dumps(selector)}).click()")

    def view(self, name: str) -> None:
        self.click(f"[data-shows={name}]")

    def fill(self, selector: str, value: str) -> None:
        self.evaluate(f"(() => {{ const input = document.querySelector({json.dumps(selector)}); input.value = {json.dumps(value)};"
                      "for (const event of ['input', 'change']) input.dispatchEvent(new Event(event, {bubbles: true})); })()")

    def edit(self, document: int, before: str, after: str) -> None:
        """Changes a text as if it was typed."""
        self.evaluate(f"document.querySelectorAll('#texts button')[{document}].click()")
        self.evaluate(
            "(() => { const area = [...document.querySelectorAll('.editor')].find((each) => !each.hidden).querySelector('textarea');"
            f"const at = area.value.indexOf({json.dumps(before)}); if (at < 0) throw new Error('not there');"
            f"area.focus(); area.setSelectionRange(at, at + {len(before)});"
            f"document.execCommand('insertText', false, {json.dumps(after)}); }})()")

    def press(self, key: str, code: int, modifiers=0, text=None) -> None:
        values = {"key": key, "windowsVirtualKeyCode": code, "modifiers": modifiers}
        self.call("Input.dispatchKeyEvent", type="keyDown", **values, **({"text": text} if text else {}))
        self.call("Input.dispatchKeyEvent", type="keyUp", **values)

    def complaints(self, origin: str | None = None) -> list:
        """Exceptions, errors of the log, and what was asked of others than the origin."""
        self.evaluate("0")
        found = []
        for event in self.browser.events:
            if event.get("sessionId") != self.session:  # windows that were closed may still complain
                continue
            method, parameters = event.get("method"), event.get("params", {})
            if method == "Runtime.exceptionThrown":
                found.append(parameters["exceptionDetails"])
            refuses = "status of 422" in parameters.get("entry", {}).get("text", "")  # in words, on the page
            if method == "Log.entryAdded" and parameters["entry"]["level"] == "error" and not refuses:
                found.append(parameters["entry"])
            if method == "Runtime.consoleAPICalled" and parameters["type"] == "error":
                found.append(parameters["args"])
            if origin and method == "Network.requestWillBeSent":
                url = parameters["request"]["url"]
                if not url.startswith((origin, "blob:" + origin, "data:", "about:")):
                    found.append(url)
        return found

    def screenshot(self, file) -> None:
        self.call("Page.bringToFront")  # others are not drawn
        data = self.call("Page.captureScreenshot", format="png")["data"]
        Path(file).write_bytes(base64.b64decode(data))


CAR = [ROOT / "examples/mountain_car" / name for name in ("domain.rddl", "instance.rddl")]
SIZES = [(360, 740), (480, 800), (768, 1024), (1280, 900), (1920, 1080)]
PICTURES = os.environ.get("RDDLC_SCREENSHOTS")
CTRL = 2  # as the protocol has it
HAS_RUN = "document.querySelector('#hand-episode .transport') && !document.querySelector('#hand-episode .transport').hidden"
STEP = "document.querySelector('#hand-episode output').textContent"


def require_browser() -> None:
    if not find_browser():
        print("SKIPPED: the page of the studio is tested in Chromium, which is not here (apt-get install chromium)",
              file=sys.stderr)
        sys.exit(77)


@functools.cache
def shared_browser() -> Browser:
    """One start for all tests of a process. A name of an attacker leads to this machine."""
    always_in_front = ("--disable-background-timer-throttling", "--disable-backgrounding-occluded-windows",
                       "--disable-renderer-backgrounding")  # windows of a test stand behind each other
    browser = Browser("--host-resolver-rules=MAP evil.example 127.0.0.1", *always_in_front)
    atexit.register(browser.close)
    return browser


def folder_with_car(add_cleanup) -> Path:
    """Returns a new folder with copies of CAR, which `add_cleanup` of a test removes."""
    folder = tempfile.TemporaryDirectory()
    add_cleanup(folder.cleanup)
    for path in CAR:
        (Path(folder.name) / path.name).write_text(path.read_text())
    return Path(folder.name)


class PageTest(unittest.TestCase):
    """One program for each class, with windows for each test. With RDDLC_SCREENSHOTS=FOLDER tests leave pictures of
    each view at five sizes there."""

    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = folder_with_car(cls.addClassCleanup)
        cls.program = Program("domain.rddl", "instance.rddl", "--engine=interpreter", folder=cls.folder)
        cls.addClassCleanup(cls.program.close)
        cls.browser = shared_browser()
        cls.origin = f"http://127.0.0.1:{cls.program.port}"

    def setUp(self) -> None:
        self.browser.events.clear()

    def open(self, width=1280, height=900) -> Window:
        window = Window(self.browser, self.program.address, width, height)
        self.addCleanup(window.close)
        self.addCleanup(lambda: self.assertEqual(window.complaints(), []))
        return window

    def picture(self, window: Window, name: str) -> None:
        if PICTURES:
            for width, height in SIZES:
                window.resize(width, height)
                time.sleep(0.4)
                window.screenshot(Path(PICTURES) / f"{name}-{width}.png")
            window.resize(1280, 900)

    def assert_fits(self, window: Window) -> None:
        """No size makes the page scroll sideways."""
        for width, height in SIZES:
            window.resize(width, height)
            wide = window.evaluate("document.documentElement.scrollWidth")
            self.assertLessEqual(wide, width)
        window.resize(1280, 900)
