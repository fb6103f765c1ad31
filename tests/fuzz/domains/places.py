"""Places of few things, on roads and by directions: tables of bools of which few are true. Cells that read their neighbours. Spots that tools change."""

from domains.draft import ACTION, CONSTANT, STATE, Draft, boolean, of, over, real
from rddl_problem import Type

FROM, TO = "?s", "?t"


def add(draft: Draft) -> None:
    for part in draft.rng.sample([roads, robots, cells, tools], draft.pick([1, 1, 2])):
        part(draft)


def spots(draft: Draft, counts: list[int]) -> str:
    name = draft.fresh("spot")
    draft.problem.types.append(Type(name, False, [f"{name}-{i}" for i in range(draft.pick(counts))]))
    return name


def roads(draft: Draft) -> None:
    """A vehicle, or two, on roads between many places; spare tires lie there."""
    spot = spots(draft, [17, 17, 18, 20, 33, 65, 66])
    members = draft.problem.type(spot).members
    road = draft.declare("ROAD", CONSTANT, "bool", spot, spot, default="false")
    offsets = draft.pick([[0, 1, 2, 5, len(members) - 1], [1, 2, 5, len(members) - 1]])
    for index, member in enumerate(members):
        for offset in draft.rng.sample(offsets, draft.pick([0, 1, 2, 2])):
            road.values[(member, members[(index + offset) % len(members)])] = "true"
    vehicle = draft.declare("vehicle-at", STATE, "bool", spot, default="false")
    for member in draft.rng.sample(members, draft.pick([1, 1, 1, 2]) if len(members) > 32 else 1):
        vehicle.values[(member,)] = "true"
    move = draft.declare("move", ACTION, "bool", spot, spot, default="false")
    load = draft.declare("load", ACTION, "bool", spot, default="false")
    moves = draft.pick([boolean("true"), draft.some_bool({})])

    def moved(source: str, target: str):
        factors = [draft.at(move, source, target), draft.at(vehicle, source), draft.at(road, source, target), moves]
        draft.rng.shuffle(factors)
        return boolean("(%s ^ %s ^ %s ^ %s)", *factors)

    comes, goes = over("exists", FROM, spot, moved(FROM, "?p")), over("exists", TO, spot, moved("?p", TO))
    here = draft.at(vehicle, "?p")
    next_place = draft.pick([
        boolean("(if (%s) then true else if (%s) then false else %s)", comes, goes, here),
        boolean("(if (%s) then false else if (%s) then true else %s)", goes, comes, here),
        boolean("(%s | (%s ^ ~%s))", comes, here, goes),
        boolean("((%s | %s) ^ ~%s)", here, comes, goes),
        boolean("(if (%s) then true else %s)", comes, draft.pick([here, boolean("false"), boolean("true")])),
        boolean("(%s ~= %s)", comes, here),
    ])  # fmt: skip
    draft.define(vehicle, ("?p",), next_place)
    spare = draft.declare("spare-in", STATE, "bool", spot)
    taken = boolean("(%s ^ %s ^ %s)", draft.at(load, "?p"), draft.at(vehicle, "?p"), draft.at(spare, "?p"))
    draft.define(spare, ("?p",), boolean(draft.pick(["(if (%s) then false else %s)", "(~%s ^ %s)", "(%s | %s)"]), taken, draft.at(spare, "?p")))
    stock = draft.declare("stock", STATE, "bool")
    draft.define(stock, (), boolean(draft.pick(["(%s | %s)", "(%s ^ ~%s)"]), over("exists", "?p", spot, taken), draft.at(stock)))
    went = over("exists", f"{FROM} : {spot}, {TO}", spot, moved(FROM, TO))
    draft.earn(boolean("%s", draft.interm("went", {}, went).name))
    draft.earn(over("sum", "?p", spot, draft.at(vehicle, "?p", prime=draft.chance(0.5))))


def robots(draft: Draft) -> None:
    """Each robot goes where its direction leads, by tables of the directions."""
    robot, spot = draft.objects("robot"), spots(draft, [8, 9, 16, 17, 31, 32, 33, 64, 65])
    way = draft.enumeration("way", draft.pick([1, 2, 3, 5]))
    members, size = draft.problem.type(spot).members, draft.size(spot)
    leads = draft.declare("LEADS", CONSTANT, "bool", way.name, spot, spot, default="false")
    for word in way.members:
        offset, spread = draft.pick([0, 1, -1, 3, -4]), draft.pick([1, 1, 1, 2, 3])
        for index, member in enumerate(members):
            for k in range(spread if draft.chance(0.9) else 0):
                leads.values[(word, member, members[(index + offset + k) % size])] = "true"
    place = draft.declare("robot-at", STATE, "bool", robot, spot, default="false")
    for member in draft.problem.type(robot).members:
        for other in draft.rng.sample(members, draft.pick([0, 1, 1, 1]) + (size > 31 and draft.chance(0.2))):
            place.values[(member, other)] = "true"
    drive = draft.declare("drive", draft.pick([ACTION, ACTION, STATE]), way.name, robot, default=way.literal(way.members[-1]))
    if drive.role == STATE:
        draft.define(drive, ("?r",), of(way.name, "%s", draft.at(drive, "?r")))
    reached = boolean(f"(%s ^ (%s == ?w) ^ %s)", draft.at(place, "?r", FROM), draft.at(drive, "?r"), draft.at(leads, "?w", FROM, "?p"))
    if draft.chance(0.4):
        reached = boolean("(%s ^ %s)", reached, draft.some_bool(draft.pick([{}, {"?r": robot}, {"?p": spot}, {FROM: spot}])))
    draft.define(place, ("?r", "?p"), over("exists", f"{FROM} : {spot}, ?w", way.name, reached))
    there = draft.pick([draft.at(place, "?r", "?p"), boolean("~%s", draft.at(place, "?r", "?p")), boolean("(%s ^ %s)", draft.at(place, "?r", "?p"), draft.some_bool({"?r": robot}))])
    draft.earn(over(draft.pick(["sum", "sum", "exists", "forall"]), f"?r : {robot}, ?p", spot, there))


def cells(draft: Draft) -> None:
    """Bools read those of neighbours, in branches that constants decide."""
    cell = spots(draft, [8, 9, 16, 17, 31, 33, 64, 65])
    members, size = draft.problem.type(cell).members, draft.size(cell)
    neighbours, kinds = [], []
    for _ in range(draft.pick([1, 2, 3])):
        neighbour, offset = draft.declare("NEXT", CONSTANT, cell, cell), draft.pick([1, -1, 3, -4])
        for index, member in enumerate(members):
            neighbour.values[(member,)] = members[min(max(index + offset, 0), size - 1)]
        neighbours.append(neighbour)
    for _ in range(draft.pick([1, 2, 3])):
        kind, begin = draft.declare("KIND", CONSTANT, "bool", cell, default="false"), draft.pick([0, 1, size // 2, size - 1])
        for member in members[begin:] if draft.chance(0.5) else members[:begin]:
            kind.values[(member,)] = "true"
        kinds.append(kind)
    states = [draft.declare("lit", STATE, "bool", cell) for _ in range(draft.pick([1, 2]))]

    def value(depth: int):
        if depth == 0:
            return draft.at(draft.pick(states), draft.pick(["?c", *[draft.at(each, "?c") for each in neighbours] * 2]))
        kind, parts = draft.at(draft.pick(kinds), "?c"), [value(depth - 1), value(depth - 1)]
        form = draft.pick(["(if (%s) then %s else %s)", "((%s | %s) ^ %s)", "((%s ^ %s) | %s)", "(%s => (%s ^ ~%s))"])
        return boolean(form, draft.pick([kind, kind, value(0)]), *parts)

    for state in states:
        flips = draft.coin(draft.pick(["0.5", "0.125"]))
        draft.define(state, ("?c",), boolean("(if (%s) then %s else %s)", draft.pick([value(0), draft.at(kinds[0], "?c")]), value(draft.pick([1, 2, 3])), draft.pick([flips, value(2)])))
        draft.earn(over("sum", "?c", cell, draft.at(state, "?c")))


def tools(draft: Draft) -> None:
    """Spots stay as they are, or become what others were, where no tool is used."""
    spot, rover = spots(draft, [4, 8, 9, 16, 17]), draft.objects("rover")
    size = draft.size(spot)
    share = draft.declare("share", STATE, "real", spot, default=str(1 / size))
    draft.define(share, ("?p",), real(draft.pick(["%s", "(%s * 1.0)", "max[0.0, %s]"]), draft.at(share, "?p")))
    used = [draft.declare("use", ACTION, "bool", rover, spot, default=draft.pick(["false", "false", "true"])) for _ in range(draft.pick([1, 2]))]
    kind = draft.pick(["bool", "int", "real", "real"])
    kept = [draft.declare("kept", STATE, kind, spot) for _ in range(draft.pick([1, 2, 3]))]
    scope = {"?p": spot, "?r": rover, "?q": spot}
    for table in kept:
        other = draft.at(draft.pick(kept), "?q")
        drawn = f"Discrete_{{?d : {spot}}} [%s]"
        object_ = of(spot, drawn, draft.at(share, "?d")) if draft.flavour.draws and draft.chance(0.15) else "?p"
        factors = [draft.at(draft.pick(used), "?r", object_), boolean("(%s ~= %s)", other, draft.at(table, "?p")), draft.some_bool(scope)]
        if draft.chance(0.3):
            factors.append(draft.at(draft.pick(used), "?r", "?q"))
        draft.rng.shuffle(factors)
        changes = over("exists", f"?r : {rover}, ?q", spot, boolean("(" + " ^ ".join(["%s"] * len(factors)) + ")", *factors))
        own = draft.at(draft.pick([table, table, draft.pick(kept)]), "?p")
        if kind == "bool":
            value = boolean(draft.pick(["(%s | %s)", "(if (%s) then false else %s)", "(~%s ^ %s)", "(%s ~= %s)"]), changes, own)
        else:
            forms = {"int": ["7", "(1 - %s)"], "real": ["(-0.0)", "(-%s)", "(%s * 0.5)"]}[kind]
            form = draft.pick(forms)
            new = of(kind, form, *[draft.at(draft.pick(kept), "?p")] * form.count("%s"))
            value = of(kind, "(if (%s) then %s else %s)", changes, new, own)
        draft.define(table, ("?p",), value)
        earned = draft.at(table, "?p", prime=draft.chance(0.5))
        draft.earn(over("sum", "?p", spot, earned if kind != "real" else draft.revealed(earned)))
