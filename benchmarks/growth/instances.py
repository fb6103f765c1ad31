"""Instances of any size of the domains in this folder, whose tables are sparse: a few entries an object.

    python instances.py network 1000 > instance.rddl
"""

import random
import sys
from dataclasses import dataclass

SHAPES = {10: (2, 5), 100: (10, 10), 1000: (25, 40), 10000: (100, 100)}  # of the grids


@dataclass
class Instance:
    text: str
    entries: int  # of its tables that are not zero


def network(count: int) -> Instance:
    """A ring with as many more connections at random: four neighbours each."""
    draw = random.Random(count)
    names = [f"c{i}" for i in range(count)]
    pairs = {(i, (i + 1) % count) for i in range(count)}
    while len(pairs) < 2 * count:
        i, j = draw.sample(range(count), 2)
        if (j, i) not in pairs:
            pairs.add((i, j))
    both = sorted(pairs | {(j, i) for i, j in pairs})
    entries = [f"CONNECTED({names[i]}, {names[j]});" for i, j in both]
    return instance("network", {"computer": names}, entries, len(entries))


def fire(count: int) -> Instance:
    width, height = SHAPES[count]
    cells = [(x, y) for x in range(width) for y in range(height)]
    around = [(dx, dy) for dx in (-1, 0, 1) for dy in (-1, 0, 1) if (dx, dy) != (0, 0)]
    entries = [
        f"NEIGHBOR(x{x}, y{y}, x{x + dx}, y{y + dy});"
        for x, y in cells
        for dx, dy in around
        if 0 <= x + dx < width and 0 <= y + dy < height
    ]
    objects = {"x_pos": [f"x{x}" for x in range(width)], "y_pos": [f"y{y}" for y in range(height)]}
    start = [f"burning(x{width // 2}, y{height // 2});"]
    return instance("fire", objects, entries, len(entries), start)


def recommender(count: int) -> Instance:
    """Half of the objects are consumers, the others items; a consumer likes four items."""
    draw = random.Random(count)
    half = count // 2
    entries = [
        f"LIKES(c{c}, i{i}) = {draw.uniform(0.1, 1.0):.3f};"
        for c in range(half)
        for i in draw.sample(range(half), min(4, half))
    ]
    objects = {"consumer": [f"c{c}" for c in range(half)], "item": [f"i{i}" for i in range(half)]}
    return instance("recommender", objects, entries, len(entries))


def instance(domain: str, objects: dict[str, list[str]], entries: list[str], count: int, start=()) -> Instance:
    object_lines = "\n".join(f"        {name} : {{ {', '.join(names)} }};" for name, names in objects.items())
    initial = f"    init-state {{ {' '.join(start)} }};\n" if start else ""
    lines = "\n".join(f"        {entry}" for entry in entries)
    text = f"""non-fluents tables {{
    domain = {domain};
    objects {{
{object_lines}
    }};
    non-fluents {{
{lines}
    }};
}}

instance {domain}_instance {{
    domain = {domain};
    non-fluents = tables;
{initial}    max-nondef-actions = 1;
    horizon = 40;
    discount = 1.0;
}}
"""
    return Instance(text, count)


GENERATORS = {"network": network, "fire": fire, "recommender": recommender}

if __name__ == "__main__":
    print(GENERATORS[sys.argv[1]](int(sys.argv[2])).text, end="")
