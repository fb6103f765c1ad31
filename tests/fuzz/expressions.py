"""Expressions of each kind, nested to any depth, and what is known about their values.

Over 400 lines: a function for each shape.
"""

import math

from rddl_problem import UNSURE, Expr, Type

EDGE_REALS = (
    "(1.0 / 0.0)", "(-1.0 / 0.0)", "(0.0 / 0.0)", "ln[0.0]", "sqrt[-1.0]", "(1.0 / 3.0 * 0.0)",
)  # fmt: skip
ROUGH_FUNCTIONS = (
    "sin[%s]", "cos[%s]", "tanh[%s]", "atan[%s]", "exp[min[%s, 3.0]]", "sqrt[abs[%s]]",
    "ln[abs[%s] + 0.5]", "lngamma[abs[%s] + 0.5]", "gamma[min[abs[%s], 9.0] + 0.5]",
    "acos[max[-1.0, min[1.0, %s / 8.0]]]", "asin[max[-0.5, min[0.5, %s / 8.0]]]",
    "sinh[max[-3.0, min[3.0, %s]]]", "cosh[max[-3.0, min[3.0, %s]]]", "tan[max[-1.0, min[1.0, %s]]]",
)  # fmt: skip
EDGE_FUNCTIONS = (
    "ln[%s]", "sqrt[%s]", "acos[%s]", "asin[%s]", "exp[%s]", "cosh[%s]", "sinh[%s]", "tan[%s]",
    "sin[%s]", "cos[%s]", "atan[%s]", "tanh[%s]", "hypot[%s, %s]", "log[%s, %s]", "lngamma[abs[%s] + 0.5]",
    "gamma[abs[%s] + 0.5]", "pow[%s + 0.0, %s]",
)  # fmt: skip
LARGE_INTS = ("9223372036854775807", "4611686018427387904", "3037000500", "9007199254740993")

LARGEST_SCOPE = 5000  # elements, aggregations within one another included
LARGEST_WORK = 3000  # of one element


class Expressions:
    """A part of a generator (generate.py)."""

    # ------------------------------------------------------------------------------- leaves

    def reference(self, kind: str, depth: int, exact: bool = True) -> Expr | None:
        """A fluent of that range, its arguments from the scope, literals or nested."""
        matching = [
            (name, fluent)
            for name, fluent in self.visible
            if fluent.range == kind and (fluent.is_exact() or not exact or self.flavour.wild)
        ]
        if not matching:
            return None
        name, fluent = self.pick(matching)
        return self.applied(name, fluent, depth)

    def applied(self, name: str, fluent, depth: int) -> Expr | None:
        """Applies the fluent to arguments."""
        kind = fluent.range
        about = dict(magnitude=fluent.magnitude, fraction=fluent.fraction, finite=fluent.finite)
        if not fluent.parameters:
            return Expr(kind, name, **about)
        arguments = []
        for parameter in fluent.parameters:
            argument = self.argument(parameter, depth)
            if argument is None:
                return None
            arguments.append(argument)
        return Expr(kind, f"{name}({', '.join(['%s'] * len(arguments))})", tuple(arguments), **about)

    def argument(self, type_name: str, depth: int) -> Expr | None:
        """A term: a variable, a literal, a fluent of that type, or argmax."""
        variables = [variable for variable, of in self.scope if of == type_name]
        type_ = self.problem.type(type_name)
        options = []
        if variables:
            options.append((8, lambda: Expr(type_name, self.pick(variables))))
        if type_.enumerated:
            options.append((3, lambda: self.literal(type_)))
        if depth > 0:
            options.append((2, lambda: self.reference(type_name, depth - 1)))
            options.append((1, lambda: self.arg_best(type_name, depth - 1)))
            if self.flavour.draws:
                options.append((1, lambda: self.discrete_over(type_name, depth - 1)))
        if not options:
            return self.arg_best(type_name, 0)
        return self.pick_weighted(options)() or self.arg_best(type_name, 0)

    def literal(self, type_: Type) -> Expr:
        member = self.pick(type_.members)
        bare = member[0].isalpha() and self.chance(0.2)
        return Expr(type_.name, member if bare else type_.literal(member))

    def constant(self, kind: str) -> Expr:
        if kind == "bool":
            return Expr("bool", self.pick(["true", "false"]))
        if kind == "int":
            return Expr("int", self.pick(["0", "1", "2", "3", "-1", "5", "10"]), (), 4)
        texts = ["0.0", "1.0", "0.5", ".25", "2.5", "-1.5", "3.75", "-0.0"]
        return Expr("real", self.pick(texts), (), 3, 2)

    def said_before(self, kind: str, exact: bool = True) -> Expr | None:
        """Repeats an expression, so that several CPFs compute the same."""
        variables = {variable for variable, _ in self.scope}
        names = {name for name, _ in self.visible}
        fluents = {f.name for f in self.problem.fluents} | {f.name + "'" for f in self.problem.fluents}
        fitting = [
            expr
            for expr, used, mentioned in self.said
            if expr.kind == kind
            and used <= variables
            and (mentioned & fluents) <= names
            and (expr.is_exact() or not exact or kind not in ("int", "real"))
            and (expr.finite or not self.scope)
        ]
        return self.pick(fitting) if fitting else None

    def leaf(self, kind: str, depth: int = 1, exact: bool = True) -> Expr:
        found = None if self.chance(0.15) else self.reference(kind, depth, exact)
        return found or self.constant(kind)

    # ----------------------------------------------------------------------------- booleans

    def boolean(self, depth: int) -> Expr:
        if depth <= 0:
            return self.leaf("bool")
        if self.chance(0.04) and (said := self.said_before("bool")):
            return said
        options = [
            (4, self.shape_of_bool),
            (3, self.boolean_reference),
            (3, self.logic),
            (1, self.negation),
            (4, self.comparison),
            (1, self.number_comparison),
            (1, lambda d: Expr("bool", "KronDelta(%s)", (self.boolean(d),))),
            (2, self.object_equality),
            (2, self.quantifier),
            (1, lambda d: self.conditional("bool", self.boolean, d)),
            (1, lambda d: self.switch("bool", self.boolean, d)),
            (1, self.logic_chain),
            (1, self.comparison_chain),
            (0.3, self.test_of_nothing),
            (1 if self.flavour.wild else 0, self.bool_by_sign),
        ]
        if self.flavour.draws:
            options.append((2, self.bernoulli))
        return self.pick_weighted(options)(depth - 1) or self.leaf("bool")

    def number_comparison(self, depth: int) -> Expr:
        """Compares two of the same few values, so that they are equal now and then."""
        first, second = self.leaf(kind := self.pick(["int", "bool"]), depth), self.leaf(kind, depth)
        return Expr("bool", f"(%s {self.pick(['==', '~=', '<=', '>'])} %s)", (first, second))

    def boolean_reference(self, depth: int) -> Expr | None:
        return self.reference("bool", depth)

    def logic(self, depth: int) -> Expr:
        op = self.pick(["^", "&", "|", "=>", "<=>"])
        return Expr("bool", f"(%s {op} %s)", (self.boolean(depth), self.boolean(depth)))

    def negation(self, depth: int) -> Expr:
        return Expr("bool", "~%s", (self.grouped(self.boolean(depth)),))

    def grouped(self, part: Expr) -> Expr:
        return Expr(part.kind, self.pick(["(%s)", "[%s]"]), (part,), part.magnitude, part.fraction, part.finite)

    def comparison(self, depth: int) -> Expr:
        op = self.pick(["==", "~=", "<", "<=", ">", ">="])
        return Expr("bool", f"(%s {op} %s)", (self.number(depth), self.number(depth)))

    def object_equality(self, depth: int) -> Expr:
        type_ = self.any_type()
        first, second = self.member(type_.name, depth), self.member(type_.name, depth)
        return Expr("bool", f"(%s {self.pick(['==', '~='])} %s)", (first, second))

    def quantifier(self, depth: int) -> Expr | None:
        return self.aggregation(
            lambda: self.boolean(depth),
            lambda binder, body, _n: Expr("bool", f"({self.pick(['forall', 'exists'])}_{binder} [%s])", (body,)),
        )

    def logic_chain(self, depth: int) -> Expr:
        """No brackets: precedence and association decide."""
        parts = [self.boolean(0) for _ in range(self.rng.randint(2, 5))]
        parts = [Expr("bool", "~%s", (p,)) if self.chance(0.2) else p for p in parts]
        if self.chance(0.3):
            parts[-1] = self.open_quantifier(parts[-1])
        return self.chain("bool", parts, ["^", "&", "|", "=>", "<=>"])

    def open_quantifier(self, part: Expr) -> Expr:
        variable, type_ = self.fresh_variable(), self.any_type()
        form = f"{self.pick(['forall', 'exists'])}_{{{variable} : {type_.name}}} %s"
        return Expr("bool", form, (part,))

    def comparison_chain(self, depth: int) -> Expr:
        parts = [self.leaf(self.pick(["int", "real", "bool"]), 0) for _ in range(3)]
        ops = ["<", "<=", ">", ">=", "==", "~=", "+", "-"]
        return self.chain("bool", parts, ops, first=self.pick(ops[:6]))

    def chain(self, kind: str, parts, ops, first: str | None = None, **about) -> Expr:
        forms = ["%s"]
        for number in range(len(parts) - 1):
            forms.append(first if first and number == 0 else self.pick(ops))
            forms.append("%s")
        return Expr(kind, f"({' '.join(forms)})", tuple(parts), **about)

    # ------------------------------------------------------------------------------ numbers

    def number(self, depth: int, rough: bool = False) -> Expr:
        """A bool, int or real; exact unless rough will do."""
        rough = rough or self.flavour.wild
        kind = self.pick_weighted([(1, "bool"), (3, "int"), (6, "real")])
        if kind == "bool" and depth <= 2:
            return self.boolean(min(depth, 2))
        if kind == "int":
            return self.exact_int(self.integer(depth))
        return self.real(depth, rough)

    def exact_int(self, value: Expr) -> Expr:
        """Ints that become reals must fit there."""
        return value if value.magnitude <= 40 or self.flavour.wild else Expr("int", "mod[%s, 97]", (value,), 8)

    def integer(self, depth: int) -> Expr:
        if depth <= 0:
            return self.leaf("int")
        if self.chance(0.04) and (said := self.said_before("int")):
            return said
        options = [
            (4, self.shape_of_int),
            (2, lambda d: self.reference("int", d)),
            (4, lambda d: self.arithmetic("int", self.integer, d)),
            (3, self.rounding),
            (2, self.division_of_ints),
            (1, lambda d: self.minimum(self.integer, d)),
            (2, lambda d: self.reduction(self.int_or_bool, d)),
            (1, lambda d: self.conditional("int", self.integer, d)),
            (1, lambda d: self.switch("int", self.integer, d)),
            (1, self.power_of_ints),
            (1, lambda d: self.unary(self.integer(d))),
            (1, lambda d: Expr("int", "abs[%s]", (value := self.integer(d),), value.magnitude)),
            (1, self.wild_int),
            (1, lambda d: Expr("int", "KronDelta(%s)", (value := self.integer(d),), value.magnitude)),
            (1, self.of_bools),
            (1, self.of_nothing),
        ]
        if self.flavour.draws:
            options.append((2, self.counting_draw))
        return self.pick_weighted(options)(depth - 1) or self.leaf("int")

    def int_or_bool(self, depth: int) -> Expr:
        return self.boolean(depth) if self.chance(0.3) else self.integer(depth)

    def real(self, depth: int, rough: bool = False) -> Expr:
        rough = rough or self.flavour.wild
        if depth <= 0:
            return self.leaf("real", exact=not rough)
        if self.chance(0.04) and (said := self.said_before("real", not rough)):
            return said
        part = lambda d: self.number(d, rough)  # noqa: E731
        options = [
            (5, lambda d: self.shape_of_real(d, rough)),
            (3, lambda d: self.reference("real", d, exact=not rough)),
            (5, lambda d: self.arithmetic("real", part, d)),
            (1, lambda d: self.minimum(part, d)),
            (2, lambda d: self.reduction(part, d)),
            (2, lambda d: self.average(d, rough)),
            (2, lambda d: self.conditional("real", part, d)),
            (1, lambda d: self.switch("real", part, d)),
            (2, self.exact_division),
            (1, lambda d: self.unary(self.real(d, rough))),
            (0 if self.flavour.finite else 2, self.edge),
            (1, lambda d: self.numeric_chain(d, rough)),
            (1, lambda d: self.dirac(self.real(d, rough))),
            (2 if self.flavour.wild else 0, self.real_by_sign),
        ]
        if rough:
            options += [(5, self.rough_function), (2, self.rough_division)]
            options += [] if self.flavour.finite else [(2, self.edge_function), (2, self.beyond_reals)]
        if self.flavour.draws:
            options.append((3 if rough else 0, self.continuous_draw))
        return self.pick_weighted(options)(depth - 1) or self.leaf("real", exact=not rough)

    def dirac(self, part: Expr) -> Expr:
        return Expr("real", "DiracDelta(%s)", (part,), part.magnitude, part.fraction, part.finite)

    def arithmetic(self, kind: str, part, depth: int) -> Expr | None:
        first, second = part(depth), part(depth)
        op = self.pick(["+", "+", "-", "-", "*", "*"])
        kind = "real" if "real" in (first.kind, second.kind) else "int"
        magnitude = max(first.magnitude, second.magnitude) + 1
        fraction = max(first.fraction, second.fraction)
        finite = first.finite and second.finite
        if op == "*":
            if not finite and self.scope and not self.flavour.wild:
                return None  # 0 * inf
            magnitude = first.magnitude + second.magnitude
            fraction = min(UNSURE, first.fraction + second.fraction)
        return self.known(kind, f"(%s {op} %s)", (first, second), magnitude, fraction, finite)

    def known(self, kind, form, parts, magnitude, fraction=0, finite=True) -> Expr | None:
        """Nothing if an exact value would no longer be exact, or the int wraps around."""
        if magnitude > (600 if self.flavour.wild else 60):
            return None
        if self.flavour.wild:
            return Expr(kind, form, parts, magnitude, UNSURE if kind == "real" else 0, finite)
        rough = any(p.kind not in self.type_names() and p.fraction >= UNSURE for p in parts)
        if rough:
            fraction = UNSURE
        elif magnitude + fraction > 50 and (kind == "real" or magnitude > 60):
            return None
        return Expr(kind, form, parts, magnitude, fraction, finite)

    def type_names(self) -> set[str]:
        return {t.name for t in self.problem.types}

    def minimum(self, part, depth: int) -> Expr:
        first, second = part(depth), part(depth)
        kind = "real" if "real" in (first.kind, second.kind) else "int"
        return Expr(
            kind,
            f"{self.pick(['min', 'max'])}[%s, %s]",
            (first, second),
            max(first.magnitude, second.magnitude),
            max(first.fraction, second.fraction),
            first.finite and second.finite,
        )

    def unary(self, part: Expr) -> Expr:
        # Unary plus is broken in pyRDDLGym within a scope.
        sign = "+" if not self.scope and self.chance(0.3) else "-"
        return Expr(part.kind, sign + "%s", (self.grouped(part),), part.magnitude, part.fraction, part.finite)

    def rounding(self, depth: int) -> Expr:
        value = self.number(depth)
        name = self.pick(["round", "floor", "ceil", "sgn"])
        if self.chance(0.1):
            large = self.pick(["9223372036854775807.0", "10000000000000000000.0", "4503599627370497.5"])
            value = Expr("real", f"({self.pick(['max', 'min'])}[%s, {large}])", (value,), 70)
        magnitude = value.magnitude + 1 if value.finite else 64
        return Expr("int", f"{name}[%s]", (value,), magnitude)

    def division_of_ints(self, depth: int) -> Expr:
        first, second = self.int_or_bool(depth), self.int_or_bool(depth)
        name = self.pick(["div", "mod", "fmod"])
        magnitude = max(first.magnitude, second.magnitude)
        return Expr("int", f"{name}[%s, %s]", (first, second), magnitude)

    def power_of_ints(self, depth: int) -> Expr:
        base, exponent = self.int_or_bool(depth), self.integer(depth)
        exponent = Expr("int", self.pick(["mod[%s, 4]", "abs[%s]"]), (exponent,), exponent.magnitude)
        return Expr("int", "pow[%s, %s]", (base, exponent), 64)

    def of_bools(self, depth: int) -> Expr:
        """Bools count as 0 and 1."""
        form = self.pick(["(%s + %s)", "(%s * %s)", "(%s - %s)", "max[%s, %s]", "min[%s, %s]"])
        return Expr("int", form, (self.boolean(depth), self.boolean(depth)), 2)

    def of_nothing(self, depth: int) -> Expr | None:
        """An aggregation over a type without members."""
        binder = f"{{{self.fresh_variable()} : {self.type_without_members()}}}"
        return Expr("int", f"({self.pick(['sum', 'prod'])}_{binder} [%s])", (self.integer(depth),), 2)

    def type_without_members(self) -> str:
        if self.problem.type("none") is None:
            self.problem.types.append(Type("none", True, []))
        return "none"

    def wild_int(self, depth: int) -> Expr | None:
        """Wraps around. One operand is a fluent, since pyRDDLGym has big ints among literals."""
        fluent = self.reference("int", 0)
        if fluent is None:
            return None
        literal = Expr("int", self.pick(LARGE_INTS))
        return Expr("int", f"(%s {self.pick(['+', '*', '-'])} %s)", (fluent, literal), 64)

    def exact_division(self, depth: int) -> Expr | None:
        value = self.number(depth)
        divisor = self.pick(["2.0", "4", "-0.5", "8.0"])
        return self.known(
            "real", f"(%s / {divisor})", (value,), value.magnitude + 1, value.fraction + 3, value.finite
        )

    def edge(self, depth: int) -> Expr:
        """Infinities and nan, and what makes them."""
        if self.chance(0.4):
            return Expr("real", self.pick(EDGE_REALS), (), 3, 2, False)
        value = self.number(depth)
        if self.chance(0.5):
            divisor = self.boolean(depth - 1)
            return Expr("real", "(%s / %s)", (value, divisor), value.magnitude, value.fraction, False)
        divisor = self.number(depth - 1)
        magnitude = max(value.magnitude, divisor.magnitude)
        fraction = max(value.fraction, divisor.fraction)
        if "real" not in (value.kind, divisor.kind):
            value = Expr("real", "(%s + 0.0)", (value,), value.magnitude + 1, value.fraction, value.finite)
        return Expr("real", "fmod[%s, %s]", (value, divisor), magnitude, fraction, False)

    def numeric_chain(self, depth: int, rough: bool) -> Expr | None:
        """No brackets: precedence, association, and open ends decide."""
        parts = [self.leaf(self.pick(["int", "real", "bool"]), 0) for _ in range(self.rng.randint(2, 4))]
        if not all(p.finite for p in parts):
            return None
        parts = [Expr("real" if p.kind == "real" else "int", "-%s", (p,), p.magnitude, p.fraction) if self.chance(0.15) else p for p in parts]
        if self.chance(0.4):
            variable, type_ = self.fresh_variable(), self.any_type()
            name = self.pick(["sum", "min", "max"])
            end = f"{name}_{{{variable} : {type_.name}}} %s"
            if self.chance(0.3):
                end = "if (%s) then 1 else %s"
                parts[-1] = Expr("real", end, (self.boolean(0), parts[-1]), 10, 2)
            else:
                parts[-1] = Expr("real", end, (parts[-1],), 12, 2)
        return self.chain("real", parts, ["+", "-", "*"], magnitude=36, fraction=8)

    def rough_division(self, depth: int) -> Expr:
        first, second = self.number(depth, True), self.number(depth, True)
        return Expr(
            "real", "(%s / (abs[%s] + 0.5))", (first, second), first.magnitude + 1, UNSURE,
            first.finite and second.finite,
        )  # fmt: skip

    def rough_function(self, depth: int) -> Expr | None:
        form = self.pick(ROUGH_FUNCTIONS + ("hypot[%s, %s]", "pow[%s, %s]", "log[%s, %s]"))
        if form.startswith("hypot"):
            parts = (self.number(depth, True), self.number(depth, True))
            magnitude = max(p.magnitude for p in parts) + 1
        elif form.startswith("pow"):
            form = "pow[min[abs[%s], 9.0] + 0.5, max[-3.0, min[3.0, %s]]]"
            parts, magnitude = (self.number(depth, True), self.number(depth, True)), 12
        elif form.startswith("log"):
            form = "log[abs[%s] + 0.5, 2.0 + abs[%s]]"
            parts, magnitude = (self.number(depth, True), self.number(depth, True)), 5
        else:
            parts = (self.number(depth, True),)
            magnitude = 40 if form.startswith(("lngamma", "gamma")) else max(12, parts[0].magnitude)
        # sin of a large unsure number is anything.
        if any(p.magnitude > 20 or not p.finite for p in parts):
            return None
        return Expr("real", form, parts, magnitude, UNSURE)

    def edge_function(self, depth: int) -> Expr:
        """Functions outside of their domain: of exact numbers, so that nan and inf are sure."""
        form = self.pick(EDGE_FUNCTIONS)
        parts = [self.number(depth) for _ in range(form.count("%s"))]
        if form.startswith("pow") and parts[0].kind != "real":
            first = parts[0]
            parts[0] = Expr("real", "(%s + 0.0)", (first,), first.magnitude + 1, first.fraction, first.finite)
        if form[:3] in ("tan", "sin", "cos") and parts[0].magnitude > 20:
            form = "sqrt[%s]"
        return Expr("real", form, tuple(parts), 30, UNSURE, False)

    # ------------------------------------------------------------- aggregations and choices

    def fresh_variable(self) -> str:
        self.variable_count += 1
        return f"?v{self.variable_count}"

    def enter(self, variables: list[tuple[str, str]]) -> bool:
        """Puts variables into the scope, unless that makes too much work."""
        count = math.prod(self.size(of) for _, of in variables)
        if self.work * count > LARGEST_WORK or self.elements() * count > LARGEST_SCOPE:
            return False
        self.scope += variables
        self.work *= max(1, count)
        return True

    def leave(self, variables: list[tuple[str, str]]) -> None:
        del self.scope[-len(variables) :]
        self.work //= max(1, math.prod(self.size(of) for _, of in variables))

    def aggregation(self, make_body, make, most: int = 3):
        """make(binder, body, number of elements) with 1 to `most` variables in the scope of the body."""
        types = [self.any_type() for _ in range(self.rng.choice([1, 1, 1, 2, 3][: most + 2]))]
        return self.aggregation_over([t.name for t in types[:most]], make_body, make)

    def aggregation_over(self, types: list[str], make_body, make):
        variables = [(self.fresh_variable(), name) for name in types]
        if not self.enter(variables):
            return None
        body = make_body()
        self.leave(variables)
        count = math.prod(map(self.size, types))
        binder = "{" + ", ".join(f"{variable} : {of}" for variable, of in variables) + "}"
        return make(binder, body, count)

    def reduction(self, part, depth: int) -> Expr | None:
        name = self.pick(["sum", "sum", "prod", "min", "max"])

        def make(binder, body, count):
            kind = "real" if body.kind == "real" else "int"
            magnitude, fraction = body.magnitude, body.fraction
            if name == "sum":
                magnitude += math.ceil(math.log2(count)) if count else 0
            elif name == "prod":
                magnitude, fraction = magnitude * max(count, 1), min(UNSURE, fraction * max(count, 1))
            if name == "prod" and not body.finite and count > 1:
                return None
            form = f"({name}_{binder} [%s])"
            return self.known(kind, form, (body,), magnitude, fraction, body.finite)

        return self.aggregation(lambda: part(depth), make)

    def average(self, depth: int, rough: bool) -> Expr | None:
        def make(binder, body, count):
            if body.magnitude > 40 or (count not in (1, 2, 4, 8) and not rough):
                return None
            fraction = body.fraction + int(math.log2(count)) if count in (1, 2, 4, 8) else UNSURE
            form = f"(avg_{binder} [%s])"
            return self.known("real", form, (body,), body.magnitude + 6, fraction, body.finite)

        return self.aggregation(lambda: self.number(depth, rough), make)

    def arg_best(self, type_name: str, depth: int) -> Expr:
        variable = self.fresh_variable()
        name = self.pick(["argmax", "argmin"])
        if not self.enter([(variable, type_name)]):
            return Expr(type_name, f"{name}_{{{variable} : {type_name}}} [0]")
        self.nested_terms += 1
        body = self.number(depth) if self.nested_terms <= 3 else self.constant("int")
        self.nested_terms -= 1
        self.leave([(variable, type_name)])
        return Expr(type_name, f"{name}_{{{variable} : {type_name}}} [%s]", (body,))

    def conditional(self, kind: str, part, depth: int) -> Expr:
        condition = self.boolean(depth)
        return self.choice(kind, "(if (%s) then %s else %s)", (condition,), [part(depth), part(depth)])

    def choice(self, kind: str, form: str, before: tuple[Expr, ...], values: list[Expr]) -> Expr:
        if kind == "real" and all(v.kind != "real" for v in values):
            values[0] = Expr("real", "(%s + 0.0)", (values[0],), values[0].magnitude, 0, values[0].finite)
        return Expr(
            kind,
            form,
            (*before, *values),
            max(v.magnitude for v in values),
            max(v.fraction for v in values),
            all(v.finite for v in values),
        )

    def switch(self, kind: str, part, depth: int) -> Expr | None:
        enumerated = [t for t in self.problem.types if t.enumerated and t.members]
        type_ = self.pick(enumerated)
        subject = self.reference(type_.name, min(depth, 1))
        if subject is None:
            return None
        members = list(type_.members)
        self.rng.shuffle(members)
        labels = [f"case @{member}" for member in members]
        if self.chance(0.5):
            labels[self.rng.randrange(len(labels)) :] = ["default"]
            self.rng.shuffle(labels)
        form = "(switch (%s) { " + ", ".join(f"{label} : %s" for label in labels) + " })"
        return self.choice(kind, form, (subject,), [part(depth) for _ in labels])

    # ------------------------------------------------------------------------------ objects

    def member(self, type_name: str, depth: int) -> Expr:
        type_ = self.problem.type(type_name)
        variables = [variable for variable, of in self.scope if of == type_name]
        options = [(2, lambda d: self.reference(type_name, d)), (1, lambda d: self.arg_best(type_name, d))]
        if variables:
            options.append((2, lambda _d: Expr(type_name, self.pick(variables))))
        if type_.enumerated:
            options.append((2, lambda _d: self.literal(type_)))
        if depth > 0:
            part = lambda d: self.member(type_name, d)  # noqa: E731
            options.append((2, lambda d: self.conditional(type_name, part, d)))
            options.append((1, lambda d: self.switch(type_name, part, d)))
            if self.flavour.draws:
                options.append((2, lambda d: self.discrete_over(type_name, d)))
                if type_.enumerated:
                    options.append((2, lambda d: self.discrete(type_, d)))
        found = self.pick_weighted(options)(max(0, depth - 1))
        return self.grouped(found or self.arg_best(type_name, 0))
