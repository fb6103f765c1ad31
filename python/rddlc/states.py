"""States of episodes, which know their problem."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .arguments import whole
from .causes import text_of
from .errors import ArgumentError, EpisodeOver
from .model import Model


@dataclass(frozen=True)
class State:
    """The state of an episode: the bytes of the true state's record, the steps made, why it is over
    (`rddlc.causes`; 0: it runs), and the problem that it is of. It holds no random numbers."""

    record: bytes
    steps: int
    causes: int = 0
    problem: str = ""

    def refuse_end(self) -> None:
        """Raises EpisodeOver where nothing follows."""
        if self.causes:
            raise EpisodeOver(
                f"nothing follows this state: the episode is over ({text_of(self.causes)})"
            )


class StateForm:
    """The form of a problem's states."""

    def __init__(self, model: Model) -> None:
        parts = [
            (each.name, each.scalar, each.range, each.objects, each.parameters, each.offset)
            for each in model.states
        ]
        digest = hashlib.blake2b(repr((model.state_size, parts)).encode(), digest_size=6)
        self.problem = f"{model.domain} {model.instance} {digest.hexdigest()}"
        self._size = model.state_size
        places = [
            np.arange(each.offset, each.offset + each.count)
            for each in model.states
            if each.scalar == "bool"
        ]
        self._bools = np.concatenate(places) if places else np.empty(0, np.int64)

    def record_of(self, state: Any) -> NDArray[np.uint8]:
        """(bytes,) of a state of this problem. Raises ArgumentError for anything else: the engine
        reads whatever bytes it is given."""
        if not isinstance(state, State):
            raise ArgumentError(f"a state is an rddlc.State, not a {type(state).__name__}")
        if not isinstance(state.record, bytes):
            raise ArgumentError(f"a state's record is bytes, not a {type(state.record).__name__}")
        if len(state.record) != self._size:
            raise ArgumentError(
                f"a state has {self._size} bytes, not {len(state.record)}: it is of another problem"
            )
        if state.problem != self.problem:
            raise ArgumentError(
                f"the state is of another problem, '{state.problem}', not of '{self.problem}'"
            )
        whole("the state's count of steps", state.steps, 0)
        whole("the state's causes", state.causes, 0, 15)
        record = np.frombuffer(state.record, np.uint8)
        if (record[self._bools] > 1).any():
            raise ArgumentError("a state's record has a bool that is neither 0 nor 1")
        return record
