#!/usr/bin/env python3
"""Makes the pictures of docs/studio.md: the page of `rddl studio` in headless Chromium, as a user has it.

    .venv/bin/python scripts/studio_pictures.py [--bin build/bin] [NAME...]
"""

import argparse
import io
import os
import sys
import tempfile
from base64 import b64decode
from collections.abc import Callable
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parents[1]
PICTURES = ROOT / "docs/images/studio"
COLOURS = 128


def tries(window) -> None:
    """A plan in the middle of an episode, beside the texts."""
    window.resize(1280, 900)
    window.view("try")
    window.fill("#policy", "plan:cem,steps=5000")
    window.click("#run")
    window.wait("!document.querySelector('#halt').hidden")
    window.wait("document.querySelector('#halt').hidden", 300)
    window.evaluate("(() => { const slider = document.querySelector('#hand-episode input[type=range]');"
                    "slider.value = 40; slider.dispatchEvent(new Event('input')); })()")
    window.wait("document.querySelector('#hand-episode img').dataset.step === '40'")


def errs(window) -> None:
    """A mistake, where it is, with its repair."""
    window.resize(860, 810)
    window.edit(0, "max[0.0, min[CAPACITY,", "max[0.0, min[CAPACTY,")
    window.wait("!!document.querySelector('#problems .fix:not([hidden])')")
    window.evaluate("document.querySelector('#problems .place').click()")


def compares(window) -> None:
    """Two policies with the same luck."""
    window.resize(860, 950)
    window.view("compare")
    window.fill("#second", "plan:cem,steps=500")
    window.fill("#episodes", "20")
    window.click("#evaluate")
    window.wait("!!document.querySelector('#verdict')", 300)
    window.click("#beside")
    window.wait("document.querySelector('#both output')?.textContent.endsWith('of 40')", 120)
    window.evaluate("document.querySelector('#both [aria-label=\"Last step\"]').click()")
    window.wait("[...document.querySelectorAll('#both img')].every((each) => each.dataset.step === '40')")


def learns(window) -> None:
    """The curve of a learner, on a narrow screen."""
    window.resize(360, 740)
    window.view("train")
    window.fill("#learner", "cgp")
    window.fill("#options", "gens=40")
    window.click("#learn")
    window.wait("!document.querySelector('#use-policy').hidden", 120)


# A name, the words of `rddl studio`, and what is done on its page.
SHOTS: dict[str, tuple[list[str], Callable]] = {
    "try": (["examples/reservoir", "1"], tries),
    "error": ([], errs),
    "compare": ([], compares),
    "train": (["examples/mountain_car", "1"], learns),
}


def write(window, path: Path) -> None:
    """As a PNG of few colours, which is small."""
    window.evaluate("scrollTo(0, 0)")
    window.call("Page.bringToFront")
    data = b64decode(window.call("Page.captureScreenshot", format="png")["data"])
    picture = Image.open(io.BytesIO(data)).convert("RGB").quantize(COLOURS, dither=Image.Dither.NONE)
    path.parent.mkdir(parents=True, exist_ok=True)
    picture.save(path, optimize=True)
    print(f"{path.relative_to(ROOT)}: {path.stat().st_size:,} bytes")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--bin", default=ROOT / "build/bin", help="folder of rddl")
    parser.add_argument("names", nargs="*", default=list(SHOTS))
    options = parser.parse_args()
    os.environ["RDDLC_BIN"] = str(Path(options.bin).resolve())
    sys.path.insert(0, str(ROOT / "tests/studio"))
    from studio import Program, Window, shared_browser
    for name in options.names:
        words, act = SHOTS[name]
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "examples").symlink_to(ROOT / "examples")
            program = Program(*words, folder=folder)
            window = Window(shared_browser(), program.address)
            act(window)
            write(window, PICTURES / f"{name}.png")
            window.close()
            program.end()
    return 0


if __name__ == "__main__":
    sys.exit(main())
