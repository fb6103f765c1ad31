#!/usr/bin/env python3
"""Random RDDL problems that are well-typed and mean the same in every engine.

    tests/fuzz/generate.py SEED                   prints the problem of that seed
    tests/fuzz/generate.py SEED --flavour random  one with distributions

| flavour | |
|---|---|
| plain   | means the same in pyRDDLGym and in rddlc, and draws nothing |
| random  | the same with distributions |
| wild    | for our own engines alone: values that are rounded decide comparisons, nan and infinities go anywhere, ints wrap around; random initial values and policies |
| finite  | for --fast-math: no nan, no infinities |

What pyRDDLGym and rddlc mean differently on purpose (docs/decisions.md) is avoided but in wild
problems: values that do not fit on some path, products of zero and inf within loops over objects,
errors in branches not taken. Where rounding may differ (sums in another order, exp of another
library), the value is marked unsure, and nothing that jumps (comparisons, floor, argmax) is applied
to it.

What is drawn from stands beside this: tables.py (sizes and values), expressions.py,
distributions.py, shapes.py (what passes look for), assumptions.py (what they take for granted),
signs.py (which sign a zero has), matrices.py.
"""

import argparse
import math
import random
import re

import domains
from assumptions import Assumptions
from distributions import Distributions
from expressions import Expressions
from flavours import FLAVOURS, flavour_of
from matrices import Matrices
from rddl_problem import UNSURE, Expr, Fluent, Policy, Problem, Type, work_of
from shapes import Shapes
from signs import Signs
from tables import Tables

NAMES = ("a", "b-2", "sum", "avg_x", "Max", "abs", "q1", "load", "pow", "z-z", "in", "t_1", "new", "int8")
MOST_WORK = 12000  # operations of one step, about
LARGEST_SCOPE = 2500  # elements of a fluent that is computed
LARGEST_TABLE = 17000


class Generator(Tables, Expressions, Distributions, Shapes, Assumptions, Signs, Matrices):
    def __init__(self, seed: int, flavour: str):
        self.rng = random.Random(f"{seed} {flavour}")
        self.flavour = flavour_of(flavour, seed)
        self.problem = Problem(flavour=flavour)
        self.visible: list[tuple[str, Fluent]] = []  # what expressions may mention now
        self.scope: list[tuple[str, str]] = []  # variable and type
        self.work = 1  # elements, of the aggregations around
        self.work_left = MOST_WORK
        self.elements_left = self.pick([100, 500, 500, LARGEST_SCOPE])
        self.variable_count = 0
        self.nested_terms = 0  # argmax or Discrete_ in arguments within one another
        self.clamp_is_of_at = self.chance(0.5)  # shapes.py
        self.likings: dict[tuple, float] = {}
        self.said: list[tuple[Expr, set[str], set[str]]] = []  # expressions, their variables and names

    def generate(self) -> Problem:
        self.make_types()
        self.make_fluents()
        self.make_cpfs()
        self.make_conditions()
        if self.flavour.wild and self.chance(0.2):
            self.make_policy()
        if self.flavour.wild and self.flavour.draws and self.chance(0.3):
            self.make_initial_draws()
        self.problem.horizon = self.rng.choice([5, 20, 40])
        actions = sum(f.role == "action-fluent" for f in self.problem.fluents)
        if actions and self.problem.policy is None and self.chance(0.3):
            self.problem.max_nondef_actions = str(self.rng.randint(1, 3))
        return self.problem

    # ------------------------------------------------------------------------- small helpers

    def chance(self, probability: float) -> bool:
        return self.rng.random() < probability

    def pick(self, options):
        return self.rng.choice(options)

    def any_type(self) -> Type:
        return self.pick([t for t in self.problem.types if t.members])

    def pick_weighted(self, options):
        """One of (weight, value). Each problem has its likes: so that it holds much of the same."""
        weights, values = zip(*options)
        liked = [weight * self.liking(len(values), i) for i, weight in enumerate(weights)]
        return self.rng.choices(values, liked)[0]

    def liking(self, *option) -> float:
        if option not in self.likings:
            self.likings[option] = self.pick([0.1, 0.5, 1.0, 1.0, 2.0, 6.0])
        return self.likings[option]

    def size(self, type_name: str) -> int:
        return len(self.problem.type(type_name).members)

    def elements(self) -> int:
        """The number of elements of the scope."""
        return math.prod(self.size(of) for _, of in self.scope)

    def affordable(self, make, depth: int) -> Expr:
        """The deepest of which a step does not cost too much."""
        elements = max(1, self.elements())
        allowed = min(self.work_left / 2, MOST_WORK / 3)
        while depth > 0:
            value = make(depth)
            work = elements * work_of(value, self.problem)
            if work <= allowed:
                break
            depth -= 1
        else:
            value = make(0)
            work = elements
        self.work_left = max(500, self.work_left - work)
        return value

    # -------------------------------------------------------------------------- declarations

    def make_types(self) -> None:
        for name, size in list(zip(("thing", "place"), self.sizes()))[: self.rng.randint(1, 2)]:
            self.problem.types.append(Type(name, False, [f"{name[0]}{i}" for i in range(size)]))
        for name in ("hue", "mode")[: self.rng.randint(1, 2)]:
            members = [f"{name}{i}" for i in range(self.rng.choice([1, 2, 3, 3, 4, 6]))]
            if self.chance(0.2):
                members[-1] = "7-" + members[-1]
            self.problem.types.append(Type(name, True, members))

    def make_fluents(self) -> None:
        names = [*self.rng.sample(NAMES, 6), *(f"f{i}" for i in range(40))]
        counts = {
            "non-fluent": self.rng.randint(1, 4),
            "state-fluent": self.rng.randint(2, 6),
            "action-fluent": self.rng.randint(0, 3),
            "interm-fluent": self.rng.randint(0, 3),
            "derived-fluent": self.rng.randint(0, 1),
            "observ-fluent": self.rng.choice([0, 0, 0, 2]),
        }
        self.problem.fluents += self.tables_that_shapes_need() + self.fluents_with_bounds() + self.fluents_of_matrices()
        for role, count in counts.items():
            for _ in range(count):
                self.problem.fluents.append(self.make_fluent(names.pop(0), role))

    def make_fluent(self, name: str, role: str) -> Fluent:
        enumerated = [t.name for t in self.problem.types if t.enumerated and t.members]
        objects = [t.name for t in self.problem.types if not t.enumerated]
        ranges = ["bool"] * 3 + ["int"] * 2 + ["real"] * 3 + enumerated
        if role != "action-fluent":
            ranges += objects
        arity = self.pick([0, 1, 1, 1, 2, 2, 3])
        parameters = tuple(self.pick(objects + objects + enumerated) for _ in range(arity))
        return self.declared(name, role, self.pick(ranges), parameters)

    def declared(self, name: str, role: str, kind: str, parameters: tuple[str, ...]) -> Fluent:
        largest = LARGEST_TABLE if role == "non-fluent" and kind == "bool" else min(LARGEST_SCOPE, self.elements_left)
        if role == "non-fluent":
            largest = max(largest, 600)
        while math.prod(map(self.size, parameters)) > largest:
            parameters = parameters[1:]
        if role != "non-fluent":
            self.elements_left = max(20, self.elements_left - math.prod(map(self.size, parameters)))
        fluent = Fluent(name, role, kind, parameters)
        if kind == "bool":
            fluent.magnitude, fluent.fraction = 1, 0
        elif kind == "int":
            is_large = self.flavour.wild and self.chance(0.3)
            fluent.magnitude, fluent.fraction = 64 if is_large else 10, 0
        elif kind == "real":
            fluent.magnitude, fluent.fraction = 10, 2
            if role != "action-fluent" and self.chance(0.35):
                fluent.fraction = UNSURE
        if role in ("non-fluent", "state-fluent", "action-fluent"):
            self.give_values(fluent)
        return fluent

    # ------------------------------------------------------------------------- definitions

    def of(self, *roles: str) -> list[tuple[str, Fluent]]:
        return [(f.name, f) for f in self.problem.fluents if f.role in roles]

    def make_cpfs(self) -> None:
        constants, states, actions = self.of("non-fluent"), self.of("state-fluent"), self.of("action-fluent")
        derived = []
        for name, fluent in self.of("derived-fluent"):
            self.visible = constants + ([] if self.chance(0.2) else states + derived)
            self.define(name, fluent)
            derived.append((name, fluent))
        interm = []
        for name, fluent in self.of("interm-fluent"):
            self.visible = constants + ([] if self.chance(0.2) else states + actions + derived + interm)
            self.define(name, fluent)
            interm.append((name, fluent))
        next_states = []
        for name, fluent in self.rng.sample(states, len(states)):
            self.visible = constants + states + actions + derived + interm + next_states
            self.define(name + "'", fluent)
            next_states.append((name + "'", fluent))
        for name, fluent in self.of("observ-fluent"):
            self.visible = constants + actions + derived + interm + next_states
            self.define(name, fluent)
        self.visible = constants + states + actions + derived + interm + next_states
        rough = self.chance(0.5)
        self.problem.reward = self.affordable(lambda depth: self.finite_number(depth, rough), 4)
        if self.flavour.draws and self.chance(0.1):
            self.add_to_reward(self.drawn_in_pairs())
        if self.flavour.finite and self.chance(0.3):
            self.add_to_reward(self.sum_of_lines())
        if self.chance(0.2 if rough or self.flavour.wild else 0.0):
            self.add_to_reward(self.pick([self.chosen_by_sums, self.sum_of_rounded_terms])(1))

    def add_to_reward(self, term: Expr | None) -> None:
        if term is not None and work_of(term, self.problem) <= MOST_WORK / 2:
            self.problem.reward = Expr("real", "(%s + %s)", (self.problem.reward, term), 30, UNSURE, False)

    def finite_number(self, depth: int, rough: bool, always: bool = False) -> Expr:
        value = self.number(depth, rough)
        while not (value.finite or (self.flavour.wild and not always)):
            value = self.number(depth - 1, rough)
        return value

    def define(self, name: str, fluent: Fluent) -> None:
        parameters, body = self.definition(fluent)
        self.problem.cpfs[name] = (parameters, body)
        self.remember(body, parameters)

    def definition(self, fluent: Fluent) -> tuple[tuple[str, ...], Expr]:
        parameters = tuple(f"?{parameter[0]}{i}" for i, parameter in enumerate(fluent.parameters))
        self.scope = list(zip(parameters, fluent.parameters))
        depth = self.pick([1, 2, 3, 4, 4, 5, 6, 8])
        shaped = None
        if fluent.name in ("ratio", "part"):
            shaped = self.definition_of_matrix(fluent)
        elif fluent.name in ("turn", "speed", "bound") and self.chance(0.9):
            shaped = self.definition_with_bounds(fluent)
        elif fluent.name in ("near", "bumped"):
            shaped = self.definition_with_places(fluent)
        elif self.chance(0.6 if fluent.name in ("stock", "cap", "at") else 0.25):
            shaped = self.shaped_definition(fluent)
        if shaped is not None:
            body = self.affordable(lambda _: shaped, 1)
        elif fluent.range == "bool":
            body = self.delta(self.affordable(self.boolean, depth), "KronDelta(%s)")
        elif fluent.range == "int":
            value = self.affordable(self.integer, depth)
            body = self.delta(self.small_int(fluent, value), "KronDelta(%s)")
        elif fluent.range == "real":
            body = self.delta(self.tame_real(fluent, depth), "DiracDelta(%s)")
        else:
            body = self.affordable(lambda d: self.member(fluent.range, d), depth)
        self.scope = []
        return parameters, body

    def remember(self, body: Expr, parameters: tuple[str, ...]) -> None:
        """Keeps it for later CPFs of the same parameters, which may repeat it."""
        parts = [part for part in body.all() if part.parts and is_closed(part)]
        for part in self.rng.sample(parts, min(3, len(parts))):
            self.said.append((part, part.free_variables(), part.names()))

    def delta(self, body: Expr, form: str) -> Expr:
        return Expr(body.kind, form, (body,)) if self.chance(0.15) else body

    def small_int(self, fluent: Fluent, value: Expr) -> Expr:
        """Ints of fluents stay small."""
        if value.magnitude <= fluent.magnitude:
            return value
        form = self.pick(["max[-500, min[500, %s]]", "mod[%s, 50]", "mod[%s, -7]"])
        return Expr("int", form, (value,), 10)

    def tame_real(self, fluent: Fluent, depth: int) -> Expr:
        """A number for a real fluent. A value that may not be finite gets an interm-fluent of its
        own."""
        exact = fluent.is_exact()
        value = self.as_real(self.affordable(lambda d: self.number(d, rough=not exact), depth))
        if value.finite and value.magnitude <= 10 and (value.fraction <= 2 or not exact):
            return value
        if self.flavour.wild:
            return self.wild_real(fluent, value)
        if not value.finite and fluent.role != "observ-fluent" and "'" not in str(value):
            value = self.through_interm(fluent, value)
            form = "(if (%s >= -500.0 ^ %s <= 500.0) then %s + 0.0 else 0.25)"
            inside = Expr("real", form, (value, value, value), 10, value.fraction)
            if not exact or inside.fraction <= 2:
                return inside
            return Expr("real", "floor[4.0 * %s] / 4.0", (inside,), 10, 2)
        while not value.finite:
            value = self.as_real(self.number(2, rough=not exact))
        bounded = Expr("real", "max[-500.0, min[500.0, %s]]", (value,), 10, value.fraction)
        if not exact or bounded.fraction <= 2:
            return bounded
        return Expr("real", "(round[4.0 * %s] / 4.0)", (bounded,), 10, 2)

    def as_real(self, value: Expr) -> Expr:
        """pyRDDLGym has an int where a later CPF of the step reads it, and computes with ints."""
        if value.kind == "real" or self.flavour.wild or self.flavour.finite:
            return value
        return Expr("real", "(%s + 0.0)", (value,), value.magnitude + 1, value.fraction, value.finite)

    def wild_real(self, fluent: Fluent, value: Expr) -> Expr:
        """Bounds the value, or lets it be nan; or infinite: sums over steps would overflow. Actions
        are assumed finite, also those of policies."""
        if fluent.role == "action-fluent":
            value = self.finite_number(1, True, always=True)
        bounded = Expr("real", "max[-500.0, min[500.0, %s]]", (value,), 10, UNSURE, value.finite)
        if not value.finite and self.chance(0.3):
            condition = self.boolean(1)
            return Expr("real", "(if (%s) then (1.0 / 0.0) else %s)", (condition, bounded), 10, UNSURE, False)
        return bounded

    def through_interm(self, fluent: Fluent, value: Expr) -> Expr:
        name = f"raw-{fluent.name}"
        role = "derived-fluent" if fluent.role == "derived-fluent" else "interm-fluent"
        raw = Fluent(name, role, "real", fluent.parameters)
        raw.magnitude, raw.fraction, raw.finite = value.magnitude, value.fraction, False
        self.problem.fluents.append(raw)
        variables = tuple(variable for variable, _ in self.scope)
        self.problem.cpfs[name] = (variables, value)
        head = f"{name}({', '.join(variables)})" if variables else name
        return Expr("real", head, (), value.magnitude, value.fraction, False)

    # ---------------------------------------------------------------- conditions and policies

    def make_conditions(self) -> None:
        self.visible = self.of("non-fluent", "state-fluent")
        has_bounds = any(fluent.name == "speed" for fluent in self.problem.fluents)
        for conditions, chance in (
            (self.problem.invariants, 0.05 if has_bounds else 0.3),  # others would be violated most often
            (self.problem.terminations, 0.3),
        ):
            while self.chance(chance):
                conditions.append(self.affordable(self.boolean, 3))
        if has_bounds and self.chance(0.8):
            self.problem.invariants += self.bounds_at_places()
        while self.chance(0.2 if has_bounds else 0.5 if self.flavour.finite else 0.3):
            self.problem.invariants += self.bounds_at_places() if has_bounds and self.chance(0.8) else self.bounds_of_state()
        self.visible = self.visible + self.of("action-fluent")
        while self.chance(0.4):
            self.problem.preconditions.append(self.affordable(self.boolean, 3))

    def make_policy(self) -> None:
        """Sees what is observed, remembers one or two things, and gives every action."""
        own = [self.declared("memo", "state-fluent", self.pick(["bool", "int", "real"]), ())]
        first = self.problem.types[0].name
        own.append(self.declared("memos", "state-fluent", self.pick(["bool", "int"]), (first,)))
        for fluent in own:
            fluent.values.clear()  # the instance gives no values
        derived = self.declared("hint", "derived-fluent", self.pick(["bool", "real"]), (first,))
        seen = self.of("observ-fluent") or self.of("state-fluent")
        memory = [(f.name, f) for f in own]
        policy = Policy([*own, derived])
        self.visible = self.of("non-fluent") + seen + memory
        policy.cpfs["hint"] = self.definition(derived)
        self.visible = self.visible + [("hint", derived)]
        for name, fluent in self.of("action-fluent"):
            policy.cpfs[name] = self.definition(fluent)
        self.visible = self.visible + self.of("action-fluent")
        for name, fluent in memory:
            policy.cpfs[name + "'"] = self.definition(fluent)
        self.problem.policy = policy

    def make_initial_draws(self) -> None:
        forms = {
            "bool": ["Bernoulli(0.5)", "Bernoulli(0.1)"],
            "int": ["Poisson(2.0)", "Binomial(5, 0.5)", "Geometric(0.4)"],
            "real": ["Uniform(-1, 2)", "Normal(0, 1)", "Exponential(2.0)"],
        }
        for _, fluent in self.of("state-fluent"):
            for objects in self.problem.groundings(fluent):
                if fluent.range in forms and self.chance(0.3):
                    fluent.values[objects] = self.pick(forms[fluent.range])


def is_closed(expr: Expr) -> bool:
    """Whether it stands in any place without brackets: no chain continues in it."""
    return expr.form.startswith("(") or re.match(r"[A-Za-z-]+[\[(]", expr.form) is not None


def generate(seed: int, flavour: str = "plain") -> Problem:
    return Generator(seed, flavour).generate()


GENERATORS = {"expressions": generate, "domains": domains.generate}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("seed", type=int)
    parser.add_argument("--flavour", choices=FLAVOURS, default="plain")
    parser.add_argument("--generator", choices=GENERATORS, default="expressions", help="domains: whole little domains")
    arguments = parser.parse_args()
    print(GENERATORS[arguments.generator](arguments.seed, arguments.flavour).text(), end="")


if __name__ == "__main__":
    main()
