"""Cells with neighbours: games of life, fires, walkers, coordinates."""

from domains.draft import ACTION, CONSTANT, STATE, Draft, boolean, integer, over, real

N = "?n"


def add(draft: Draft) -> None:
    cell = draft.objects("cell", main=True)
    near = neighbours(draft, cell)
    alive = draft.declare("alive", STATE, "bool", cell)
    toggle = draft.declare("toggle", ACTION, "bool", cell, default="false")
    around = neighbour_count(draft, near, alive, cell)
    draft.define(alive, ("?c",), rule(draft, alive, toggle, around))
    if draft.flavour.finite or draft.chance(0.6):
        crowding(draft, cell, around)
    for part in draft.rng.sample([walkers, heat, coordinates, frontier], draft.pick([1, 2, 2, 3])):
        part(draft, cell, near, alive)
    draft.earn(over("sum", "?c", cell, boolean("%s", draft.at(alive, "?c", prime=draft.chance(0.5)))))


def neighbours(draft: Draft, cell: str):
    """A line, a ring, a torus of rows, the diagonal, or random pairs."""
    near = draft.declare("NEAR", CONSTANT, "bool", cell, cell, default="false")
    size, members = draft.size(cell), draft.problem.type(cell).members
    width = draft.pick([1, 2, 3, 4, 8])
    offsets = draft.pick([(1,), (1, -1), (1, -1, width, -width), (0,), (0, 1), (1, -1, width, width + 1)])
    wraps, kept = draft.chance(0.5), draft.pick([1.0, 1.0, 0.7])
    for index in range(size):
        for offset in offsets:
            other = index + offset
            if (wraps or 0 <= other < size) and draft.chance(kept):
                near.values[(members[index], members[other % size])] = "true"
    return near


def neighbour_count(draft: Draft, near, alive, cell: str):
    mask = draft.at(near, *draft.pick([("?c", N), (N, "?c")]))
    return over("sum", N, cell, boolean(draft.pick(["(%s ^ %s)", "(%s ^ ~%s)", "(%s * %s)"]), mask, draft.at(alive, N)))


def rule(draft: Draft, alive, toggle, around):
    here, pushed = draft.at(alive, "?c"), draft.at(toggle, "?c")
    if draft.chance(0.4):
        around = draft.at(draft.interm("around", {"?c": alive.parameters[0]}, around), "?c")
    few, many = draft.pick([(2, 3), (1, 2), (0, 1), (3, 8)])
    life = boolean(f"((%s ^ (%s >= {few}) ^ (%s <= {many})) | (~%s ^ (%s == {many})))", here, around, around, here, around)
    fire = boolean("(%s | (%s))", here, draft.coin(real("(%s * 0.25)", around)))
    parity = boolean("(%s ~= (mod[%s, 2] == 1))", here, around)
    body = draft.pick([life, fire, parity, spread(draft, alive, around), spread(draft, alive, around)])
    return boolean(draft.pick(["(%s ~= %s)", "(%s | %s)", "(%s ^ ~%s)"]), body, pushed)


def spread(draft: Draft, alive, around):
    """Cells catch fire, or computers fail, by how many around them did."""
    low, rise = draft.pick([("0.05", "0.1"), ("0.525", "0.0475"), ("0.0", "0.25")])
    by_count = draft.coin(real(f"({low} + {rise} * %s)", around))
    share = draft.coin(real(f"({low} + 0.5 * (1.0 + %s) / (1.0 + {draft.size(alive.parameters[0])}))", around))
    caught = draft.pick([by_count, share])
    form = draft.pick(["(if (%s == 0) then false else %s)", "(if (%s > 0) then %s else OTHER)", "(if (exists) then %s else OTHER)"])
    other = draft.pick([boolean("false"), draft.coin("0.1"), draft.at(alive, "?c")])
    if "exists" in form:
        return boolean("(if (%s) then %s else %s)", is_near(around), caught, other)
    return boolean(form.replace("OTHER", "%s"), around, caught, *([other] if "OTHER" in form else []))


def crowding(draft: Draft, cell: str, around) -> None:
    """A line of the count, and another value if the count is 0."""
    low, rise = draft.pick([("0.525", "0.0475"), ("0.05", "0.1"), ("-1.0", "0.25"), ("0.0", "-0.3")])
    line = real(f"({low} + {rise} * %s)", around)
    if draft.chance(0.6):  # each cell has a line of its own
        risk = draft.declare("RISK", CONSTANT, "real", cell, default="0.525")
        for objects in draft.problem.groundings(risk):
            risk.values[objects] = draft.pick(["0.1", "0.3", "0.7", "1.1", "0.525"] if draft.problem.flavour != "plain" else ["0.5", "2.0"])
        form = draft.pick(["((0.1 + 0.5 * (1 + %s)) / (1.5 + abs[%s]))", "(0.45 + 0.3 * (0.7 + %s) / (0.5 + %s) / 3.1)", "(%s * %s)"])
        line = real(form if draft.problem.flavour != "plain" else "(%s * %s)", around, draft.at(risk, "?c"))
    term = draft.pick([line, real("(if (%s) then %s else %s)", is_near(around), line, draft.pick(["0.0", "-0.0", "1.0"]))])
    draft.earn(over("sum", "?c", cell, term))


def is_near(around):
    """Whether there is any: as exists, if what is counted are bools."""
    if "*" in around.parts[0].form or not around.form.startswith("(sum_"):
        return boolean("(%s > 0)", around)
    return boolean(around.form.replace("(sum_", "(exists_"), *around.parts)


def walkers(draft: Draft, cell: str, near, alive) -> None:
    """Each stays, or goes to the best neighbour."""
    walker = draft.objects("walker")
    place = draft.declare("place", STATE, cell, walker)
    score = draft.declare("SCORE", CONSTANT, "real", cell)
    here = draft.at(place, "?w")
    worth = real("(%s * %s)", draft.at(near, here, N), draft.signed(draft.at(score, N)))
    best = over(draft.pick(["argmax", "argmin"]), N, cell, worth)
    if draft.flavour.draws and draft.chance(0.4):
        best = real(f"(UnnormDiscrete_{{{N} : {cell}}} [%s + 0.25])", draft.at(near, here, N))
    stays = boolean("(%s | %s)", draft.at(alive, here), draft.some_bool({"?w": walker}))
    draft.define(place, ("?w",), real("(if (%s) then %s else %s)", stays, here, best))
    seen = boolean("((%s == ?c) ^ %s)", draft.at(place, "?w", prime=True), draft.at(alive, "?c"))
    draft.earn(draft.revealed(over("sum", "?w", walker, real("(%s * %s)", draft.at(score, draft.at(place, "?w")), draft.some_real({})))))
    draft.earn(over("sum", "?w", walker, over("sum", "?c", cell, seen)))


def heat(draft: Draft, cell: str, near, alive) -> None:
    """Goes to neighbours; sources and sinks of either sign."""
    warmth = draft.declare("heat", STATE, "real", cell)
    source = draft.signed(draft.some_real({"?c": cell}))
    flow = over("sum", N, cell, real("(%s * (%s - %s))", draft.at(near, "?c", N), draft.at(warmth, N), draft.at(warmth, "?c")))
    next_heat = real("(%s + 0.25 * %s + %s * %s)", draft.at(warmth, "?c"), flow, draft.at(alive, "?c"), source)
    draft.define(warmth, ("?c",), draft.bounded(next_heat))
    draft.earn(draft.revealed(over("sum", "?c", cell, real("(%s * %s)", draft.at(alive, "?c"), draft.signed(draft.at(warmth, "?c"))))))


def coordinates(draft: Draft, cell: str, near, alive) -> None:
    """One walker by numbers, which finds its cell by comparing them."""
    x = draft.declare("X", CONSTANT, "int", cell, default="0")
    width = draft.pick([1, 3, 8, 100])
    for index, member in enumerate(draft.problem.type(cell).members):
        x.values[(member,)] = str(index % width - draft.pick([0, 0, 1]))
    at = draft.declare("at-x", STATE, "int")
    step = draft.declare("step", ACTION, "int", default="0")
    draft.define(at, (), draft.small(integer("(%s + %s)", draft.at(at), draft.at(step))))
    same = boolean("(%s == %s)", draft.at(x, "?c"), draft.at(at))
    draft.earn(draft.revealed(over("sum", "?c", cell, real("(%s * %s)", same, draft.signed(draft.some_real({"?c": cell}))))))
    draft.problem.preconditions.append(boolean("((%s >= -1) ^ (%s <= 2))", draft.at(step), draft.at(step)))


def frontier(draft: Draft, cell: str, near, alive) -> None:
    edge = over("exists", N, cell, boolean("(%s ^ (%s ~= %s))", draft.at(near, "?c", N), draft.at(alive, N), draft.at(alive, "?c")))
    border = draft.interm("border", {"?c": cell}, edge)
    count = over("sum", "?c", cell, draft.at(border, "?c"))
    draft.earn(real("(if (%s == %s) then 1.0 else -0.5)", count, draft.pick(["0", "1", "3"])))
    if draft.chance(0.4):
        draft.problem.terminations.append(boolean("~%s", over("exists", "?c", cell, draft.at(alive, "?c"))))
