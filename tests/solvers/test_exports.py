"""Policies that rddl exports act as they do in rddl: by the Python reader, as Python, as C++ and as ONNX.

    test_exports.py --rddl PROGRAM --examples FOLDER --cxx COMPILER --cache FOLDER
"""

import argparse
import importlib.util
import json
import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree
from pathlib import Path

import onnx_reader

ROOT = Path(__file__).resolve().parents[2]


def load(name, path):
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    sys.dont_write_bytecode = True
    spec.loader.exec_module(module)
    return module


def check_picture(svg, dot):
    """The picture is XML, and has the boxes and lines of the graph for Graphviz, within its borders."""
    root = xml.etree.ElementTree.fromstring(svg)
    parts = lambda name: root.findall(f"{{http://www.w3.org/2000/svg}}{name}")
    width, height = float(root.get("width")), float(root.get("height"))
    labels = re.findall(r'^    [to]\d+ \[label="(.*?)", shape', dot, re.MULTILINE)
    assert len(parts("text")) == len(labels) > 1, (svg, dot)
    assert "throttle" in [text.text for text in parts("text")]
    assert len(parts("path")) == dot.count("->")
    for box in parts("rect")[1:]:
        x, y = float(box.get("x")), float(box.get("y"))
        assert 0 < x < x + float(box.get("width")) < width and 0 < y < y + float(box.get("height")) < height, svg


def trained(rddl, folder, *words):
    """Trains, runs an episode, and returns the state and the action of each of its steps."""
    rddl("train", *words, "--quiet", "--out", str(folder / "run"))
    rddl("run", "--policy", str(folder / "run"), "--trace", str(folder / "trace.jsonl"), "--quiet")
    steps = [json.loads(line) for line in (folder / "trace.jsonl").read_text().splitlines()[1:]]
    assert steps
    # Traces leave out defaults.
    return [(step["step"], step["state"], step["action"].get("throttle", 0.0)) for step in steps]


def check_formula(rddl, folder):
    """Checks formulas of CGP. Returns the number of steps in which the export and rddl agree."""
    steps = trained(rddl, folder, "cgp", "--gens", "40")
    rddl("export", "--policy", str(folder / "run"), "--as", "py", "-o", str(folder / "formula.py"))
    formula = load("formula", folder / "formula.py")
    check_picture(rddl("export", "--policy", str(folder / "run"), "--as", "svg"),
                  rddl("export", "--policy", str(folder / "run"), "--as", "dot"))
    for number, state, action in steps:
        found = max(-1.0, min(1.0, formula.act([state[n] for n in formula.INPUTS])[0]))
        assert abs(found - action) < 1e-5, (number, found)
    return len(steps)


def check_network(rddl, folder, cxx, *options):
    """Checks networks of PPO, trained with these options. Returns the number of steps in which the
    export and rddl agree."""
    steps = trained(rddl, folder, "ppo", "--steps", "20000", "--envs", "16", "--rollout", "64", "--minibatch", "256",
                    *options)
    network = load("policy", ROOT / "solvers/python/policy.py").Policy(folder / "run/policy.json")
    for number, state, action in steps:
        found = network.act(state, number)["throttle"]
        # Floats there, doubles here.
        assert abs(found - action) < 1e-5, (number, found)

    rddl("export", "--policy", str(folder / "run"), "--as", "cpp", "-o", str(folder / "network.hpp"))
    remembers = "--recurrent" in options
    (folder / "main.cpp").write_text(
        '#include "network.hpp"\n#include <cstdio>\nint main() {\n    float x[policy::feature_count], y[1];\n'
        f'{"    float memory[policy::memory_count] = {};" if remembers else ""}\n'
        '    while (std::scanf("%f %f %f", x, x + 1, x + 2) == 3) {\n'
        f'        policy::act(x, {"memory, " if remembers else ""}y);\n'
        '        std::printf("%.9g\\n", double(y[0]));\n    }\n}\n')
    subprocess.run([cxx, "-std=c++17", "-Wall", "-Wextra", "-Werror", "-o", folder / "main", folder / "main.cpp"],
                   check=True)
    rows = [network.features(state, number) for number, state, _ in steps]
    text = "\n".join(" ".join(f"{x:.9g}" for x in row) for row in rows)
    out = subprocess.run([folder / "main"], input=text, check=True, capture_output=True, text=True).stdout.split()
    assert len(out) == len(steps)
    for found, (number, _, action) in zip(out, steps):
        assert abs(max(-1.0, min(1.0, float(found))) - action) < 1e-5, (number, found, action)

    rddl("export", "--policy", str(folder / "run"), "--as", "onnx", "-o", str(folder / "network.onnx"))
    graph = onnx_reader.Graph((folder / "network.onnx").read_bytes())
    assert graph.inputs == ["features"] + ["memory"] * remembers, graph.inputs
    assert graph.outputs == ["outputs"] + ["next_memory"] * remembers, graph.outputs
    memory = [0.0] * int(options[options.index("--recurrent") + 1]) if remembers else []
    for row, (number, _, action) in zip(rows, steps):
        results = graph.run({"features": [row], "memory": [memory]})
        memory = results["next_memory"][0] if remembers else []
        assert abs(max(-1.0, min(1.0, results["outputs"][0][0])) - action) < 1e-5, (number, results, action)
    return len(steps)


def check_choices(rddl, folder):
    """Checks PPO where one bool of a group changes at a time. Returns the number of steps that
    agree with the reader."""
    rddl("train", "ppo", "--engine", "interpreter", "--steps", "4000", "--envs", "16", "--rollout", "32", "--minibatch",
         "128", "--quiet", "--out", str(folder / "run"))
    rddl("run", "--engine", "interpreter", "--policy", str(folder / "run"), "--trace", str(folder / "trace.jsonl"),
         "--quiet")
    policy = load("policy", ROOT / "solvers/python/policy.py").Policy(folder / "run/policy.json")
    assert any("group" in head for head in policy.file["action"]["categories"])
    steps = [json.loads(line) for line in (folder / "trace.jsonl").read_text().splitlines()[1:]]
    in_traces = lambda name: name.replace("(", "___").replace(", ", "__").replace(")", "")
    seen = [column["name"] for column in policy.file["observation"]["space"]["columns"]]
    for step in steps:
        action = policy.act({name: step["state"][in_traces(name)] for name in seen}, step["step"])
        assert {in_traces(name) for name, value in action.items() if value} == set(step["action"]), (step, action)
    changed = {name for step in steps for name in step["action"]}
    assert changed, steps
    return len(steps)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--rddl", required=True)
    parser.add_argument("--examples", type=Path, required=True)
    parser.add_argument("--cxx", required=True)
    parser.add_argument("--cache", required=True)
    arguments = parser.parse_args()
    environment = {**os.environ, "XDG_CACHE_HOME": arguments.cache}

    def in_folder(problem, check, *more):
        files = [str(problem / f"{name}.rddl") for name in ("domain", "instance")]

        def rddl(*words):
            command = [*words[:2], *files, *words[2:]] if words[0] == "train" else [words[0], *files, *words[1:]]
            return subprocess.run([arguments.rddl, *command], check=True, capture_output=True, text=True,
                                  env=environment).stdout

        with tempfile.TemporaryDirectory() as name:
            return check(rddl, Path(name), *more)

    car = arguments.examples / "mountain_car"
    formula = in_folder(car, check_formula)
    networks = [in_folder(car, check_network, arguments.cxx, *options)
                for options in ((), ("--squash", "on"), ("--recurrent", "11"), ("--activation", "relu"),
                                ("--activation", "relu", "--squash", "on", "--recurrent", "11"))]
    assert all(formula + steps > 100 for steps in networks), (formula, networks)
    choices = [in_folder(Path(__file__).parent / "problems" / name, check_choices) for name in ("shop", "museum")]
    steps = formula + sum(networks) + sum(choices)
    print(f"{steps} steps agree")
    return 0


if __name__ == "__main__":
    sys.exit(main())
