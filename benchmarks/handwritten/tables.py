"""Prints the tables of the instances as C++ arrays, from the installed rddlrepository.

    python tables.py > tables.hpp

Over 400 lines: a function for each instance, all of one kind.
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


def braced(values: np.ndarray, text) -> str:
    """The text of each value; each row has braces of its own."""
    return "{" + ", ".join(braced(row, text) for row in values) + "}" if values.ndim else text(values)


def sizes(values: np.ndarray) -> str:
    return "".join(f"[{size}]" for size in values.shape)


def array(name: str, values) -> str:
    """Reals, row after row."""
    values = np.asarray(values, dtype=float)
    return f"inline constexpr double {name}{sizes(values)} = {braced(values, lambda value: float(value).hex())};"


def bit_sets(name: str, rows) -> str:
    """A number for each row, whose bit k says whether entry k is true."""
    numbers = [sum(1 << int(k) for k in np.flatnonzero(row)) for row in rows]
    return f"inline constexpr std::uint64_t {name}[] = {{{', '.join(f'{n:#x}' for n in numbers)}}};"


def bit_set(name: str, row) -> str:
    """A number whose bit k says whether entry k is true."""
    return number(name, f"{sum(1 << int(k) for k in np.flatnonzero(row)):#x}", "std::uint64_t")


def words(name: str, numbers) -> str:
    """Sets of bits, row after row."""
    numbers = np.asarray(numbers, dtype=int)
    return f"inline constexpr std::uint64_t {name}{sizes(numbers)} = {braced(numbers, hex)};"


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


def number(name: str, value, kind: str = "double") -> str:
    return f"inline constexpr {kind} {name} = {value};"


def integers(name: str, values, kind: str = "std::int64_t") -> str:
    """Integers or bools, row after row."""
    values = np.asarray(values, dtype=int)
    return f"inline constexpr {kind} {name}{sizes(values)} = {braced(values, str)};"


def the_only(bools) -> int:
    """The place of the one that is true, row after row."""
    (place,) = np.flatnonzero(bools)
    return int(place)


def game_of_life() -> list[str]:
    values = values_of("GameOfLife_MDP_ippc2011", "10")
    columns, rows = values["alive"].shape
    for (a, b, c, d), is_near in np.ndenumerate(values["NEIGHBOR"]):
        assert is_near == (max(abs(a - c), abs(b - d)) == 1), "the eight cells around a cell"
    assert (columns, rows) == (10, 3)
    return [array("noise", values["NOISE-PROB"].ravel()), bit_sets("alive", [values["alive"].ravel()])]


def navigation() -> list[str]:
    values = values_of("Navigation_MDP_ippc2011", "10")
    columns, rows = values["robot-at"].shape

    def moved(x: int, y: int) -> list[int]:
        targets = []
        for name, along, at in (("NORTH", 1, y), ("SOUTH", 1, y), ("EAST", 0, x), ("WEST", 0, x)):
            to = np.flatnonzero(values[name][at])
            assert len(to) <= 1
            place = [x, y]
            if len(to):
                place[along] = int(to[0])
            targets.append(place[0] * rows + place[1] if len(to) else -1)
        return targets

    targets = [moved(x, y) for x in range(columns) for y in range(rows)]
    return [
        array("danger", values["P"].ravel()),
        integers("next", np.transpose(targets), "int"),
        number("robot", the_only(values["robot-at"]), "int"),
        number("goal", the_only(values["GOAL"]), "int"),
    ]


def crossing_traffic() -> list[str]:
    values = values_of("CrossingTraffic_MDP_ippc2014", "10")
    after = np.eye(7, k=1, dtype=bool)
    for name, is_after in (("NORTH", after), ("SOUTH", after.T), ("EAST", after), ("WEST", after.T)):
        assert np.array_equal(values[name], is_after), "cells follow each other"
    assert [list(np.flatnonzero(values[name])) for name in ("MAX-XPOS", "MIN-YPOS", "MAX-YPOS")] == [[6], [0], [6]]
    the_only(values["GOAL"])
    return [
        bit_sets("robot", [values["robot-at"].ravel()]),
        bit_sets("obstacles", [values["obstacle-at"].ravel()]),
        bit_sets("goal", [values["GOAL"].ravel()]),
        number("input_rate", values["INPUT-RATE"]),
    ]


def academic_advising() -> list[str]:
    values = values_of("AcademicAdvising_MDP_ippc2014", "10")
    constants = {"PRIOR_PROB_PASS_NO_PREREQ": 0.8, "PRIOR_PROB_PASS": 0.2, "COURSE_COST": -1, "COURSE_RETAKE_COST": -2}
    assert all(np.all(values[name] == value) for name, value in constants.items())
    return [bit_sets("prerequisites", values["PREREQ"].T), bit_sets("program", [values["PROGRAM_REQUIREMENT"]])]


def skill_teaching() -> list[str]:
    values = values_of("SkillTeaching_MDP_ippc2014", "10")
    names = ("PROB_HIGH", "PROB_ALL_PRE", "PROB_PER_PRE", "PROB_ALL_PRE_MED", "PROB_PER_PRE_MED", "LOSE_PROB")
    return [
        array("weight", values["SKILL_WEIGHT"]),
        bit_sets("required", values["PRE_REQ"].T),
        *(array(name.lower(), values[name]) for name in names),
    ]


def triangle_tireworld() -> list[str]:
    values = values_of("TriangleTireworld_MDP_ippc2014", "10")
    spares = ", ".join(str(int(spare)) for spare in values["spare-in"])
    return [
        f"inline constexpr std::array<bool, {values['spare-in'].size}> spares = {{{{{spares}}}}};",
        integers("road", values["road"], "bool"),
        number("start", the_only(values["vehicle-at"]), "std::size_t"),
        number("goal", the_only(values["goal-location"]), "std::size_t"),
        number("good_tire", int(values["not-flattire"]), "bool"),
        number("flat_probability", values["FLAT-PROB"]),
    ]


def elevators() -> list[str]:
    values = values_of("Elevators_MDP_ippc2014", "10")
    assert np.array_equal(values["ADJACENT-UP"], np.eye(6, k=1)) and values["elevator-at-floor"].shape == (1, 6)
    assert (values["ELEVATOR-PENALTY-RIGHT-DIR"], values["ELEVATOR-PENALTY-WRONG-DIR"]) == (0.75, 3)
    ends = [the_only(values[name]) for name in ("elevator-at-floor", "BOTTOM-FLOOR", "TOP-FLOOR")]
    assert ends == [0, 0, 5]
    return [array("arrive", values["ARRIVE-PARAM"])]


def crossing_streets(problem: str) -> list[str]:
    values = values_of(problem, "10")
    half = np.eye(36, k=2, dtype=bool)
    assert np.array_equal(values["FLOWS-INTO-CELL"], np.kron(np.eye(2, dtype=bool), half)), "two cells further"
    inputs = values["PERIMETER-INPUT-CELL"].reshape(2, 36)
    assert np.array_equal(np.flatnonzero(inputs[0]), [0, 1]) and np.array_equal(inputs[0], inputs[1])
    assert not np.any(values["light-signal1"]) and not np.any(values["light-signal2"])

    def sets(name: str, cells) -> str:
        parts = np.array([sum(1 << int(k) for k in np.flatnonzero(part)) for part in np.reshape(cells, (-1, 36))])
        return words(name, parts.reshape(-1, 2) if len(parts) > 2 else parts)

    return [
        sets("occupied", values["occupied"]),
        sets("exits", values["PERIMETER-EXIT-CELL"]),
        sets("north_south", values["FLOWS-INTO-INTERSECTION-NS"].T),
        sets("east_west", values["FLOWS-INTO-INTERSECTION-EW"].T),
        array("rates", values["PERIMETER-INPUT-RATE"].reshape(2, 36)[:, :2]),
    ]


def traffic() -> list[str]:
    return crossing_streets("Traffic_MDP_ippc2014")


def traffic_ctm() -> list[str]:
    return crossing_streets("Traffic_CTM_MDP_ippc2011")


def knapsack() -> list[str]:
    values = values_of("Knapsack_or", "0")
    return [
        array("probability", values["ITEM-PROB"]),
        integers("weight", values["ITEM-WEIGHT"]),
        integers("value", values["ITEM-VALUE"]),
    ]


def bin_packing() -> list[str]:
    values = values_of("BinPacking_or", "0")
    return [array("probability", values["ITEM-PROB"]), integers("size", values["ITEM-SIZE"])]


def power_gen() -> list[str]:
    values = values_of("PowerGen_ippc2023", "5")
    assert np.all(values["PROD-SHAPE"] == 1) and not np.any(values["prevOn"]) and not np.any(values["prevProd"])
    assert np.all(values["PROD-UNITS-MIN"] > 0)
    tables = {
        "least": "PROD-UNITS-MIN",
        "greatest": "PROD-UNITS-MAX",
        "scale": "PROD-SCALE",
        "cost": "COST-PER-UNIT",
        "change": "PROD-CHANGE-PENALTY",
        "turn_on": "TURN-ON-COST",
    }
    numbers = {
        "income": "INCOME-PER-UNIT",
        "temperature": "temperature",
        "temperature_variance": "TEMP-VARIANCE",
        "least_temperature": "TEMP-MIN",
        "greatest_temperature": "TEMP-MAX",
        "demand_factor": "DEMAND-EXP-COEF",
        "least_demand_temperature": "MIN-DEMAND-TEMP",
        "least_demand": "MIN-CONSUMPTION",
        "penalty": "UNFULFILLED-DEMAND-PENALTY",
    }
    return [
        *(array(name, values[fluent]) for name, fluent in tables.items()),
        *(number(name, values[fluent]) for name, fluent in numbers.items()),
    ]


def hvac() -> list[str]:
    values = values_of("HVAC_ippc2023", "5")
    same = {"HEAT-COST": "heat_cost", "ZONE-VOL": "zone_volume", "HEATER-VOL": "heater_volume", "SIGMA": "exchange"}
    for name in same:
        assert np.all(values[name] == values[name][0])
    assert np.all(values["occupied"]) and np.all(values["ADJ-HEATER"].sum(axis=1) > 0)
    numbers = {
        "TEMP-OUT": "outside",
        "AIR-COST": "air_cost",
        "ZONE-DISCOMFORT-PENALTY": "penalty",
        "TEMP-ZONE-MIN": "least",
        "TEMP-ZONE-MAX": "greatest",
        "OUT-AIR-FLOW": "out_air_flow",
        "K": "k",
        "K-dz": "zone_loss",
        "K-dh": "heater_loss",
        "DELTA-T": "dt",
    }
    return [
        bit_sets("neighbours", values["ADJ-ZONES"] | values["ADJ-ZONES"].T),
        bit_sets("zones_of_heater", values["ADJ-HEATER"]),
        bit_sets("heaters_of_zone", values["ADJ-HEATER"].T),
        array("zone_start", values["temp-zone"]),
        array("heater_start", values["temp-heater"]),
        array("leave", values["P-SWITCH"]),
        *(number(name, float(values[fluent][0])) for fluent, name in same.items()),
        *(number(name, float(values[fluent])) for fluent, name in numbers.items()),
    ]


def epidemic() -> list[str]:
    values = values_of("Epidemic", "0")
    same = {"incubation_rate": "incubation", "recover_rate": "recover", "discharge_rate": "discharge"}
    assert all(np.all(values[name] == values[name][0]) for name in same)
    costs = {"vacc_cost": 0.05, "distancing_cost": 0.5, "school_cost": 1, "death_cost": 1000, "overload_cost": 500, "hosp_capacity": 0.05}
    assert all(values[name] == cost for name, cost in costs.items())
    return [
        array("start", [values[name] for name in "SEIRHD"]),
        array("contact", values["contact_rate"]),
        array("hospital_rate", values["hosp_rate"]),
        array("death_rate", values["death_rate"]),
        integers("at_school", values["affect_by_school_shutdown"], "bool"),
        *(number(name, float(values[fluent][0])) for fluent, name in same.items()),
        number("distancing", float(values["distancing_reduction_rate"])),
        number("closing", float(values["school_shutdown_reduction_rate"])),
    ]


def recsim() -> list[str]:
    values = values_of("RecSim_ippc2023", "1")
    providers = len(values["PROVIDER-DISCOUNT"])
    assert np.array_equal(values["LESS"], np.triu(np.ones((providers, providers)), k=1))
    assert np.array_equal(values["NEXT-PROVIDER"], np.eye(providers, k=1))
    assert np.all(values["PROVIDER-DISCOUNT"] == 0.5) and not np.any(values["item-by"])
    assert not np.any(values["consumer-satisfaction"])
    return [
        array("satisfaction", values["provider-satisfaction"]),
        array("affinity", values["CONSUMER-AFFINITY"]),
        array("competence", values["PROVIDER-COMPETENCE"]),
        array("first_features", values["item-feature"]),
        number("greatest_affinity", float(values["MAX-AFFINITY"])),
    ]


def pizza() -> list[str]:
    values = values_of("Pizza_rddlsim", "0")
    orders = [f"{{{place}, {count}}}" for place, count in enumerate(values["ORDERS"]) if count > 0]
    assert [list(np.flatnonzero(row)) for row in values["truckAt"]] == [[0], [0]] and np.all(values["hot"])
    assert not any(np.any(values[name]) for name in ("delivered", "pizzaInTruck", "disposed"))
    return [
        "struct Orders { int place; std::uint64_t count; };",
        f"inline constexpr Orders orders[] = {{{', '.join(orders)}}};",
        number("shop", 1, "std::uint64_t"),
        number("drive_probability", float(values["DRIVEPROB"][0])),
    ]


def intruders_discrete() -> list[str]:
    values = values_of("Intruders_Discrete", "0")
    steps = [[np.argmax(rows, axis=1) for rows in values[name]] for name in ("TARGET-X", "TARGET-Y")]
    assert all(np.all(values[name].sum(axis=2) == 1) for name in ("TARGET-X", "TARGET-Y"))
    targets = [[x[a] * 4 + y[b] for a in range(4) for b in range(4)] for x, y in zip(*steps, strict=True)]
    return [
        integers("next", targets),
        integers("intruders", [the_only(places) for places in values["intruder-at"]]),
        integers("cameras", [the_only(places) for places in values["camera-at"]]),
        integers("danger", np.flatnonzero(values["IS-DANGER-ZONE"])),
    ]


def zombies() -> list[str]:
    values = values_of("Zombies_arcade", "2")
    assert values["X_MAX"] == 10 and values["Y_MAX"] == 1 and np.all(values["y_loc"] == 0.5)
    return [array("x", values["x_loc"]), bit_sets("zombies", [values["zombie"]])]


def tamarisk() -> list[str]:
    values = values_of("Tamarisk_MDP_ippc2014", "10")
    assert np.array_equal(values["SLOT-AT-REACH"], np.repeat(np.eye(8), 3, axis=0)), "three slots each"
    assert np.array_equal(values["DOWNSTREAM-REACH"], np.eye(8, k=-1)), "reaches follow each other"
    return [bit_sets(name, [values[f"{name}-at"]]) for name in ("tamarisk", "native")]


def mars_rover() -> list[str]:
    values = values_of("MarsRover_ippc2023", "3")
    assert np.all(values["MAX-POWER"] == 0.1) and values["SCALE-FACTOR"] == 0.1
    assert not np.any(values["vel-x"]) and not np.any(values["vel-y"])
    tables = {"area": "MINERAL-AREA", "value": "MINERAL-VALUE", "mineral_x": "MINERAL-POS-X", "mineral_y": "MINERAL-POS-Y"}
    return [
        *(array(name, values[fluent]) for name, fluent in tables.items()),
        array("x", values["pos-x"]),
        array("y", values["pos-y"]),
    ]


def earth_observation() -> list[str]:
    values = values_of("EarthObservation_ippc2018", "17")
    next_patches = np.zeros((96, 96, 3), dtype=bool)
    for patch in range(96):
        for direction, up in enumerate((1, -1, 0)):
            if 0 <= patch % 12 + up < 12:
                next_patches[patch, (patch + 12 + up) % 96, direction] = True
    assert np.array_equal(values["CONNECTED"], next_patches), "columns of twelve around a cylinder"
    visibility = values["visibility"]
    high, medium, low = (
        [float(values[f"{start}_TO_{end}_VIS"]) for end in ends]
        for start, ends in (("HIGH", ("LOW", "MEDIUM")), ("MEDIUM", ("HIGH", "LOW")), ("LOW", ("HIGH", "MEDIUM")))
    )
    return [
        integers("focal_point", values["is-focal-point"], "bool"),
        integers("target", values["is-target"], "bool"),
        integers("high", visibility == 0, "bool"),
        integers("low", visibility == 2, "bool"),
        array("failure", [values[f"FAILURE_PROB_{kind}_VIS"] for kind in ("HIGH", "MEDIUM", "LOW")]),
        array("after_high", [1.0 - high[0] - high[1], 1.0 - high[0]]),
        array("after_medium", [medium[0], 1.0 - medium[1]]),
        array("after_low", [low[0], low[0] + low[1]]),
    ]


def academic_advising_2018() -> list[str]:
    values = values_of("AcademicAdvising_ippc2018", "10")
    constants = {"COURSE_COST": -1, "COURSE_RETAKE_COST": -1, "PROGRAM_INCOMPLETE_PENALTY": -5}
    assert all(np.all(values[name] == value) for name, value in constants.items())
    return [
        bit_sets("prerequisites", values["PREREQ"].T),
        bit_sets("program", [values["PROGRAM_REQUIREMENT"]]),
        array("prior", values["PRIOR_PROB_PASS"]),
        array("alone", values["PRIOR_PROB_PASS_NO_PREREQ"]),
    ]


def cooperative_recon() -> list[str]:
    values = values_of("CooperativeRecon_ippc2018", "11")
    assert np.array_equal(values["HAS_TOOL"], [[1, 1, 0, 0, 0], [0, 0, 1, 1, 1]])
    kinds = [list(np.flatnonzero(values[f"{kind}_TOOL"])) for kind in ("WATER", "LIFE", "CAMERA")]
    assert kinds == [[0, 2], [1, 3], [4]]
    for name, axis, step in (("LEFT", "x", -1), ("RIGHT", "x", 1), ("DOWN", "y", -1), ("UP", "y", 1)):
        assert np.array_equal(values[f"ADJACENT_{name}"], np.eye(6, k=-step)), f"steps along {axis}"
    names = ("DETECT_PROB", "DETECT_PROB_DAMAGED", "DETECT_PROB_WITH_SUPPORT", "DETECT_PROB_DAMAGED_WITH_SUPPORT")
    assert [values[name] for name in names] == [0.5, 0.25, 0.8, 0.4]
    none = np.zeros(8)
    return [
        array("damage", values["DAMAGE_PROB"].ravel()),
        array("rewards", np.concatenate([values["GOOD_PIC_REWARD"], none, values["BAD_PIC_REWARD"], none])),
        integers("cells", [the_only(cells) for cells in values["agent-at"]], "std::uint64_t"),
    ]


def wildlife_preserve() -> list[str]:
    values = values_of("WildlifePreserve_p10_ippc2018", "10")
    assert np.all(values["POACHER-REMEMBERS"]) and not np.any(values["ATTACK-WEIGHT_2"])
    return [
        array("never", values["ATTACK-WEIGHT_0"]),
        array("once", values["ATTACK-WEIGHT_1"]),
        array("reward", values["DEFENDER-REWARD"]),
        array("penalty", values["DEFENDER-PENALTY"]),
    ]


def manufacturer() -> list[str]:
    values = values_of("Manufacturer_ippc2018", "13")
    assert [tuple(pair) for pair in np.argwhere(values["PROCESSED_TO"])] == [(0, 2), (0, 4), (1, 2), (2, 3), (2, 4)]
    assert list(np.flatnonzero(values["have-factory"])) == [4] and not np.any(values["BUILD_FACTORY_COST"][[0, 1, 4]])
    chances = values["PRICE_LEVEL_PROB"]  # of the next level, by level and trend
    levels = len(chances)
    assert np.all(np.transpose(chances)[:, ~np.tri(levels, k=1, dtype=bool)] == 0), "a level up at most"
    limits = np.array([[chances[2, 3, t], chances[2, 3, t] + chances[3, 3, t]] for t in range(3)]).T
    for (level, trend), _ in np.ndenumerate(chances[0]):
        sums = np.cumsum(chances[:, level, trend])
        assert level == 0 or sums[level - 1] == limits[0, trend], "the same step from each level"
        assert level == levels - 1 or sums[level] == limits[1, trend]
    change = values["PRICE_TREND_CHANGE_PROB"]
    ones = np.ones_like(change)
    first = np.stack([1.0 - change, change / 2, 0 * change])  # a lower trend, by the trend
    second = np.stack([ones, change / 2 + (1.0 - change), change])
    single = {
        "marketing_bonus": "MARKETING_MANAGER_BONUS",
        "lobbyist_bonus": "LOBBYIST_BONUS",
        "manager_salary": "SALARY_PRODUCTION_MANAGER",
        "marketing_salary": "SALARY_MARKETING_MANAGER",
        "lobbyist_salary": "SALARY_LOBBYIST",
        "manager_applies": "PROB_PRODUCTION_MANAGER_APPLIES",
        "lobbyist_applies": "PROB_LOBBYIST_APPLIES",
        "marketing_applies": "PROB_MARKETING_MANAGER_APPLIES",
    }
    return [
        bit_sets("processed", [values["PROCESSED_TO"].ravel()]),
        bit_sets("factories", [values["have-factory"]]),
        integers("trends", values["price-trend"], "std::uint64_t"),
        array("price", values["PRICE"]),
        array("factor", values["PRICE_LEVEL_FACTOR"]),
        array("level_limits", limits),
        array("trend_limits", np.stack([first, second]).transpose(2, 0, 1)),
        integers("build_cost", values["BUILD_FACTORY_COST"], "std::uint64_t"),
        array("delay", values["PROB_CONSTRUCTION_DELAY_FACTORY"]),
        number("levels", levels, "std::size_t"),
        *(number(name, float(values[fluent])) for name, fluent in single.items()),
    ]


def logistics() -> list[str]:
    values = values_of("Logistics_rddlsim", "0")
    assert np.all(values["MAX-DOCKED"] == 2) and np.all(values["CAPACITY"] == 1)
    assert [values[f"{crowd}_CROWD_PROB"] for crowd in ("BIG", "MED", "LOW")] == [0, 0.5, 1]
    assert values["PROB_LOAD"] == values["PROB_UNLOAD"]
    tables = [values[name].ravel() for name in ("truckAt", "atDepot", "boxInTruck", "boxInCity")]
    return [
        bit_set("start", np.concatenate(tables)),
        bit_set("destinations", values["DESTINATION"].ravel()),
        number("load_probability", values["PROB_LOAD"]),
    ]


def option() -> list[str]:
    values = values_of("Option_or", "1")
    assert np.all(values["price"] == 10) and values["time"] == 0 and not values["exercised"]
    covariances = values["RHO"] * np.sqrt(np.outer(values["VAR"], values["VAR"]))
    (first, _), (shared, second) = np.linalg.cholesky(covariances)
    numbers = {"price": 10.0, "delta": values["DELTA"], "maturity": values["MATURITY"], "strike": values["STRIKE"]}
    return [
        array("drift", (values["MEAN"] - 0.5 * values["VAR"]) * values["DELTA"]),
        array("factor", np.multiply([first, shared, second], np.sqrt(values["DELTA"]))),
        *(number(name, float(value)) for name, value in numbers.items()),
    ]


def uav() -> list[str]:
    values = values_of("UAV_ippc2023", "5")
    assert all(np.all(values[f"{end}-{axis}"] == sign * 50000) for end, sign in (("MIN", -1), ("MAX", 1)) for axis in "XYZ")
    limits = {"ACC": 10, "DELTA-PHI": 1, "DELTA-THETA": 1}
    assert all(np.all(values[f"MAX-{name}"] == most) and np.all(values[f"MIN-{name}"] == -most) for name, most in limits.items())
    assert (values["GRAVITY"], values["SCALE-FACTOR"], values["VEL-REG"]) == (9.8, 0.1, 0.001)
    controlled = np.flatnonzero(values["CONTROLLABLE"])
    return [
        integers("controlled", controlled, "std::size_t"),
        array("goal", [values[f"GOAL-{axis}"][controlled] for axis in "XYZ"]),
        array("start", [values[name] for name in ("phi", "pos-x", "pos-y", "pos-z", "psi", "theta", "vel")]),
        number("variance", values["RANDOM-WALK-COEFF"]),
    ]


def race_car() -> list[str]:
    values = values_of("RaceCar_ippc2023", "5")
    ends = [values[name] for name in ("X1", "Y1", "X2", "Y2")]
    assert np.all((ends[0] == ends[2]) | (ends[1] == ends[3])), "walls along the axes"
    assert values["vx"] == values["vy"] == 0 and values["x"] == values["X0"] and values["y"] == values["Y0"]
    assert (values["MASS"], values["DT"], values["COST"], values["GOAL-REWARD"]) == (1, 0.1, 0.01, 1)
    names = {"start_x": "X0", "start_y": "Y0", "goal_x": "GX", "goal_y": "GY", "radius": "RADIUS"}
    return [
        *(array(name, of) for name, of in zip(("x1", "y1", "x2", "y2"), ends, strict=True)),
        *(number(name, float(values[fluent])) for name, fluent in names.items()),
    ]


def traffic_blx() -> list[str]:
    values = values_of("TrafficBLX_SimplePhases", "0")
    sources, sinks = [0, 2, 4, 6], [1, 3, 5, 7]
    assert [list(np.flatnonzero(values[name])) for name in ("SOURCE", "SINK")] == [sources, sinks]
    turns = [[(source + way) % 8 for way in (1, 3, 5)] for source in sources]  # right, through and left
    assert [sorted(ways) for ways in turns] == [list(np.flatnonzero(values["TURN"][source])) for source in sources]
    constants = {"MU": 0.53, "BETA": 0.33, "Nl": 4, "Vl": 13.8, "Dl": 150, "Lv": 6, "Ts": 1, "SOURCE-ARRIVAL-RATE": 0.3, "SOURCE-MU": 0.4}
    assert all(np.all(values[name][..., sources] == value) if np.ndim(values[name]) else values[name] == value for name, value in constants.items())
    assert not any(np.any(values[name]) for name in ("flow-on-link", "q", "Nc", "virtual-q", "signal-t"))
    assert np.array_equal(values["TIME-VAL"], np.arange(21)) and np.array_equal(values["NEXT"], np.eye(21, k=1))
    green = values["GREEN"]
    assert all(np.all(green[source, way[0]]) for source, way in zip(sources, turns, strict=True)), "right turns always"
    return [
        array("green_through", [[green[source, way[1], phase] for source, way in zip(sources, turns, strict=True)] for phase in range(8)]),
        array("green_left", [[green[source, way[2], phase] for source, way in zip(sources, turns, strict=True)] for phase in range(8)]),
        array("least", values["PHASE-MIN"][0]),
        array("most", values["PHASE-MAX"][0]),
    ]


def red_finned_blue_eye() -> list[str]:
    values = values_of("RedFinnedBlueEye_ippc2018", "20")
    connected = values["SPRINGS_CONNECTED"]
    springs, _, levels = connected.shape
    assert not np.any(connected & connected.swapaxes(0, 1)), "a chance to colonize is 0 or 1"
    assert np.all(connected[:, :, 1:] <= connected[:, :, :-1]), "high water connects more"
    assert values["translocate-possible-in"] == 0 and values["TRANSLOCATION_INTERVAL"] == 4
    near = connected | connected.swapaxes(0, 1)
    distances = sorted({b - a for a, b, _ in np.argwhere(connected)})
    assert min(distances) > 0
    # Each distance and level has the springs that are connected to a spring so much further.
    open_at = [[np.array([s + d < springs and near[s, s + d, level] for s in range(springs)]) for level in range(levels)] for d in distances]
    neighbours = [[sum(1 << int(k) for k in np.flatnonzero(near[s, :, level])) for s in range(springs)] + [0] * (-springs % 8) for level in range(levels)]
    further = [[sum(1 << int(k) for k in np.flatnonzero(row)) for row in rows] + [0] for rows in open_at]
    return [
        bit_set("fish", values["population"] == 0),
        bit_set("gambusia", values["population"] == 1),
        number("springs", springs, "std::size_t"),
        number("levels", levels, "std::size_t"),
        integers("distances", distances, "int"),
        words("neighbours", neighbours),
        words("further", further),
        array("level_chances", values["HIGH_WATER_PROB"]),
        array("mortality", values["NATURAL_MORTALITY_PROB"]),
        array("success", [values[f"{name}_SUCCESS_PROB"] for name in ("POISON", "REMOVE_MANUALLY", "TRANSLOCATION")]),
    ]


def chromatic_dice() -> list[str]:
    values = values_of("ChromaticDice_ippc2018", "10")
    for part, bonus in (("VALUE", 45), ("COLOR", 40)):
        assert np.array_equal(values[f"BONUS_PROB_{part}_PART"], [0, 0, 0, 1, 1, 1])
        assert np.all(values[f"BONUS_{part}_PART"] == bonus)
    scores = {"FIVE_OF_A_KIND": 50, "LARGE_STRAIGHT": 40, "SMALL_STRAIGHT": 30, "FULL_HOUSE": 25, "COLOR_FULL_HOUSE": 20}
    assert all(values[f"SCORE_{name}"] == score for name, score in scores.items())
    assert all(np.all(values[name] == start) for name, start in (("die-value", 0), ("die-color", 2), ("current-phase", 0)))
    return [
        array("value_chances", values["VALUE_PROB"]),
        array("color_chances", values["COLOR_PROB"]),
        bit_set("taken", values["taken"]),
        number("level", values["bonus-level-value-part"], "std::uint64_t"),
    ]


def quadcopter() -> list[str]:
    values = values_of("Quadcopter_physics", "1")
    constants = {"FMAX": 1e6, "MC": 0.3, "MR": 0.1, "R": 0.15, "L": 0.3, "DF": 2, "K": 0.01, "B": 0.001, "KD": 4, "DT": 0.01, "G": 9.8}
    weights = {"DISTANCE": 1, "COLLISION": 10000, "TILT": 0.0001, "WOBBLE": 0.0001}
    assert all(values[name] == value for name, value in (constants | weights).items())
    assert len(set(values["ID"])) == len(values["ID"])
    moving = ("xdot", "ydot", "zdot", "phi", "theta", "psi", "phidot", "thetadot", "psidot")
    assert not any(np.any(values[name]) for name in moving)
    return [array("start", [values[axis] for axis in "xyz"]), array("target", [values[f"T{axis}"] for axis in "XYZ"])]


def tetris() -> list[str]:
    values = values_of("Tetris_arcade", "0")
    for name in ("WIDTH", "HEIGHT", "OFFSET-X", "OFFSET-Y"):
        assert np.all(np.diff(values[name]) == 1), "in order"
    assert values["WIDTH"].size == 4 and values["HEIGHT"].size == 6
    assert np.all(values["PROB-SHAPE"] == 1) and not np.any(values["filled"])
    assert [values[f"CLEARED-{count}"] for count in (1, 2, 3, 4)] == [40, 100, 300, 1200]
    placed = [
        sum(1 << (4 * int(y) + column + int(x)) for x, y in np.argwhere(cells) if column + x < 4)
        for rotations in values["SHAPES"] for cells in rotations for column in range(4)
    ]
    return [words("placed", placed), number("shape", the_only(values["current-shape-type"]), "std::uint64_t")]


def sokoban() -> list[str]:
    values = values_of("Sokoban_arcade", "0")
    walls = values["WALL"]
    assert walls.shape == (5, 7) and np.all(np.diff(values["IX"]) == 1) and np.all(np.diff(values["IY"]) == 1)
    assert all(np.all(side) for side in (walls[0], walls[-1], walls[:, 0], walls[:, -1]))
    assert np.sum(values["box"]) <= np.sum(values["STORAGE"]) and np.sum(values["man"]) == 1
    names = {"walls": "WALL", "storage": "STORAGE", "boxes": "box", "man": "man"}
    return [bit_set(ours, values[name].ravel()) for ours, name in names.items()]


TABLES = (
    mountain_car,
    sysadmin,
    wildfire,
    reservoir,
    game_of_life,
    navigation,
    crossing_traffic,
    academic_advising,
    skill_teaching,
    triangle_tireworld,
    elevators,
    traffic,
    knapsack,
    bin_packing,
    power_gen,
    hvac,
    epidemic,
    recsim,
    pizza,
    intruders_discrete,
    zombies,
    tamarisk,
    mars_rover,
    earth_observation,
    academic_advising_2018,
    cooperative_recon,
    wildlife_preserve,
    manufacturer,
    logistics,
    option,
    uav,
    race_car,
    traffic_blx,
    red_finned_blue_eye,
    traffic_ctm,
    chromatic_dice,
    quadcopter,
    tetris,
    sokoban,
)


def main() -> None:
    print("// Made by tables.py.\n#pragma once\n\n#include <array>\n#include <cstddef>\n#include <cstdint>")
    for tables in TABLES:
        print(f"\nnamespace {tables.__name__} {{", *tables(), "}", sep="\n")


if __name__ == "__main__":
    main()
