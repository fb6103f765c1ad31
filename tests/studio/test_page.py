"""The page of `rddl studio` in headless Chromium: what one does on it."""

import json
import subprocess
import time
import unittest

from studio import CAR, CTRL, HAS_RUN, RDDL, STEP, PageTest, Window, require_browser
from test_sessions import Sessions  # noqa: F401: runs here, in the same browser

require_browser()
CARET = "[...document.querySelectorAll('.editor')].find((each) => !each.hidden).querySelector('textarea').selectionStart"


class Page(PageTest):
    # ---- edit

    def test_opens_without_errors_or_network(self):
        window = self.open()
        window.wait("document.querySelector('#problems-title').textContent === 'No problems'")
        self.assertEqual(window.evaluate("document.querySelector('textarea').value"), CAR[0].read_text())
        self.assertTrue(window.evaluate("document.querySelectorAll('.words .keyword').length > 3"))
        for view in "edit", "try", "compare", "train":
            window.view(view)
            self.assert_fits(window)
        self.assertEqual(window.complaints(self.origin), [])
        # Everything that takes input has a name for those who do not see it.
        nameless = window.evaluate("[...document.querySelectorAll('input, select, textarea, button')].filter((each) => "
                                   "!(each.labels?.length || each.getAttribute('aria-label') || each.textContent.trim())).length")
        self.assertEqual(nameless, 0)

    def test_error_is_shown_where_it_is_and_repaired(self):
        window = self.open()
        window.edit(0, "FUEL-COST   :", "FUEL-COSTS  :")
        window.wait("document.querySelectorAll('#problems li.error').length")
        line = 1 + window.evaluate("document.querySelector('textarea').value.split('\\n').findIndex((l) => /FUEL-COST\\b/.test(l))")
        place = window.text("#problems li .place")
        self.assertTrue(place.startswith(f"domain.rddl:{line}:"), place)
        self.assertIn("[E0201]", window.text("#problems li"))
        self.assertIn("^^^^^^^^^", window.text("#problems li pre"))
        self.assertEqual(window.text(".gutter .error"), str(line))
        self.assertEqual(window.text(".marks .error"), "FUEL-COST")
        self.picture(window, "error")
        window.click("#problems li .place")
        caret = window.evaluate(CARET)
        self.assertEqual(window.evaluate("document.querySelector('textarea').value")[caret:caret + 9], "FUEL-COST")
        # Every place has a fix of its own, and the keyboard makes them: F8, Ctrl-.
        window.wait("!document.querySelector('#problems li .fix').hidden")
        for _ in range(10):
            if window.text("#problems-title") == "No problems":
                break
            count = window.evaluate("document.querySelectorAll('#problems li').length")
            window.evaluate("document.querySelector('textarea').focus()")
            window.press("F8", 119)
            window.press(".", 190, CTRL)
            window.wait(f"document.querySelectorAll('#problems li').length < {count}")
        self.assertEqual(window.text("#problems-title"), "No problems")
        self.assertIn("edited", window.text("#state"))

    def test_changes_arrive_in_order(self):
        """Completion and the check ask at nearly the same time. The one that is sent first may be slow on its way."""
        window = self.open()
        window.evaluate("(() => { const quick = window.fetch; let count = 0; window.fetch = async (...words) => {"
                        "if (words[0] === '/api/language' && ++count === 1) await new Promise((go) => setTimeout(go, 700));"
                        "return quick(...words); }; })()")
        window.edit(0, "FUEL-COST", "FUEL-COSTS")
        window.wait("document.querySelectorAll('#problems li.error').length")
        window.edit(0, "FUEL-COSTS", "FUEL-COST")
        window.wait("document.querySelector('#problems-title').textContent === 'No problems'")

    def test_edits_of_a_text_that_has_changed_are_dropped(self):
        """Keys that are typed while the server is asked move the places of its edits."""
        for method, act in (("formatting", lambda window: window.click("#format")),
                            ("codeAction", lambda window: window.press(".", 190, CTRL))):
            window = self.open()
            window.edit(0, "FUEL-COST   :", "FUEL-COSTS     :")
            window.wait("document.querySelectorAll('#problems li.error').length")
            window.click("#problems li .place")
            if method == "formatting":  # takes a text without errors
                window.edit(0, "FUEL-COSTS", "FUEL-COST")
                window.wait("document.querySelector('#problems-title').textContent === 'No problems'")
            window.evaluate("(() => { const quick = window.fetch; const gate = new Promise((go) => { window.open_gate = go; });"
                            f"window.fetch = async (...words) => {{ if (String(words[1]?.body).includes('textDocument/{method}')) {{"
                            "window.is_asked = true; await gate; } return quick(...words); }; })()")
            act(window)
            window.wait("window.is_asked")
            window.edit(0, "domain mountain_car", "// typed\ndomain mountain_car")
            typed = window.evaluate("document.querySelector('textarea').value")
            window.evaluate("window.open_gate()")
            window.wait("document.querySelector('#edit-message').textContent === 'the text has changed: try again'")
            self.assertEqual(window.evaluate("document.querySelector('textarea').value"), typed)

    def test_renamed_domain(self):
        """Both texts are one problem, whatever names they give."""
        window = self.open()
        window.edit(0, "domain mountain_car {", "domain hill {")
        window.wait("document.querySelectorAll('#problems li.warning .fix:not([hidden])').length === 2")
        self.assertIn("[W0205]", window.text("#problems li"))
        window.edit(0, "reward =", "reward = =")
        window.wait("document.querySelectorAll('#problems li.error').length")
        window.view("try")
        window.click("#run")
        self.assertIn("errors", window.text("#try-message"))
        window.edit(0, "reward = =", "reward =")
        self.assertEqual(window.text("#try-message"), "")

    def test_completes_and_explains(self):
        window = self.open()
        window.edit(0, "reward = ", "reward = vel")
        window.wait("!document.querySelector('.completions').hidden")
        self.assertIn("velocity", window.text(".completions"))
        self.picture(window, "completion")
        window.press("Enter", 13)
        window.wait("document.querySelector('.completions').hidden")
        self.assertIn("reward = velocity", window.evaluate("document.querySelector('textarea').value"))
        window.press("ArrowLeft", 37)
        window.wait("document.querySelector('#about').textContent.includes('velocity')")

    # ---- try

    def begin(self, window: Window) -> None:
        window.view("try")
        window.click("#begin")
        window.wait(HAS_RUN)

    def test_run_plays_with_picture_and_charts(self):
        window = self.open()
        window.view("try")
        window.fill("#policy", "random")
        window.fill("#hand-episode select", "25")
        window.click("#run")
        window.wait(f"Number({STEP}.split(' ')[1]) > 3")  # it moves
        window.wait(f"{STEP}.split(' ')[3] === '200'")
        window.evaluate("document.querySelector('#hand-episode [aria-label=\"Last step\"]').click()")
        window.wait(f"{STEP} === 'step 200 of 200'")
        self.assertIn("ended: horizon", window.text("#hand-episode figcaption"))
        window.wait("document.querySelector('#hand-episode img').dataset.step === '200'")
        self.assertTrue(window.evaluate("document.querySelector('#hand-episode img').naturalWidth > 300"))
        self.assertTrue(window.evaluate("[...document.querySelectorAll('#try canvas')].every((c) => "
                                        "c.getContext('2d').getImageData(0, 0, c.width, c.height).data.some((b) => b > 0))"))
        self.assertGreaterEqual(window.evaluate("document.querySelectorAll('#try canvas').length"), 3)
        self.assert_fits(window)
        self.picture(window, "run")

    def replay(self, actions: list[dict]) -> list[dict]:
        lines = "".join(json.dumps({"action": action}) + "\n" for action in actions)
        run = subprocess.run([RDDL, "replay", *CAR, "--seed", "0"], input=lines, capture_output=True, text=True, check=True)
        return [json.loads(line) for line in run.stdout.splitlines()]

    def values(self, window: Window) -> dict:
        return window.evaluate("Object.fromEntries([...document.querySelectorAll('#try tbody tr')].map("
                               "(row) => [row.querySelector('th').textContent, Number(row.querySelector('td').textContent)]))")

    def assert_shows(self, window: Window, state: dict) -> None:
        for name, value in self.values(window).items():
            self.assertAlmostEqual(value, state[name], delta=1e-4 * max(1, abs(state[name])))

    def test_manual_action_gives_the_step_of_the_engine(self):
        window = self.open()
        self.begin(window)
        name = self.program.ask("describe", tab=window.evaluate("sessionStorage.getItem('rddl-tab')"),
                                player="hand")["problem"]["actions"][0]["name"]
        forces = [1.0, -1.0, 0.5]
        for k, force in enumerate(forces):
            window.fill("#actions input", str(force))
            window.click("#take")
            window.wait(f"{STEP}.startsWith('step {k + 1} ')")
        self.assert_shows(window, self.replay([{name: force} for force in forces])[-1]["state"])
        # Back, and another action in place of the second one.
        for _ in range(2):
            window.click("#hand-episode [aria-label=Back]")
        self.assertEqual(window.evaluate(STEP), "step 1 of 3")
        self.assertEqual(float(window.evaluate("document.querySelector('#actions input').value")), -1.0)
        window.fill("#actions input", "0.25")
        window.click("#take")
        window.wait(f"{STEP} === 'step 2 of 2'")
        self.assert_shows(window, self.replay([{name: 1.0}, {name: 0.25}])[-1]["state"])
        self.picture(window, "hand")
        # An illegal action is explained, and taken by those who insist.
        window.fill("#actions input", "7")
        window.evaluate("document.querySelector('#actions input').max = ''")
        window.click("#take")
        window.wait("!document.querySelector('#take-anyway').hidden")
        self.assertIn("illegal", window.text("#try-message"))
        window.click("#take-anyway")
        window.wait(f"{STEP} === 'step 3 of 3'")
        # The policy continues from there.
        window.click("#once")
        window.wait(f"{STEP} === 'step 4 of 4'")
        window.click("#ask")
        window.wait("document.querySelector('#try-message').textContent.includes('would do this')")

    def test_texts_with_errors_do_not_run(self):
        window = self.open()
        window.edit(0, "reward =", "reward = =")
        window.wait("document.querySelectorAll('#problems li.error').length")
        window.view("try")
        window.click("#run")
        self.assertIn("errors", window.text("#try-message"))
        # A message that quotes the words of a user shows them as text.
        window.edit(0, "reward = =", "reward =")
        window.wait("document.querySelector('#problems-title').textContent === 'No problems'")
        window.fill("#policy", "<img src=x onerror='window.hacked=1'>")
        window.click("#run")
        window.wait("document.querySelector('#try-message').textContent.includes('<img')")
        self.assertFalse(window.evaluate("'hacked' in window"))

    def test_policy_blocks_of_files_and_a_fluent_with_a_name_of_javascript(self):
        (self.folder / "push.rddl").write_text("policy push { domain = mountain_car; cpfs { throttle = 0.0; constructor = true; }; }")
        window = self.open()
        window.edit(0, "pvariables {", "pvariables { constructor : { action-fluent, bool, default = false };")
        window.wait("document.querySelector('#problems-title').textContent === 'No problems'")
        self.begin(window)
        actions = "[...document.querySelectorAll('#actions input')]"
        self.assertFalse(window.evaluate(f"{actions}.some((each) => each.checked)"))
        window.fill("#policy", "push.rddl")
        window.click("#ask")  # in an episode that was begun without this block
        window.wait("document.querySelector('#try-message').textContent.startsWith('push.rddl would do this in a new')")
        self.assertTrue(window.evaluate(f"{actions}.some((each) => each.checked)"))
        window.click("#once")
        window.wait(f"{STEP} === 'step 1 of 1'")
        self.assertIn("constructor", window.text("#hand-episode figcaption") + window.evaluate(
            "(document.querySelector('#hand-episode [aria-label=Back]').click(), document.querySelector('#hand-episode figcaption').textContent)"))
        # The texts have no block: that of the file does not play in its place.
        window.fill("#policy", "rddl")
        window.click("#once")
        window.wait("document.querySelector('#try-message').classList.contains('bad')")
        self.assertEqual(window.evaluate(STEP), "step 0 of 0")

    def test_keyboard_alone(self):
        window = self.open()
        window.evaluate("document.querySelector('[data-shows=try]').focus()")
        window.press("Enter", 13, text="\r")
        found = []

        def tab_to(wanted):
            for _ in range(40):
                window.press("Tab", 9)
                found.append(window.evaluate("document.activeElement.id || document.activeElement.ariaLabel || document.activeElement.tagName"))
                if found[-1] == wanted:
                    return
            self.fail(f"{wanted} is not reached: {found}")

        tab_to("once")
        window.press("Enter", 13, text="\r")
        window.wait(HAS_RUN)
        window.wait(f"{STEP} === 'step 1 of 1'")
        self.assertTrue(window.evaluate("getComputedStyle(document.activeElement).outlineStyle === 'solid'"))
        tab_to("Back")
        window.press("Enter", 13, text="\r")
        window.wait(f"{STEP} === 'step 0 of 1'")
        tab_to("Step")
        window.press("ArrowRight", 39)
        window.wait(f"{STEP} === 'step 1 of 1'")
        tab_to("take")
        window.press("Enter", 13, text="\r")
        window.wait(f"{STEP} === 'step 2 of 2'")
        # The tabulator also leaves the text areas.
        window.evaluate("document.querySelector('textarea').focus()")
        window.press("Tab", 9)
        self.assertNotEqual(window.evaluate("document.activeElement.tagName"), "TEXTAREA")

    def test_long_texts_stay_quick(self):
        window = self.open()
        lines = "".join(f"        // line {k}\\n" for k in range(5000))
        window.edit(0, "pvariables {", f"pvariables {{\n{lines.replace(chr(92) * 2 + 'n', chr(10))}")
        window.evaluate("document.querySelector('textarea').scrollTop = 1e6")
        time.sleep(0.2)
        took = window.evaluate("(() => { const area = document.querySelector('textarea');"
                               "const took = Array.from({length: 10}, () => { const begin = performance.now();"
                               "area.dispatchEvent(new Event('input')); return performance.now() - begin; });"
                               "return Math.min(...took); })()")  # others may use the processor meanwhile
        self.assertLess(took, 100)  # milliseconds of a key
        self.assertLess(window.evaluate("document.querySelectorAll('.gutter .numbers div').length"), 200)
        window.wait("document.querySelector('#problems-title').textContent === 'No problems'")

    # ---- compare and train

    def test_compares(self):
        window = self.open()
        window.view("compare")
        window.fill("#episodes", "50")
        window.click("#evaluate")
        window.wait("!!document.querySelector('#verdict')", 60)
        self.assertIn("50 pairs", window.text("#verdict"))
        window.click("#beside")
        window.wait("document.querySelectorAll('#both figcaption').length === 2 && "
                    "[...document.querySelectorAll('#both figcaption')].every((each) => each.textContent.includes('return'))")
        window.wait("document.querySelector('#both output').textContent.endsWith('of 200')")
        window.click("#both [aria-label='Last step']")
        captions = "[...document.querySelectorAll('#both figcaption')].map((each) => each.textContent)"
        window.wait(f"{captions}[0].startsWith('noop · step 200') && {captions}[1].startsWith('random · step 200')")
        self.assert_fits(window)
        self.picture(window, "compare")

    def test_trains_with_a_curve(self):
        window = self.open()
        window.view("train")
        window.fill("#learner", "cgp")
        window.fill("#seconds", "300")
        window.fill("#options", "gens=2000000 episodes=1")
        window.click("#learn")
        window.wait("document.querySelector('#curve .key').textContent.includes('while it learns -') || "
                    "/while it learns \\d/.test(document.querySelector('#curve .key').textContent)", 60)
        self.picture(window, "train")
        window.reload()  # what runs goes on
        window.wait("document.querySelector('#train-message').textContent.includes('learning for')")
        window.click("#train-stop")
        window.wait("document.querySelector('#train-stop').hidden && !document.querySelector('#use-policy').hidden")
        self.assertIn("runs/", window.text("#train-message"))
        window.click("#use-policy")
        self.assertTrue(window.evaluate("document.querySelector('#policy').value").startswith("runs/"))
        window.click("#once")
        window.wait(HAS_RUN)
        window.wait(f"{STEP} === 'step 1 of 1'")
        self.assert_fits(window)


if __name__ == "__main__":
    unittest.main()
