"""Problems for the tests: those of examples/, and a few of one file. Interpreted unless a test asks
for the compiled engine, since to compile one takes seconds."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from typing import Any

import rddlc

# Gymnasium's checker makes an environment of each render mode, also that with a window.
os.environ.setdefault("SDL_VIDEODRIVER", "dummy")

FOLDER = Path(__file__).resolve().parents[2] / "examples"
WRITTEN = tempfile.TemporaryDirectory()  # the files of problems, which are read again
EXAMPLES = ("cart_pole", "delivery", "mountain_car", "network", "reservoir", "robot", "t_maze")

DOOR = """
domain doors {
    types { door : object; };
    pvariables {
        LOCKED(door) : { non-fluent, bool, default = false };
        is_open(door) : { state-fluent, bool, default = false };
        open(door) : { action-fluent, bool, default = false };
    };
    cpfs { is_open'(?d) = is_open(?d) | open(?d); };
    reward = sum_{?d : door} is_open(?d);
    action-preconditions { forall_{?d : door} [open(?d) => ~LOCKED(?d)]; };
}
non-fluents two { domain = doors; objects { door : {d1, d2}; }; non-fluents { LOCKED(d2); }; }
instance doors_1 { domain = doors; non-fluents = two; max-nondef-actions = 1; horizon = 5; discount = 1.0; }
"""

GLASS = """
domain glass {
    pvariables {
        filled : { state-fluent, real, default = 0.0 };
        pour : { action-fluent, real, default = 0.0 };
    };
    cpfs { filled' = filled + pour; };
    reward = filled;
    state-invariants { filled >= 0; filled <= 4; };
    action-preconditions { filled + pour <= 1; };
}
non-fluents none { domain = glass; }
instance glass_1 { domain = glass; non-fluents = none; max-nondef-actions = pos-inf; horizon = 5; discount = 1.0; }
"""

COUNTERS = """
domain counters {
    types { color : { @red, @green, @blue }; counter : object; };
    pvariables {
        count(counter) : { state-fluent, int, default = 0 };
        shade : { state-fluent, color, default = @red };
        filled : { state-fluent, real, default = 0.0 };
        paint : { action-fluent, color, default = @green };
        add(counter) : { action-fluent, int, default = 0 };
        push : { action-fluent, real, default = 0.0 };
        pull : { action-fluent, real, default = 0.0 };
    };
    cpfs {
        count'(?c) = count(?c) + add(?c);
        shade' = paint;
        filled' = filled + push - pull;
    };
    reward = filled + (sum_{?c : counter} count(?c));
    action-preconditions {
        forall_{?c : counter} [add(?c) >= -1 ^ add(?c) <= 2];
        pull >= 0;
    };
}
non-fluents two { domain = counters; objects { counter : {a, b}; }; }
instance counters_1 {
    domain = counters; non-fluents = two;
    max-nondef-actions = pos-inf; horizon = 5; discount = 1.0;
}
"""

TEXTS = {
    "refuses": GLASS,
    "refuses_some": DOOR,
    "mistake": GLASS.replace("filled + pour;", "filled + por;"),
    "counters": COUNTERS,
    "counters_two": COUNTERS.replace("pos-inf; horizon", "2; horizon"),
}


def example(name: str, engine: str = "interpreter", **options: Any) -> rddlc.RDDLEnv:
    """An environment of examples/`name`."""
    return rddlc.make(FOLDER / name / "domain.rddl", FOLDER / name / "instance.rddl",
                      engine=engine, **options)


def problem_of(name: str, engine: str = "interpreter") -> rddlc.Problem:
    """One of TEXTS."""
    return problem_of_text(TEXTS[name], name, engine)


def problem_of_text(
    text: str, name: str = "problem", engine: str = "interpreter"
) -> rddlc.Problem:
    file = Path(tempfile.mkdtemp(dir=WRITTEN.name)) / f"{name}.rddl"
    file.write_text(text)
    return rddlc.Problem(file, engine=engine)


def written(name: str, **options: Any) -> rddlc.RDDLEnv:
    """An environment of one of TEXTS."""
    return rddlc.make(problem_of(name), **options)
