"""Why an episode ended (rddl/simulator.h)."""

TERMINATED = 1
HORIZON = 2
INVARIANT = 4
FAULT = 8
TRUNCATED = HORIZON | INVARIANT | FAULT

NAMES = {TERMINATED: "terminated", HORIZON: "horizon", INVARIANT: "invariant", FAULT: "fault"}


def text_of(causes: int) -> str:
    """ "terminated", "horizon", "invariant", "fault", or several of them: "terminated, horizon"."""
    return ", ".join(name for bit, name in NAMES.items() if causes & bit)


TEXTS = [None, *(text_of(causes) for causes in range(1, 16))]
"""Returns the names of all causes; None for no cause."""
