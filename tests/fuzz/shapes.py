"""Patterns that passes look for: counts of neighbours, pieces by intervals, masks, thresholds, ...

Over 400 lines: a function for each shape.
"""

import itertools
import math

from rddl_problem import UNSURE, Expr, Fluent

CHANGING = ("state-fluent", "action-fluent", "interm-fluent", "derived-fluent")
LIMITS = ("-2.4", "0.5", "1.0", "2.25", "10.0")


class Shapes:
    """A part of a generator (generate.py). Each method gives None if the problem lacks what it
    needs."""

    def tables_that_shapes_need(self) -> list[Fluent]:
        """Relations, the ends of intervals, and what they choose from."""
        objects = [t.name for t in self.problem.types if not t.enumerated]
        first, last = objects[0], objects[-1]
        wanted = [
            ("LINK", "non-fluent", "bool", (first, first)),
            ("MAY", "non-fluent", "bool", (first, last)),
            ("WEIGHT", "non-fluent", "real", (last,)),
            ("COST", "non-fluent", "real", (first,)),
            ("GAIN", "non-fluent", "real", (first, last)),
            ("on", "state-fluent", "bool", (first,)),
            ("busy", "state-fluent", "bool", (last,)),
            ("push", "action-fluent", "bool", (first,)),
            ("at", "state-fluent", first, ()),
            ("height", "state-fluent", "real", ()),
            ("stock", "state-fluent", "real", (first,)),
            ("cap", "state-fluent", "real", (first,)),
            ("flow", "state-fluent", "real", (first, last)),
        ]
        share = self.pick([0.3, 0.6, 0.9])
        fluents = [self.declared(*about) for about in wanted if self.chance(share)]
        for fluent in fluents:
            if fluent.name in ("stock", "cap"):
                fluent.fraction = UNSURE  # it is clamped by tables
        if self.chance(0.4):
            fluents += self.ladders(self.pick(objects))
        if self.chance(0.25):
            fluents += self.places(max(objects, key=self.size))
        return fluents

    def ladders(self, type_name: str) -> list[Fluent]:
        """Intervals side by side, and a number for each."""
        low, high, time = (Fluent(name, "non-fluent", "real", (type_name,)) for name in ("LOW", "HIGH", "TIME"))
        time.range = "int"
        low.magnitude = high.magnitude = time.magnitude = 10
        low.default, high.default, time.default = "-2.0", "-2.0", "0"
        width = self.pick([0.25, 0.5, 1.0])
        start = self.pick([-2.0, 0.0])
        gap = self.pick([0.0, 0.0, 0.25, -0.25])
        for number, member in enumerate(self.problem.type(type_name).members):
            low.values[(member,)] = str(start + width * number % 200)
            high.values[(member,)] = str(start + width * number % 200 + width - gap)
            time.values[(member,)] = str(number)
        return [low, high, time]

    def places(self, type_name: str) -> list[Fluent]:
        """A place in the plane for each object, and what is near one."""
        x, y = (Fluent(name, "non-fluent", "real", (type_name,)) for name in ("PLACE_X", "PLACE_Y"))
        for fluent in x, y:
            fluent.default, fluent.magnitude, fluent.fraction = "-25.0", 10, 2
            for member in self.problem.type(type_name).members:
                fluent.values[(member,)] = str(self.rng.randint(-100, 100) / 4)
        position = [self.declared(name, "state-fluent", "real", ()) for name in ("east", "north")]
        near = Fluent("near", "interm-fluent", "bool", (type_name,), magnitude=1, fraction=0)
        return [x, y, *position, near, self.declared("bumped", "state-fluent", "bool", ())]

    # --------------------------------------------------------------------------- references

    def over(self, kind: str, variables, roles=None, exact: bool = True) -> Expr | None:
        """A fluent of these variables, if one may be mentioned: of one of them at least."""
        wanted = set(variables)
        matching = []
        for name, fluent in self.visible:
            if fluent.range != kind or (roles and fluent.role not in roles):
                continue
            if exact and not fluent.is_exact() or not (fluent.finite or self.flavour.wild):
                continue
            choices = [[v for v, of in self.scope if of == p] for p in fluent.parameters]
            if choices and all(choices) and wanted & {v for vs in choices for v in vs}:
                matching.append((name, fluent, choices))
        if not matching:
            return None
        name, fluent, choices = self.pick(matching)
        arguments = []
        for choice in choices:  # each wanted variable once, if there is room
            fresh = [v for v in choice if v in wanted and v not in arguments]
            arguments.append(self.pick(fresh or choice))
        head = f"{name}({', '.join(['%s'] * len(arguments))})"
        parts = tuple(Expr("object", argument) for argument in arguments)
        return Expr(kind, head, parts, fluent.magnitude, fluent.fraction, fluent.finite)

    def types_of_relations(self) -> list[str]:
        """The types of the parameters of bool tables."""
        return [p for _, f in self.visible if f.range == "bool" for p in f.parameters if self.size(p)]

    def masked(self, variables, depth: int) -> Expr:
        """A bool of a table and something that changes."""
        mask = self.over("bool", variables, ("non-fluent",)) or self.boolean(0)
        subject = self.over("bool", variables, CHANGING) or self.boolean(min(1, depth))
        if self.chance(0.25):
            mask = Expr("bool", "~%s", (mask,))
        form = self.pick(["(%s ^ %s)"] * 5 + ["(%s => %s)", "(%s | %s)", "(%s <=> %s)", "(%s ~= %s)"])
        both = Expr("bool", form, (mask, subject))
        if self.chance(0.3):
            other = self.over("bool", variables) or self.boolean(0)
            if self.problem.flavour != "plain" and self.chance(0.2):
                other = self.uncertain(variables) or other
            both = Expr("bool", self.pick(["(%s ^ %s)", "(%s | %s)", "(%s ~= %s)"]), (both, other))
        return both

    def over_objects(self, depth: int, form: str, make_body, most: int = 2) -> Expr | None:
        """An aggregation over one object, or a pair, of types that bool tables are about."""
        types = self.types_of_relations()
        if not types:
            return None
        chosen = [self.pick(types) for _ in range(self.pick([1, 1, most]))]

        def body():
            return make_body([variable for variable, _ in self.scope[-len(chosen) :]])

        return self.aggregation_over(chosen, body, lambda binder, inside, n: (binder, inside, n))

    # ------------------------------------------------------------------------------- bools

    def shape_of_bool(self, depth: int) -> Expr | None:
        return self.pick_weighted([
            (3, self.any_masked), (2, self.count_compared), (1, self.opposite_bounds),
            (2, self.only_one), (1, self.in_an_interval), (1, self.different_objects), (2, self.threshold), (1, self.rounded_threshold),
            (2 if self.flavour.draws else 0, self.draw_in_branches),
            (2 if self.flavour.draws else 0, self.drawn_object),
            (1 if self.flavour.draws else 0, self.certain_draw),
        ])(depth)  # fmt: skip

    def drawn_object(self, depth: int) -> Expr | None:
        """Whether a drawn object, whose weights are sums, is that of the scope."""
        variables = [(v, of) for v, of in self.scope if self.size(of)]
        if not variables:
            return None
        variable, type_name = self.pick(variables)
        drawn = (self.fresh_variable(), type_name)
        if not self.enter([drawn]):
            return None
        weight = self.sum_of_row() or self.weighted_sum(0) or self.constant("real")
        self.leave([drawn])
        form = f"(UnnormDiscrete_{{{drawn[0]} : {type_name}}} [(min[abs[%s], 20] + 0.5)])"
        return Expr("bool", "(%s == %s)", (Expr(type_name, form, (weight,)), Expr(type_name, variable)))

    def any_masked(self, depth: int) -> Expr | None:
        found = self.over_objects(depth, "", lambda variables: self.masked(variables, depth))
        if found is None:
            return None
        binder, body, _ = found
        return Expr("bool", f"({self.pick(['exists', 'exists', 'forall'])}_{binder} [%s])", (body,))

    def count(self, depth: int) -> Expr | None:
        found = self.over_objects(depth, "", lambda variables: self.masked(variables, depth))
        if found is None:
            return None
        binder, body, number = found
        return Expr("int", f"(sum_{binder} [%s])", (body,), math.ceil(math.log2(number + 1)) + 1)

    def count_compared(self, depth: int) -> Expr | None:
        count = self.count(depth)
        if count is None:
            return None
        return Expr("bool", f"(%s {self.pick(['>=', '>', '==', '<', '<=', '~='])} {self.pick([0, 1, 2, 3, 8])})", (count,))

    def number_that_changes(self, exact: bool = True) -> Expr | None:
        matching = [
            (name, f)
            for name, f in self.visible
            if f.range == "real" and f.role in CHANGING and (f.is_exact() or not exact or self.flavour.wild)
        ]
        if not matching:
            return None
        found = self.applied(*self.pick(matching), 0)
        return found if found is not None and (found.finite or self.flavour.wild) else None

    def opposite_bounds(self, depth: int) -> Expr | None:
        number = self.number_that_changes()
        if number is None:
            return None
        limit = self.pick(LIMITS[1:])
        form = self.pick([
            f"(%s < -{limit} | %s > {limit})", f"(%s <= -{limit} | %s >= {limit})",
            f"(%s >= -{limit} ^ %s <= {limit})", f"(%s > -{limit} ^ %s < {limit})",
        ])  # fmt: skip
        return Expr("bool", form, (number, number))

    def only_one(self, depth: int) -> Expr | None:
        """exists of the one object that an object-valued fluent is."""
        types = [f.range for _, f in self.visible if self.problem.type(f.range) and self.size(f.range)]
        if not types:
            return None
        type_name = self.pick(types)
        term = self.reference(type_name, 0)
        if term is None:
            return None

        def body():
            variable = self.scope[-1][0]
            rest = self.over("bool", [variable]) or self.boolean(min(1, depth))
            same = Expr("bool", self.pick(["(%s == " + variable + ")", "(" + variable + " == %s)"]), (term,))
            return Expr("bool", "(%s ^ %s)", (same, rest))

        return self.aggregation_over(
            [type_name], body, lambda binder, inside, _n: Expr("bool", f"(exists_{binder} [%s])", (inside,))
        )

    def different_objects(self, depth: int) -> Expr | None:
        """Different objects of a type, most of which may change places."""

        def suits(fluent: Fluent) -> bool:
            return fluent.role in CHANGING and fluent.is_exact() and (fluent.finite or self.flavour.wild)

        fluents = [(n, f) for n, f in self.visible if len(f.parameters) == 1 and suits(f)]
        fluents = [(n, f) for n, f in fluents if self.size(f.parameters[0])]
        if not fluents:
            return None
        name, fluent = self.pick(fluents)
        numbers = ["%s == %s", "%s ~= %s", "%s < %s", "%s - %s > 0", "%s + %s < 1"]
        forms = {"bool": ["%s ^ %s", "%s | %s", "%s ~= %s"], "int": numbers, "real": numbers}
        form = self.pick(forms.get(fluent.range, numbers[:2]))
        is_exists = self.chance(0.5)

        def body() -> Expr:
            variables = [variable for variable, _ in self.scope[-count:]]
            values = [f"{name}({variable})" for variable in variables]
            pairs = list(itertools.combinations(range(count), 2))
            orders = [self.pick([(i, j), (j, i)]) for i, j in pairs]
            differ = [f"({variables[i]} ~= {variables[j]})" for i, j in orders if self.chance(0.9)]
            about = [f"({form % (values[i], values[j])})" for i, j in pairs if j == i + 1 or self.chance(0.5)]
            if is_exists:
                return Expr("bool", f"({' ^ '.join(differ + about)})", ())
            conditions = [condition.replace("~=", "==") for condition in differ] + about
            return Expr("bool", f"({' | '.join(conditions)})", ())

        count = self.pick([2, 2, 3])
        quantifier = "exists" if is_exists else "forall"
        return self.aggregation_over(
            [fluent.parameters[0]] * count,
            body,
            lambda binder, inside, _n: Expr("bool", f"({quantifier}_{binder} [%s])", (inside,)),
        )

    def is_inside(self) -> Expr | None:
        """Whether a number is in an interval of the innermost variable."""
        variable, type_name = self.scope[-1]
        number = self.number_that_changes()
        ladder = any(name == "LOW" and f.parameters == (type_name,) for name, f in self.visible)
        if number is None or not ladder:
            return None
        form = self.pick(["(%s >= LOW({v}) ^ %s < HIGH({v}))", "(LOW({v}) < %s ^ %s <= HIGH({v}))"])
        return Expr("bool", form.replace("{v}", variable), (number, number))

    def with_ladder(self, make_body, make):
        types = [f.parameters[0] for name, f in self.visible if name == "LOW"]
        if not types:
            return None
        return self.aggregation_over(types[:1], make_body, make)

    def in_an_interval(self, depth: int) -> Expr | None:
        def body():
            inside = self.is_inside() or self.boolean(0)
            return inside if self.chance(0.5) else Expr("bool", "(%s ^ %s)", (inside, self.boolean(0)))

        return self.with_ladder(body, lambda binder, e, _n: Expr("bool", f"(exists_{binder} [%s])", (e,)))

    def definition_with_places(self, fluent: Fluent) -> Expr:
        """Whether a place is near, of each object; and whether one is."""
        if fluent.name == "bumped":
            place = next(f for _, f in self.visible if f.name == "near").parameters[0]
            return Expr("bool", f"(exists_{{?p : {place}}} [near(?p)])", ())
        form = self.pick([
            "(pow[east - PLACE_X({v}), 2] + pow[north - PLACE_Y({v}), 2] <= {least})",
            "(abs[east - PLACE_X({v})] + abs[north - PLACE_Y({v})] < {least})",
            "(max[abs[east - PLACE_X({v})], abs[north - PLACE_Y({v})]] < {least})",
        ])  # fmt: skip
        least = self.pick(["0.25", "0.5", "2.5"])
        return Expr("bool", form.replace("{v}", self.scope[-1][0]).replace("{least}", least), ())

    def threshold(self, depth: int) -> Expr | None:
        """A sum of coefficients that have no exact doubles (in wild problems), and a limit."""
        steps = ["0.1", "0.3", "0.7", "1.1"] if self.flavour.wild else ["0.25", "0.5", "0.75"]

        def body(variables):
            first = self.over("bool", variables, CHANGING) or self.boolean(0)
            if self.chance(0.3):
                first = self.count(0) or first
            one = Expr("real", self.pick([
                f"{self.pick(steps)} * %s", f"%s * {self.pick(steps)}", f"3.0 * ({self.pick(steps)} * %s)",
                f"{self.pick(steps)} * (%s * {self.pick(steps)})", f"%s * {self.pick(steps)} / 0.5",
            ]), (first,))  # fmt: skip
            if self.chance(0.5):
                return one
            second = self.over("bool", variables) or self.boolean(0)
            return Expr("real", f"%s {self.pick('+-')} {self.pick(steps)} * %s", (one, second))

        found = self.over_objects(depth, "", body)
        if found is None:
            return None
        binder, inside, _ = found
        limit = self.pick(["1.0", "0.5", "0.0", "0.3", "2.0"])
        name = self.pick(["sum", "sum", "sum", "max"])
        return Expr("bool", f"(({name}_{binder} [%s]) {self.pick(['>=', '==', '<', '>'])} {limit})", (inside,))

    def draw_in_branches(self, depth: int) -> Expr | None:
        """Branches that draw: of the same law, or the very same; or that cannot happen."""
        condition = self.count_compared(depth) or self.boolean(1)
        first, second = self.bernoulli(1), self.bernoulli(1)
        form = self.pick([
            (first, second), (first, first), (Expr("bool", "false"), second), (first, Expr("bool", "true")),
        ])  # fmt: skip
        return Expr("bool", "(if (%s) then %s else %s)", (condition, *form))

    def certain_draw(self, depth: int) -> Expr | None:
        """With a probability of 0 or 1: a product over neighbours, which bools decide."""

        def body(variables):
            subject = self.over("bool", variables, CHANGING) or self.boolean(0)
            return Expr("real", "1.0 - %s * %s", (subject, self.masked(variables, depth)))

        found = self.over_objects(depth, "", body)
        if found is None:
            return None
        binder, factor, _ = found
        form = self.pick(["Bernoulli(1.0 - prod_{} [{}])", "Bernoulli(prod_{} [{}])"])
        return Expr("bool", form.replace("{}", binder, 1).replace("{}", "%s"), (factor,))

    # ----------------------------------------------------------------------------- numbers

    def shape_of_int(self, depth: int) -> Expr | None:
        return self.pick_weighted([
            (4, self.count), (2, self.count_of_factors), (1, self.looked_up), (1, self.count_in_switch),
            (1, lambda d: self.steps_of_count(d, "int")),
        ])(depth)  # fmt: skip

    def count_of_factors(self, depth: int) -> Expr | None:
        """Counts pairs, where each bool knows but one of the two."""
        types = self.types_of_relations()
        if not types:
            return None
        chosen = [self.pick(types), self.pick(types)]

        def body():
            (a, _), (b, _) = self.scope[-2:]
            first = self.over("bool", [a]) or self.boolean(0)
            second = self.over("bool", [b], CHANGING) or self.boolean(0)
            both = Expr("bool", "(%s ^ %s)", (first, second))
            if self.chance(0.5) and (mask := self.over("bool", [a, b], ("non-fluent",))):
                both = Expr("bool", "(%s ^ %s)", (mask, both))
            return both

        return self.aggregation_over(chosen, body, lambda binder, e, n: Expr("int", f"(sum_{binder} [%s])", (e,), 14))

    def looked_up(self, depth: int) -> Expr | None:
        """The value of the object whose number this is."""
        number = self.reference("int", 0)
        if number is None or not any(name == "TIME" for name, _ in self.visible):
            return None

        def body():
            variable = self.scope[-1][0]
            value = self.over("int", [variable]) or self.constant("int")
            same = Expr("bool", f"(TIME({variable}) == %s)", (number,))
            return Expr("int", "(%s * %s)", (same, value), value.magnitude)

        return self.with_ladder(
            body, lambda binder, e, n: Expr("int", f"(sum_{binder} [%s])", (e,), e.magnitude + 10)
        )

    def count_in_switch(self, depth: int) -> Expr | None:
        return self.switch("int", lambda d: self.count(d) or self.constant("int"), min(depth, 1))

    def steps_of_count(self, depth: int, kind: str) -> Expr | None:
        """The value for a count of 0, of 1, and of more."""
        count = self.count(depth)
        if count is None:
            return None
        values = [self.constant(kind) for _ in range(3)]
        if self.chance(0.4):  # an exists of what is counted
            any_of = Expr("bool", count.form.replace("(sum_", "(exists_", 1), count.parts)
            return self.choice(kind, "(if (%s) then %s * %s else %s)", (any_of, count), values[:2])
        form = f"(if (%s {self.pick(['==', '>='])} 1) then %s else if (%s == 0) then %s else %s)"
        first, second, third = values
        return Expr(kind, form, (count, first, count, second, third), 4, 2)

    def shape_of_real(self, depth: int, rough: bool) -> Expr | None:
        rough = rough or self.flavour.wild
        options = [
            (2, lambda d: self.steps_of_count(d, "real")), (3, self.pieces), (2, self.weighted_sum),
            (2, self.line_of_count), (2, self.steps_of_number), (3, self.product_of_bools), (2, self.part_of_constants), (1, self.square),
        ]  # fmt: skip
        if rough:
            options += [
                (8 if self.flavour.finite else 4, self.function_of_count), (3, self.products_with_constants),
                (4, self.expensive_terms), (4, self.sum_of_rounded_terms), (1, self.chosen_by_sums),
                (2, self.functions_in_pairs), (2 if self.flavour.draws else 0, self.normal_in_branches),
                ((2 if self.scope else 8) if self.flavour.draws else 0, self.draw_times_constant),
            ]  # fmt: skip
        return self.pick_weighted(options)(depth)

    def product_of_bools(self, depth: int) -> Expr | None:
        """Of a constant for each true and each false bool: products that do not round, or do."""

        def body(variables):
            chosen = self.over("bool", variables, CHANGING) or self.boolean(0)
            steps = ["0.5", "1.0", "0.0", "1.5", "2.5"] + (["0.3", "-0.5"] if self.flavour.wild else [])
            return Expr("real", f"if (%s) then {self.pick(steps)} else {self.pick(steps)}", (chosen,))

        found = self.over_objects(depth, "", body, most=1)
        if found is None:
            return None
        binder, inside, _ = found
        return Expr("real", f"(prod_{binder} [%s])", (inside,), 100, UNSURE)

    def pieces(self, depth: int) -> Expr | None:
        """The value of the interval in which a number lies: a constant, or a value of the object."""

        def body():
            variable = self.scope[-1][0]
            roles = ("non-fluent",) if self.chance(0.6) else None
            value = self.over("real", [variable], roles) or self.constant("real")
            inside = self.is_inside() or self.boolean(0)
            form = self.pick(["(%s * %s)", "(if (%s) then %s else 0.0)"])
            return Expr("real", form, (inside, value), value.magnitude, value.fraction, value.finite)

        return self.with_ladder(
            body,
            lambda binder, e, n: self.known(
                "real", f"(sum_{binder} [%s])", (e,), e.magnitude + n.bit_length(), e.fraction, e.finite
            ),
        )

    def steps_of_number(self, depth: int) -> Expr | None:
        number = self.number_that_changes()
        if number is None:
            return None
        limits = sorted({self.pick(LIMITS) for _ in range(3)}, key=float)
        op = self.pick(["<", "<=", ">"])
        values = [self.constant("real") for _ in range(len(limits) + 1)]
        form = "".join(f"if (%s {op} {limit}) then %s else " for limit in limits)
        parts = [part for value in values[:-1] for part in (number, value)]
        return Expr("real", f"({form}%s)", (*parts, values[-1]), 3, 2)

    def weighted_sum(self, depth: int) -> Expr | None:
        def body(variables):
            weight = self.over("real", variables, ("non-fluent",)) or self.constant("real")
            return Expr("real", "(%s * %s)", (weight, self.masked(variables, depth)), weight.magnitude, weight.fraction)

        found = self.over_objects(depth, "", body)
        if found is None:
            return None
        binder, inside, number = found
        magnitude = inside.magnitude + number.bit_length()
        return self.known("real", f"(sum_{binder} [%s])", (inside,), magnitude, inside.fraction)

    def line_of_count(self, depth: int) -> Expr | None:
        count = self.count(depth)
        if count is None:
            return None
        form = self.pick(["(%s * 0.25 + 1.0)", "(2.5 - 0.5 * %s)", "min[1.0, 0.25 + 0.125 * %s]"])
        return Expr("real", form, (count,), count.magnitude + 2, 3)

    def part_of_constants(self, depth: int) -> Expr | None:
        """Computed of tables and variables alone."""
        everything = self.visible
        self.visible = [(name, f) for name, f in everything if f.role == "non-fluent"]
        draws, self.flavour = self.flavour, type(self.flavour)(False, self.flavour.wild, self.flavour.finite)
        constant = self.real(min(depth, 2), self.flavour.wild)
        self.visible, self.flavour = everything, draws
        other = self.number_that_changes()
        if other is None or not constant.finite:
            return constant
        return self.known(
            "real", "(%s * %s)", (constant, other), constant.magnitude + other.magnitude,
            min(UNSURE, constant.fraction + other.fraction), other.finite,
        )  # fmt: skip

    def square(self, depth: int) -> Expr | None:
        number = self.number_that_changes()
        if number is None:
            return None
        if number.is_exact() and not self.flavour.wild:  # pow is another library's
            form = "(%s * %s)"
            return self.known("real", form, (number, number), 2 * number.magnitude, 2 * number.fraction)
        return Expr("real", "pow[%s, 2.0]", (number,), 2 * number.magnitude, UNSURE, number.finite)

    def sum_of_row(self) -> Expr | None:
        """The sum of numbers over a row of a relation that the scope chooses."""
        relations = [
            f for _, f in self.visible if f.range == "bool" and f.role == "non-fluent" and len(f.parameters) == 2
        ]
        own = {of for _, of in self.scope}
        relations = [f for f in relations if f.parameters[0] in own and self.size(f.parameters[1])]
        if not relations:
            return None
        relation = self.pick(relations)
        outer = self.pick([variable for variable, of in self.scope if of == relation.parameters[0]])

        def body():
            variable = self.scope[-1][0]
            number = self.over("real", [variable], CHANGING, exact=False) or self.constant("real")
            if self.chance(0.15):
                number = self.draw_or_fault(relation.parameters[1], variable) or number
            form = f"({relation.name}({outer}, {variable}) * %s)"
            return Expr("real", form, (number,), number.magnitude, UNSURE, number.finite)

        return self.aggregation_over(
            [relation.parameters[1]],
            body,
            lambda binder, e, n: Expr("real", f"(sum_{binder} [%s])", (e,), e.magnitude + n.bit_length(), UNSURE, e.finite),
        )

    def draw_or_fault(self, type_name: str, variable: str) -> Expr | None:
        """A term that has a place of its own: a draw, or what has no value for some objects."""
        if self.flavour.draws and self.chance(0.6):
            return Expr("real", self.pick(["Normal(0.0, 1.0)", "Exponential(2.0)", "Uniform(-1, 1)"]))
        has_time = any(name == "TIME" and f.parameters == (type_name,) for name, f in self.visible)
        if not self.flavour.wild or not has_time:
            return None
        return Expr("real", f"pow[2, TIME({variable}) + 1]", (), 10)

    def best_by_state(self, type_name: str) -> Expr | None:
        variable = self.fresh_variable()
        if not self.enter([(variable, type_name)]):
            return None
        value = self.over("bool", [variable], CHANGING) or self.over("real", [variable], CHANGING)
        self.leave([(variable, type_name)])
        return value and Expr(type_name, f"(argmax_{{{variable} : {type_name}}} [%s])", (value,))

    def shaped_definition(self, fluent: Fluent) -> Expr | None:
        """The CPF of a fluent whose every object sums over a row, or knows a line by a count; or of
        one that is the best object."""
        if fluent.name == "at":
            return self.best_by_state(fluent.range)
        if clamp := self.clamped_by_table(fluent):
            return clamp
        if fluent.range == "real" and not fluent.is_exact() and self.chance(0.5 if self.flavour.finite else 0.1):
            count, weight = self.count(1), self.over("real", [v for v, _ in self.scope], ("non-fluent",), exact=False)
            if count is not None and weight is not None:
                line = self.line_of_each_object(count, weight)
                return Expr("real", "max[-500.0, min[500.0, %s]]", (line,), 10, UNSURE)
        if self.flavour.wild and self.chance(0.3) and fluent.range in ("bool", "real"):
            return self.bool_by_sign(1) if fluent.range == "bool" else self.wild_real(fluent, self.real_by_sign(1))
        total = self.sum_of_row()
        if total is None or not (total.finite or self.flavour.wild):
            return None
        if fluent.range == "bool" and self.flavour.draws:
            chance = self.pick(["(1.0 / (1.0 + exp[min[2.5 - %s, 30.0]]))", "(0.5 + 0.5 * tanh[%s])"])
            return Expr("bool", f"Bernoulli({chance})", (total,))
        if fluent.range != "real" or fluent.is_exact():
            return None
        forms = ["%s", "(%s * 0.25)", "(0.5 + %s)", "(sqrt[abs[%s]] * tanh[0.3 * %s])", "(exp[min[sin[%s], 3.0]] + cos[%s])"]
        forms += ["(%s + Normal(0.0, 1.0))", "(%s + Exponential(2.0))", "(%s * Uniform(-1, 1))"] if self.flavour.draws else []
        if self.flavour.draws and self.chance(0.3) and (drawn := self.drawn_object(1)):
            form = self.pick(["(Normal(0.0, 1.0) + tanh[%s] + %s)", "(%s + Normal(0.0, 1.0) + %s)"])
            return Expr("real", f"max[-500.0, min[500.0, {form}]]", (total, drawn), 10, UNSURE)
        form = self.pick(forms)
        if fluent.role == "state-fluent":
            form = f"max[-500.0, min[500.0, {form}]]"
        return Expr("real", form, (total,) * form.count("%s"), 10, UNSURE)

    # ----------------------------------------------------------- numbers whose rounding may differ

    def function_of_count(self, depth: int) -> Expr | None:
        count = self.count(depth)
        if count is None:
            return None
        weight = self.over("real", [v for v, _ in self.scope], ("non-fluent",), exact=False)
        if weight is not None and self.chance(0.5):
            return self.line_of_each_object(count, weight)
        form = self.pick([
            "(1.0 / (1.0 + exp[min[4.5 - %s, 30.0]]))", "pow[0.9, min[%s, 64]]", "sqrt[%s + 0.1]",
            "(0.45 + 0.1 * min[%s, 5])", "(1.0 / (%s + 1))", "(0.1 + 0.05 * %s)",
        ])  # fmt: skip
        return Expr("real", form, (count,), count.magnitude + 4, UNSURE)

    def line_of_each_object(self, count: Expr, weight: Expr) -> Expr:
        form = self.pick([
            "((0.1 + 0.5 * (1 + %s)) / (1.5 + abs[%s]))", "(0.45 + 0.3 * (0.7 + %s) / (0.5 + abs[%s]) / 3.1)",
            "min[0.9, 0.1 + 0.3 * (%s / 7.3) / (1.1 + abs[%s])]", "(exp[min[0.1 * %s, 3.0]] * %s)",
        ])  # fmt: skip
        return Expr("real", form, (count, weight), count.magnitude + weight.magnitude + 4, UNSURE)

    def sum_of_lines(self) -> Expr | None:
        """Over objects, each of which has its own line by a count."""
        tables = [
            (name, f) for name, f in self.visible
            if f.range == "real" and f.role == "non-fluent" and len(f.parameters) == 1 and self.size(f.parameters[0])
        ]  # fmt: skip
        if not tables:
            return None
        name, fluent = self.pick(tables)

        def body():
            weight = Expr("real", f"{name}({self.scope[-1][0]})", (), fluent.magnitude, UNSURE)
            count = self.count(0)
            return self.line_of_each_object(count, weight) if count is not None else weight

        return self.aggregation_over(
            [fluent.parameters[0]], body, lambda binder, e, _n: Expr("real", f"(sum_{binder} [%s])", (e,), 30, UNSURE)
        )

    def products_with_constants(self, depth: int) -> Expr | None:
        number = self.number_that_changes(exact=False)
        if number is None:
            return None
        form = self.pick([
            "(%s * 0.3 * 2.5)", "(%s / 7.0)", "(%s * 3.0 / 7.0)", "(%s * 0.1 + 2.0) * 4.0", "pow[%s, 3.0]",
            "(0.7 - %s - 0.2)", "max[0.0, %s]", "min[0.0, %s]", "(0.0 - 0.3 * %s)", "(0.0 * %s)",
        ])  # fmt: skip
        return Expr("real", form, (number,), 3 * number.magnitude + 2, UNSURE, number.finite)

    def expensive_terms(self, depth: int) -> Expr | None:
        """sum of a function that a bool lets count."""

        def body(variables):
            number = self.over("real", variables, None, exact=False) or self.constant("real")
            chosen = self.over("bool", variables, CHANGING) or self.boolean(0)
            function = self.pick(["sqrt[abs[%s]]", "(sin[%s] + cos[0.3 * %s])", "tanh[sin[%s] + %s]"])
            value = Expr("real", function, (number,) * function.count("%s"), max(5, number.magnitude), UNSURE, number.finite)
            form = self.pick(["(%s * %s)", "(%s * %s)", "(if (%s) then %s else 0.0)"])
            parts = (chosen, value) if "if" in form or self.chance(0.5) else (value, chosen)
            return Expr("real", form, parts, value.magnitude, UNSURE, value.finite)

        found = self.over_objects(depth, "", body)
        if found is None:
            return None
        binder, inside, number = found
        return Expr("real", f"(sum_{binder} [%s])", (inside,), inside.magnitude + number.bit_length(), UNSURE, inside.finite)

    def functions_in_pairs(self, depth: int) -> Expr | None:
        """A sum in a sum: the inner one does not know the outer object, or only that."""

        def inner(variables):
            number = self.over("real", variables, None, exact=False) or self.constant("real")
            chosen = self.masked(variables, 0)
            return Expr("real", "(%s * %s)", (number, chosen), number.magnitude, UNSURE, number.finite)

        def body(variables):
            found = self.over_objects(depth, "", inner, most=1)
            if found is None:
                return self.constant("real")
            binder, inside, number = found
            total = Expr("real", f"(sum_{binder} [%s])", (inside,), inside.magnitude + number.bit_length(), UNSURE, inside.finite)
            chosen = self.over("bool", variables) or self.boolean(0)
            return Expr("real", "(%s * %s)", (chosen, total), total.magnitude, UNSURE, total.finite)

        found = self.over_objects(depth, "", body, most=1)
        if found is None:
            return None
        binder, inside, number = found
        return Expr("real", f"(sum_{binder} [%s])", (inside,), inside.magnitude + number.bit_length(), UNSURE, inside.finite)

    def normal_in_branches(self, depth: int) -> Expr | None:
        condition = self.count_compared(depth) or self.boolean(1)
        mean = self.number_that_changes(exact=False) or self.constant("real")
        other = self.pick(["Normal(%s, 1.0)", "Normal(%s, 0.25)", "%s", "Uniform(%s, 900.0)"])
        return Expr("real", f"(if (%s) then Normal(%s, 1.0) else {other})", (condition, mean, mean), 12, UNSURE, False)

    def drawn_in_pairs(self) -> Expr | None:
        """An object whose weights are sums over pairs, each of which knows it."""
        types = [f for _, f in self.visible if f.range == "real" and f.role == "state-fluent" and len(f.parameters) == 1]
        if not types:
            return None
        fluent = self.pick(types)
        type_name = fluent.parameters[0]
        w, x, y = (self.fresh_variable() for _ in range(3))
        drawn, first, second = (f"{fluent.name}({v})" for v in (w, x, y))
        term = self.pick([f"tanh[{first} * {second} + {drawn}]", f"sin[{first} - {second}] * cos[{drawn}]"])
        inside = self.pick([
            f"sum_{{{x} : {type_name}, {y} : {type_name}}} [{term}]", f"sum_{{{x} : {type_name}}} [sin[{first}] * cos[{drawn}]]",
        ])  # fmt: skip
        draw = Expr(type_name, f"(UnnormDiscrete_{{{w} : {type_name}}} [(1.5 + tanh[{inside}])])")
        other = self.reference(type_name, 0) or self.arg_best(type_name, 0)
        return Expr("bool", "(%s == %s)", (draw, other))

    def draw_times_constant(self, depth: int) -> Expr:
        """A draw times a factor that turns out to be simple."""
        draw = self.pick([
            self.continuous_draw(0), self.counting_draw(0), Expr("real", "Normal(0.0, 1.0)"), self.bernoulli(0),
        ])  # fmt: skip
        other = self.pick([self.part_of_constants(1) or self.constant("real"), Expr("real", "exp[0.0]"), Expr("real", "cos[0.0]"), self.constant("real")])
        parts = (draw, other) if self.chance(0.5) else (other, draw)
        return Expr("real", "(%s * %s)", parts, 40, UNSURE, False)
