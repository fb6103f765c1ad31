"""Tests of the statistical tests: they let equal distributions pass and find unequal ones."""

import math
import unittest

import numpy as np

from compare import relative_difference
from two_sample import fisher, kolmogorov_smirnov, p_value, same_values_merged

DRAWS = 2000
SURE = 1e-9  # what a real difference must get below


class TwoSampleTest(unittest.TestCase):
    def setUp(self):
        self.random = np.random.default_rng(1)

    def test_fisher_is_the_hypergeometric_tail(self):
        # 3 of 5 against 0 of 5: P(3 or more) = C(5,3) C(5,0) / C(10,3).
        self.assertAlmostEqual(fisher(3, 5, 0, 5), 2 * math.comb(5, 3) / math.comb(10, 3))
        self.assertEqual(fisher(0, DRAWS, 0, DRAWS), 1.0)

    def test_p_values_of_equal_distributions_are_not_too_small(self):
        samplers = {
            "bernoulli": lambda: self.random.random(DRAWS) < 0.03,
            "poisson": lambda: self.random.poisson(4.0, DRAWS),
            "normal": lambda: self.random.normal(size=DRAWS),
            "clipped": lambda: np.maximum(0.0, self.random.normal(size=DRAWS)),
        }
        for name, sampler in samplers.items():
            p_values = np.array([p_value(sampler(), sampler()) for _ in range(400)])
            for level in (0.1, 0.01):
                expected = 400 * level
                self.assertLess(
                    np.count_nonzero(p_values < level), expected + 6 * math.sqrt(expected), name
                )

    def test_different_distributions_are_told_apart(self):
        normal = self.random.normal(size=DRAWS)
        pairs = {
            "chance": (self.random.random(DRAWS) < 0.3, self.random.random(DRAWS) < 0.5),
            "rare": (np.zeros(DRAWS, dtype=bool), self.random.random(DRAWS) < 0.03),
            "variance for deviation": (normal * 0.1, self.random.normal(size=DRAWS) * 0.01),
            "shifted": (normal, self.random.normal(size=DRAWS) + 0.5),
            "atom": (np.maximum(normal, 0.0), np.abs(self.random.normal(size=DRAWS))),
            "object": (self.random.integers(3, size=DRAWS), self.random.integers(2, size=DRAWS)),
            "nan": (normal, np.where(normal > 0, normal, np.nan)),
        }
        for name, (first, second) in pairs.items():
            self.assertLess(p_value(first, second), SURE, name)

    def test_rounding_does_not_matter(self):
        clipped = np.minimum(100.0, self.random.normal(100.0, 1.0, size=DRAWS))
        again = np.minimum(100.0, self.random.normal(100.0, 1.0, size=DRAWS))
        self.assertGreater(p_value(clipped, again * (1 + 1e-15)), SURE)
        first, second = same_values_merged(np.array([1.0, np.inf]), np.array([1 + 1e-12, np.inf]))
        self.assertEqual(first.tolist(), second.tolist())

    def test_few_draws_tell_what_never_meets(self):
        self.assertLess(p_value(np.full(40, 1.0), np.full(40, 1.0 + 1e-6)), SURE)
        self.assertLess(kolmogorov_smirnov(np.arange(40), np.arange(40, 80)), SURE)
        self.assertGreater(p_value(np.arange(40), np.arange(40) + 0.5), 0.1)

    def test_relative_difference(self):
        expected = np.array([1.0, 0.0, np.nan, np.inf, np.inf, 2.0, np.nan])
        found = np.array([1.0, 0.0, np.nan, np.inf, -np.inf, 2.0 + 2e-8, 1.0])
        difference = relative_difference(expected, found)
        self.assertEqual((difference > 1e-9).tolist(), [False] * 4 + [True] * 3)
        self.assertAlmostEqual(difference[5], 1e-8, places=12)


if __name__ == "__main__":
    unittest.main()
