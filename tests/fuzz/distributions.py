"""Draws: of any distribution, anywhere."""

from rddl_problem import UNSURE, Expr, Type


class Distributions:
    """A part of a generator (generate.py)."""

    def probability(self, depth: int) -> Expr:
        if self.chance(0.5):
            return Expr("real", self.pick(["0.5", "0.0", "1", "0.25", "true", "0.9"]))
        value = self.number(depth, True)
        # Faults now and then.
        return Expr("real", "max[0.0, min[1.0, %s]]" if self.chance(0.9) else "%s", (value,))

    def positive(self, depth: int) -> Expr:
        value = self.number(depth, True)
        return Expr("real", "(min[abs[%s], 20] + 0.5)" if self.chance(0.95) else "%s", (value,))

    def bernoulli(self, depth: int) -> Expr:
        return Expr("bool", "Bernoulli(%s)", (self.probability(depth),))

    def counting_draw(self, depth: int) -> Expr:
        form, parameters = self.pick(
            [
                ("Poisson(%s)", [self.positive]),
                ("Geometric(max[0.01, %s])", [self.probability]),
                ("Binomial(mod[%s, 20], %s)", [self.integer, self.probability]),
                ("NegativeBinomial(%s, max[0.01, %s])", [self.positive, self.probability]),
            ]
        )
        return Expr("int", form, tuple(make(depth) for make in parameters), 30)

    def continuous_draw(self, depth: int) -> Expr:
        two = self.pick(["Weibull", "Gamma", "Beta", "Pareto", "Gompertz", "Kumaraswamy"])
        located = self.pick(["Normal", "Gumbel", "Laplace", "Cauchy"])
        rough = lambda d: self.number(d, True)  # noqa: E731
        form, parameters = self.pick(
            [
                (f"{two}(%s, %s)", [self.positive, self.positive]),
                (f"{located}(%s, %s)", [rough, self.positive]),
                (f"{self.pick(['Exponential', 'Student', 'ChiSquare'])}(%s)", [self.positive]),
                ("Uniform(-1, %s)", [self.positive]),
            ]
        )
        return Expr("real", form, tuple(make(depth) for make in parameters), 30, UNSURE, False)

    def discrete(self, type_: Type, depth: int) -> Expr:
        members = list(type_.members)
        self.rng.shuffle(members)
        if self.chance(0.5):
            weights = ["0.0"] * len(members)
            weights[0] = "0.75"
            weights[-1] = "0.25" if len(members) > 1 else "1.0"
            cases = ", ".join(f"@{m} : {w}" for m, w in zip(members, weights))
            return Expr(type_.name, f"Discrete({type_.name}, {cases})")
        cases = ", ".join(f"@{m} : %s" for m in members)
        weights = tuple(self.positive(depth) for _ in members)
        return Expr(type_.name, f"UnnormDiscrete({type_.name}, {cases})", weights)

    def discrete_over(self, type_name: str, depth: int) -> Expr | None:
        variable = self.fresh_variable()
        if not self.enter([(variable, type_name)]):
            return None
        self.nested_terms += 1
        weight = self.positive(depth) if self.nested_terms <= 3 else Expr("real", "0.5")
        self.nested_terms -= 1
        self.leave([(variable, type_name)])
        return Expr(type_name, f"UnnormDiscrete_{{{variable} : {type_name}}} [%s]", (weight,))
