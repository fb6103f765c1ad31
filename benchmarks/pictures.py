#!/usr/bin/env python3
"""How quickly pictures are drawn: a movie beside pyRDDLGym's, and frames a second of each visualizer.

    .venv/bin/python benchmarks/pictures.py [--rddl build/bin/rddl] [--without-pyrddlgym]

Movies are of 600 x 400 pixels, as GIF. Times are those of the processor. The time of a visualizer is that of reading the trace,
drawing and encoding; start-up is measured by a movie of the same trace with a single frame and subtracted.
"""

import argparse
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "scripts"))
import gallery  # noqa: E402

STEPS = 200
REPEATS = 3

PYRDDLGYM = """
import sys, warnings
warnings.filterwarnings("ignore")
import pyRDDLGym
from pyRDDLGym.core.policy import RandomAgent
from pyRDDLGym.core.visualizer.movie import MovieGenerator
folder = sys.argv[1]
env = pyRDDLGym.make("MountainCar_ippc2023", "1")
if hasattr(env._visualizer, "wait_time"):
    env._visualizer.wait_time = 0  # it sleeps for a tenth of a second a frame otherwise
env._movie_generator = MovieGenerator(folder, "car", max_frames=1000)
agent = RandomAgent(env.action_space, num_actions=env.max_allowed_actions, seed=42)
state, _ = env.reset(seed=42)
frames = 0
for step in range(200):
    image = env.render(to_display=False)
    frames += 1
    state, reward, terminated, truncated, _ = env.step(agent.sample_action(state))
    if terminated or truncated:
        break
env._movie_generator.save_animation("car")
print(frames)
"""


def seconds(words: list, environment: dict) -> float:
    best = float("inf")
    for _ in range(REPEATS):
        process = subprocess.Popen([str(word) for word in words], env=environment,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        assert status == 0, words
        best = min(best, usage.ru_utime + usage.ru_stime)
    return best


def movies(rddl: str, folder: Path, environment: dict, with_pyrddlgym: bool) -> None:
    print(f"| the {STEPS}-step movie of MountainCar_ippc2023 1 | seconds of the processor |\n|---|---|")
    for engine in "compiled", "interpreter":
        words = [rddl, "run", "MountainCar_ippc2023", "1", "--quiet", "--engine", engine,
                 "--gif", folder / "car.gif"]
        subprocess.run([str(word) for word in words], check=True, env=environment)  # compiles it
        print(f"| rddl run --gif, {engine} | {seconds(words, environment):.2f} |")
    if with_pyrddlgym:
        words = [sys.executable, "-c", PYRDDLGYM, folder]
        environment = {**environment, "SDL_VIDEODRIVER": "dummy", "PYGAME_HIDE_SUPPORT_PROMPT": "1"}
        print(f"| pyRDDLGym, MovieGenerator | {seconds(words, environment):.2f} |")


def rates(rddl: str, folder: Path, environment: dict) -> None:
    print("\n| visualizer | frames a second |\n|---|---|")
    for shot in gallery.SHOTS:
        trace = folder / "trace.jsonl"
        subprocess.run([rddl, "run", shot.problem, shot.instance, "--engine", "interpreter",
                        "--quiet", "--horizon", str(STEPS), "--trace", str(trace)], env=environment)
        frames = len(trace.read_text().splitlines())
        words = [rddl, "render", trace, "--quiet", "--gif", folder / "movie.gif",
                 "--visualizer", shot.visualizer or shot.name]
        start = seconds([*words, "--max-frames", "1"], environment)
        spent = seconds(words, environment) - start
        print(f"| {shot.name} | {frames / spent:,.0f} |", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rddl", default=str(ROOT / "build/bin/rddl"))
    parser.add_argument("--without-pyrddlgym", action="store_true")
    arguments = parser.parse_args()
    environment = {"RDDL_REPOSITORY": gallery.repository(), **os.environ}
    with tempfile.TemporaryDirectory() as folder:
        movies(arguments.rddl, Path(folder), environment, not arguments.without_pyrddlgym)
        rates(arguments.rddl, Path(folder), environment)


if __name__ == "__main__":
    main()
