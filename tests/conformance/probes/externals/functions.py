"""The functions of functions.hpp."""

import numpy as np


def mix_along(heat, height, vent):
    return heat * np.exp(-height / 500.0) - vent * heat[0]


def spread(flow, burn):
    return np.roll(flow, -1, axis=0) + 2.0 * burn[:, np.newaxis]


def spread_turned(flow):
    return flow.T * np.arange(1, flow.shape[1] + 1)[:, np.newaxis]


def counted(works, sensors, sent):
    return np.int64(sensors + sent if works else 0)


def is_warm(heat):
    return heat > 1.0


def any(values):
    return np.any(values)


def mean_of(values):
    return sum(values) / len(values)


def largest(values):
    return np.max(values)
