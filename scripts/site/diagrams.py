"""Draws the flowcharts of the pages as SVG. GitHub draws them itself; the site loads no program for it.

The method is that of Sugiyama, Tagawa and Toda (1981): layers by the longest path, an order in each layer by the
mean place of neighbours, and edges over several layers through places that are kept free for them.
"""

import html
import re
from collections import defaultdict
from dataclasses import dataclass, field

BLOCK = re.compile(r"^```mermaid\n(.*?)^```$", re.M | re.S)
EDGE = re.compile(r"\s*(\w+) --> (\w+)")
CHARACTER, HEIGHT, LAYER, GAP, MARGIN = 8.4, 30, 74, 22, 6  # pixels
FREE = 14  # width of the place of an edge that passes a layer
SWEEPS = 24


@dataclass
class Node:
    label: str  # empty where an edge passes
    layer: int
    above: list["Node"] = field(default_factory=list)
    below: list["Node"] = field(default_factory=list)
    x: float = 0.0

    @property
    def width(self) -> float:
        return CHARACTER * len(self.label) + 20 if self.label else FREE

    @property
    def y(self) -> float:
        return MARGIN + self.layer * LAYER


def edges_of(text: str) -> list[tuple[str, str]]:
    lines = text.splitlines()
    found = [EDGE.fullmatch(line) for line in lines[1:]]
    if lines[0] != "flowchart TD" or not all(found):
        raise ValueError(f"the site draws flowcharts of lines 'a --> b' alone: {lines}")
    return [(edge[1], edge[2]) for edge in found if edge]


def layers_of(edges: list[tuple[str, str]]) -> dict[str, int]:
    """Returns the length of the longest path to each name. Names without edges to them stand just above the next."""
    layer = {name: 0 for edge in edges for name in edge}
    for _ in layer:
        for source, target in edges:
            layer[target] = max(layer[target], layer[source] + 1)
    if max(layer.values()) >= len(layer):
        raise ValueError("the site draws no circles")
    for source in set(layer) - {target for _, target in edges}:
        layer[source] = min(layer[target] for start, target in edges if start == source) - 1
    return layer


def graph_of(edges: list[tuple[str, str]]) -> list[list[Node]]:
    """Returns the nodes of each layer, with those where an edge passes."""
    nodes = {name: Node(name, layer) for name, layer in layers_of(edges).items()}
    rows: list[list[Node]] = [[] for _ in range(1 + max(node.layer for node in nodes.values()))]
    for node in nodes.values():
        rows[node.layer].append(node)
    for source, target in edges:
        upper = nodes[source]
        for layer in range(upper.layer + 1, nodes[target].layer + 1):
            lower = nodes[target] if layer == nodes[target].layer else Node("", layer)
            if not lower.label:
                rows[layer].append(lower)
            upper.below.append(lower)
            lower.above.append(upper)
            upper = lower
    return rows


def mean(nodes: list[Node], otherwise: float) -> float:
    return sum(node.x for node in nodes) / len(nodes) if nodes else otherwise


def spread(row: list[Node], wanted: list[float]) -> None:
    """Moves the nodes of a row to the wanted places, as far as they do not overlap."""
    def apart(left: Node, right: Node) -> float:
        return (left.width + right.width) / 2 + GAP
    to_right, to_left = list(wanted), list(wanted)
    for k in range(1, len(row)):
        to_right[k] = max(to_right[k], to_right[k - 1] + apart(row[k - 1], row[k]))
    for k in reversed(range(len(row) - 1)):
        to_left[k] = min(to_left[k], to_left[k + 1] - apart(row[k], row[k + 1]))
    for k, node in enumerate(row):
        node.x = (to_right[k] + to_left[k]) / 2


def arrange(rows: list[list[Node]]) -> None:
    """Gives each node its x, in several sweeps down and up."""
    for row in rows:
        spread(row, [0.0] * len(row))
    for sweep in range(SWEEPS):
        down = sweep % 2 == 0
        for row in rows if down else reversed(rows):
            wanted = {id(node): mean(node.above if down else node.below, node.x) for node in row}
            row.sort(key=lambda node: wanted[id(node)])
            spread(row, [wanted[id(node)] for node in row])
    for row in rows:
        spread(row, [mean([*node.above, *node.below], node.x) for node in row])
    left = min(node.x - node.width / 2 for row in rows for node in row) - MARGIN
    for row in rows:
        for node in row:
            node.x -= left


def path(upper: Node, lower: Node) -> str:
    """Draws an edge down to a named node, through the places that are free for it."""
    points, at = [(upper.x, upper.y + HEIGHT)], lower
    while not at.label:
        points += [(at.x, at.y), (at.x, at.y + HEIGHT)]
        at = at.below[0]
    points.append((at.x, at.y - 3))
    text = f"M{points[0][0]:.0f} {points[0][1]:.0f}"
    for k, (x, y) in enumerate(points[1:]):
        x0, y0 = points[k]
        middle = (y0 + y) / 2
        text += f"C{x0:.0f} {middle:.0f} {x:.0f} {middle:.0f} {x:.0f} {y:.0f}"
    return f'<path d="{text}" marker-end="url(#head)"/>'


def svg(text: str) -> str:
    """Returns a flowchart as SVG, in the colours of the page around it."""
    edges = edges_of(text)
    rows = graph_of(edges)
    arrange(rows)
    named = [node for row in rows for node in row if node.label]
    width = max(node.x + node.width / 2 for row in rows for node in row) + MARGIN
    height = MARGIN + len(rows) * LAYER - (LAYER - HEIGHT) + MARGIN
    words: dict[str, list[str]] = defaultdict(list)
    for source, target in edges:
        words[source].append(target)
    label = html.escape("; ".join(f"{source} uses {', '.join(targets)}" for source, targets in words.items()))
    boxes = [f'<rect x="{node.x - node.width / 2:.0f}" y="{node.y:.0f}" width="{node.width:.0f}" height="{HEIGHT}" rx="5"/>'
             for node in named]
    names = [f'<text x="{node.x:.0f}" y="{node.y + 20:.0f}">{html.escape(node.label)}</text>' for node in named]
    lines = [path(node, lower) for node in named for lower in node.below]
    return "\n".join([
        f'<figure class="diagram"><svg role="img" aria-label="{label}" viewBox="0 0 {width:.0f} {height:.0f}" width="{width:.0f}">',
        '<defs><marker id="head" viewBox="0 0 8 8" refX="6" refY="4" markerWidth="7" markerHeight="7" orient="auto">'
        '<path d="M0 0L8 4L0 8z"/></marker></defs>',
        '<g class="lines">', *lines, "</g>", '<g class="boxes">', *boxes, "</g>", '<g class="names">', *names, "</g>",
        "</svg></figure>"])


def drawn(page: str) -> str:
    """Returns a page with pictures in place of its flowcharts."""
    return BLOCK.sub(lambda block: svg(block[1]), page)
