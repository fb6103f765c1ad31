"""Arguments that cannot be are refused before anything is done, with what they are and what may be."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from difflib import get_close_matches
from operator import index
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .errors import ArgumentError, Error

MOST_INT64 = (1 << 63) - 1
MOST_THREADS = 4096  # that of `rddl --threads`
SEEDS = 1 << 64  # a seed is below that


def whole(name: str, given: Any, least: int, most: int = MOST_INT64) -> int:
    """An int, of Python or numpy, from `least` to `most`."""
    number = _int_of(name, given)
    if number < least:
        words = {0: "zero", 1: "one"}
        raise ArgumentError(f"{name} is {shown(number)}: {words.get(least, least)} or more")
    if number > most:
        raise ArgumentError(f"{name} is {shown(number)}: no more than {most}")
    return number


def _int_of(name: str, given: Any) -> int:
    """A bool is refused: it is another argument, in the wrong place. So is an array, however small."""
    try:
        if isinstance(given, (bool, np.bool_, np.ndarray)):
            raise TypeError
        return index(given)
    except TypeError:
        raise ArgumentError(f"{name} is {shown(given)}, which is not a whole number") from None


def whole_or_none(name: str, given: Any, least: int, most: int = MOST_INT64) -> int | None:
    return None if given is None else whole(name, given, least, most)


def seed_of(given: Any) -> int:
    """A seed of 64 bits."""
    number = _int_of("seed", given)
    if not 0 <= number < SEEDS:
        raise ArgumentError(f"seed is {shown(number)}: greater or equal to zero, and below 2^64")
    return number


def seed_or_none(given: Any) -> int | None:
    return None if given is None else seed_of(given)


def thread_count(given: Any) -> int:
    """0: one for each core."""
    return whole("threads", given, 0, MOST_THREADS)


def finite(name: str, given: Any) -> float:
    """A number that is neither nan nor infinite."""
    is_number = isinstance(given, (int, float, np.integer, np.floating))
    try:
        number = float(given) if is_number and not isinstance(given, bool) else math.nan
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise ArgumentError(f"{name} is {shown(given)}, which is not a finite number")
    return number


def array_in(name: str, given: Any, error: type[Error]) -> NDArray[Any]:
    """What is an array already, or lists of the same lengths; bytes are not numbers."""
    if isinstance(given, (bytes, bytearray, memoryview)):
        raise error(f"{name} is {shown(given)}, which is not an array")
    try:
        return np.asarray(given)
    except (TypeError, ValueError):
        raise error(f"{name} is {shown(given)}, which is not an array") from None


def numbers_in(name: str, given: Any, error: type[Error]) -> NDArray[Any]:
    """An array of bools, ints or reals."""
    array = array_in(name, given, error)
    if array.size and array.dtype.kind not in "biuf":
        raise error(f"{name} is {shown(given)}, which is not an array of numbers")
    return array


def text(name: str, given: Any) -> str:
    if not isinstance(given, str):
        raise ArgumentError(f"{name} is {shown(given)}, which is not a str")
    return given


def flag(name: str, given: Any) -> bool:
    if not isinstance(given, (bool, np.bool_)):
        raise ArgumentError(f"{name} is {shown(given)}, which is neither True nor False")
    return bool(given)


def one_of(name: str, given: Any, known: Sequence[Any]) -> Any:
    if not any(given is each or (isinstance(given, str) and given == each) for each in known):
        raise ArgumentError(f"{name} is {shown(given)}, which is not one of {_listed(map(repr, known))}")
    return given


def size_of(given: Any) -> tuple[int, int]:
    """Width and height in pixels; the painter knows how many there may be."""
    if not isinstance(given, (Sequence, np.ndarray)) or isinstance(given, str) or len(given) != 2:
        raise ArgumentError(f"render_size is {given!r}, which is not a width and a height")
    most = (1 << 31) - 1
    return whole("render_size", given[0], -most, most), whole("render_size", given[1], -most, most)


def refuse_unknown(what: str, given: Iterable[Any], known: Sequence[str]) -> None:
    """Raises for unknown names, since a misspelt option would have no effect. what: "option"."""
    for name in given:
        if name not in known:
            close = get_close_matches(str(name), known, 1)
            hint = f"did you mean {close[0]!r}?" if close else f"there are {_listed(known)}"
            raise ArgumentError(f"there is no {what} {shown(name)}; {hint}")


def options_of_reset(options: Any, known: Sequence[str]) -> Mapping[str, Any]:
    """Returns the `options` of a reset; empty for None."""
    if options is None:
        return {}
    if not isinstance(options, Mapping):
        raise ArgumentError(f"options are a dictionary, not a {type(options).__name__}")
    refuse_unknown("option of reset", options, known)
    return options


def keywords_of(function: Callable[..., Any]) -> tuple[str, ...]:
    """Returns the parameters that are keyword-only."""
    parameters = inspect.signature(function).parameters.values()
    return tuple(each.name for each in parameters if each.kind is each.KEYWORD_ONLY)


def _listed(names: Iterable[str]) -> str:
    return ", ".join(names)


def shown(given: Any) -> str:
    """Returns a value for a message: not too long."""
    try:
        text = repr(given)
    except ValueError:  # Python writes no int of thousands of digits
        text = f"a number of {given.bit_length()} bits"
    except RecursionError:
        text = f"a {type(given).__name__} of too many levels"
    return text if len(text) <= 40 else text[:37] + "..."
