"""Prints the tables of the instances as C++ arrays, from the installed rddlrepository.

    python tables.py > tables.hpp
"""

import sys
from pathlib import Path

import numpy as np
import pyRDDLGym

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests/conformance"))

from problems import repository_cases  # noqa: E402


def values_of(problem: str, instance: str) -> dict:
    """All fluents' initial values and the non-fluents, by name."""
    (case,) = [case for case in repository_cases(problem) if case.instance == instance]
    env = pyRDDLGym.make(str(case.domain_path), str(case.instance_path), vectorized=True)
    return env.sampler.init_values


def array(name: str, values) -> str:
    """Reals, row after row."""
    values = np.asarray(values, dtype=float)
    sizes = "".join(f"[{size}]" for size in values.shape)
    numbers = ", ".join(float(value).hex() for value in values.ravel())
    return f"inline constexpr double {name}{sizes} = {{{numbers}}};"


def bit_sets(name: str, rows) -> str:
    """A number for each row, whose bit k says whether entry k is true."""
    numbers = [sum(1 << int(k) for k in np.flatnonzero(row)) for row in rows]
    return f"inline constexpr std::uint64_t {name}[] = {{{', '.join(f'{n:#x}' for n in numbers)}}};"


def mountain_car() -> list[str]:
    values = values_of("MountainCar_ippc2023", "1")
    starts, ends = values["X-START"], values["X-END"]
    assert np.array_equal(starts[1:], ends[:-1]), "the segments follow each other"
    slopes = (values["Y-END"] - values["Y-START"]) / (ends - starts)
    return [array("starts", starts), array("slopes", slopes), f"inline constexpr double end = {float(ends[-1]).hex()};"]


def sysadmin() -> list[str]:
    values = values_of("SysAdmin_MDP_ippc2011", "10")
    neighbours = values["CONNECTED"].T  # of computer x: those y that are connected to it
    return [bit_sets("neighbours", neighbours), f"inline constexpr double reboot = {values['REBOOT-PROB']};"]


def wildfire() -> list[str]:
    values = values_of("Wildfire_MDP_ippc2014", "10")
    cells = values["TARGET"].size
    return [
        bit_sets("neighbours", values["NEIGHBOR"].reshape(cells, cells)),
        bit_sets("targets", [values["TARGET"].ravel()]),
        bit_sets("initially_burning", [values["burning"].ravel()]),
    ]


def reservoir() -> list[str]:
    values = values_of("Reservoir_ippc2023", "5")
    connected = values["RES_CONNECT"]
    outlets = connected.sum(axis=1) + values["CONNECTED_TO_SEA"]
    arrays = {name: values[name] for name in ("TOP_RES", "MIN_LEVEL", "MAX_LEVEL", "RAIN_VAR", "LOW_COST", "HIGH_COST", "OVERFLOW_COST", "rlevel")}
    return [
        *(array(name.lower(), np.broadcast_to(entries, outlets.shape)) for name, entries in arrays.items()),
        array("outlets", outlets),
        bit_sets("sources", connected.T),
        f"inline constexpr double evaporation = {values['EVAPORATION_FACTOR']};",
    ]


def main() -> None:
    print("// Made by tables.py.\n#pragma once\n\n#include <cstdint>")
    for tables in (mountain_car, sysadmin, wildfire, reservoir):
        print(f"\nnamespace {tables.__name__} {{", *tables(), "}", sep="\n")


if __name__ == "__main__":
    main()
