"""The names that only some versions of Gymnasium have. Single environments need 0.28.1 or later, vectors
1.0."""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, Any

import gymnasium
from numpy.typing import NDArray

HAS_VECTORS = int(gymnasium.__version__.split(".")[0]) >= 1

if TYPE_CHECKING:
    from gymnasium.vector import AutoresetMode as AutoresetMode
    from gymnasium.vector import VectorEnv

    VectorBase = VectorEnv[Any, Any, NDArray[Any]]
else:
    try:
        from gymnasium.vector import AutoresetMode
    except ImportError:  # before 1.1

        class AutoresetMode(Enum):
            """What becomes of an environment whose episode has ended."""

            NEXT_STEP = "NextStep"
            SAME_STEP = "SameStep"
            DISABLED = "Disabled"

    if HAS_VECTORS:
        from gymnasium.vector import VectorEnv

        VectorBase = VectorEnv[Any, Any, NDArray[Any]]
    else:
        VectorBase = object


def sample_arguments(mask: Any, probability: Any) -> tuple[Any, ...]:
    """The arguments of a space's `sample`, which has had a probability since Gymnasium 1.1."""
    return (mask,) if probability is None else (mask, probability)
