"""The purposes of random problems: docs/fuzzing.md."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Flavour:
    draws: bool = False
    wild: bool = False
    finite: bool = False


FLAVOURS = {
    "plain": Flavour(),
    "random": Flavour(draws=True),
    "wild": Flavour(draws=True, wild=True),
    "finite": Flavour(draws=True, finite=True),
}


def flavour_of(name: str, seed: int) -> Flavour:
    """Half of the wild and finite problems draw."""
    flavour = FLAVOURS[name]
    if flavour.wild or flavour.finite:
        return Flavour(seed % 2 == 0, flavour.wild, flavour.finite)
    return flavour
