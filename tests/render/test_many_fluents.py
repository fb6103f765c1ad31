"""States of 500 values can be read: pictures of the general visualizers, compared with those in many_fluents/.

RDDLC_UPDATE=1 writes them anew; look at them then.
"""

import os
import unittest
from pathlib import Path

import numpy
from PIL import Image
from test_pictures import MOST_STRONG, PictureTest, differing

WANTED = Path(__file__).parent / "many_fluents"

# Each its state-fluents, their formulas, and how many objects each type has.
BOOLS = ("alive(cell) : { state-fluent, bool, default = false };", "alive'(?c) = Bernoulli(0.3);", {"cell": 500})
NUMBERS = ("water(reservoir_in_the_north) : { state-fluent, real, default = 0.0 };",
           "water'(?r) = water(?r) + Normal(0, 1);", {"reservoir_in_the_north": 500})
GRID = ("heat(x, y) : { state-fluent, real, default = 0.0 };", "heat'(?x, ?y) = Normal(0, 1);", {"x": 4, "y": 125})
FLUENTS = ("".join(f"level-{k}(tank) : {{ state-fluent, real, default = {k}.0 }};"
                   f"is-open-{k}(tank) : {{ state-fluent, bool, default = false }};" for k in range(25)),
           "".join(f"level-{k}'(?t) = level-{k}(?t) + Normal(0, 1); is-open-{k}'(?t) = Bernoulli(0.5);"
                   for k in range(25)), {"tank": 10})
SHOTS = {"bools": (BOOLS, ["chart", "heatmap", "text"]), "numbers": (NUMBERS, ["chart", "heatmap", "text"]),
         "grid": (GRID, ["heatmap"]), "fluents": (FLUENTS, ["chart", "heatmap", "text"])}


def problem_of(fluents: str, formulas: str, types: dict[str, int]) -> str:
    objects = " ".join(f"{name} : {{ {', '.join(f'{name}_{k}' for k in range(1, count + 1))} }};"
                       for name, count in types.items())
    return (f"domain many {{ types {{ {' '.join(f'{name} : object;' for name in types)} }};"
            f" pvariables {{ {fluents} act : {{ action-fluent, bool, default = false }}; }};"
            f" cpfs {{ {formulas} }}; reward = 0; }}"
            f" non-fluents many_objects {{ domain = many; objects {{ {objects} }}; }}"
            " instance many_1 { domain = many; non-fluents = many_objects; horizon = 60; discount = 1.0; }")


class ManyFluents(PictureTest):
    def draw(self, name: str, visualizer: str) -> Image.Image:
        (self.folder / "many.rddl").write_text(problem_of(*SHOTS[name][0]))
        self.rddl("run", "many.rddl", "--engine=interpreter", "--quiet", "--policy=noop", "--step=40", "--png=a.png",
                  f"--visualizer={visualizer}")
        with Image.open(self.folder / "a.png") as picture:
            return picture.convert("RGB")

    def test_pictures(self):
        for name, (_, visualizers) in SHOTS.items():
            for visualizer in visualizers:
                with self.subTest(name, visualizer=visualizer):
                    now = self.draw(name, visualizer)
                    wanted = WANTED / f"{name}_{visualizer}.png"
                    if os.environ.get("RDDLC_UPDATE"):
                        now.quantize(256).save(wanted, optimize=True)
                    with Image.open(wanted) as picture:
                        before = numpy.asarray(picture.convert("RGB"), dtype=int)
                    self.assertLessEqual(differing(numpy.asarray(now, dtype=int), before), MOST_STRONG)

    def test_auto(self):
        """Rows of cells over time, a grid, and words."""
        for name, visualizer in {"bools": "chart", "numbers": "chart", "grid": "heatmap", "fluents": "text"}.items():
            self.assertEqual(self.draw(name, "auto"), self.draw(name, visualizer), name)


if __name__ == "__main__":
    unittest.main()
