"""The page of `rddl studio` in headless Chromium: files, several tabs, reloads, an end of the program, hostile pages."""

import http.server
import json
import threading
import time

from studio import CAR, CTRL, HAS_RUN, STEP, PageTest, Program, Window, require_browser

require_browser()


class Sessions(PageTest):
    # ---- files

    def test_saves_by_the_keyboard(self):
        window = self.open()
        window.edit(1, "horizon", "// saved\n    horizon")
        window.press("s", 83, CTRL)
        window.wait("document.querySelector('#edit-message').textContent === 'saved'")
        self.assertIn("// saved", (self.folder / "instance.rddl").read_text())
        window.wait("document.querySelector('#state').textContent === ''")
        (self.folder / "instance.rddl").write_text(CAR[1].read_text())
        window.press("s", 83, CTRL)
        window.wait("document.querySelector('#edit-message').textContent.includes('another program')")
        time.sleep(0.6)  # the explanation of the word at the cursor comes meanwhile
        self.assertIn("another program", window.text("#edit-message"))
        window.edit(1, "// saved\n    ", "")
        window.click("#save")
        window.wait("document.querySelector('#edit-message').textContent === 'saved'")
        self.assertEqual((self.folder / "instance.rddl").read_text(), CAR[1].read_text())

    def test_files_keep_their_ends_of_lines(self):
        (self.folder / "dos.rddl").write_bytes("".join(path.read_text() for path in CAR).replace("\n", "\r\n").encode())
        program = Program("dos.rddl", "--engine=interpreter", folder=self.folder)
        self.addCleanup(program.close)
        window = Window(self.browser, program.address)
        window.wait("document.querySelector('#problems-title').textContent === 'No problems'")
        self.assertEqual(window.text("#state"), "")
        window.edit(0, "horizon", "// mine\n    horizon")
        window.click("#save")
        window.wait("document.querySelector('#edit-message').textContent === 'saved'")
        text = (self.folder / "dos.rddl").read_bytes()
        self.assertIn(b"// mine\r\n    horizon", text)
        self.assertEqual(text.count(b"\n"), text.count(b"\r\n"))
        window.close()

    # ---- tabs, reloads, an end

    def test_tabs_reload_and_an_end_of_the_program(self):
        program = Program("domain.rddl", "instance.rddl", "--engine=interpreter", folder=self.folder)
        self.addCleanup(program.close)
        first = Window(self.browser, program.address)
        second = Window(self.browser, program.address)
        first.edit(0, "reward =", "// of the first tab\n    reward =")
        first.wait("document.querySelector('#state').textContent.includes('edited')")
        self.assertNotIn("of the first", second.evaluate("document.querySelector('textarea').value"))
        first.view("try")
        first.click("#once")
        first.wait(HAS_RUN)
        first.wait(f"{STEP} === 'step 1 of 1'")
        self.assertTrue(second.evaluate("document.querySelector('#hand-episode .transport').hidden"))
        first.reload()
        self.assertIn("of the first tab", first.evaluate("document.querySelector('textarea').value"))
        first.wait(HAS_RUN)
        self.assertEqual(first.evaluate(STEP), "step 1 of 1")
        # The program ends: the page says so, and keeps what is typed then.
        self.assertEqual(program.end()[0], 130)
        first.ping()
        first.wait("!document.querySelector('#gone').hidden")
        self.picture(first, "gone")
        first.edit(0, "// of the first tab", "// after the end")
        first.wait("Object.keys(localStorage).some((key) => localStorage.getItem(key).includes('after the end'))")
        # A new one at the same port: the old page does not know its secret, a new tab has the text.
        again = Program("domain.rddl", "instance.rddl", "--engine=interpreter", folder=self.folder, port=program.port)
        self.addCleanup(again.close)
        first.ping()
        first.wait("document.querySelector('#gone').textContent.includes('earlier run')")
        first.close()
        third = Window(self.browser, again.address)
        third.wait("!document.querySelector('#earlier').hidden")
        third.click("#earlier-take")
        self.assertIn("// after the end", third.evaluate("document.querySelector('textarea').value"))
        third.close()
        second.close()

    def test_reload_waits_for_the_page_before_it(self):
        """On a busy machine the page that is left ends late. Another page with its lock stands for it."""
        first = self.open()
        first.edit(0, "reward =", "// mine\n    reward =")
        first.wait("document.querySelector('#state').textContent.includes('edited')")
        name = first.evaluate("sessionStorage.getItem('rddl-tab')")
        late = self.open()
        late.evaluate(f"void navigator.locks.request('rddl-studio/{name}', () => new Promise((end) => setTimeout(end, 2500)))")
        first.reload()
        self.assertEqual(first.evaluate("sessionStorage.getItem('rddl-tab')"), name)
        self.assertIn("// mine", first.evaluate("document.querySelector('textarea').value"))

    # ---- other pages in the same browser

    def test_hostile_page_cannot_drive_it(self):
        texts = {path.stem: path.read_text() for path in CAR}
        save = json.dumps({"tab": "evil", "domain": "hacked", "instance": texts["instance"], "force": True})
        api = f"{self.origin}/api/save"
        attack = f"""<!doctype html><body>An attack.<iframe id=framed src="{self.origin}/"></iframe>
            <form id=form method=post enctype="text/plain" action="{api}" target=hidden><input name='{save[:-1]},"x":"' value='"}}'></form>
            <iframe name=hidden></iframe><script>
            const body = {json.dumps(save)}, tries = [
              () => fetch("{api}", {{method: "POST", body}}),
              () => fetch("{api}", {{method: "POST", body, mode: "no-cors"}}).then((r) => {{ if (r.type !== "opaque") return r.text(); throw 0; }}),
              () => fetch("{api}", {{method: "POST", body, headers: {{"Content-Type": "application/json", "X-Rddl-Token": "0"}}}}),
              () => fetch("{self.origin}/").then((r) => r.text()),
              () => fetch("http://evil.example:{self.program.port}/").then((r) => r.text()),
              () => fetch("http://evil.example:{self.program.port}/api/open", {{method: "POST", body}}).then((r) => r.text()),
              () => Promise.resolve(document.getElementById("framed").contentWindow.document.body.innerText || Promise.reject()),
              () => new Promise((yes, no) => {{ const s = document.createElement("script"); s.src = "{self.origin}/server.js"; s.onload = yes; s.onerror = no; document.body.append(s); }}),
              () => new Promise((yes, no) => {{ const w = new WebSocket("ws://127.0.0.1:{self.program.port}/"); w.onopen = yes; w.onerror = no; }})];
            document.getElementById("form").submit();
            // Once the frame is there: until then its document is an empty one, which the attacker may read.
            window.onload = () => Promise.allSettled(tries.map(async (each) => each())).then((all) => {{ window.outcome = all.map((each) => each.status); }});
            </script>""".encode()

        class Evil(http.server.BaseHTTPRequestHandler):
            def do_GET(self):  # noqa: N802
                self.send_response(200)
                self.send_header("Content-Type", "text/html")
                self.end_headers()
                self.wfile.write(attack)

            def log_message(self, *_):
                pass

        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Evil)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        self.addCleanup(server.server_close)
        self.addCleanup(server.shutdown)
        window = Window(self.browser, f"http://evil.example:{server.server_port}/")
        outcome = window.wait("window.outcome")
        self.assertEqual(outcome, ["rejected"] * 9)
        self.assertEqual((self.folder / "domain.rddl").read_text(), texts["domain"])
        # The page itself, opened under the attacker's name, gets nothing.
        window.call("Page.navigate", url=f"http://evil.example:{self.program.port}/#{self.program.token}")
        window.wait("document.body?.textContent.includes('Host')")
        window.close()
        self.browser.events.clear()
