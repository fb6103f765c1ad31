#!/usr/bin/env python3
"""Makes docs/gallery.md and its pictures, one for each visualizer; tests/render compares with them.

    .venv/bin/python scripts/gallery.py [--rddl build/bin/rddl] [NAME...]
"""

import argparse
import os
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PICTURES = ROOT / "docs/images/gallery"
SIZE = 480, 320


@dataclass(frozen=True)
class Shot:
    """A state of an episode of random actions with seed 0."""
    name: str
    problem: str
    instance: str
    step: int
    visualizer: str = ""
    options: list = field(default_factory=list, hash=False)


SHOTS = [
    Shot("chart", "HVAC_ippc2023", "7", 90, "chart"),
    Shot("chart_of_many", "SysAdmin_MDP_ippc2011", "10", 30, "chart"),
    Shot("heatmap", "CooperativeRecon_MDP_ippc2011", "3", 12, "heatmap"),
    Shot("text", "Manufacturer_ippc2018", "1", 5, "text"),
    Shot("auto", "BinPacking_or", "0", 12, "auto"),
    Shot("acrobot", "Acrobot_gym", "0", 30),
    Shot("cart_pole", "CartPole_Discrete_gym", "0", 7),
    Shot("crossing_traffic", "CrossingTraffic_MDP_ippc2011", "7", 5),
    Shot("elevators", "Elevators_MDP_ippc2011", "5", 20),
    Shot("elevators_counted", "Elevators", "0", 30),
    Shot("game_of_life", "GameOfLife_MDP_ippc2011", "8", 2),
    Shot("hvac", "HVAC_ippc2023", "3", 10),
    Shot("hvac_air", "HVAC", "1", 5),
    Shot("intruders", "Intruders_Continuous", "0", 15),
    Shot("intruders_grid", "Intruders_Discrete", "0", 5),
    Shot("mars_rover", "MarsRover_ippc2023", "3", 30),
    Shot("mountain_car", "MountainCar_ippc2023", "3", 20),
    Shot("navigation", "Navigation_Continuous", "0", 10),
    Shot("navigation_grid", "Navigation_MDP_ippc2011", "3", 2),
    Shot("network", "SysAdmin_MDP_ippc2011", "5", 9),
    Shot("pendulum", "Pendulum_gym", "0", 20),
    Shot("pong", "Pong_arcade", "0", 15),
    Shot("power_gen", "PowerGen_ippc2023", "3", 10),
    Shot("quadcopter", "Quadcopter_physics", "1", 60),
    Shot("race_car", "RaceCar_ippc2023", "3", 60),
    Shot("reacher", "Reacher_physics", "1", 40),
    Shot("recommender", "RecSim_ippc2023", "3", 20),
    Shot("reservoir", "Reservoir_ippc2023", "2", 20),
    Shot("sliding_squares", "Eight_arcade", "1", 5),
    Shot("sokoban", "Sokoban_arcade", "0", 3),
    Shot("sudoku", "Sudoku_arcade", "1", 5),
    Shot("tetris", "Tetris_arcade", "0", 3),
    Shot("tower_of_hanoi", "TowerOfHanoi_arcade", "0", 7),
    Shot("traffic", "TrafficBLX_SimplePhases", "0", 60),
    Shot("traffic_cells", "Traffic_MDP_ippc2014", "5", 8),
    Shot("uav", "UAV_ippc2023", "3", 40),
    Shot("wildfire", "Wildfire_MDP_ippc2014", "5", 6),
]


def repository() -> str:
    import rddlrepository
    return rddlrepository.__path__[0]


def draw(shot: Shot, rddl: str, path: Path) -> None:
    words = [rddl, "run", shot.problem, shot.instance, "--engine", "interpreter", "--quiet",
             "--seed", "0", "--png", str(path), "--step", str(shot.step),
             "--size", f"{SIZE[0]}x{SIZE[1]}", *shot.options]
    if shot.visualizer:
        words += ["--visualizer", shot.visualizer]
    environment = {"RDDL_REPOSITORY": repository(), **os.environ}
    done = subprocess.run(words, env=environment, text=True, capture_output=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(words)}\n{done.stderr}")


def summaries(rddl: str) -> dict[str, str]:
    """Returns the description of each visualizer."""
    text = subprocess.run([rddl, "render", "-", "--visualizer", "list"], text=True, check=True,
                          capture_output=True).stdout
    return dict(line.split(maxsplit=1) for line in text.splitlines())


def draw_scenes(rddl: str) -> None:
    """Draws the scenes that are shipped, for docs/scenes.md; their states are those of the
    visualizers."""
    for shot in SHOTS:
        scene = ROOT / f"render/scenes/{shot.name}.json"
        if scene.exists():
            with_scene = Shot(shot.name, shot.problem, shot.instance, shot.step,
                              options=["--scene", str(scene)])
            draw(with_scene, rddl, PICTURES.parent / f"scene_{shot.name}.png")


INTRODUCTION = """# Gallery

One picture for each visualizer, of episodes of random actions ([pictures](pictures.md) says how to
make them). `scripts/gallery.py` makes this page and its pictures; `tests/render` compares them.
"""


def page(rddl: str) -> str:
    told = summaries(rddl)
    lines = [INTRODUCTION]
    for shot in SHOTS:
        name = shot.visualizer or shot.name
        option = f" --visualizer {shot.visualizer}" if shot.visualizer else ""
        lines += [f"## {name}: {told[name]}", "",
                  f"![{shot.problem} {shot.instance}, step {shot.step}](images/gallery/{shot.name}.png)", "",
                  f"`rddl run {shot.problem} {shot.instance}{option} --gif movie.gif`", ""]
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rddl", default=str(ROOT / "build/bin/rddl"))
    parser.add_argument("names", nargs="*", help="of pictures; all if there is none")
    arguments = parser.parse_args()
    PICTURES.mkdir(parents=True, exist_ok=True)
    for shot in SHOTS:
        if not arguments.names or shot.name in arguments.names:
            draw(shot, arguments.rddl, PICTURES / f"{shot.name}.png")
            print(shot.name)
    (ROOT / "docs/gallery.md").write_text(page(arguments.rddl))
    draw_scenes(arguments.rddl)


if __name__ == "__main__":
    main()
