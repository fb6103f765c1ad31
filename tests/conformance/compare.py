"""Compares outcomes of the reference with ours, and says where they differ."""

from dataclasses import dataclass, field

import numpy as np

from model import (
    REWARD,
    TERMINATED,
    TRUNCATED,
    Columns,
    DrawPoint,
    Problem,
    Transitions,
    Values,
    row_of,
)
from two_sample import p_value

TOLERANCE = 1e-9  # relative, for reals of one step
PROJECTIONS = 3


@dataclass
class Column:
    """One kind of value that a step gives."""

    name: str
    labels: tuple[str, ...]
    real: bool
    random: bool


@dataclass
class Findings:
    """The result of comparing one instance with one engine."""

    exact_values: int = 0  # compared one by one
    worst_difference: float = 0.0  # relative, of reals
    tests: list[tuple[float, str]] = field(default_factory=list)  # p-value of each, and what it is
    disagreements: list[str] = field(default_factory=list)


def columns_of(problem: Problem) -> list[Column]:
    fluents = problem.outcome_fluents()
    return [
        *(Column(f.name, f.groundings, f.range == "real", f.random) for f in fluents),
        Column(REWARD, ("reward",), True, problem.random_reward),
        Column(TERMINATED, ("terminated",), False, problem.random_ending),
        Column(TRUNCATED, ("truncated",), False, problem.random_ending),
    ]


def compare_transitions(
    problem: Problem, expected: Transitions, found: Columns, findings: Findings
) -> None:
    """Value by value, everything that no draw has a part in."""

    def start(row: int) -> str:
        return describe_start(row_of(expected.states, row), row_of(expected.actions, row))

    for column in columns_of(problem):
        if not column.random:
            compare_values(column, expected.outcomes[column.name], found[column.name], start, findings)


def compare_draws(problem: Problem, point: DrawPoint, found: Columns, findings: Findings) -> None:
    """Compares at one state and action: deterministic values one by one, the rest in distribution."""

    description_of_start = describe_start(point.state, point.action)

    def start(_row: int) -> str:
        return description_of_start

    for column in columns_of(problem):
        if column.random:
            for statistic, first, second in statistics(column, point.outcomes, found):
                p = p_value(first, second)
                description = f"{summary(first)} expected, {summary(second)} found" if p < 1e-4 else ""
                findings.tests.append((p, f"{statistic}: {description}; {description_of_start}"))
        else:
            compare_values(column, point.outcomes[column.name], found[column.name], start, findings)
    for first, second in projections(problem, point.outcomes, found):
        findings.tests.append((p_value(first, second), f"joint distribution; {description_of_start}"))


def compare_values(column: Column, expected, found, start, findings: Findings) -> None:
    if column.real:
        difference = relative_difference(expected, found)
        findings.worst_difference = max(findings.worst_difference, difference.max(initial=0.0))
        wrong = difference > TOLERANCE
    else:
        wrong = expected != found
    findings.exact_values += expected.size
    if wrong.any():
        row, index = np.argwhere(wrong)[0]
        findings.disagreements.append(
            f"{column.labels[index]}: {expected[row, index]!r} expected, {found[row, index]!r} found"
            f" ({np.count_nonzero(wrong)} of {wrong.size} values of {column.name} differ);"
            f" {start(row)}"
        )


def relative_difference(expected: np.ndarray, found: np.ndarray) -> np.ndarray:
    """0 where equal, both nan, or the same infinity."""
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        scale = np.maximum(np.abs(expected), np.abs(found))
        difference = np.abs(expected - found) / scale
    same = (expected == found) | (np.isnan(expected) & np.isnan(found))
    difference[~same & ~np.isfinite(difference)] = np.inf
    return np.where(same, 0.0, difference)


def statistics(column: Column, expected: Columns, found: Columns):
    """One sample for each value of the column, and one of their sum, which shows whether values
    that are drawn together depend on each other as they should."""
    first, second = expected[column.name], found[column.name]
    for index, label in enumerate(column.labels):
        yield label, first[:, index], second[:, index]
    if len(column.labels) > 1:
        yield f"sum of {column.name}", first.sum(axis=1), second.sum(axis=1)


def projections(problem: Problem, expected: Columns, found: Columns):
    """All random values of a draw, reward included, weighed and added: a test of their joint
    distribution. The weights are random but fixed, on the scale of each value's deviation."""
    names = [column.name for column in columns_of(problem) if column.random]
    if not names:
        return
    first, second = (
        np.concatenate([side[name].astype(np.float64) for name in names], axis=1)
        for side in (expected, found)
    )
    pooled = np.concatenate([first, second])
    if first.shape[1] < 2 or not np.isfinite(pooled).all():
        return
    deviation = pooled.std(axis=0)
    deviation[deviation <= TOLERANCE * np.abs(pooled).max(axis=0)] = np.inf  # rounding, no chance
    for number in range(PROJECTIONS):
        weights = np.random.default_rng(number).normal(size=first.shape[1])
        weights = weights / deviation
        # Rounded, so that sums of the same values in two roundings stay the same.
        yield tuple(np.round((side - pooled.mean(axis=0)) @ weights, 6) for side in (first, second))


def judge_draws(findings: Findings, false_alarm_rate: float) -> None:
    """Adds a disagreement for every test that fails when all of them share the given rate."""
    for p, description in sorted(findings.tests):
        if p * len(findings.tests) >= false_alarm_rate:
            break
        findings.disagreements.append(f"distribution differs (p = {p:.1e}): {description}")


def summary(sample: np.ndarray) -> str:
    values, counts = np.unique(sample, return_counts=True)
    if len(values) <= 4:
        return " ".join(f"{value}:{count}" for value, count in zip(values.tolist(), counts))
    return f"mean {sample.mean():.6g}, deviation {sample.std():.3g}"


def describe_start(state: Values, action: Values) -> str:
    def text(values: Values) -> str:
        parts = []
        for name, array in values.items():
            shown = array.tolist() if array.size > 1 else array.tolist()[0]
            parts.append(f"{name}={shown}")
        joined = ", ".join(parts)
        return joined if len(joined) < 400 else joined[:400] + "…"

    return f"in state {text(state)} under action {text(action)}"
