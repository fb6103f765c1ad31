"""The replay page in headless Chromium: what it shows, and that the keyboard is enough."""

import json
import sys
import time
import unittest

from browser import Browser, find_browser
from test_pictures import EXAMPLE, PictureTest

if not find_browser():
    print("SKIPPED: the replay page is tested in Chromium, which is not here (apt-get install chromium)",
          file=sys.stderr)
    sys.exit(77)


class Page(PictureTest):
    @classmethod
    def setUpClass(cls) -> None:
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.close)

    def setUp(self) -> None:
        super().setUp()
        self.trace("car.jsonl", "--policy", EXAMPLE / "policy.rddl", horizon=40)

    def trace(self, name: str, *words, **options) -> list[dict]:
        self.run_car(f"--trace={name}", *words, **options)
        return [json.loads(line) for line in (self.folder / name).read_text().splitlines()[1:]]

    def steps(self) -> list[dict]:
        lines = (self.folder / "car.jsonl").read_text().splitlines()
        return [json.loads(line) for line in lines[1:]]

    def open(self, *words) -> None:
        self.rddl("render", "car.jsonl", "--html=page.html", *words)
        self.browser.call("Emulation.setDeviceMetricsOverride", width=1000, height=900,
                          deviceScaleFactor=1, mobile=False)
        self.browser.open(self.folder / "page.html")

    def text(self, selector: str) -> str:
        return self.browser.evaluate(f"document.querySelector({json.dumps(selector)}).textContent")

    def values(self, run: int = 0) -> dict:
        return self.browser.evaluate(
            "Object.fromEntries([...document.querySelectorAll('#values tr')].map("
            f"(row) => [row.querySelector('th').textContent, Number(row.querySelectorAll('td')[{run}].textContent)]))")

    def assert_shows(self, number: int, steps: list[dict]) -> None:
        state = steps[number]["state"] if number < len(steps) else steps[-1]["next_state"]
        self.assertTrue(self.text("#step").startswith(f"step {number} "), self.text("#step"))
        for name, value in self.values().items():
            self.assertAlmostEqual(value, state[name], delta=1e-4 * max(1, abs(state[name])))
        total = sum(step["reward"] for step in steps[:number])
        self.assertIn(f"step {number} · return {float(f'{total:.5g}'):g}", self.text("figcaption"))

    def test_opens_without_errors_or_network(self):
        self.open()
        self.assertEqual(self.browser.complaints(), [])
        self.assertEqual(self.text("h1"), "mountain_car_1")
        self.assertTrue(self.browser.evaluate(
            "(async () => { const i = document.querySelector('figure img'); await i.decode(); "
            "return i.naturalWidth === 600 && i.naturalHeight === 400; })()"))
        # Each of the charts has ink.
        self.assertTrue(self.browser.evaluate(
            "[...document.querySelectorAll('canvas')].every((c) => "
            "c.getContext('2d').getImageData(0, 0, c.width, c.height).data.some((b) => b > 0))"))
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('canvas').length"), 4)

    def test_keyboard_alone(self):
        steps = self.steps()
        self.open()
        self.assert_shows(0, steps)
        for _ in range(3):
            self.browser.press("ArrowRight")
        self.assert_shows(3, steps)
        self.browser.press("PageDown")
        self.assert_shows(13, steps)
        self.browser.press("ArrowLeft")
        self.assert_shows(12, steps)
        self.browser.press("End")
        self.assert_shows(40, steps)
        self.assertIn("ended: horizon", self.text("figcaption"))
        self.browser.press("Home")
        self.assert_shows(0, steps)
        # The tabulator reaches each control, and the keys of a slider move on.
        found = set()
        for _ in range(12):
            self.browser.press("Tab")
            found.add(self.browser.evaluate("document.activeElement.id || document.activeElement.className"))
        self.assertLessEqual({"first", "back", "play", "on", "last", "scrubber", "speed", "filter", "table"}, found)
        self.browser.evaluate("document.getElementById('scrubber').focus()")
        self.browser.press("ArrowRight")
        self.assert_shows(1, steps)
        self.assertEqual(self.browser.complaints(), [])

    def test_plays_and_stops(self):
        self.open("--fps=20")
        self.browser.press(" ")
        self.assertEqual(self.browser.evaluate("document.getElementById('play').getAttribute('aria-pressed')"), "true")
        deadline = time.monotonic() + 20
        while int(self.text("#step").split()[1]) < 5 and time.monotonic() < deadline:
            time.sleep(0.05)
        self.browser.press(" ")
        stopped = self.text("#step")
        self.assertGreaterEqual(int(stopped.split()[1]), 5)
        time.sleep(0.3)
        self.assertEqual(self.text("#step"), stopped)
        self.assert_shows(int(stopped.split()[1]), self.steps())

    def test_marks_changes(self):
        self.open()
        marked = "[...document.querySelectorAll('td.changed')].length"
        self.assertEqual(self.browser.evaluate(marked), 0)
        self.browser.press("ArrowRight")
        self.assertEqual(self.browser.evaluate(marked), 2)

    def test_table_is_that_of_the_trace_at_every_step(self):
        steps = self.steps()
        self.open()
        for k in range(len(steps) + 1):
            self.assert_shows(k, steps)
            self.browser.press("ArrowRight")

    def test_tells_policy_and_seed(self):
        self.open()
        header = json.loads((self.folder / "car.jsonl").read_text().splitlines()[0])
        self.assertIn(f"car.jsonl (policy {header['policy']}, seed {header['seed']})", self.text(".run-0 .name"))

    def test_filter_and_charts(self):
        self.open()
        self.browser.evaluate("document.getElementById('filter').value = 'velo'; "
                              "document.getElementById('filter').dispatchEvent(new Event('input'))")
        self.assertEqual(list(self.values()), ["velocity"])
        self.browser.evaluate("document.querySelector('#values button').focus()")
        self.browser.press("Enter")
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('canvas').length"), 3)
        # A step is at the same place in all charts, whatever their limits are.
        self.assertEqual(self.browser.evaluate("new Set(charts.map((chart) => chart.left)).size"), 1)

    def test_two_traces_side_by_side(self):
        other = self.trace("other.jsonl", "--seed=5")
        self.open("--beside=other.jsonl")
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('figure').length"), 2)
        for _ in range(35):
            self.browser.press("ArrowRight")
        self.assert_shows(35, self.steps())
        # The other one has ended five steps ago.
        for name, value in self.values(1).items():
            self.assertAlmostEqual(value, other[-1]["next_state"][name], delta=1e-4)
        self.assertEqual(self.browser.complaints(), [])

    def test_narrow_screens_and_colours(self):
        self.open()
        self.browser.call("Emulation.setDeviceMetricsOverride", width=360, height=700, deviceScaleFactor=2,
                          mobile=True)
        for scheme in "light", "dark":
            self.browser.call("Emulation.setEmulatedMedia",
                              features=[{"name": "prefers-color-scheme", "value": scheme}])
            self.assertLessEqual(self.browser.evaluate("document.documentElement.scrollWidth"), 360)
            ground = self.browser.evaluate("getComputedStyle(document.body).backgroundColor")
            light = sum(map(int, ground.removeprefix("rgb(").rstrip(")").split(","))) > 382
            self.assertEqual(light, scheme == "light")
        self.browser.evaluate("document.getElementById('theme').click()")
        self.assertEqual(self.browser.evaluate("document.documentElement.dataset.theme"), "light")

    def test_pictures_keep_their_shape(self):
        self.trace("other.jsonl", "--seed=5")
        self.open("--beside=other.jsonl")
        for width, height in (360, 700), (500, 900), (1000, 300), (1000, 900), (1600, 900):
            self.browser.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1,
                              mobile=False)
            for shape in self.browser.evaluate("[...document.querySelectorAll('figure img')].map("
                                               "(i) => [i.clientWidth, i.clientHeight])"):
                self.assertAlmostEqual(shape[0] / shape[1], 1.5, delta=0.02, msg=f"{width}x{height}")

    def test_names_are_no_markup(self):
        (self.folder / "<b>&.jsonl").write_text((self.folder / "car.jsonl").read_text())
        self.rddl("render", "car.jsonl", "--html=page.html", "--beside=<b>&.jsonl")
        self.browser.open(self.folder / "page.html")
        self.assertIn("<b>&.jsonl", self.text(".run-1 .name"))
        # The header of a trace is also escaped; any program may have written it.
        header, *steps = (self.folder / "car.jsonl").read_text().splitlines()
        policy = "</script><script>window.hacked = 1</script>\"'&<img src=x onerror='hacked=1'>"
        changed = json.dumps({**json.loads(header), "policy": policy})
        (self.folder / "car.jsonl").write_text("\n".join([changed, *steps]) + "\n")
        self.open()
        self.assertIn(policy, self.text(".run-0 .name"))
        self.assertFalse(self.browser.evaluate("'hacked' in window"))
        self.assertEqual(self.browser.complaints(), [])


class Refusals(PictureTest):
    def test_two_traces_are_for_pages(self):
        self.run_car("--trace=t.jsonl")
        refused = self.rddl("render", "t.jsonl", "--beside=t.jsonl", "--gif=a.gif", status=2)
        self.assertIn("--beside is for --html alone", refused.stderr)
        refused = self.rddl("render", "t.jsonl", "--beside=missing.jsonl", "--html=a.html", status=1)
        self.assertIn("cannot read 'missing.jsonl'", refused.stderr)
        self.assertEqual(self.left_behind(), ["t.jsonl"])


if __name__ == "__main__":
    unittest.main()
