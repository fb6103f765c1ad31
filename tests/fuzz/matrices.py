"""Matrices and random vectors: inverses of what is nearly singular, parts of what nearly underflows."""

from rddl_problem import UNSURE, Expr, Fluent

LARGEST_AXIS = 6
TINY = "0." + "0" * 309 + "1"


class Matrices:
    """A part of a generator (generate.py). For our own engines alone: numpy eliminates in another
    order."""

    def fluents_of_matrices(self) -> list[Fluent]:
        """Terms of a matrix, its inverse, and random parts of 1."""
        axis = self.problem.types[0].name
        if not self.flavour.wild or not 0 < self.size(axis) <= LARGEST_AXIS or not self.chance(0.5):
            return []
        term = Fluent("TERM", "non-fluent", "real", (axis, axis), "0.0")
        for row, column in self.problem.groundings(term):
            if row == column:
                term.values[(row, column)] = self.pick(["1.0", "1.0", "4.0", "-2.5", TINY, "0.0"])
            elif self.chance(0.2):
                term.values[(row, column)] = self.pick(["1.0", "-0.5", TINY])
        shape = Fluent("SHAPE", "non-fluent", "real", (axis,), self.pick(["1.0", "0.25", TINY]))
        for tuple_ in self.problem.groundings(shape):
            if self.chance(0.2):
                shape.values[tuple_] = self.pick(["3.0", "0.5", TINY])
        fluents = [term, shape, Fluent("ratio", "interm-fluent", "real", (axis, axis))]
        if self.flavour.draws:
            fluents.append(Fluent("part", "interm-fluent", "real", (axis,)))
        for fluent in fluents:
            fluent.magnitude, fluent.fraction, fluent.finite = 10, UNSURE, fluent.role == "non-fluent"
        return fluents

    def definition_of_matrix(self, fluent: Fluent) -> Expr:
        about = dict(magnitude=10, fraction=UNSURE, finite=False)
        own = self.scope[0][0]
        if fluent.name == "part":
            return Expr("real", f"Dirichlet[{own}](SHAPE(_))", (), **about)
        other = self.scope[1][0]
        function = self.pick(["inverse", "inverse", "pinverse"])
        element, parts = f"TERM({own}, {other})", ()
        if self.chance(0.5):
            element += self.pick([" + %s", f" + (if ({own} == {other}) then %s else 0.0)"])
            parts = (self.finite_number(1, rough=True, always=True),)
        return Expr("real", f"{function}[row={own}, col={other}] [{element}]", parts, **about)
