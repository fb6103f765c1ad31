"""Coefficients of the tanh of PPO's networks (solvers/network/kernels.hpp), and its error in floats.

    python3 docs/mathematics/tanh_of_networks.py

tanh(x) is x p(x^2) / q(x^2) for |x| <= 8, with p and q of degree 4 and q(0) = 1, so that the largest relative error
is least: by least squares whose weights grow where the error is large (C. Lawson, 1961). Needs numpy.
"""

import numpy as np

LARGEST, DEGREE = 8.0, 4


def coefficients(rounds=1500, count=4000):
    x = np.maximum((np.cos(np.pi * (np.arange(count) + 0.5) / count) + 1) / 2 * LARGEST, 1e-4)
    u, y = (x / LARGEST) ** 2, np.tanh(x) / x
    powers = np.vander(u, DEGREE + 1, increasing=True)
    weights, denominator, best, least = np.ones(count), np.ones(count), None, np.inf
    for _ in range(rounds):
        scale = np.sqrt(weights) / (y * denominator)
        rows = np.hstack([powers, -y[:, None] * powers[:, 1:]]) * scale[:, None]
        norms = np.linalg.norm(rows, axis=0)
        found = np.linalg.lstsq(rows / norms, y * scale, rcond=None)[0] / norms
        p, q = found[:DEGREE + 1], np.concatenate([[1], found[DEGREE + 1:]])
        denominator = powers @ q
        errors = np.abs(powers @ p / denominator / y - 1)
        if errors.max() < least:
            least, best = errors.max(), (p, q)
        weights = np.maximum(weights * errors**0.7 / np.sum(weights * errors**0.7), 1e-14)
    scales = LARGEST ** (-2.0 * np.arange(DEGREE + 1))
    return [(each * scales).astype(np.float32) for each in best]


def tanh(p, q, x, fused):
    """As kernels.hpp computes it, with and without fused multiply-adds."""
    square = x * x

    def polynomial(numbers):
        sum_ = np.full_like(x, numbers[-1])
        for number in numbers[-2::-1]:
            if fused:
                sum_ = (sum_.astype(np.float64) * square + np.float64(number)).astype(np.float32)
            else:
                sum_ = sum_ * square + number
        return sum_

    return x * polynomial(p) / polynomial(q)


if __name__ == "__main__":
    p, q = coefficients()
    print("p", *(f"{each:.9g}" for each in p))
    print("q", *(f"{each:.9g}" for each in q))
    x = np.concatenate([np.linspace(1e-6, LARGEST, 2_000_001), np.logspace(-8, 0, 400_001)]).astype(np.float32)
    for fused in (True, False):
        found = tanh(p, q, x, fused)
        error = np.abs(found / np.tanh(x.astype(np.float64)) - 1).max()
        print(f"{'with' if fused else 'without'} fused multiply-adds: largest relative error {error:.2g}, "
              f"largest value {found.max():.9g}")
