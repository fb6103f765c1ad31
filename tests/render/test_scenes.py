"""Scene files; docs/scenes.md shows what they may hold."""

import json
import unittest

import numpy
from PIL import Image
from test_pictures import DIAGNOSED, MOST_STRONG, ROOT, SUCCESS, PictureTest, differing, gallery


class Scenes(PictureTest):
    DRAWN = {"game_of_life": ("GameOfLife_MDP_ippc2011", "8", "2"),
             "wildfire": ("Wildfire_MDP_ippc2014", "5", "6")}

    def draw(self, scene: dict | str, status=SUCCESS) -> str:
        text = scene if isinstance(scene, str) else json.dumps(scene)
        (self.folder / "scene.json").write_text(text)
        return self.run_car("--png=a.png", "--scene=scene.json", "--step=3", status=status).stderr

    def test_scenes_that_are_shipped(self):
        for name, (problem, instance, step) in self.DRAWN.items():
            self.rddl("run", problem, instance, "--engine=interpreter", "--quiet", "--png=a.png",
                      f"--step={step}", f"--scene={ROOT}/render/scenes/{name}.json",
                      f"--size={gallery.SIZE[0]}x{gallery.SIZE[1]}")
            with Image.open(self.folder / "a.png") as picture:
                now = numpy.asarray(picture.convert("RGB"), dtype=int)
            with Image.open(gallery.PICTURES.parent / f"scene_{name}.png") as picture:
                wanted = numpy.asarray(picture.convert("RGB"), dtype=int)
            self.assertLessEqual(differing(now, wanted), MOST_STRONG)

    def test_letters_of_all_scripts(self):
        """Each letter that the font has not is a box; escapes of JSON are read."""
        def drawn(text: str) -> bytes:
            self.draw({"world": {"right": 2, "top": 1},
                       "shapes": [{"shape": "text", "x": 1, "y": 0.5, "text": text}]})
            return (self.folder / "a.png").read_bytes()

        self.assertEqual(drawn("水位"), drawn("한국"))
        self.assertNotEqual(drawn("水位"), drawn("水"))
        self.assertNotEqual(drawn("ä"), drawn("水"))
        escaped = drawn("ä")  # json.dumps writes "\\u00e4"
        self.draw('{"world": {"right": 2, "top": 1},'
                  ' "shapes": [{"shape": "text", "x": 1, "y": 0.5, "text": "ä"}]}')
        self.assertEqual((self.folder / "a.png").read_bytes(), escaped)

    def test_values_of_the_state_and_action(self):
        """Circles where the state says, as large as the action says."""
        scene = {"world": {"left": -1.5, "bottom": -1, "right": 1.5, "top": 1}, "shapes": [
            {"shape": "circle", "x": "position", "y": 0, "radius": "0.1 + 0.3 * abs[throttle]",
             "color": {"if": "velocity < 0", "then": "#ff0000", "else": "#00ff00"}}]}
        self.draw(scene)
        self.run_car("--trace=t.jsonl")
        step = json.loads((self.folder / "t.jsonl").read_text().splitlines()[4])
        with Image.open(self.folder / "a.png") as picture:
            pixels = numpy.asarray(picture.convert("RGB"), dtype=int)
        color = (255, 0, 0) if step["state"]["velocity"] < 0 else (0, 255, 0)
        y, x = numpy.nonzero((pixels == color).all(axis=2))
        # The world is as high as the body of the picture: 400 - 26 - 26 - 16 points for 2 units.
        unit = 332 / 2
        self.assertAlmostEqual((x.min() + x.max()) / 2, 300 + unit * step["state"]["position"], delta=1.5)
        radius = 0.1 + 0.3 * abs(step["action"].get("throttle", 0))
        self.assertAlmostEqual((x.max() - x.min()) / 2, unit * radius, delta=1.5)

    def test_mistakes_in_expressions(self):
        world = '{"world": {"right": 1, "top": 1},\n "shapes": [{"shape": "circle", "y": 0, "radius": 1,\n  "x": "%s"}]}'
        for expression, place, complaint in (
                ("positoin", "3:9", "E02"), ("position +", "3:", "E01"), ("position 3", "3:17", "E0101"),
                ("?x", "3:8", "E0202"), ("(position", "3:", "E01"), ("", "3:", "E01"),
                ("position == @a", "3:", "E0")):
            text = self.draw(world % expression, status=DIAGNOSED)
            self.assertIn("scene.json:3:", text, expression)
            self.assertIn(complaint, text, expression)
            self.assertIn("^", text, expression)
            self.assertFalse((self.folder / "a.png").exists())

    def test_what_texts_show(self):
        """Bools and objects in words, whatever expression they are of."""
        (self.folder / "d.rddl").write_text(
            "domain d { types { o : object; colour : {@red, @green}; }; pvariables {"
            " on(o) : { state-fluent, bool, default = true }; light : { state-fluent, colour, default = @green };"
            " place(o) : { state-fluent, o }; x : { state-fluent, real, default = 1.5 };"
            " a : { action-fluent, bool, default = false }; };"
            " cpfs { on'(?o) = on(?o); light' = light; place'(?o) = place(?o); x' = x; }; reward = x; }"
            " non-fluents n { domain = d; objects { o : {o1, o2}; }; }"
            " instance i { domain = d; non-fluents = n; init-state { place(o1) = o2; place(o2) = o2; };"
            " horizon = 2; discount = 1.0; }")

        def drawn(text: str) -> bytes:
            (self.folder / "s.json").write_text(json.dumps({"world": {"right": 2}, "shapes": [
                {"shape": "text", "for": {"?o": "o"}, "x": 1, "y": "0.2 + index-o(?o) / 2", "text": text}]}))
            self.rddl("run", "d.rddl", "--engine=interpreter", "--quiet", "--png=a.png", "--scene=s.json")
            return (self.folder / "a.png").read_bytes()

        for expression, words in (("on(?o)", "true"), ("~on(?o)", "false"), ("on(?o) ^ x > 1", "true"),
                                  ("light", "green"), ("light == @red", "false"), ("place(?o)", "o2"),
                                  ("a", "false"), ("x", "1.5"), ("index-o(?o) - index-o(?o)", "0"),
                                  ("if (on(?o)) then 1 else 0", "1"), ("sum_{?p : o} [on(?p)]", "2")):
            self.assertEqual(drawn(f"is {{{expression}}}"), drawn(f"is {words}"), expression)

    def test_a_mistake_is_told_once_in_words_of_the_scene(self):
        circle = {"shape": "circle", "x": 1, "y": 1, "radius": 1}
        text = self.draw({"shapes": [{**circle, "visible": "position"}]}, status=DIAGNOSED)
        self.assertRegex(text, r"scene.json:1:\d+: error: the value of 'expression 1 of the scene' must be bool")
        text = self.draw({"shapes": [{"shape": "circle", "for": {"?w": "wheel"}, "x": "index-wheel(?w)",
                                      "y": "index-wheel(?w)", "radius": 1}]}, status=DIAGNOSED)
        self.assertEqual(text.count("wheel"), 1)
        # The other expressions are correct, and nothing is reported about them.
        text = self.draw({"shapes": [{**circle, "x": "positoin", "y": "velocity", "radius": "1 + 1"}]}, status=DIAGNOSED)
        self.assertIn("1 error\n", text)
        self.assertNotIn("warning", text)

    def test_mistakes_without_an_expression(self):
        """Members that stand beside constants only are also checked."""
        def told(**members) -> str:
            return self.draw({"world": {"right": 2, "top": 1}, "shapes": [
                {"shape": "circle", "x": 1, "y": 1, "radius": 1, **members}]}, status=DIAGNOSED)

        for type_name in "nosuch", "bool":
            self.assertIn(f"there is no type of objects '{type_name}'", told(**{"for": {"?x": type_name}}))
        self.assertIn("'outline' is true or false", told(outline="yes"))
        self.assertIn("may not be negative", told(radius=-1))

    def test_brackets_that_lie_deep(self):
        told = self.draw('{"world": ' + "[" * 1_000_000, status=DIAGNOSED)
        self.assertIn("more than 256 brackets", told)

    def test_too_much(self):
        """A scene that would take minutes is refused at once."""
        circle = {"shape": "circle", "x": "position", "y": 0, "radius": 1}
        self.assertIn("no more than 1000 expressions", self.draw({"shapes": [circle] * 1001}, status=DIAGNOSED))
        many = {**circle, "for": {f"?s{k}": "segment" for k in range(30)}}
        few = {**circle, "for": {f"?s{k}": "segment" for k in range(3)}}
        for shapes in [many], [few] * 300:
            self.assertIn("more than 100000 shapes", self.draw({"shapes": shapes}, status=DIAGNOSED))
        color = "red"
        for _ in range(100_000):
            color = '{"if": "true", "then": "blue", "else": ' + color + "}"
            if len(color) > 100_000:
                break
        text = '{"shapes": [{"shape": "circle", "x": 0, "y": 0, "radius": 1, "color": %s}]}' % color
        self.assertIn("more than 256 brackets", self.draw(text, status=DIAGNOSED))

    def test_world_without_limits(self):
        """A world without limits is from 0 to 1, whichever of these are given."""
        shape = {"shape": "circle", "x": 0.5, "y": 0.5, "radius": 0.5}
        pictures = []
        for world in {}, {"world": {}}, {"world": {"right": 1}}, {"world": {"left": 0, "bottom": 0, "right": 1, "top": 1}}:
            self.draw({**world, "shapes": [shape]})
            pictures.append((self.folder / "a.png").read_bytes())
        self.assertEqual(len(set(pictures)), 1)

    def test_align(self):
        def ink(align: str) -> tuple[int, int]:
            self.draw({"world": {"right": 2}, "shapes": [
                {"shape": "text", "x": 1, "y": 0.5, "text": "letters", "color": "#ff0000", "align": align}]})
            with Image.open(self.folder / "a.png") as picture:
                pixels = numpy.asarray(picture.convert("RGB"), dtype=int)
            x = numpy.nonzero((pixels[:, :, 0] > 200) & (pixels[:, :, 1] < 100))[1]
            return x.min(), x.max()

        self.assertGreater(ink("left")[0], 298)
        self.assertLess(ink("right")[1], 302)
        self.assertAlmostEqual(sum(ink("center")) / 2, 300, delta=4)

    def test_names_that_are_the_domains(self):
        (self.folder / "d.rddl").write_text(
            "domain d { types { o : object; }; pvariables { count-o : { non-fluent, real, default = 0.25 };"
            " x : { state-fluent, real, default = 1.0 }; a : { action-fluent, bool, default = false }; };"
            " cpfs { x' = x; }; reward = x; } non-fluents n { domain = d; objects { o : {o1, o2}; }; }"
            " instance i { domain = d; non-fluents = n; horizon = 2; discount = 1.0; }")
        (self.folder / "s.json").write_text(json.dumps({"shapes": [
            {"shape": "text", "for": {"?o": "o"}, "x": "count-o", "y": "index-o(?o) / 2", "text": "{?o}"}]}))
        self.rddl("run", "d.rddl", "--engine=interpreter", "--quiet", "--png=a.png", "--scene=s.json")

    def test_braces_within_a_text(self):
        self.draw({"world": {"right": 2, "top": 1}, "shapes": [
            {"shape": "text", "x": 1, "y": 0.5, "text": "{max_{?s: segment} [position]} in all"}]})

    def test_mistakes_in_the_file(self):
        circle = {"shape": "circle", "x": 0, "y": 0, "radius": 1}
        for scene, complaint in (
                ("{", "this is not JSON"), ("[]", "a scene is a JSON object"), ("{}", "an array 'shapes'"),
                ('{"shapes": [], "shapes": []}', "given twice"), ('{"world": {"left": 1e400}, "shapes": []}', "1e400"),
                ('{"shapes": [], "about": "\\ud800"}', "this is not JSON"),
                ({"shapes": [{}]}, "'shape' of the shape is missing"),
                ({"shapes": [{"shape": "cirle"}]}, "did you mean 'circle'?"),
                ({"shapes": [{"shape": "circle"}]}, "'x' of the circle is missing"),
                ({"shapes": [{**circle, "colour": "red"}]}, "did you mean 'color'?"),
                ({"shapes": [{**circle, "color": "vermillion"}]}, "did you mean 'vermilion'?"),
                ({"shapes": [{**circle, "color": {"if": "true"}}]}, "'then' of the color is missing"),
                ({"shapes": [{**circle, "x": True}]}, "a number, or a text"),
                ({"shapes": [{**circle, "visible": 1}]}, "a condition is a text"),
                ({"shapes": [{**circle, "for": {"x": "segment"}}]}, "a variable is '?' and a name"),
                ({"shapes": [{**circle, "for": {"?x y": "segment"}}]}, "a variable is '?' and a name"),
                ({"shapes": [{"shape": "text", "x": 0, "y": 0, "text": "a {b"}]}, "is not closed"),
                ({"shapes": [{"shape": "text", "x": 0, "y": 0, "text": "a\nb"}]}, "stands on one line"),
                ({"shapes": [{"shape": "polygon", "points": [[0, 0]]}]}, "three or more")):
            text = self.draw(scene, status=DIAGNOSED)
            self.assertRegex(text, r"scene.json:\d+:\d+: ")
            self.assertIn(complaint, text)
        self.assertIn("there is no type of objects 'wheel'", self.draw(
            {"shapes": [{**circle, "x": "1 * index-wheel(?w)", "for": {"?w": "wheel"}}]}, status=DIAGNOSED))
        self.assertIn("nothing to see of the scene's world", self.draw(
            {"world": {"left": 1, "right": 1, "top": 1}, "shapes": [circle]}, status=DIAGNOSED))
        for scene in "none.json", "/dev/zero":
            self.assertIn("cannot read", self.run_car("--png=a.png", f"--scene={scene}", status=DIAGNOSED).stderr)


if __name__ == "__main__":
    unittest.main()
