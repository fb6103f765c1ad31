"""A problem under construction: what all families of domains use."""

import random

from flavours import flavour_of
from rddl_problem import UNSURE, Expr, Fluent, Problem, Type
from tables import Tables

FEW = (1, 1, 2, 3, 4, 5)
SOME = (7, 8, 9, 15, 16, 17)
MANY = (31, 32, 33, 63, 64, 65)  # around words and registers
STATE, ACTION, INTERM, CONSTANT = "state-fluent", "action-fluent", "interm-fluent", "non-fluent"
OBSERVATION = "observ-fluent"


def of(kind: str, form: str, *parts) -> Expr:
    """An expression of these parts, which reduction may simplify."""
    return Expr(kind, form, tuple(part if isinstance(part, Expr) else Expr("object", str(part)) for part in parts), 10, UNSURE)


def real(form: str, *parts) -> Expr:
    return of("real", form, *parts)


def integer(form: str, *parts) -> Expr:
    return of("int", form, *parts)


def boolean(form: str, *parts) -> Expr:
    return of("bool", form, *parts)


def over(operator: str, variable: str, type_name: str, body: Expr) -> Expr:
    """An aggregation over the objects of a type."""
    kind = "bool" if operator in ("exists", "forall") else type_name if operator.startswith(("arg", "Discrete")) else body.kind
    kind = "int" if operator == "sum" and body.kind == "bool" else "real" if operator == "avg" else kind
    return of(kind, f"({operator}_{{{variable} : {type_name}}} [%s])", body)


class Draft(Tables):
    def __init__(self, seed: int, flavour: str):
        self.rng = random.Random(f"domain {seed} {flavour}")
        self.flavour = flavour_of(flavour, seed)
        # 1 / 0 shows the sign of a zero. pyRDDLGym and --fast-math have rules of their own for it.
        self.reveals = flavour in ("random", "wild")
        self.problem = Problem(flavour)
        self.rewards: list[Expr] = []
        self.scale = self.rng.choices((FEW, SOME, MANY), (45, 42, 13))[0]

    # ------------------------------------------------------------------------- small helpers

    def chance(self, probability: float) -> bool:
        return self.rng.random() < probability

    def pick(self, options):
        return self.rng.choice(options)

    def size(self, type_name: str) -> int:
        return len(self.problem.type(type_name).members)

    def fresh(self, stem: str) -> str:
        names = {f.name for f in self.problem.fluents} | {t.name for t in self.problem.types}
        return next(name for name in (stem, *(f"{stem}-{i}" for i in range(2, 99))) if name not in names)

    # -------------------------------------------------------------------------- declarations

    def objects(self, stem: str, main: bool = False) -> str:
        """An object type: one that is there already, now and then."""
        there = [t.name for t in self.problem.types if not t.enumerated]
        if there and self.chance(0.3):
            return self.pick(there)
        is_first = not there
        size = self.pick(self.scale if main and is_first else FEW if self.scale is MANY else FEW + SOME)
        name = self.fresh(stem)
        self.problem.types.append(Type(name, False, [f"{name[0]}{len(there)}-{i}" for i in range(size)]))
        return name

    def enumeration(self, stem: str, count: int) -> Type:
        name = self.fresh(stem)
        type_ = Type(name, True, [f"{name}-{word}" for word in "abcdefgh"[:count]])
        self.problem.types.append(type_)
        return type_

    def declare(self, stem: str, role: str, kind: str, *parameters: str, default: str | None = None) -> Fluent:
        """Declares a fluent with random values, except for a default that is given."""
        fluent = Fluent(self.fresh(stem), role, kind, parameters)
        fluent.magnitude, fluent.fraction = 10, 2
        if kind == "real" and self.problem.flavour != "plain" and self.chance(0.4):
            fluent.fraction = UNSURE
        if role != INTERM and default is None:
            self.give_values(fluent)
        if default is not None:
            fluent.default = default
        if kind == "real":
            fluent.fraction = UNSURE
        self.problem.fluents.append(fluent)
        return fluent

    def define(self, fluent: Fluent, variables: tuple[str, ...], body: Expr) -> None:
        self.problem.cpfs[fluent.name + ("'" if fluent.role == STATE else "")] = (variables, body)

    def interm(self, stem: str, variables: dict[str, str], body: Expr) -> Fluent:
        """A fluent for the value of an expression, over these variables and their types."""
        fluent = self.declare(stem, INTERM, body.kind, *variables.values())
        self.define(fluent, tuple(variables), body)
        return fluent

    def observe(self, stem: str, variables: dict[str, str], body: Expr) -> None:
        """An observation of these variables and their types; it may read what the step has computed."""
        name = self.fresh(stem)
        self.problem.fluents.append(Fluent(name, OBSERVATION, body.kind, tuple(variables.values()), None, {}, 10, UNSURE))
        self.problem.cpfs[name] = (tuple(variables), body)

    # --------------------------------------------------------------------------- expressions

    def at(self, fluent: Fluent, *arguments, prime: bool = False) -> Expr:
        name = fluent.name + ("'" if prime else "")
        return of(fluent.range, f"{name}({', '.join(['%s'] * len(arguments))})" if arguments else name, *arguments)

    def comparison(self) -> str:
        return self.pick([">=", ">", "<", "<=", "==", "~="])

    def chosen(self, scope: dict[str, str], kinds: tuple[str, ...], roles=(STATE, CONSTANT, ACTION, INTERM)) -> Expr | None:
        """Any fluent that these variables can index, of whatever family."""
        fitting = []
        for fluent in self.problem.fluents:
            choices = [[v for v, of_ in scope.items() if of_ == p] for p in fluent.parameters]
            if fluent.range in kinds and fluent.role in roles and all(choices):
                fitting.append((fluent, choices))
        if not fitting:
            return None
        fluent, choices = self.pick(fitting)
        return self.at(fluent, *(self.pick(choice) for choice in choices))

    def some_bool(self, scope: dict[str, str], roles=(STATE, CONSTANT, ACTION)) -> Expr:
        found = self.chosen(scope, ("bool",), roles)
        if found is None or self.chance(0.2):
            number = self.chosen(scope, ("int", "real"), roles)
            if number is None:
                return found or boolean(self.pick(["true", "false"]))
            return boolean(f"(%s {self.comparison()} {self.pick(['0.0', '-0.0', '1', '0.5', '-2'])})", number)
        return boolean("~%s", found) if self.chance(0.2) else found

    def some_number(self, scope: dict[str, str], roles=(STATE, CONSTANT, ACTION)) -> Expr:
        found = self.chosen(scope, ("real", "int"), roles)
        if found is None or self.chance(0.15):
            return self.chosen(scope, ("bool",), roles) or real(self.pick(["0.5", "(-0.25)", "0.0", "(-0.0)", "1.0", "2.0"]))
        return found

    def some_real(self, scope: dict[str, str], roles=(STATE, CONSTANT, ACTION)) -> Expr:
        number = self.some_number(scope, roles)
        return number if number.kind == "real" else real("(%s * 1.0)", number)

    def zero(self, number: Expr) -> Expr:
        """A zero of either sign, or what may be one."""
        return real(self.pick(["(0.0 * %s)", "(-0.0 * %s)", "(%s * 0.0)", "(-(0.0 * %s))", "(0.0 - 0.0 * %s)"]), number)

    def signed(self, number: Expr) -> Expr:
        """A number that is as often negative as positive, and often a zero."""
        form = self.pick(["%s", "(-%s)", "(0.0 - %s)", "(%s - 0.5)", "(%s * -1.0)", "(%s + 0.0)", "(1.0 * %s)", "ZERO", "MASK"])
        if form == "ZERO":
            return self.zero(number)
        if form == "MASK":
            return real(self.pick(["(%s * %s)", "(if (%s) then -%s else -0.0)"]), self.some_bool({}), number)
        return real(form, number)

    def revealed(self, number: Expr) -> Expr:
        """Bounded. Where signs of zeros count, different for 0.0 and -0.0."""
        if not self.reveals:
            forms = ["max[-9.0, min[9.0, %s]]", "(%s / (0.5 + abs[%s]))", "(if (%s > 0.0) then 1.0 else -1.0)", "sgn[%s] * 1.0"]
        else:
            forms = [
                "max[-9.0, min[9.0, 1.0 / %s]]", "(if (1.0 / %s > 0.0) then 1.0 else -1.0)", "min[90.0, max[-90.0, -2.0 / %s]]",
                "max[-9.0, min[9.0, %s / (%s + 0.0)]]", "max[-9.0, min[9.0, (1.0 / %s) - (0.5 / %s)]]",
                "(if ((1.0 / %s) == (1.0 / 0.0)) then 2.0 else 0.25)", "max[-9.0, min[9.0, pow[%s, -1.0]]]",
                "max[-9.0, min[9.0, 1.0 / (-%s)]]", "max[-9.0, min[9.0, 1.0 / (%s * 2.0)]]", "max[-9.0, min[9.0, 1.0 / sqrt[%s]]]",
            ]  # fmt: skip
        form = self.pick(forms)
        return real(form, *([number] * form.count("%s")))

    def bounded(self, number: Expr) -> Expr:
        low, high = self.pick([("-10.0", "10.0"), ("0.0", "16.0"), ("-0.0", "5.0"), ("-500.0", "500.0")])
        return real(self.pick([f"max[{low}, min[{high}, %s]]", f"min[{high}, max[{low}, %s]]"]), number)

    def small(self, number: Expr) -> Expr:
        """An int within bounds."""
        return integer(self.pick(["max[0, min[9, %s]]", "max[-100, min[100, %s]]", "mod[%s, 7]", "mod[%s, -5]"]), number)

    def coin(self, probability: Expr | str) -> Expr:
        """A draw where the problem draws, else a comparison."""
        if self.flavour.draws:
            return boolean("Bernoulli(min[1.0, max[0.0, %s]])", probability)
        return boolean("(%s >= 0.5)", probability)

    def earn(self, term: Expr) -> None:
        self.rewards.append(term)
