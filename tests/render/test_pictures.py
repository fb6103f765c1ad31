"""The pictures that rddl draws, read by Pillow.

    test_pictures.py [CLASS]       some of the public problems
    test_pictures.py --all         every problem of rddlrepository: PNG and GIF decode, with their sizes

Over 400 lines: a test for each thing that can be seen.
"""

import base64
import fcntl
import io
import json
import os
import pty
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import termios
import unittest
import xml.etree.ElementTree
from pathlib import Path

import numpy
from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
RDDL = os.environ.get("RDDL", str(ROOT / "build/bin/rddl"))
sys.path.insert(0, str(ROOT / "scripts"))
import gallery  # noqa: E402

EXAMPLE = ROOT / "examples/mountain_car"
SUCCESS, DIAGNOSED, USAGE = 0, 1, 2

# Two pictures are alike if few pixels differ by much: another version of FreeType or cairo may shade
# the edges of letters differently.
STRONG_DIFFERENCE = 64  # of 255, in a channel
MOST_STRONG = 0.003     # of all pixels


def environment() -> dict:
    return {"RDDL_REPOSITORY": gallery.repository(), **os.environ}


class PictureTest(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory(prefix="rddlc-pictures-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def rddl(self, *words, status=SUCCESS, **options) -> subprocess.CompletedProcess:
        done = subprocess.run([RDDL, *map(str, words)], cwd=self.folder, text=True,
                              capture_output=True, env=environment(), **options)
        self.assertEqual(done.returncode, status, f"{words}\n{done.stdout}\n{done.stderr}")
        return done

    def run_car(self, *words, horizon=30, **options) -> subprocess.CompletedProcess:
        return self.rddl("run", EXAMPLE / "domain.rddl", EXAMPLE / "instance.rddl",
                         "--engine=interpreter", f"--horizon={horizon}", "--quiet", *words, **options)

    def left_behind(self) -> list[str]:
        return sorted(path.name for path in self.folder.rglob("*"))


def frames_of(path: Path) -> list[numpy.ndarray]:
    with Image.open(path) as movie:
        frames = []
        for k in range(movie.n_frames):
            movie.seek(k)
            frames.append(numpy.asarray(movie.convert("RGB"), dtype=int))
        return frames


def differing(a: numpy.ndarray, b: numpy.ndarray) -> float:
    """The part of pixels that differ strongly."""
    return float(numpy.mean(numpy.abs(a - b).max(axis=2) > STRONG_DIFFERENCE))


class Files(PictureTest):
    def test_formats_and_sizes(self):
        self.run_car("--gif=a.gif", "--png=a.png", "--svg=a.svg", "--size=300x220")
        for name in "a.gif", "a.png":
            with Image.open(self.folder / name) as picture:
                self.assertEqual(picture.size, (300, 220))
        with Image.open(self.folder / "a.gif") as movie:
            self.assertEqual(movie.n_frames, 31)
            self.assertEqual(movie.info["loop"], 0)
        svg = (self.folder / "a.svg").read_text()
        self.assertIn('width="300px"', svg)
        self.assertIn('viewBox="0 0 300 220"', svg)

    def test_folders_of_all_states(self):
        self.run_car("--png=frames", "--svg=drawings", "--gif=a.gif")
        names = [f"{k:06}" for k in range(31)]
        self.assertEqual(sorted(path.stem for path in (self.folder / "frames").iterdir()), names)
        self.assertEqual(sorted(path.stem for path in (self.folder / "drawings").iterdir()), names)
        # A movie of at most 255 colours a frame is exact: each frame is the picture.
        for k, frame in enumerate(frames_of(self.folder / "a.gif")):
            with Image.open(self.folder / f"frames/{k:06}.png") as picture:
                still = numpy.asarray(picture.convert("RGB"), dtype=int)
            self.assertEqual(differing(frame, still), 0, f"state {k}")

    def test_one_state(self):
        self.run_car("--png=all")
        self.run_car("--png=seventh.png", "--step=7")
        self.assertEqual((self.folder / "seventh.png").read_bytes(),
                         (self.folder / "all/000007.png").read_bytes())
        self.run_car("--png=last.png")
        self.assertEqual((self.folder / "last.png").read_bytes(),
                         (self.folder / "all/000030.png").read_bytes())

    def test_standard_output(self):
        """Output for other programs: nothing else is printed, and no file is written."""
        self.run_car("--trace=t.jsonl", "--gif=a.gif", "--png=a.png", "--svg=a.svg", "--html=a.html")
        before = self.left_behind()
        for kind in "gif", "png", "svg", "html":
            for words in (["render", "t.jsonl"], ["render", "-"]):
                with open(self.folder / "t.jsonl") as trace:
                    done = subprocess.run([RDDL, *words, f"--{kind}=-"], cwd=self.folder, stdin=trace, check=True,
                                          capture_output=True, env=environment())
                self.assertEqual(done.stderr, b"")
                wanted = (self.folder / f"a.{kind}").read_bytes()
                if kind == "html":  # the name of the episode is the trace's
                    self.assertEqual(done.stdout[-1000:], wanted[-1000:])
                else:  # cairo numbers what it has drawn
                    self.assertEqual(re.sub(rb"surface\d+", b"", done.stdout), re.sub(rb"surface\d+", b"", wanted))
            text = self.run_car(f"--{kind}=-", "--json", status=USAGE).stderr
            self.assertIn("both write to standard output", text)
        for words in ["--gif=-", "--png=-"], ["--html=-", "--watch"], ["--svg=-", "--trace=-"]:
            self.assertIn("both write to standard output", self.run_car(*words, status=USAGE).stderr)
        self.assertIn("not '-'", self.run_car("--video=-", status=USAGE).stderr)
        self.assertEqual(self.left_behind(), before)

    def test_render_draws_what_run_draws(self):
        self.run_car("--gif=a.gif", "--trace=t.jsonl", "--episodes=3", "--environment=1")
        self.rddl("render", "t.jsonl", "--gif=b.gif", "--environment=1")
        self.rddl("render", "t.jsonl", EXAMPLE / "domain.rddl", EXAMPLE / "instance.rddl",
                  "--gif=c.gif", "--environment=1")
        self.rddl("render", "t.jsonl", "--gif=other.gif", "--environment=2")
        picture = (self.folder / "a.gif").read_bytes()
        self.assertEqual((self.folder / "b.gif").read_bytes(), picture)
        self.assertEqual((self.folder / "c.gif").read_bytes(), picture)
        self.assertNotEqual((self.folder / "other.gif").read_bytes(), picture)

    def test_traces_of_other_programs(self):
        """States alone, without a header, as a user of pyRDDLGym would write them."""
        states = [{"state": {"position": -0.5 + 0.01 * k, "velocity": 0.01}} for k in range(5)]
        (self.folder / "t.jsonl").write_text("\n".join(map(json.dumps, states)))
        self.rddl("render", "t.jsonl", EXAMPLE / "domain.rddl", EXAMPLE / "instance.rddl",
                  "--gif=a.gif", "--visualizer=mountain_car")
        self.assertEqual(len(frames_of(self.folder / "a.gif")), 5)

    def test_every_visualizer_is_listed(self):
        text = self.rddl("run", "--visualizer=list", EXAMPLE / "domain.rddl").stdout
        names = [line.split()[0] for line in text.splitlines()]
        self.assertIn("mountain_car", names)
        shown = {shot.visualizer or shot.name for shot in gallery.SHOTS}
        self.assertEqual(shown, set(names), "each visualizer has a picture in scripts/gallery.py")


    def test_an_episode_without_steps(self):
        """Its initial state is drawn, in each form."""
        (self.folder / "over.rddl").write_text(
            "domain d { pvariables { x : { state-fluent, real, default = 1.0 };"
            " a : { action-fluent, bool, default = false }; };"
            " cpfs { x' = x + 1; }; reward = x; termination { x >= 1; }; }"
            " non-fluents n { domain = d; }"
            " instance i { domain = d; non-fluents = n; horizon = 5; discount = 1.0; }")
        done = self.rddl("run", "over.rddl", "--engine=interpreter", "--quiet", "--gif=a.gif", "--png=a.png",
                         "--html=a.html", "--watch", "--episodes=2")
        self.assertEqual(done.stdout, "i  episode 0  step 0 / 5  return 0  ended: terminated\n  x 1\n\n"
                         "i  episode 1  step 0 / 5  return 0  ended: terminated\n  x 1\n\n")
        self.assertEqual(len(frames_of(self.folder / "a.gif")), 1)


class Movies(PictureTest):
    def durations(self, name: str) -> list[int]:
        with Image.open(self.folder / name) as movie:
            durations = []
            for k in range(movie.n_frames):
                movie.seek(k)
                durations.append(movie.info["duration"])
            return durations

    def test_frame_rate(self):
        self.run_car("--gif=a.gif", "--fps=30")
        durations = self.durations("a.gif")
        self.assertAlmostEqual(sum(durations[:-1]), 1000, delta=10)
        self.assertEqual(durations[-1], 1500)

    def test_most_frames(self):
        self.run_car("--gif=a.gif", "--max-frames=10")
        # Every fourth of 31 states: 0, 4, ... 28, and the last one.
        self.assertEqual(len(self.durations("a.gif")), 9)
        for most in 1, 2, 3, 7, 16, 30, 31, 32:
            self.run_car("--png=frames", f"--max-frames={most}")
            names = sorted(path.stem for path in (self.folder / "frames").iterdir())
            self.assertLessEqual(len(names), most)
            self.assertEqual(names[-1], "000030")
            shutil.rmtree(self.folder / "frames")

    def test_most_frames_whatever_the_header_says(self):
        self.run_car("--trace=t.jsonl")
        header, *steps = (self.folder / "t.jsonl").read_text().splitlines()
        for horizon in 0, 3, 30, 2000:
            changed = json.dumps({**json.loads(header), "horizon": horizon})
            (self.folder / "t.jsonl").write_text("\n".join([changed, *steps]) + "\n")
            done = self.rddl("render", "t.jsonl", "--gif=a.gif", "--max-frames=10")
            self.assertEqual(len(self.durations("a.gif")), 9)
            self.assertEqual(done.stdout, "9 of 31 states drawn by 'mountain_car'\n")
        watched = self.rddl("render", "t.jsonl", "--watch", "--max-frames=4", "--quiet").stdout
        self.assertLessEqual(len(re.findall("step ", watched)), 4)
        self.assertIn("step 30", watched)
        self.assertEqual(self.rddl("render", "t.jsonl", "--png=a.png", "--step=3").stdout,
                         "1 of 31 states drawn by 'mountain_car'\n")
        self.assertEqual(self.rddl("render", "t.jsonl", "--png=a.png", "--gif=a.gif").stdout,
                         "31 states drawn by 'mountain_car'\n")

    def test_more_frames_than_players_show(self):
        self.run_car("--gif=a.gif", "--fps=200")
        self.assertTrue(all(duration >= 20 for duration in self.durations("a.gif")))
        self.assertAlmostEqual(sum(self.durations("a.gif")[:-1]), 30 * 5, delta=20)

    def test_real_time(self):
        self.rddl("run", "Pendulum_gym", "0", "--engine=interpreter", "--horizon=20", "--quiet",
                  "--gif=a.gif", "--real-time-factor=0.5")
        # A step of 0.05 s takes 0.1 s.
        self.assertEqual(set(self.durations("a.gif")[:-1]), {100})
        refused = self.run_car("--gif=b.gif", "--real-time-factor=1", status=USAGE)
        self.assertIn("does not say how long a step is", refused.stderr)
        refused = self.run_car("--gif=b.gif", "--real-time-factor=1", "--fps=3", status=USAGE)
        self.assertIn("--fps and --real-time-factor both", refused.stderr)
        self.assertEqual(self.left_behind(), ["a.gif"])

    def test_videos(self):
        if not shutil.which("ffmpeg"):
            refused = self.run_car("--video=a.mp4", status=DIAGNOSED)
            self.assertIn("cannot start ffmpeg", refused.stderr)
            self.skipTest("there is no ffmpeg")
        for name, magic, place in (("a.mp4", b"ftyp", 4), ("b.MP4", b"ftyp", 4), ("a.webm", b"\x1a\x45\xdf\xa3", 0),
                                   ("a.webp", b"WEBP", 8)):
            self.run_car(f"--video={name}", "--size=300x201")
            data = (self.folder / name).read_bytes()
            self.assertEqual(data[place:place + 4], magic)
        with Image.open(self.folder / "a.webp") as movie:
            self.assertEqual(movie.size, (300, 201))


class Errors(PictureTest):
    def refuse(self, *words, status=DIAGNOSED) -> str:
        done = self.rddl(*words, status=status)
        self.assertNotIn("mistake", done.stderr)
        return done.stderr

    def refuse_each_kind(self, complaint: str, *words) -> None:
        """Nothing is left, and an older file stays as it was."""
        kinds = ["gif", "png", "svg", "html"] + (["mp4", "webp"] if shutil.which("ffmpeg") else [])
        before = self.left_behind()
        for kind in kinds:
            option = "--video" if kind in ("mp4", "webp") else f"--{kind}"
            self.assertIn(complaint, self.refuse(*words, f"{option}=a.{kind}"))
            self.assertEqual(self.left_behind(), before)
            (self.folder / f"old.{kind}").write_text("older")
            self.assertIn(complaint, self.refuse(*words, f"{option}=old.{kind}"))
            self.assertEqual((self.folder / f"old.{kind}").read_text(), "older")
            (self.folder / f"old.{kind}").unlink()

    def trace(self) -> list[str]:
        self.run_car("--trace=t.jsonl")
        return (self.folder / "t.jsonl").read_text().splitlines(keepends=True)

    def test_two_outputs_in_one_file(self):
        (self.folder / "link").symlink_to("a.gif")
        for words in (("--trace=a.gif", "--gif=a.gif"), ("--gif=a.gif", "--html=./a.gif"),
                      ("--gif=link.gif", "--html=link.gif"), ("--trace=link", "--gif=a.gif")):
            done = self.run_car(*words, status=USAGE)
            self.assertIn("two outputs would be written to", done.stderr)
        self.assertFalse((self.folder / "a.gif").exists())
        self.assertIn("--gif writes a file .gif", self.run_car("--gif=a.png", status=USAGE).stderr)

    def test_rewards_that_are_no_numbers(self):
        lines = self.trace()
        step = json.loads(lines[4])
        for reward, total in ("nan", "nan"), ("inf", "inf"):
            lines[4] = json.dumps({**step, "reward": reward}) + "\n"
            (self.folder / "t.jsonl").write_text("".join(lines))
            shown = self.rddl("render", "t.jsonl", "--watch").stdout
            self.assertRegex(shown, f"reward {reward}")
            self.assertRegex(shown, f"return {total}")

    def test_trace_cut_off_in_a_line(self):
        lines = self.trace()
        (self.folder / "t.jsonl").write_text("".join(lines[:9]) + lines[9][:40])
        text = self.refuse("render", "t.jsonl", "--gif=a.gif", "--png=a.png")
        self.assertIn("'t.jsonl', line 10: the line is cut off in the middle", text)
        self.assertEqual(self.left_behind(), ["t.jsonl"])
        self.refuse_each_kind("the line is cut off in the middle", "render", "t.jsonl")

    def test_trace_cut_off_between_lines(self):
        (self.folder / "t.jsonl").write_text("".join(self.trace()[:9]))
        done = self.rddl("render", "t.jsonl", "--gif=a.gif")
        self.assertIn("episode 0 does not end in 't.jsonl'", done.stderr)
        self.assertEqual(len(frames_of(self.folder / "a.gif")), 9)

    def test_trace_of_another_problem(self):
        self.trace()
        other = ROOT / "examples/network"
        text = self.refuse("render", "t.jsonl", other / "domain.rddl", other / "instance.rddl",
                           "--gif=a.gif")
        self.assertIn("the trace is of instance", text)
        self.assertEqual(self.left_behind(), ["t.jsonl"])
        self.refuse_each_kind("the trace is of instance", "render", "t.jsonl", other / "domain.rddl",
                              other / "instance.rddl")

    def test_values_that_do_not_fit(self):
        for line, complaint in (('{"state": {"position": "far"}}', "'position' takes a number"),
                                ('{"state": {"altitude": 1}}', "no state-fluent is called"),
                                ('[1]', "not a JSON object"), ('{"x": 1}', "no state and no action"),
                                ("nonsense", "no JSON"),
                                ('{"state": {}, "step": "3"}', "'step' is an int from 0 on, not \"3\""),
                                ('{"state": {}, "step": -1}', "'step' is an int from 0 on, not -1"),
                                ('{"state": {}, "episode": 1.5}', "'episode' is an int from 0 on, not 1.5"),
                                ('{"state": {}, "episode": 18446744073709551615}', "'episode' is an int from 0 on"),
                                ('{"state": {}, "step": 9007199254740993}', "'step' is at most 9007199254740992"),
                                ('{"state": {}, "step": 3}\n{"state": {}, "step": 2}', "comes after")):
            (self.folder / "t.jsonl").write_text(line)
            text = self.refuse("render", "t.jsonl", EXAMPLE / "domain.rddl",
                               EXAMPLE / "instance.rddl", "--gif=a.gif")
            self.assertIn(complaint, text)
            self.assertFalse((self.folder / "a.gif").exists())

    def test_steps_that_are_far_apart(self):
        """A chart has no column for each step that is not there."""
        (self.folder / "many.rddl").write_text(
            "domain d { types { o : object; }; pvariables { on(o) : { state-fluent, bool, default = false };"
            " a : { action-fluent, bool, default = false }; };"
            " cpfs { on'(?o) = ~on(?o); }; reward = 0; } non-fluents n { domain = d; objects { o : {o1, o2}; }; }"
            " instance i { domain = d; non-fluents = n; horizon = 5; discount = 1.0; }")
        for last in 10**6, 10**12, 2**53:
            (self.folder / "t.jsonl").write_text("".join(
                json.dumps({"state": {"on___o1": True}, "step": step}) + "\n" for step in (0, 7, last)))
            self.rddl("render", "t.jsonl", "many.rddl", "--visualizer=chart", "--gif=a.gif", "--html=a.html")
            self.assertEqual(len(frames_of(self.folder / "a.gif")), 3)

    def test_horizons_that_are_no_ints(self):
        header, *steps = self.trace()
        for horizon in "long", -3, 1.5, [1]:
            changed = json.dumps({**json.loads(header), "horizon": horizon})
            (self.folder / "t.jsonl").write_text("".join([changed + "\n", *steps]))
            self.assertIn("line 1: 'horizon' is an int from 0 on", self.refuse("render", "t.jsonl", "--gif=a.gif"))

    def test_texts_of_a_trace_are_only_text(self):
        *lines, last = self.trace()
        cause = "\x1b]0;mine\x07\x1b[2J\x7f</text><script>&\"'"
        (self.folder / "t.jsonl").write_text("".join(lines) + json.dumps({**json.loads(last), "causes": [cause]}) + "\n")
        done = self.rddl("render", "t.jsonl", "--watch", "--svg=a.svg", "--quiet")
        self.assertIn("ended: \ufffd]0;mine\ufffd\ufffd[2J\ufffd</text>", done.stdout)
        self.assertNotRegex(done.stdout, "[\x00-\x09\x0b-\x1f\x7f]")
        self.assertNotIn("<script", (self.folder / "a.svg").read_text())
        xml.etree.ElementTree.parse(self.folder / "a.svg")

    def test_what_is_no_trace(self):
        (self.folder / "t.bin").write_bytes(bytes(range(256)) * 10)
        self.assertIn("'t.bin' is not a trace: its first line is not JSON", self.refuse("render", "t.bin", "--gif=a.gif"))
        text = self.refuse("render", EXAMPLE, "1", "--gif=a.gif")
        self.assertIn("is a folder, not a trace", text)
        self.assertIn("rddl run --gif", text)

    def test_links_that_lead_nowhere(self):
        (self.folder / "link").symlink_to("nowhere")
        self.assertIn("a link to a folder that is not there", self.run_car("--png=link", status=DIAGNOSED).stderr)

    def test_nothing_to_read(self):
        (self.folder / "t.jsonl").write_text("")
        self.assertIn("is empty", self.refuse("render", "t.jsonl", "--gif=a.gif"))
        self.assertIn("cannot read", self.refuse("render", "missing.jsonl", "--gif=a.gif"))
        (self.folder / "t.jsonl").write_text('{"state": {}}\n')
        self.assertIn("does not say which problem", self.refuse("render", "t.jsonl", "--gif=a.gif"))
        self.trace()
        self.assertIn("has no step of episode 5",
                      self.refuse("render", "t.jsonl", "--gif=a.gif", "--environment=5"))

    def test_files_that_cannot_be_written(self):
        (self.folder / "file").write_text("")
        for option in "gif", "png", "svg", "video", "html":
            ending = {"video": "mp4"}.get(option, option)
            text = self.run_car(f"--{option}=missing/a.{ending}", status=DIAGNOSED).stderr
            self.assertIn("cannot write", text)
            text = self.run_car(f"--{option}=file/a.{ending}", status=DIAGNOSED).stderr
            self.assertIn("cannot write", text)
        text = self.run_car("--png=file/frames", status=DIAGNOSED).stderr
        self.assertIn("cannot write", text)
        self.assertEqual(self.left_behind(), ["file"])

    def test_the_trace_is_not_overwritten(self):
        lines = self.trace()
        self.refuse("render", "t.jsonl", "--gif=t.jsonl")
        self.assertEqual((self.folder / "t.jsonl").read_text(), "".join(lines))

    def test_options(self):
        for option, complaint in (("--size=600", "not WIDTHxHEIGHT"), ("--size=9x9", "16"),
                                  ("--size=99999x100", "8192"), ("--fps=0", "--fps"),
                                  ("--visualizer=mountain_cat", "did you mean 'mountain_car'?"),
                                  ("--max-frames=0", "'0' is not a positive int"), ("--step=-1", "not an int from 0 on"),
                                  ("--environment=1", "there is no episode 1")):
            text = self.run_car("--gif=a.gif", option, status=USAGE).stderr
            self.assertIn(complaint, text)
        self.assertIn("nothing to write", self.refuse("render", "t.jsonl", status=USAGE))
        text = self.run_car("--video=a.avi", status=USAGE).stderr
        self.assertIn(".mp4, .webm or .webp", text)
        text = self.run_car("--png=a.jpg", status=USAGE).stderr
        self.assertIn("a picture is a file .png, or a folder of them, not 'a.jpg'", text)
        self.run_car("--png=b.PNG")
        self.assertTrue((self.folder / "b.PNG").is_file())
        text = self.run_car("--png=a.png", "--step=99", status=DIAGNOSED).stderr
        self.assertIn("there is no state 99: the episode has 30 steps", text)

    def test_a_visualizer_of_another_domain(self):
        done = self.run_car("--png=a.png", "--visualizer=network")
        self.assertIn("draws a fluent 'running', which this problem lacks", done.stderr)
        self.run_car("--png=b.png", "--visualizer=auto")
        self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())


class Terminal(PictureTest):
    def test_files_are_not_written_to_terminals(self):
        for option in "--gif=-", "--html=-":
            ours, theirs = pty.openpty()
            done = subprocess.run([RDDL, "run", EXAMPLE / "domain.rddl", EXAMPLE / "instance.rddl", option],
                                  stdout=theirs, stderr=subprocess.PIPE, env=environment(), text=True)
            os.close(theirs)
            self.assertEqual(self.rest_of(ours), "")
            self.assertEqual(done.returncode, USAGE)
            self.assertIn("standard output is a terminal", done.stderr)

    def start(self, *words, size=(24, 80), **variables) -> tuple[subprocess.Popen, int]:
        """The program in a terminal of so many rows and columns, and what reads its screen."""
        ours, theirs = pty.openpty()
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", *size, 0, 0))
        process = subprocess.Popen(
            [RDDL, "run", *map(str, words), "--engine=interpreter", "--quiet", "--watch", "--fps=50"],
            stdout=theirs, stderr=theirs, cwd=self.folder,
            env={**environment(), "TERM": "xterm", "TERM_PROGRAM": "", **variables})
        os.close(theirs)
        return process, ours

    def rest_of(self, screen: int) -> str:
        text = b""
        try:
            while chunk := os.read(screen, 1 << 16):
                text += chunk
        except OSError:  # Linux reports in this way that the other end is closed
            pass
        os.close(screen)
        return text.decode().replace("\r\n", "\n")

    def watch(self, *words, **options) -> str:
        """Returns the terminal output of three steps."""
        process, screen = self.start(*words, "--horizon=3", **options)
        text = self.rest_of(screen)
        self.assertEqual(process.wait(), SUCCESS, text)
        return text

    def test_progress(self):
        """A bar on the terminal shows that files are drawn, and is wiped at the end; --quiet hides
        it."""
        self.run_car("--trace=t.jsonl", "--policy=noop", horizon=900)
        for option, bars in ([], True), (["--quiet"], False):
            ours, theirs = pty.openpty()
            subprocess.run([RDDL, "render", "t.jsonl", "--gif=a.gif", *option], stdout=subprocess.DEVNULL, stderr=theirs,
                           cwd=self.folder, env=environment(), check=True)
            os.close(theirs)
            told = self.rest_of(ours)
            self.assertEqual("drawing [=" in told, bars, told)
            self.assertTrue(told.endswith("\r\x1b[K") or not bars, told)

    def test_text_in_place(self):
        text = self.watch(EXAMPLE / "domain.rddl", EXAMPLE / "instance.rddl")
        states = text.split("\x1b[H")[1:]
        self.assertEqual(len(states), 4)
        for k, state in enumerate(states):
            self.assertIn(f"step {k} / 3", state)
        self.assertIn("action: throttle =", states[0])
        self.assertIn("  position -0.5", states[0])
        self.assertIn("* position", states[1])
        self.assertIn("ended: horizon", states[3])

    def test_an_episode_without_end_is_seen_and_stopped(self):
        process, screen = self.start(EXAMPLE / "domain.rddl", EXAMPLE / "instance.rddl", "--horizon=0",
                                     "--policy=noop")
        seen = b""
        while b"step 5" not in seen:
            seen += os.read(screen, 1 << 16)
        process.send_signal(signal.SIGINT)
        text = self.rest_of(screen)
        self.assertEqual(process.wait(), 128 + signal.SIGINT)
        self.assertTrue(text.endswith("rddl: interrupted after 0 of 1 episodes\n"), text)

    def test_one_episode_after_the_other(self):
        text = self.watch(EXAMPLE / "domain.rddl", EXAMPLE / "instance.rddl", "--episodes=2", "--threads=2")
        seen = re.findall(r"mountain_car_1  episode (\d)  step (\d)", text)
        self.assertEqual(seen, [(episode, str(k)) for episode in "01" for k in range(4)])
        one = self.watch(EXAMPLE / "domain.rddl", EXAMPLE / "instance.rddl", "--episodes=2",
                         "--environment=1")
        self.assertEqual(one.split("\x1b[H")[1:], text.split("\x1b[H")[5:])

    def test_small_terminals(self):
        text = self.watch("CooperativeRecon_MDP_ippc2011", "3", size=(8, 40))
        for state in text.split("\x1b[H")[1:]:
            lines = state.split("\x1b[J")[0].rstrip("\n").split("\n")
            self.assertLessEqual(len(lines), 7)
            for line in lines:
                plain = re.sub(r"\x1b\[[0-9]*[mK]", "", line)
                self.assertLessEqual(len(plain), 40)
            self.assertIn("more", lines[-1])

    def test_terminals_that_show_pictures(self):
        kitty = self.watch(EXAMPLE / "domain.rddl", EXAMPLE / "instance.rddl", TERM="xterm-kitty")
        chunks = re.findall(r"\x1b_G(?:a=T,f=100,)?m=([01]);([^\x1b]*)\x1b", kitty)
        pictures = "".join(data + ("\n" if more == "0" else "") for more, data in chunks).split("\n")[:-1]
        iterm = self.watch(EXAMPLE / "domain.rddl", EXAMPLE / "instance.rddl", TERM_PROGRAM="iTerm.app")
        others = re.findall(r"\x1b]1337;File=inline=1;size=\d+:([^\a]*)\a", iterm)
        self.assertEqual(pictures, others)
        self.assertEqual(len(pictures), 4)
        self.assertEqual(re.findall(r"\x1b\[Hmountain_car_1  episode 0  step (\d)", kitty), list("0123"))
        for picture in pictures:
            with Image.open(io.BytesIO(base64.b64decode(picture))) as image:
                self.assertEqual(image.size, (600, 400))

    def test_no_terminal(self):
        text = self.run_car("--watch").stdout
        self.assertNotIn("\x1b", text)
        self.assertEqual(len(re.findall(r"^mountain_car_1  episode 0  step \d+ / 30", text, re.M)), 31)
        # The options for files of one episode do not change that all are shown, and a trace is the
        # same as ever.
        both = self.run_car("--watch", "--episodes=2", "--gif=a.gif", "--trace=a.jsonl").stdout
        self.assertTrue(both.startswith(text))
        self.assertEqual(len(re.findall(r"^mountain_car_1  episode 1  step \d+ / 30", both, re.M)), 31)
        self.assertEqual(len(frames_of(self.folder / "a.gif")), 31)
        self.run_car("--episodes=2", "--trace=b.jsonl")
        self.assertEqual((self.folder / "a.jsonl").read_bytes(), (self.folder / "b.jsonl").read_bytes())
        self.assertEqual(self.rddl("render", "a.jsonl", "--watch", "--quiet").stdout, both)

    def test_values_that_are_no_numbers(self):
        """They change once; pictures are drawn all the same."""
        (self.folder / "odd.rddl").write_text(
            "domain d { pvariables { x : { state-fluent, real, default = 1.0 };"
            " a : { action-fluent, bool, default = false }; };"
            " cpfs { x' = (x - 1) / (x - x); }; reward = x; }"
            " non-fluents n { domain = d; }"
            " instance i { domain = d; non-fluents = n; horizon = 3; discount = 1.0; }")
        done = self.rddl("run", "odd.rddl", "--engine=interpreter", "--quiet", "--watch", "--gif=a.gif")
        self.assertEqual(re.findall(r"(.) x (\S+)$", done.stdout, re.M),
                         [(" ", "1"), ("*", "nan"), (" ", "nan"), (" ", "nan")])
        for visualizer in "chart", "heatmap", "text":
            self.rddl("run", "odd.rddl", "--engine=interpreter", "--quiet", "--png=a.png", "--html=a.html",
                      "--svg=a.svg", f"--visualizer={visualizer}")

    def test_one_thing_on_standard_output(self):
        for option in "--json", "--trace=-":
            refused = self.run_car("--watch", option, status=USAGE)
            self.assertIn("both write to standard output", refused.stderr)


class Gallery(PictureTest):
    def test_pictures_are_those_of_the_gallery(self):
        for shot in gallery.SHOTS:
            with self.subTest(shot.name):
                gallery.draw(shot, RDDL, self.folder / "now.png")
                with Image.open(self.folder / "now.png") as picture:
                    now = numpy.asarray(picture.convert("RGB"), dtype=int)
                with Image.open(gallery.PICTURES / f"{shot.name}.png") as picture:
                    wanted = numpy.asarray(picture.convert("RGB"), dtype=int)
                self.assertEqual(now.shape, wanted.shape)
                self.assertLessEqual(differing(now, wanted), MOST_STRONG,
                                     "scripts/gallery.py makes it anew; look at it then")

    def test_the_page_is_that_of_the_script(self):
        self.assertEqual((ROOT / "docs/gallery.md").read_text(), gallery.page(RDDL))

    def test_domains_have_visualizers_of_their_own(self):
        """No picture of a domain's visualizer is one of 'auto', which stands in for it."""
        for shot in gallery.SHOTS:
            if shot.visualizer:
                continue
            done = self.rddl("run", shot.problem, shot.instance, "--engine=interpreter",
                             "--horizon=1", "--quiet", "--png=a.png", f"--visualizer={shot.name}")
            self.assertEqual(done.stderr, "", shot.name)


def draw_every_problem() -> None:
    """One instance of each problem, by its visualizer and by 'auto'."""
    listed = json.loads(subprocess.run([RDDL, "list", "--json"], text=True, check=True,
                                       capture_output=True, env=environment()).stdout)
    problems = listed["problems"] if isinstance(listed, dict) else listed
    steps = 3
    with tempfile.TemporaryDirectory() as folder:
        for problem in problems:
            for visualizer in "", "auto":
                words = [RDDL, "run", problem["name"], problem["instances"][-1],
                         "--engine=interpreter", f"--horizon={steps}", "--quiet",
                         "--preconditions=ignore", f"--gif={folder}/a.gif", f"--png={folder}/a.png",
                         "--size=480x320"] + ([f"--visualizer={visualizer}"] if visualizer else [])
                done = subprocess.run(words, text=True, capture_output=True, env=environment())
                # Random actions make some problems fault; the steps before the fault are drawn.
                is_fault = done.returncode == DIAGNOSED and "faulted" in done.stderr
                assert done.returncode == SUCCESS or is_fault, f"{words}\n{done.stderr}"
                with Image.open(f"{folder}/a.png") as picture:
                    assert picture.size == (480, 320)
                    picture.load()
                frames = frames_of(Path(f"{folder}/a.gif"))
                assert 1 <= len(frames) <= steps + 1, len(frames)
                assert all(frame.shape == (320, 480, 3) for frame in frames)
            print(f"{problem['name']}: {len(frames)} frames", flush=True)
    print(f"{len(problems)} problems")


if __name__ == "__main__":
    if sys.argv[1:] == ["--all"]:
        draw_every_problem()
    else:
        unittest.main()
