"""A problem as the comparison sees it: its fluents, and values as flat arrays.

Values of a fluent are one row-major array over its groundings: bool, int64 or float64, and for
objects their index. Several transitions are stacked, so that a column of n transitions of a
fluent with k groundings is an array of n rows and k columns.
"""

from dataclasses import dataclass

import numpy as np

DTYPES = {"bool": np.bool_, "int": np.int64, "real": np.float64}

# Columns of an outcome that are not fluents. (`?` cannot occur in a fluent's name.)
REWARD = "reward?"
TERMINATED = "terminated?"
TRUNCATED = "truncated?"

Values = dict[str, np.ndarray]  # fluent name -> k values
Columns = dict[str, np.ndarray]  # fluent name or one of the above -> n rows of k values


@dataclass(frozen=True)
class Fluent:
    name: str
    range: str  # bool, int, real or the name of a type of objects
    shape: tuple[int, ...]
    groundings: tuple[str, ...]  # names such as at___i1__n2, row-major
    objects: tuple[str, ...]  # the members of the range, when that is a type
    random: bool  # does its value after a step depend on a draw of that step?

    @property
    def dtype(self):
        return DTYPES.get(self.range, np.int64)

    def encode(self, values: np.ndarray) -> dict:
        """Values by grounded name, as `rddl replay` reads and writes them."""
        plain = values.tolist()
        if self.objects:
            plain = [self.objects[index] for index in plain]
        elif self.range == "real":
            plain = [value if np.isfinite(value) else str(value) for value in plain]
        return dict(zip(self.groundings, plain, strict=True))

    def decode(self, rows: list[dict]) -> np.ndarray:
        """The column of this fluent in rows of values by grounded name; types must match exactly."""
        names = self.groundings
        table = [[row[name] for name in names] for row in rows]
        if self.objects:
            index = {name: number for number, name in enumerate(self.objects)}
            table = [[index[value] for value in row] for row in table]
        elif self.range == "real":
            table = [[float(value) for value in row] for row in table]  # "nan", "inf" included
        else:
            expected = bool if self.range == "bool" else int
            for row in table:
                for name, value in zip(names, row):
                    if type(value) is not expected:
                        raise ValueError(f"{name}: expected {self.range}, found {value!r}")
        return np.array(table, dtype=self.dtype).reshape(len(rows), len(names))


@dataclass(frozen=True)
class Problem:
    states: tuple[Fluent, ...]
    observations: tuple[Fluent, ...]  # empty when fully observed
    actions: tuple[Fluent, ...]
    horizon: int
    random_reward: bool
    random_ending: bool  # does a termination or an invariant draw, or depend on a random state?

    def is_random(self) -> bool:
        random = any(fluent.random for fluent in self.outcome_fluents())
        return random or self.random_reward or self.random_ending

    def outcome_fluents(self) -> tuple[Fluent, ...]:
        """Returns the fluents that a step computes, besides reward and end of the episode."""
        return self.states + self.observations


@dataclass
class Transitions:
    """Steps that do not follow one another: row i starts in its own state with its own action."""

    states: Columns
    actions: Columns
    outcomes: Columns

    def __len__(self) -> int:
        return len(self.outcomes[REWARD])

    def starts(self, count: int) -> list[tuple[Values, Values]]:
        """State and action of `count` rows, spread evenly."""
        rows = np.linspace(0, len(self) - 1, count).round().astype(int)
        return [(row_of(self.states, row), row_of(self.actions, row)) for row in rows]


@dataclass
class DrawPoint:
    """One state and action, with the outcomes of many draws of the same step."""

    state: Values
    action: Values
    outcomes: Columns

    def count(self) -> int:
        return len(self.outcomes[REWARD])


def row_of(columns: Columns, row: int) -> Values:
    return {name: values[row] for name, values in columns.items()}


def stack(rows: list[Values]) -> Columns:
    return {name: np.stack([row[name] for row in rows]) for name in rows[0]} if rows else {}
