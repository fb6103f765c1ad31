"""Signs of zeros: sums to which few or no objects contribute, and expressions that show their
zeros' signs."""

from rddl_problem import UNSURE, Expr

# Forms of one number that show the sign of zero: as a bool, and as a real.
TOLD_BY_BOOL = ("(1.0 / %s > 0.0)", "(1.0 / %s < 0.0)", "(1.0 / %s == -1.0 / 0.0)", "(atan[1.0 / %s] >= 0.0)")
TOLD_BY_REAL = (
    "max[-9.0, min[9.0, 1.0 / %s]]", "(1.0 / %s)", "atan[2.5 / %s]", "tanh[-1.0 / %s]",
    "(if (1.0 / %s < 0.0) then 3.0 else 4.0)",
)  # fmt: skip
# Forms of one number; the sign of their zero depends on the number.
OF_ONE = (
    "(0.0 - %s)", "(%s - 0.0)", "(%s + 0.0)", "(0.0 + %s)", "(%s + -0.0)", "(-0.0 - %s)", "-(%s)", "-(-(%s))",
    "(0.0 * %s)", "(-0.0 * %s)", "(%s * 1.0)", "(-1.0 * %s)", "(%s / 4.0)", "(%s / -1.0)", "(0.0 / (%s + 2.5))",
    "min[%s, 0.0]", "min[0.0, %s]", "max[%s, 0.0]", "max[0.0, %s]", "max[-0.0, %s]", "min[-0.0, %s]", "abs[%s]",
    "pow[%s, 2.0]", "pow[%s, 3.0]", "sqrt[max[%s, -0.0]]", "fmod[%s, 2.5]", "sin[%s]", "(1.0 * round[0.1 * %s])",
    "(if (%s == 0.0) then %s else 1.5)", "(%s - %s)", "(%s + %s)", "(%s * %s)", "tanh[0.5 * %s]",
)  # fmt: skip
# Forms of a bool and a number.
TERMS = (
    "(%s * %s)", "(%s * %s)", "(%s * %s)", "(%s * -(%s))", "(0.0 - %s * %s)", "(if (%s) then %s else 0.0)",
    "(if (%s) then %s else -0.0)", "(%s * (0.0 * %s))", "(-1.0 * %s * %s)", "(%s * %s / 4.0)", "(%s * sqrt[abs[%s]] * -2.5)",
)  # fmt: skip


class Signs:
    """A part of a generator (generate.py), for wild problems only, where zeros and infinities go
    anywhere."""

    def bool_by_sign(self, depth: int) -> Expr | None:
        return self.told(TOLD_BY_BOOL, "bool") if self.flavour.wild else None

    def real_by_sign(self, depth: int) -> Expr | None:
        return self.told(TOLD_BY_REAL, "real") if self.flavour.wild else None

    def told(self, forms, kind: str) -> Expr:
        return Expr(kind, self.pick(forms), (self.zero_now_and_then(),), 10, UNSURE, False)

    def zero_now_and_then(self) -> Expr:
        value = self.pick_weighted([
            (3, self.sum_of_few), (2, self.sum_in_sum), (1, self.sum_of_row), (2, self.zero_of_number),
            (1, lambda: self.expensive_terms(0)), (1, lambda: self.pieces(0)), (1, lambda: self.weighted_sum(0)),
        ])() or self.zero_of_number()  # fmt: skip
        if self.chance(0.3):
            value = self.with_form(self.pick(OF_ONE), value)
        if self.chance(0.2):
            value = Expr("real", self.pick(["(%s + %s)", "(%s - %s)"]), (value, self.zero_of_number()), 20, UNSURE, False)
        return value

    def zero_of_number(self) -> Expr:
        number = self.number_that_changes(exact=False) or self.constant("real")
        return self.with_form(self.pick(OF_ONE), number)

    def with_form(self, form: str, value: Expr) -> Expr:
        return Expr("real", form, (value,) * form.count("%s"), 20, UNSURE, False)

    def term(self, variables) -> Expr:
        """A term of these objects: for most a zero of either sign."""
        number = self.over("real", variables, None, exact=False) or self.constant("real")
        if self.chance(0.3):
            number = self.with_form(self.pick(OF_ONE), number)
        counts = self.over("bool", variables) or self.boolean(0)
        return Expr("real", self.pick(TERMS), (counts, number), 20, UNSURE, False)

    def sum_of_few(self) -> Expr | None:
        """A sum over the objects that a table or an equality chooses, which is often no object or
        one."""
        types = [of for _, f in self.visible for of in (f.range, *f.parameters) if self.problem.type(of)]
        types = [of for of in types if self.size(of)]
        if not types:
            return None

        def body():
            variable, of = self.scope[-1]
            chosen = self.chosen(variable, of)
            form = self.pick(["(%s * %s)", "(%s * %s)", "(if (%s) then %s else 0.0)"])
            return Expr("real", form, (chosen, self.term([variable])), 20, UNSURE, False)

        return self.aggregation_over(
            [self.pick(types)], body, lambda binder, e, _n: Expr("real", f"(sum_{binder} [%s])", (e,), 30, UNSURE, False)
        )

    def chosen(self, variable: str, type_name: str) -> Expr:
        """A bool that holds for few objects."""
        options = [self.over("bool", [variable], ("non-fluent",)), self.is_inside()]
        options += [Expr("bool", f"({variable} == %s)", (term,)) for _ in "12" if (term := self.reference(type_name, 0))]
        options += [Expr("bool", f"({variable} == {other})") for other, of in self.scope[:-1] if of == type_name]
        return self.pick([option for option in options if option] or [self.boolean(0)])

    def sum_in_sum(self) -> Expr | None:
        def body(variables):
            inner = self.sum_of_few() or self.term(variables)
            return Expr("real", "(%s * %s)", (self.over("bool", variables) or self.boolean(0), inner), 30, UNSURE, False)

        found = self.over_objects(0, "", body, most=1)
        return found and Expr("real", f"(sum_{found[0]} [%s])", (found[1],), 30, UNSURE, False)
