"""Tests of whether two samples come from the same distribution.

All of them hold at any false-alarm rate however small, since hundreds of thousands of them share
one rate of 1e-6: tails are exact or proven bounds, never approximations for large samples.
"""

import math

import numpy as np

# Values of this relative distance are taken as the same one (rounding differs between simulators).
SAME = 1e-9
FEW_VALUES = 16


def p_value(first: np.ndarray, second: np.ndarray) -> float:
    """The chance of a difference as large as this, or an upper bound of it.

    Few different values: each value against all others, exactly (Fisher). Many: the largest
    distance between the distribution functions (Kolmogorov-Smirnov).
    """
    first, second = same_values_merged(first, second)
    if first.max(initial=0) < FEW_VALUES and second.max(initial=0) < FEW_VALUES:
        return by_value(first, second)
    return kolmogorov_smirnov(first, second)


def same_values_merged(first: np.ndarray, second: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Both samples as the ranks of their values, equal for values that differ by rounding only."""
    values = np.concatenate([first, second]).astype(np.float64)
    order = np.argsort(values, kind="stable")  # nan last
    ordered = values[order]
    with np.errstate(invalid="ignore"):
        gap = np.diff(ordered)
        near = gap <= SAME * np.maximum(np.abs(ordered[:-1]), np.abs(ordered[1:]))
    near |= ordered[:-1] == ordered[1:]  # infinities
    near |= np.isnan(ordered[:-1])  # then the next one is nan too
    ranks = np.empty(len(values), dtype=np.int64)
    ranks[order] = np.concatenate([[0], np.cumsum(~near)])
    return ranks[: len(first)], ranks[len(first) :]


def by_value(first: np.ndarray, second: np.ndarray) -> float:
    """Fisher's exact test of each value against all others, corrected for their number."""
    count = 1 + max(first.max(), second.max())
    tallies = zip(np.bincount(first, minlength=count), np.bincount(second, minlength=count))
    tests = max(1, count if count > 2 else 1)  # of two values, one test says it all
    return min(1.0, tests * min(fisher(a, len(first), b, len(second)) for a, b in tallies))


def fisher(hits: int, draws: int, other_hits: int, other_draws: int) -> float:
    """Two-sided: twice the smaller tail of the hypergeometric distribution of `hits`."""
    total_hits, total = int(hits + other_hits), draws + other_draws
    counts = np.arange(max(0, total_hits - other_draws), min(draws, total_hits) + 1)
    log_chance = (
        log_choose(draws, counts)
        + log_choose(other_draws, total_hits - counts)
        - log_choose(total, total_hits)
    )
    chance = np.exp(log_chance)
    return min(1.0, 2.0 * min(chance[counts <= hits].sum(), chance[counts >= hits].sum()))


_log_factorials = np.zeros(1)


def log_choose(n: int, k):
    global _log_factorials
    if len(_log_factorials) <= n:
        _log_factorials = np.concatenate([[0.0], np.cumsum(np.log(np.arange(1, 2 * n + 2)))])
    return _log_factorials[n] - _log_factorials[k] - _log_factorials[n - k]


def kolmogorov_smirnov(first: np.ndarray, second: np.ndarray) -> float:
    """For two samples of n each, P(D >= d) <= C exp(-n d^2), with C = e, or 2 from n = 458 on.

    F. Wei and R. Dudley, "Two-sample Dvoretzky-Kiefer-Wolfowitz inequalities", Statistics and
    Probability Letters 82, 2012. Ties only make D smaller.
    """
    draws = len(first)
    if len(second) != draws:
        raise ValueError("needs two samples of the same size")
    constant = 2.0 if draws >= 458 else math.e
    return min(1.0, constant * math.exp(-draws * distance(first, second) ** 2))


def distance(first: np.ndarray, second: np.ndarray) -> float:
    """The largest distance between the two distribution functions of ranks."""
    count = 1 + max(first.max(), second.max())
    functions = [np.cumsum(np.bincount(s, minlength=count)) / len(s) for s in (first, second)]
    return float(np.max(np.abs(functions[0] - functions[1])))
