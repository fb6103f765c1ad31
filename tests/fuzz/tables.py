"""Sizes of types, and tables: what the structure of an instance can be."""

import itertools
import math

from rddl_problem import UNSURE, Fluent, Problem

# Around the numbers at which compiled code changes: one object, registers, words of bits, tables.
FEW = (1, 2, 2, 3, 3, 4, 5)
SOME = (7, 8, 9, 11, 13, 15, 16, 17)
MANY = (31, 32, 33, 63, 64, 65, 100, 127, 128, 129)
VERY_MANY = (512, 513)

PLAIN_INTS = (0, 1, 1, 2, 3, -1, -2, 7, 100, -500)
PLAIN_REALS = (0.0, 1.0, 0.5, -0.5, 2.25, -3.75, 17.0, 250.5)
ROUGH_REALS = (0.1, 0.3, 0.7, -0.1, 0.333, 1.1, 2.4, -2.4, 3.3, 0.0, 1.0, -0.0)
LARGE_INTS = (9007199254740993, -9007199254740993, 4611686018427387904, 9223372036854775807)


class Tables:
    """A part of a generator (generate.py)."""

    problem: Problem

    def sizes(self) -> tuple[int, int]:
        """The sizes of the two object types: most problems are small enough to be quick."""
        scale = self.rng.choices((FEW, SOME, MANY, VERY_MANY), (30, 50, 15, 5))[0]
        first, second = self.pick(scale), self.pick(FEW + SOME if scale is SOME else FEW)
        if self.chance(0.1):
            second = 1
        return (first, second) if self.chance(0.6) else (second, first)

    def give_values(self, fluent: Fluent) -> None:
        objects = {t.name for t in self.problem.types if not t.enumerated}
        if fluent.range not in objects:
            fluent.default = self.random_value(fluent)
        if fluent.role == "action-fluent":
            return
        if fluent.default is None:
            fluent.values = {o: self.random_value(fluent) for o in self.problem.groundings(fluent)}
        elif fluent.range == "bool":
            self.give_pattern(fluent)
        elif self.chance(0.85):
            self.give_numbers(fluent)

    def give_pattern(self, fluent: Fluent) -> None:
        """Chooses the elements that differ from the default."""
        sizes = [self.size(parameter) for parameter in fluent.parameters]
        if not sizes:
            return
        is_other = self.pick([
            self.dense_pattern, self.dense_pattern, self.dense_pattern, self.diagonal, self.banded,
            self.function_of_row, self.same_rows, self.few_exceptions,
        ])(sizes)  # fmt: skip
        other = "false" if fluent.default == "true" else "true"
        for index, objects in self.indexed(fluent):
            if is_other(index):
                fluent.values[objects] = other

    def indexed(self, fluent: Fluent):
        ranges = [range(self.size(parameter)) for parameter in fluent.parameters]
        return zip(itertools.product(*ranges), self.problem.groundings(fluent))

    def dense_pattern(self, sizes):
        density = self.pick([0.05, 0.1, 0.3, 0.5, 0.9])
        if math.prod(sizes) > 2500:
            density = 0.02
        return lambda index: self.chance(density)

    def diagonal(self, sizes):
        return lambda index: len(set(index)) <= 1

    def banded(self, sizes):
        width = self.pick([1, 1, 2])
        return lambda index: len(index) < 2 or abs(index[0] - index[1]) == width

    def function_of_row(self, sizes):
        """A pattern with at most one in each row, or in each column."""
        axis = self.pick([0, -1])
        chosen = {}

        def is_chosen(index):
            rest = index[1:] if axis == 0 else index[:-1]
            if rest not in chosen:
                chosen[rest] = self.rng.randrange(-1, sizes[axis])
            return index[axis] == chosen[rest]

        return is_chosen

    def same_rows(self, sizes):
        """A few kinds of rows."""
        kinds = [[self.chance(0.4) for _ in range(sizes[-1])] for _ in range(2)]
        kind_of = [self.rng.randrange(2) for _ in range(sizes[0])]
        return lambda index: bool(index) and kinds[kind_of[index[0]]][index[-1]]

    def few_exceptions(self, sizes):
        count = math.prod(sizes)
        return lambda index: self.chance(1.5 / count)

    def give_numbers(self, fluent: Fluent) -> None:
        first = self.random_value(fluent)
        few = [self.random_value(fluent) for _ in range(2)]
        is_number = fluent.range in ("int", "real")
        kind = self.pick(["any", "any", "few", "same", "ladder" if is_number else "any"])
        share = self.pick([0.1, 0.5, 1.0])
        if math.prod(map(self.size, fluent.parameters)) > 2500:
            share = 0.02
        for index, objects in self.indexed(fluent):
            if kind == "ladder":
                fluent.values[objects] = self.step_of_ladder(fluent, sum(index))
            elif self.chance(share):
                fluent.values[objects] = (
                    first if kind == "same" else self.pick(few) if kind == "few" else self.random_value(fluent)
                )

    def step_of_ladder(self, fluent: Fluent, number: int) -> str:
        """Different for each object, and sorted."""
        if fluent.range == "int":
            return str(number % 400 - 1)
        return str((number % 400) * 0.25 - 1.0)

    def random_value(self, fluent: Fluent) -> str:
        kind = fluent.range
        if kind == "bool":
            return self.pick(["true", "false"])
        if kind == "int":
            large = self.flavour.wild and fluent.magnitude > 10 and self.chance(0.2)
            return str(self.pick(LARGE_INTS if large else PLAIN_INTS))
        if kind == "real":
            rough = fluent.fraction >= UNSURE and self.chance(0.7)
            return str(self.pick(ROUGH_REALS if rough else PLAIN_REALS))
        type_ = self.problem.type(kind)
        return type_.literal(self.pick(type_.members))
