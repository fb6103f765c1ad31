"""Returns of policies in many episodes."""

from __future__ import annotations

import math
from dataclasses import dataclass

from . import _native
from .arguments import seed_of, thread_count, whole, whole_or_none

MOST_EPISODES = 10_000_000


@dataclass(frozen=True)
class Estimate:
    """A mean of episodes, with the half width of its 95 % confidence interval."""

    mean: float
    deviation: float
    minimum: float
    maximum: float
    half_width: float


@dataclass(frozen=True)
class Evaluation:
    """The returns of a policy."""

    episodes: int
    returns: Estimate
    """Sums of rewards, undiscounted."""
    discounted_returns: Estimate
    lengths: Estimate
    """Steps."""
    terminated: int
    """Episodes that a termination condition has ended."""
    faulted: int

    def is_better_than(self, other: Evaluation | None) -> bool:
        """Compares as `rddl train` chooses the best policy: by the mean return, and among equal
        ones by which reaches its end sooner. One that is not finite is never better."""
        mean = self.returns.mean
        if not math.isfinite(mean) or other is None:
            return math.isfinite(mean)
        is_sooner = self.terminated > 0 and self.lengths.mean < other.lengths.mean
        return mean > other.returns.mean or (mean == other.returns.mean and is_sooner)

    def __str__(self) -> str:
        returns = self.returns
        return f"return {returns.mean:.6g} +- {returns.half_width:.3g} ({self.episodes} episodes)"


def evaluation_of(
    policy: _native.Policy, episodes: int, seed: int, threads: int, horizon: int | None
) -> Evaluation:
    """The returns of a policy in the episodes of this seed."""
    found = policy.evaluate(
        whole("episodes", episodes, 1, MOST_EPISODES),
        seed_of(seed),
        thread_count(threads),
        whole_or_none("horizon", horizon, 0),
    )
    return Evaluation(
        episodes=found["episodes"],
        returns=Estimate(**found["return"]),
        discounted_returns=Estimate(**found["discounted_return"]),
        lengths=Estimate(**found["length"]),
        terminated=found["terminated"],
        faulted=found["faulted"],
    )
