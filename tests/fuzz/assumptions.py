"""Edge cases of the assumptions of passes: places that a step changes, coefficients that round,
objects that a draw binds, terms that fault or draw for some objects only."""

from rddl_problem import UNSURE, Expr, Fluent

FACTORS = ("0.1", "0.2", "0.3", "0.6", "0.7", "1.1", "0.25", "3.0")
WHOLE_FACTORS = ("5.0", "10.0", "10.0", "20.0", "100.0", "0.5")
LARGE_FACTORS = ("10000000000.0", "0.0000000001", "4503599627370496.0", "0.00000095367431640625")


class Assumptions:
    """A part of a generator (generate.py). Each method gives None if the problem lacks what it
    needs."""

    # ---------------------------------------------------- bounds at places that a step changes

    def fluents_with_bounds(self) -> list[Fluent]:
        """A speed that is bounded at some place, and what chooses the place."""
        place = self.problem.types[0].name
        fits = self.size(place) <= self.elements_left // 2
        if not fits or not self.chance(0.7 if self.flavour.finite else 0.12):
            return []
        kind = self.pick(["real", "real", "int"])
        self.is_upper = self.chance(0.7)
        self.usual_place = self.pick(["turn", "turn", "turn", "NEXT(turn)", "own", "HOME", "NEXT(own)"])
        fluents = [
            self.declared("NEXT", "non-fluent", place, (place,)),
            self.declared("HOME", "non-fluent", place, ()),
            self.declared("bound", self.pick(["non-fluent", "non-fluent", "state-fluent"]), kind, (place,)),
            self.declared("turn", "state-fluent", place, ()),
            self.declared("speed", "state-fluent", kind, (place,)),
        ]
        if any(not fluent.parameters for fluent in fluents if fluent.name in ("NEXT", "bound", "speed")):
            return []  # no room was left for all places
        for fluent in fluents:
            if fluent.range == "real":
                fluent.fraction = UNSURE
            if fluent.name in ("bound", "NEXT") and self.chance(0.9):
                self.differ_by_place(fluent)
            if fluent.name == "speed":  # where the bound holds, most often
                fluent.default = "-500" if self.is_upper else "500"
                fluent.values = {o: v for o, v in fluent.values.items() if self.chance(0.3)}
        return fluents

    def differ_by_place(self, fluent: Fluent) -> None:
        """A bound for each place, and a way through all of them."""
        places = self.problem.type(fluent.parameters[0]).members
        shift = self.rng.randint(1, 3)
        for number, name in enumerate(places):
            following = places[(number + shift) % len(places)]
            fluent.values[(name,)] = following if fluent.name == "NEXT" else str(self.rng.randint(-8, 8))

    def place(self, own: str | None) -> str:
        """Chooses the object of an expression: the same for most expressions of a problem."""
        chosen = self.usual_place if self.chance(0.85) else self.pick(["own", "turn", "HOME", "NEXT(own)", "NEXT(turn)"])
        return chosen.replace("own", own or "turn")

    def definition_with_bounds(self, fluent: Fluent) -> Expr | None:
        if fluent.name == "turn":
            condition = self.boolean(0)
            form = self.pick(["NEXT(turn)", "NEXT(turn)", "(if (%s) then HOME else NEXT(turn))"])
            return Expr(fluent.range, form, (condition,) * form.count("%s"))
        own = self.scope[0][0] if self.scope else None
        about = dict(magnitude=10, fraction=fluent.fraction)
        if fluent.name == "bound":
            return Expr(fluent.range, self.pick([f"bound({own})", f"bound({self.place(own)})"]), (), **about)
        limit, speed = f"bound({self.place(own)})", f"speed({self.place(own)})"
        parts = ()
        if self.chance(0.3):
            other = self.fresh_variable()
            binder = f"{{{other} : {self.problem.types[0].name}}}"
            speed, parts = "%s", (Expr(fluent.range, f"(max_{binder} [speed({other})])"),)
        sign, inner, outer, far = ("+", "min", "max", "-500") if self.is_upper else ("-", "max", "min", "500")
        beyond = f"{speed} {sign} 900"
        if self.chance(0.4):
            beyond = self.pick([f"{speed} {sign} 3", f"{speed} {sign} abs[{limit}]", f"{limit} {sign} {speed}", speed])
        bounded = self.pick([
            f"{inner}[{limit}, {outer}[{far}, {beyond}]]", f"{outer}[{far}, {inner}[{beyond}, {limit}]]",
        ])  # fmt: skip
        if self.chance(0.15):
            form = f"(if (%s) then {bounded} else speed({own}))"
            return Expr(fluent.range, form, (self.boolean(1), *parts), **about)
        return Expr(fluent.range, bounded, parts, **about)

    def bounds_at_places(self) -> list[Expr]:
        """Returns bounds as invariants: at one place, or at all of them."""
        place = self.problem.types[0].name
        op = self.pick(["<="] * 5 + ["<"]) if self.is_upper else self.pick([">="] * 5 + [">"])
        own = self.fresh_variable()
        around = self.pick([None, None, None, own])
        where = self.place(around)
        limit = where if self.chance(0.85) else self.place(around)
        body = f"speed({where}) {op} bound({limit})"
        if self.chance(0.2):
            body = f"bound({limit}) {'>=' if self.is_upper else '<='} speed({where})"
        if own in body:
            return [Expr("bool", f"(forall_{{{own} : {place}}} [{body}])")]
        return [Expr("bool", f"({body})")]

    def clamped_by_table(self, fluent: Fluent) -> Expr | None:
        """Clamps as bounds_of_state demands: by the entry of the object itself, or of one that
        changes."""
        names = {name for name, f in self.visible if f.parameters or name == "at"}
        if fluent.name not in ("stock", "cap") or not fluent.parameters or fluent.is_exact() or "COST" not in names:
            return None
        own = self.scope[0][0]
        if fluent.name == "cap":
            return Expr("real", f"COST({own})", (), 10, UNSURE)
        value = self.number(1, rough=True)
        if not value.finite:
            return None
        whose = "at" if self.clamp_is_of_at and "at" in names else own
        form = self.pick(["max[-500.0, min[COST({}), (%s + 0.0)]]", "min[COST({}), max[-500.0, (%s + 0.0)]]"])
        return Expr("real", form.format(whose), (value,), 10, UNSURE)

    def bounds_of_state(self) -> list[Expr]:
        """Returns bounds that a clamp keeps, by constants or by an entry that a table or a state
        chooses."""
        names = {name for name, f in self.visible if f.parameters or name == "at"}
        type_name = self.problem.types[0].name
        if {"stock", "COST"} <= names and self.chance(0.6):
            limit = "cap" if "cap" in names and self.chance(0.7) else "COST"
            if "at" in names and self.chance(0.6):
                return [Expr("bool", f"(stock(at) <= {limit}(at))")]
            return [Expr("bool", f"(forall_{{?c : {type_name}}} [stock(?c) <= {limit}(?c)])")]
        numbers = [(name, f) for name, f in self.visible if f.range == "real" and f.role == "state-fluent"]
        if not numbers:
            return []
        name, fluent = self.pick(numbers)
        limit = self.pick(["500.0", "500.0", "100.0"])
        body = self.pick([f"%s <= {limit}", f"(%s >= -{limit} ^ %s <= {limit})", f"%s >= -{limit}"])
        if not fluent.parameters:
            whole = Expr("real", name)
            return [Expr("bool", f"({body})", (whole,) * body.count("%s"))]
        if self.chance(0.3) and (whole := self.applied(name, fluent, 1)):
            return [Expr("bool", f"({body})", (whole,) * body.count("%s"))]
        variables = [(self.fresh_variable(), p) for p in fluent.parameters]
        binder = "{" + ", ".join(f"{v} : {of}" for v, of in variables) + "}"
        whole = Expr("real", f"{name}({', '.join(v for v, _ in variables)})")
        return [Expr("bool", f"(forall_{binder} [{body}])", (whole,) * body.count("%s"))]

    # ----------------------------------------------------------------- coefficients that round

    def sum_of_rounded_terms(self, depth: int) -> Expr | None:
        """Constants times bools and counts, in brackets: whole all in all, but not inside."""
        found = self.over_objects(depth, "", lambda variables: self.rounded_term(variables, self.pick([1, 1, 2])))
        if found is None:
            return None
        binder, inside, _ = found
        return Expr("real", f"(sum_{binder} [%s])", (inside,), 40, UNSURE)

    def rounded_threshold(self, depth: int) -> Expr | None:
        """A comparison in which one unit in the last place decides."""
        total = self.sum_of_rounded_terms(depth) if self.flavour.wild else None
        if total is None:
            return None
        return Expr("bool", f"(%s {self.pick(['>=', '==', '<', '>'])} {self.pick([1, 3, 7, 10, 12])})", (total,))

    def rounded_term(self, variables, depth: int) -> Expr:
        """A factor that makes the terms whole, or hides that they are not, times their sum."""
        terms = [self.simple_term(variables) for _ in range(self.pick([1, 2, 2, 3]))]
        if depth > 1:
            terms[0] = Expr("real", "(%s)", (self.rounded_term(variables, depth - 1),), 40, UNSURE)
        inside = "%s" + "".join(f" {self.pick('++-')} %s" for _ in terms[1:])
        factor = self.pick(LARGE_FACTORS if self.chance(0.15) else WHOLE_FACTORS)
        forms = [f"{factor} * ({inside})", f"({inside}) * {factor}", f"-({factor} * ({inside}))", f"({inside}) / {factor}"]
        return Expr("real", self.pick(forms), tuple(terms), 40, UNSURE)

    def simple_term(self, variables) -> Expr:
        counted = self.over("bool", variables, None) or self.boolean(0)
        if self.chance(0.2):
            counted = self.count(0) or counted
        return Expr("real", f"{self.pick(FACTORS)} * %s", (counted,), 10, UNSURE)

    # ------------------------------------------------------------- finite operands, infinite results

    def beyond_reals(self, depth: int) -> Expr | None:
        """A product with what is inf now and then, though all in it is moderate; and with a bool, 0 for some."""
        if not self.flavour.wild:
            return None
        tiny = self.pick(["0." + "0" * 320 + "1", "0." + "0" * 29 + "1", "0." + "0" * 40 + "1"])
        exponent = self.pick(["400.0", "1000.0", "17.0", "16.0", "0.5", "(0.0 - 300.0)"])
        shape = self.pick(["0.001", "0.01", "0.5", "1.0"])
        forms = [f"pow[(if (%s) then 10.0 else 2.0), {exponent}]", f"(1.0 / (%s + {tiny}))"]
        if self.flavour.draws:
            forms += [f"(%s + {name})" for name in (
                f"Weibull({shape}, 1.0)", f"Pareto({shape}, 1.0)", f"Student({shape})", f"Gompertz(1.0, {tiny})",
            )]  # fmt: skip
        def term(variables):
            factor = Expr("real", self.pick(forms), (self.boolean(0),), 40, UNSURE, False)
            zero = self.over("bool", variables, self.pick([None, ["non-fluent"]])) or self.boolean(0)
            return Expr("real", self.pick(["%s * %s", "[%s] * %s"]), (zero, factor), 40, UNSURE, False)

        found = self.over_objects(depth, "", term) if self.chance(0.7) else None
        if found is None:
            return Expr("real", "(%s)", (term([v for v, _ in self.scope]),), 40, UNSURE, False)
        return Expr("real", f"(sum_{found[0]} [%s])", (found[1],), 40, UNSURE, False)

    # ------------------------------------------------------------------- objects that are bound

    def chosen_by_sums(self, depth: int) -> Expr | None:
        """A number of an object that is drawn, or best, by aggregations that know it. Rounding decides."""
        if self.problem.flavour == "plain":
            return None
        numbers = [
            (name, f) for name, f in self.visible
            if f.range in ("real", "bool") and len(f.parameters) == 1 and (f.finite or self.flavour.wild)
        ]  # fmt: skip
        if not numbers:
            return None
        name, fluent = self.pick(numbers)
        chosen = self.chosen_object(fluent.parameters[0])
        if chosen is None:
            return None
        return Expr(fluent.range, f"{name}(%s)", (chosen,), fluent.magnitude, UNSURE, fluent.finite)

    def chosen_object(self, type_name: str) -> Expr | None:
        variable = self.fresh_variable()
        if not self.size(type_name) or not self.enter([(variable, type_name)]):
            return None
        weight = self.aggregated_with(variable)
        self.leave([(variable, type_name)])
        if weight is None:
            return None
        if self.flavour.draws and self.chance(0.7):
            form = f"UnnormDiscrete_{{{variable} : {type_name}}} [(1.5 + tanh[%s])]"
        else:
            form = f"{self.pick(['argmax', 'argmin'])}_{{{variable} : {type_name}}} [%s]"
        return Expr(type_name, form, (weight,))

    def aggregated_with(self, variable: str) -> Expr | None:
        """Over one or two objects, of a function of theirs and of this one."""
        numbers = [
            (name, f) for name, f in self.visible
            if f.range == "real" and len(f.parameters) in (1, 2) and all(map(self.size, f.parameters))
            and (f.finite or self.flavour.wild)
        ]  # fmt: skip
        if not numbers:
            return None
        weights = [5 if f.role != "non-fluent" and len(f.parameters) == 2 else 1 for _, f in numbers]
        name, fluent = self.rng.choices(numbers, weights)[0]

        def body():
            inner = [v for v, _ in self.scope[-len(fluent.parameters) :]]
            first = Expr("real", f"{name}({', '.join(inner)})")
            known = self.over("real", [variable], None, exact=False) or self.over("bool", [variable])
            known = known or self.constant("real")
            function = self.pick(["exp[min[{}, 3.0]]", "tanh[{}]", "sin[{}]", "(cos[{}] + sqrt[2.5])"])
            inside = self.pick(["%s * %s", "%s * %s", "%s + %s", "(if (%s > 0.5) then %s else 1.0)"])
            return Expr("real", function.format(inside), (first, known), 12, UNSURE, known.finite)

        name_of = self.pick(["sum", "sum", "sum", "max", "avg", "prod"])
        return self.aggregation_over(
            list(fluent.parameters),
            body,
            lambda binder, e, _n: Expr("real", f"({name_of}_{binder} [%s])", (e,), 20, UNSURE, e.finite),
        )

    # ----------------------------------------------------- what faults or draws for some objects

    def uncertain(self, variables) -> Expr | None:
        """A bool that has no value for some objects, or is drawn."""
        if self.flavour.draws and self.chance(0.5):
            return self.bernoulli(0)
        number = self.over("int", variables) or self.over("bool", variables)
        if number is None:
            return None
        return Expr("bool", self.pick(["(pow[2, %s] > 3)", "(pow[3, %s] == 1)", "(div[4, %s] >= 2)"]), (number,))

    def test_of_nothing(self, depth: int) -> Expr:
        """A quantifier over a type without members, around or inside of one over others."""
        empty = self.type_without_members()
        inside = f"({self.pick(['forall', 'exists'])}_{{{self.fresh_variable()} : {empty}}} [%s])"
        if self.chance(0.5):
            return Expr("bool", inside, (self.boolean(depth),))
        binder = f"{{{self.fresh_variable()} : {empty}, {self.fresh_variable()} : {self.any_type().name}}}"
        return Expr("bool", f"({self.pick(['forall', 'exists'])}_{binder} [%s])", (self.boolean(depth),))
