"""Draws what the other programs measured into docs/images/, for docs/benchmarks.md.

    .venv/bin/python benchmarks/plots.py [--results build/benchmarks] [--images docs/images]
"""

import argparse
import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402

from bench import geometric_mean  # noqa: E402
from compare import Comparison  # noqa: E402
from document import ROOT  # noqa: E402

STYLE = {
    "figure.dpi": 110,
    "font.size": 10,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.alpha": 0.3,
    "legend.frameon": False,
}
BATCH_COLOUR, SINGLE_COLOUR, LIMIT_COLOUR = "tab:blue", "tab:orange", "0.5"


def draw_speed_by_problem(results: Path):
    """Ratios to pyRDDLGym, each instance a point, in order of the ratio in a batch."""
    lines = (results / "compare.jsonl").read_text().splitlines()
    comparisons = sorted((Comparison(**json.loads(line)) for line in lines), key=lambda c: c.batch_ratio)
    figure, axes = plt.subplots(figsize=(9, 4.5))
    places = range(1, len(comparisons) + 1)
    for name, ratio, colour in (
        ("batch", "batch_ratio", BATCH_COLOUR),
        ("one environment", "single_ratio", SINGLE_COLOUR),
    ):
        ratios = [getattr(comparison, ratio) for comparison in comparisons]
        mean = geometric_mean(ratios)
        axes.plot(places, ratios, "o", markersize=3, color=colour, label=f"{name}: geometric mean {mean:,.0f}")
        axes.axhline(mean, color=colour, linewidth=1)
    axes.axhline(50, color=LIMIT_COLOUR, linewidth=1, linestyle="--", label="the least that is asked for: 50")
    axes.set_yscale("log")
    axes.set_xlabel("instances of all problems, in order of the ratio in a batch")
    axes.set_ylabel("steps/s, as multiples of pyRDDLGym's")
    axes.legend(loc="upper left")
    return figure


def draw_growth(results: Path):
    points = json.loads((results / "growth.json").read_text())
    figure, axes = plt.subplots(figsize=(7, 4.5))
    for domain in dict.fromkeys(point["domain"] for point in points):
        of_domain = [point for point in points if point["domain"] == domain]
        xs = [point["objects"] for point in of_domain]
        axes.plot(xs, [point["seconds"] * 1e6 for point in of_domain], "o-", label=domain)
    draw_slopes(axes, points)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("objects")
    axes.set_ylabel("microseconds a step, one environment")
    axes.legend()
    return figure


def draw_slopes(axes, points: list[dict]) -> None:
    """Draws growth by the number of objects, and by its square, for comparison."""
    least, most = (bound(point["objects"] for point in points) for bound in (min, max))
    start = min(point["seconds"] for point in points) * 1e6
    for power, style, name in ((1, "--", "linear"), (2, ":", "quadratic")):
        end = start * (most / least) ** power
        axes.plot([least, most], [start, end], style, color=LIMIT_COLOUR, label=name)
    axes.set_ylim(start / 2, max(point["seconds"] for point in points) * 1e6 * 20)


def draw_batches(results: Path):
    problems = json.loads((results / "batches.json").read_text())
    figure, all_axes = plt.subplots(2, 3, figsize=(10, 5.5), sharex=True)
    for axes, figures in zip(all_axes.flat, problems):
        measurements = figures["measurements"]
        for lanes, threads in sorted({(m["lanes"], m["threads"]) for m in measurements}):
            chosen = [m for m in measurements[1:] if (m["lanes"], m["threads"]) == (lanes, threads)]
            xs, ys = ([m[key] for m in chosen] for key in ("environments", "steps_per_second"))
            label = f"{lanes} lane{'s' if lanes > 1 else ''}, {threads} thread{'s' if threads > 1 else ''}"
            axes.plot(xs, [y / 1e6 for y in ys], "o-", markersize=3, label=label)
        axes.set_title(figures["problem"], fontsize=9)
        axes.set_xscale("log")
        axes.set_xticks([1, 16, 256, 4096], ["1", "16", "256", "4,096"])
        axes.minorticks_off()
        axes.margins(y=0.1)
        axes.set_ylim(bottom=0)
    figure.legend(*all_axes[0][0].get_legend_handles_labels(), loc="outside upper center", ncols=4)
    figure.supxlabel("environments in the batch")
    figure.supylabel("million steps/s")
    return figure


PLOTS = {
    "speed-by-problem": ("compare.jsonl", draw_speed_by_problem),
    "growth": ("growth.json", draw_growth),
    "batches": ("batches.json", draw_batches),
}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--results", type=Path, default=ROOT / "build/benchmarks", help="folder of the figures")
    parser.add_argument("--images", type=Path, default=ROOT / "docs/images", help="folder of the pictures")
    options = parser.parse_args()
    options.images.mkdir(parents=True, exist_ok=True)
    for name, (source, draw) in PLOTS.items():
        if not (options.results / source).exists():
            print(f"{name}: there is no {options.results / source} yet")
            continue
        with plt.rc_context(STYLE):
            figure = draw(options.results)
            figure.set_layout_engine("constrained")
            figure.savefig(options.images / f"{name}.png")
            plt.close(figure)
        print(f"written: {options.images / name}.png")
    return 0


if __name__ == "__main__":
    sys.exit(main())
