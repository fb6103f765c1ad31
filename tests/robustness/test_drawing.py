"""Pictures of every example, and of traces and scenes that are broken, of odd numbers and of odd sizes."""

import json
import random
import unittest

from commands import EXAMPLES, RDDL, SUCCESS, CommandTest

ODD_VALUES = ['"nan"', '"inf"', '"-inf"', "1e308", "-1e308", "1e-308", "-1", "99999999999", "null", '"a"', "[]"]
ODD_EXPRESSIONS = ["1 / 0", "(velocity - velocity) / 0", "-pow[10, 300]", 1e300, 0, "sqrt[-1]", "exp[1000]", "Normal(0, 1)"]


class DrawingTest(CommandTest):
    def setUp(self) -> None:
        super().setUp()
        listed = self.run_command(RDDL, "run", "x", "--visualizer=list")
        if "built without pictures" in listed.errors:
            self.skipTest("rddl was built without pictures")

    def make_trace(self, example, *options) -> list[str]:
        self.assertEqual(self.run_command(
            RDDL, "run", example / "domain.rddl", example / "instance.rddl", "--engine=interpreter", "--quiet",
            "--horizon=4", "--trace=t.jsonl", *options).status, SUCCESS)
        return (self.folder / "t.jsonl").read_text().splitlines()

    def render(self, *words):
        """Whatever becomes of it, no file is there by half."""
        for name in "a.gif", "a.png", "a.svg", "a.html":
            (self.folder / name).unlink(missing_ok=True)
        result = self.run_command(RDDL, "render", *words, "--quiet")
        for path in self.folder.glob("a.*"):
            self.assertTrue(self.is_whole(path), f"{words}\n{path}")
        return result

    @staticmethod
    def is_whole(path) -> bool:
        ends = {".gif": b"\x3b", ".png": b"IEND\xaeB`\x82", ".svg": b"</svg>\n", ".html": b"</html>\n"}
        return path.read_bytes().endswith(ends[path.suffix])


class Pictures(DrawingTest):
    EVERYTHING = "--gif=a.gif", "--png=a.png", "--svg=a.svg", "--html=a.html", "--watch"

    def test_examples(self):
        for example in EXAMPLES:
            functions = example / "functions.hpp"
            external = ["--extern", functions] if functions.exists() else []
            self.make_trace(example, *external, *self.EVERYTHING)
            for visualizer, size in ("chart", "300x200"), ("heatmap", "16x16"), ("text", "16x300"):
                with self.subTest(example.name, visualizer=visualizer):
                    result = self.render("t.jsonl", *external, "--gif=a.gif", "--svg=a.svg",
                                         f"--visualizer={visualizer}", f"--size={size}")
                    self.assertEqual(result.status, SUCCESS, result)

    def test_odd_values(self):
        for name in "cart_pole", "mountain_car", "reservoir":
            header, *lines = self.make_trace(next(e for e in EXAMPLES if e.name == name))
            for odd in ODD_VALUES if name == "cart_pole" else ODD_VALUES[:4]:
                with self.subTest(name, odd=odd):
                    step = json.loads(lines[2])
                    step["state"] = {fluent: "ODD" for fluent in step["state"]}
                    odd_line = json.dumps(step).replace('"ODD"', odd)
                    self.write("odd.jsonl", "\n".join([header, *lines[:2], odd_line, *lines[3:]]) + "\n")
                    for visualizer in [], ["--visualizer=chart"]:
                        result = self.render("odd.jsonl", "--gif=a.gif", "--html=a.html", "--size=60x40", *visualizer)
                        if "nan" in odd or "inf" in odd:
                            self.assertEqual(result.status, SUCCESS, result)

    def test_cut_and_changed_traces(self):
        text = ("\n".join(self.make_trace(EXAMPLES[0])) + "\n").encode()
        dice = random.Random(2)
        for length in range(0, len(text), len(text) // 8):
            self.write("odd.jsonl", text[:length])
            self.render("odd.jsonl", "--gif=a.gif", "--png=a.png", "--size=60x40")
            self.render("t.jsonl", "--beside=odd.jsonl", "--html=a.html", "--size=60x40")
        for _ in range(10):
            changed = bytearray(text)
            for _ in range(dice.choice((1, 1, 3))):
                place = dice.randrange(len(changed))
                changed[place:place + dice.choice((0, 1, 9))] = bytes(dice.choices(b'{}[]",:0e-.\\\0\xff', k=2))
            self.write("odd.jsonl", bytes(changed))
            self.render("odd.jsonl", EXAMPLES[0] / "domain.rddl", EXAMPLES[0] / "instance.rddl", "--gif=a.gif",
                        "--html=a.html", "--size=60x40")


class SceneFiles(DrawingTest):
    def test_odd_numbers(self):
        self.make_trace(next(e for e in EXAMPLES if e.name == "mountain_car"))
        world = {"left": -1, "bottom": -1, "right": 1, "top": 1}
        for x in ODD_EXPRESSIONS:
            told = "{position} {%s} 水位" % (x if isinstance(x, str) else "velocity")
            shapes = [{"shape": "circle", "x": x, "y": 0, "radius": 1},
                      {"shape": "circle", "x": 0, "y": 0, "radius": x},
                      {"shape": "rectangle", "left": x, "bottom": 0, "right": 1, "top": x},
                      {"shape": "text", "x": x, "y": 0, "text": told, "size": x},
                      {"shape": "polygon", "points": [[x, 0], [0, x], [1, 1]]},
                      {"shape": "cell", "column": x, "row": 0, "outline": True},
                      {"shape": "line", "x1": x, "y1": 0, "x2": 0, "y2": x, "thickness": x},
                      {"shape": "circle", "x": 0, "y": 0, "radius": 1, "color": {"scale": x, "low": 0, "high": 0}}]
            self.write("scene.json", json.dumps({"world": world, "shapes": shapes}))
            result = self.render("t.jsonl", "--scene=scene.json", "--png=a.png", "--svg=a.svg")
            self.assertEqual(result.status, SUCCESS, f"{x}\n{result}")
            self.write("scene.json", json.dumps({"world": dict.fromkeys(world, x), "shapes": shapes}))
            self.render("t.jsonl", "--scene=scene.json", "--png=a.png")

    def test_changed_bytes(self):
        self.make_trace(next(e for e in EXAMPLES if e.name == "network"))
        text = (b'{"world": {"left": -1, "right": "count-computer", "top": 2},\n'
                b' "shapes": [{"shape": "circle", "for": {"?c": "computer"}, "x": "index-computer(?c)", "y": 1,\n'
                b'   "radius": 0.2, "visible": "running(?c) | exists_{?d : computer} [LINK(?c, ?d)]",\n'
                b'   "color": {"if": "running(?c)", "then": "green", "else": "#102030"}}]}')
        dice = random.Random(3)
        for _ in range(40):
            changed = bytearray(text)
            for _ in range(dice.choice((0, 1, 1, 3))):
                place = dice.randrange(len(changed))
                changed[place:place + dice.choice((0, 1, 9))] = bytes(dice.choices(b'{}[]",:0e?()\\\0\xff', k=1))
            self.write("scene.json", bytes(changed))
            self.render("t.jsonl", "--scene=scene.json", "--png=a.png")


if __name__ == "__main__":
    unittest.main()
