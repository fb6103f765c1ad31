"""Pictures of the general visualizers stay readable with 500 values; they are compared with those
in many_fluents/.

RDDLC_UPDATE=1 writes them again; inspect them then.
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
# Fluents of all kinds, alone and in rows and grids.
MIXED = ("alive(cell) : { state-fluent, bool, default = false }; mode(machine) : { state-fluent, colour, default = @red };"
         "queue(machine) : { state-fluent, int, default = 0 }; height(tank) : { state-fluent, real, default = 0.0 };"
         "ground(x, y) : { state-fluent, bool, default = false }; heat(x, y) : { state-fluent, real, default = 0.0 };"
         "temperature-of-the-water-outside : { state-fluent, real, default = 15.0 };"
         "season : { state-fluent, colour, default = @green }; count-of-all-visitors : { state-fluent, int, default = 0 };",
         "alive'(?c) = Bernoulli(0.3); queue'(?m) = queue(?m) + Poisson(1); height'(?t) = height(?t) + Normal(0, 1);"
         "mode'(?m) = if (Bernoulli(0.2)) then @green else if (Bernoulli(0.2)) then @blue else mode(?m);"
         "ground'(?x, ?y) = Bernoulli(0.2); heat'(?x, ?y) = heat(?x, ?y) + Normal(0, 1);"
         "temperature-of-the-water-outside' = temperature-of-the-water-outside + Normal(0, 1);"
         "season' = if (Bernoulli(0.1)) then @red else if (Bernoulli(0.1)) then @blue else season;"
         "count-of-all-visitors' = count-of-all-visitors + Poisson(10);",
         {"cell": 100, "machine": 40, "tank": 60, "x": 13, "y": 10, "colour": ["@red", "@green", "@blue"]})
# Panels of lines of the same objects.
LINES = ("".join(f"level-{k}(tank_of_the_north) : {{ state-fluent, real, default = {k}.0 }};" for k in range(20)),
         "".join(f"level-{k}'(?t) = level-{k}(?t) + Normal(0, 1);" for k in range(20)), {"tank_of_the_north": 3})
SHOTS = {"bools": (BOOLS, ["chart", "heatmap", "text"]), "numbers": (NUMBERS, ["chart", "heatmap", "text"]),
         "mixed": (MIXED, ["chart", "heatmap", "text"]), "lines": (LINES, ["chart"]),
         "grid": (GRID, ["heatmap"]), "fluents": (FLUENTS, ["chart", "heatmap", "text"])}


def problem_of(fluents: str, formulas: str, types: dict[str, int | list[str]]) -> str:
    """Types have a count of objects, or the members of an enumerated type."""
    objects = " ".join(f"{name} : {{ {', '.join(f'{name}_{k}' for k in range(1, count + 1))} }};"
                       for name, count in types.items() if isinstance(count, int))
    declared = " ".join(f"{name} : {'object' if isinstance(count, int) else '{' + ', '.join(count) + '}'};"
                        for name, count in types.items())
    return (f"domain many {{ types {{ {declared} }};"
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
        for name, visualizer in {"bools": "chart", "numbers": "chart", "grid": "heatmap", "mixed": "heatmap", "lines": "chart",
                                 "fluents": "text"}.items():
            self.assertEqual(self.draw(name, "auto"), self.draw(name, visualizer), name)


if __name__ == "__main__":
    unittest.main()
