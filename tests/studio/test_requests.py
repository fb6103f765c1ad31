"""The server of `rddl studio` without a browser: whom it answers, limits, files, Ctrl-C."""

import json
import os
import socket
import subprocess
import tempfile
import threading
import time
import unittest
from pathlib import Path

from studio import CAR, RDDL, Program, folder_with_car


class Requests(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.program = Program(*CAR, folder=cls.folder.name)
        cls.addClassCleanup(cls.program.close)

    def post(self, **headers) -> int:
        return self.program.send("POST", "/api/open", {"tab": "t"}, **headers)[0]

    def test_token_host_origin_and_type(self):
        own = f"http://127.0.0.1:{self.program.port}"
        self.assertEqual(self.post(), 200)
        self.assertEqual(self.post(Origin=own), 200)
        for headers in ({"X_Rddl_Token": None}, {"X_Rddl_Token": ""}, {"X_Rddl_Token": "0" * 64},
                        {"Origin": "http://evil.example"}, {"Origin": "null"}, {"Host": None},
                        {"Host": f"evil.example:{self.program.port}"}, {"Host": "127.0.0.1"},
                        {"Origin": f"http://127.0.0.1:{self.program.port + 1}"}):
            self.assertIn(self.post(**headers), (400, 403), headers)
        for kind in None, "text/plain", "application/x-www-form-urlencoded":
            self.assertEqual(self.post(Content_Type=kind), 415, kind)

    def test_preflights_of_other_pages_are_refused(self):
        status, headers, _ = self.program.send("OPTIONS", "/api/open", Origin="http://evil.example",
                                               X_Rddl_Token=None, Access_Control_Request_Method="POST")
        self.assertEqual(status, 403)
        self.assertFalse([name for name in headers if name.lower().startswith("access-control")])

    def test_only_the_page_is_served(self):
        for path in "/", "/studio.css", "/main.js", "/editor.js":
            status, headers, body = self.program.send("GET", path, X_Rddl_Token=None, Content_Type=None)
            self.assertEqual(status, 200, path)
            self.assertNotIn(self.program.token.encode(), body)
            self.assertIn("default-src 'none'", headers["Content-Security-Policy"])
            self.assertEqual(headers["Cache-Control"], "no-store")
            self.assertEqual(headers["X-Frame-Options"], "DENY")
            self.assertEqual(headers["X-Content-Type-Options"], "nosniff")
        for path in "/nothing", "/../etc/passwd", "/%2e%2e/etc/passwd", "/api/open", "/domain.rddl":
            self.assertGreaterEqual(self.program.send("GET", path)[0], 400, path)
        self.assertEqual(self.program.send("GET", "/", Host="evil.example")[0], 403)

    def test_only_this_machine_is_listened_to(self):
        listened = Path("/proc/net/tcp").read_text().splitlines()[1:]
        places = [line.split()[1] for line in listened if line.split()[3] == "0A"]
        self.assertIn(f"0100007F:{self.program.port:04X}", places)
        self.assertNotIn(f"00000000:{self.program.port:04X}", places)

    def test_bodies_have_a_limit(self):
        too_many = (1 << 26) + 1
        connection = socket.create_connection(("127.0.0.1", self.program.port))
        head = (f"POST /api/open HTTP/1.1\r\nHost: 127.0.0.1:{self.program.port}\r\nX-Rddl-Token: {self.program.token}\r\n"
                f"Content-Type: application/json\r\nContent-Length: {too_many}\r\n\r\n")
        connection.sendall(head.encode() + b"x" * too_many)
        self.assertIn(b"413", connection.recv(100))
        connection.close()
        # Bytes that are no request, and a client that says nothing, hold up no other one.
        silent = [socket.create_connection(("127.0.0.1", self.program.port)) for _ in range(20)]
        silent[0].sendall(b"\x00\xff" * 5000)
        begin = time.monotonic()
        self.assertEqual(self.post(), 200)
        self.assertLess(time.monotonic() - begin, 3)
        for each in silent:
            each.close()

    def test_manual_step_is_that_of_replay(self):
        """The same actions by `rddl replay` give the same states and rewards."""
        texts = dict(zip(("domain", "instance"), (path.read_text() for path in CAR)))
        self.program.ask("load", player="p", seed=11, **texts)
        name = self.program.ask("describe", player="p")["problem"]["actions"][0]["name"]
        forces = [1.0, -0.5, 0.25, 0.0, 1.0]
        lines = "".join(json.dumps({"action": {name: force}}) + "\n" for force in forces)
        replayed = subprocess.run([RDDL, "replay", *CAR, "--seed", "11"], input=lines, capture_output=True, text=True,
                                  check=True).stdout.splitlines()
        for force in forces:
            self.assertEqual(self.program.ask("step", player="p", action={name: force}), {})
        moments = self.program.ask("updates", player="p")["moments"]
        for k, line in enumerate(map(json.loads, replayed)):
            self.assertEqual(moments[k + 1]["state"], line["state"])
            self.assertEqual(moments[k]["reward"], line["reward"])

    def test_many_tabs_at_once(self):
        texts = dict(zip(("domain", "instance"), (path.read_text() for path in CAR)))
        failures = []

        def work(tab):
            try:
                self.program.ask("load", tab=tab, player="p", seed=int(tab), **texts)
                self.program.ask("run", tab=tab, player="p", policy="random", steps=50)
                while self.program.ask("updates", tab=tab, player="p")["run"]["state"] == "running":
                    pass
                assert self.program.ask("updates", tab=tab, player="p")["now"] == 50
            except Exception as error:  # noqa: BLE001
                failures.append(error)

        threads = [threading.Thread(target=work, args=(str(k),)) for k in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(failures, [])


class Running(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = folder_with_car(self.addCleanup)

    def start(self, *words) -> Program:
        program = Program(*words, folder=self.folder)
        self.addCleanup(program.close)
        return program

    def test_saves_files_and_notices_other_programs(self):
        program = self.start("domain.rddl", "instance.rddl")
        texts = program.ask("open")
        self.assertTrue(texts["can_save"])
        domain, instance = texts["domain"] + "// mine\n", texts["instance"]
        program.ask("save", domain=domain, instance=instance)
        self.assertEqual((self.folder / "domain.rddl").read_text(), domain)
        (self.folder / "domain.rddl").write_text("theirs")
        refused = program.ask("save", status=422, domain=domain, instance=instance)
        self.assertIn("another program has changed", refused["error"])
        self.assertEqual((self.folder / "domain.rddl").read_text(), "theirs")
        program.ask("save", domain=domain, instance=instance, force=True)
        self.assertEqual((self.folder / "domain.rddl").read_text(), domain)

    def test_ctrl_c_ends_at_once(self):
        idle = self.start()
        self.assertFalse(idle.ask("open")["can_save"])
        status, seconds = idle.end()
        self.assertEqual(status, 130)
        self.assertLess(seconds, 2)

    def test_ctrl_c_in_the_middle_of_work(self):
        program = self.start("domain.rddl", "instance.rddl", "--engine=interpreter")
        texts = program.ask("open")
        texts = {name: texts[name] for name in ("domain", "instance")}
        program.ask("load", player="p", **texts)
        program.ask("run", player="p", policy="plan:cem,seconds=60")
        program.ask("train", solver="ppo", seconds=600, **texts)
        program.ask("compare", first="random", second="noop", episodes=1000000, **texts)
        time.sleep(0.5)
        self.assertEqual(program.ask("job", job="train")["state"], "running")
        status, seconds = program.end()
        self.assertEqual(status, 130)
        self.assertLess(seconds, 6)
        self.assertEqual((self.folder / "domain.rddl").read_text(), texts["domain"])

    def test_a_problem_that_takes_long_holds_up_nobody(self):
        """Its texts have 600 KB, it is loaded for a second, and a step takes long: a run of it takes minutes."""
        names = [f"o{k}" for k in range(200)]
        domain = ("domain d { types { t : object; }; pvariables { N(t, t) : { non-fluent, real, default = 1.0 }; "
                  "p(t, t) : { state-fluent, real, default = 0.0 }; a : { action-fluent, bool, default = false }; }; "
                  "cpfs { p'(?x, ?y) = p(?x, ?y) + N(?x, ?y) * sum_{?z : t} [p(?x, ?z) * N(?z, ?y)]; }; reward = a; }")
        values = " ".join(f"N({a},{b}) = {k % 7}.5;" for k, a in enumerate(names) for b in names)
        instance = (f"non-fluents n {{ domain = d; objects {{ t : {{{','.join(names)}}}; }}; non-fluents {{ {values} }}; }} instance i {{ "
                    "domain = d; non-fluents = n; init-state { p(o1, o2) = 1.0; }; max-nondef-actions = 1; horizon = 500; discount = 1.0; }")
        program = self.start()

        def quick(request, **members):
            begin = time.monotonic()
            answer = program.ask(request, **members)
            self.assertLess(time.monotonic() - begin, 1.5)
            return answer

        thread = threading.Thread(target=lambda: program.ask("load", player="p", domain=domain, instance=instance), daemon=True)
        thread.start()
        time.sleep(0.2)
        quick("open", tab="other")
        quick("ping")
        self.assertTrue(thread.is_alive())  # else this shows nothing
        thread.join()
        program.ask("run", player="p", policy="noop")
        time.sleep(0.3)
        self.assertEqual(quick("updates", player="p", since=1)["run"]["state"], "running")
        quick("open", tab="other")
        status, seconds = program.end()  # in the middle of a step
        self.assertEqual(status, 130)
        self.assertLess(seconds, 6)

    def test_taken_port(self):
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))
            taken.listen()
            port = taken.getsockname()[1]
            run = subprocess.run([RDDL, "studio", "--no-browser", f"--port={port}"], capture_output=True, text=True,
                                 timeout=20)
        self.assertEqual(run.returncode, 1)
        self.assertIn(f"cannot listen at port {port}", run.stderr)

    def test_wrong_problem(self):
        run = subprocess.run([RDDL, "studio", "nothing.rddl", "--no-browser"], capture_output=True, text=True, timeout=20,
                             cwd=self.folder, env=os.environ)
        self.assertEqual(run.returncode, 1)
        self.assertIn("nothing.rddl", run.stderr)


if __name__ == "__main__":
    unittest.main()
