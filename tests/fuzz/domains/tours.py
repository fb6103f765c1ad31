"""One thing on its way from cell to cell, or two. Visitors of whom each draws one of eight areas. Heat that constants let in. Levels that conditions choose."""

from domains.draft import ACTION, CONSTANT, INTERM, STATE, Draft, boolean, integer, of, over, real
from rddl_problem import Fluent, Type


def add(draft: Draft) -> None:
    for part in draft.rng.sample([walker, walker, visitors, heat, heat, levels, alarms], draft.pick([1, 2, 2])):
        part(draft)


def named(draft: Draft, stem: str, size: int) -> str:
    name = draft.fresh(stem)
    draft.problem.types.append(Type(name, False, [f"{name}-{i}" for i in range(size)]))
    return name


def walker(draft: Draft) -> None:
    """Bools without parameters choose the way; whether it is gone is drawn for the cell at its end."""
    cell = named(draft, "site", draft.pick([15, 17, 18, 31, 32, 33, 63, 64, 65, 66]))
    members = draft.problem.type(cell).members
    place = draft.declare("walker-at", STATE, "bool", cell, default="false")
    for member in draft.rng.sample(members, draft.pick([1, 1, 1, 1, 2]) if len(members) > 32 else 1):
        place.values[(member,)] = "true"
    chance = draft.declare("PASS", CONSTANT, "real", cell, default="0.75")
    for member in members:
        if draft.chance(0.5):
            chance.values[(member,)] = draft.pick(["0.0", "1.0", "0.5", "-0.0", "1.5", "-0.5"])
    ways = [way(draft, cell, members) for _ in range(draft.pick([1, 1, 2, 2, 3, 4]))]
    goes = [draft.declare("walk", draft.pick([ACTION, ACTION, ACTION, STATE]), "bool", default="false") for _ in ways]
    for bool_ in goes:
        if bool_.role == STATE:
            draft.define(bool_, (), draft.some_bool({}))
    draft.define(place, ("?c",), next_place(draft, cell, place, chance, ways, goes))
    draft.earn(over("sum", "?c", cell, draft.at(place, "?c", prime=draft.chance(0.5))))
    if draft.chance(0.5):
        gain = draft.declare("GAIN", CONSTANT, "real", cell)
        draft.earn(over("sum", "?c", cell, real("(%s * %s)", draft.at(place, "?c"), draft.at(gain, "?c"))))


def way(draft: Draft, cell: str, members: list[str]) -> Fluent:
    """From each cell to another one; at the end of a chain nowhere, in a ring to the first one."""
    relation = draft.declare("AHEAD", CONSTANT, "bool", cell, cell, default="false")
    offset, is_ring = draft.pick([1, -1, 2, 5, 0]), draft.chance(0.3)
    for index, member in enumerate(members):
        if is_ring or 0 <= index + offset < len(members):
            relation.values[(member, members[(index + offset) % len(members)])] = "true"
    return relation


def next_place(draft: Draft, cell: str, place: Fluent, chance: Fluent, ways: list[Fluent], goes: list[Fluent]):
    here = draft.at(place, "?c")
    drawn = draft.coin(draft.pick([draft.at(chance, "?c"), real("0.75")]))
    arrives = [over("exists", "?d", cell, boolean("(%s ^ %s)", draft.at(ahead, "?d", "?c"), draft.at(place, "?d"))) for ahead in ways]
    if draft.chance(0.3):
        goes = [boolean(draft.pick(["(%s ^ ~%s)", "(%s | %s)"]), draft.at(go), draft.some_bool({})) for go in goes]
    else:
        goes = [draft.at(go) for go in goes]
    moved = [boolean("(%s ^ %s)", go, arrive) for go, arrive in zip(goes, arrives)]
    any_moved = boolean("(" + " | ".join(["%s"] * len(moved)) + ")", *moved)
    none_goes = boolean("~(" + " | ".join(["%s"] * len(goes)) + ")", *goes)
    comes = boolean("(if (%s) then %s else false)", arrives[0], drawn)
    return draft.pick([
        boolean("(if (%s) then %s else %s)", goes[0], comes, here),
        boolean("(if (%s) then %s else (%s ^ %s))", any_moved, drawn, none_goes, here),
        boolean("((%s | (%s ^ %s)) ^ %s)", any_moved, none_goes, here, drawn),
        boolean("(if (%s) then (%s ^ %s) else %s)", goes[-1], arrives[-1], drawn, here),
    ])  # fmt: skip


def visitors(draft: Draft) -> None:
    """Fewer than eight draw one of eight, mostly, by weights that are divided by their sum."""
    visitor = named(draft, "visitor", draft.pick([1, 2, 3, 7, 7, 8]))
    area, day = draft.enumeration("area", draft.pick([8, 8, 8, 8, 7])), draft.enumeration("day", draft.pick([1, 2, 2, 3, 4]))
    gain, less = (draft.declare(name, CONSTANT, "real", visitor, area.name, default=draft.pick(["2.5", "0.5", "0.0"])) for name in ("LIKES", "LIKES-LESS"))
    for fluent in gain, less:
        for objects in draft.problem.groundings(fluent):
            if draft.chance(0.4):
                numbers = ["4.0", "0.1", "0.0", "7.25", "1e-300"] + (["1e308", "5e-324", "-0.0"] if draft.flavour.wild else [])
                fluent.values[objects] = draft.pick(numbers)
    open_ = draft.declare("free", STATE, "bool", area.name)
    seen = draft.declare("seen", STATE, "bool", area.name, day.name, default="false")
    chosen = draft.declare("to", draft.pick([STATE, INTERM]), area.name, visitor)
    form = draft.pick(["BY BOOL", "BY BOOL", "BY COUNT", "BY COUNT", "PLAIN"])

    def weight(variable: str):
        first, second = draft.at(gain, "?v", variable), draft.at(less, "?v", variable)
        if form == "PLAIN":
            return real("(%s + 0.25)", first)
        if form == "BY BOOL":
            return real("(if (%s) then %s else 0.25)", draft.at(open_, variable), first)
        count = over("sum", "?n", day.name, draft.at(seen, variable, "?n"))
        return real("((%s == 0) * %s + (%s == 1) * %s)", count, first, count, second)

    if draft.flavour.draws:
        share = real("(%s / %s)", weight("?a"), over("sum", "?b", area.name, weight("?b")))
        drawn = of(area.name, f"(Discrete_{{?a : {area.name}}} [%s])", share)
    else:
        drawn = over("argmax", "?a", area.name, weight("?a"))
    draft.define(chosen, ("?v",), drawn)
    comes = over("exists", "?v", visitor, boolean("(%s == ?a)", draft.at(chosen, "?v")))
    draft.define(open_, ("?a",), draft.pick([comes, boolean("~%s", draft.at(open_, "?a"))]))
    draft.define(seen, ("?a", "?n"), boolean(draft.pick(["(%s | %s)", "(%s ~= %s)"]), draft.at(seen, "?a", "?n"), comes))
    worth = draft.declare("WORTH", CONSTANT, "real", area.name)
    draft.earn(over("sum", "?a", area.name, real(draft.pick(["(if (%s) then %s else -5.0)", "(%s * %s)"]), draft.at(open_, "?a"), draft.at(worth, "?a"))))


def heat(draft: Draft) -> None:
    """Terms of a sum that constants let count for some rooms only, and that take long."""
    room = named(draft, "room", draft.pick([2, 3, 8, 9, 17]))
    warm, outer = draft.declare("warm", STATE, "real", room, default="0.5"), draft.declare("OUTER", CONSTANT, "bool", room)
    beside = draft.declare("BESIDE-ROOM", CONSTANT, "bool", room, room, default="false")
    members = draft.problem.type(room).members
    for index, member in enumerate(members):
        beside.values[(member, members[(index + 1) % len(members)])] = "true"
    own = draft.at(warm, "?r")
    flow = over("sum", "?n", room, real("(%s * (%s - %s))", draft.at(beside, "?r", "?n"), draft.at(warm, "?n"), own))
    if draft.problem.flavour == "plain":
        costly = real("(%s * %s)", own, own)
    else:
        costly = real(draft.pick(["cos[%s]", "(cos[%s] * 0.5)", "(sin[%s] * sin[%s])", "tanh[%s]", *(["(Normal(4.0, 1.0) - %s)", "Normal(4.0, 1.0)", "(Normal(-0.5, 2.0) * 0.5)"] * 2 if draft.flavour.draws else [])]).replace("%s", str(own)))
    let_in = real(draft.pick(["(%s * %s)", "(%s * (%s * 0.25))"]), draft.at(outer, "?r"), costly)
    change = real(draft.pick(["(%s + %s)", "((0.0 + %s) + %s)", "((1.0 + %s) + %s)"]), flow, let_in)
    changed = draft.pick([real("(%s + 0.1 * %s)", own, change), change])
    draft.define(warm, ("?r",), real("max[-8.0, min[8.0, %s]]", changed))
    draft.earn(draft.revealed(over(draft.pick(["sum", "max"]), "?r", room, draft.at(warm, "?r", prime=draft.chance(0.5)))))


def levels(draft: Draft) -> None:
    """An int that conditions choose, and that is compared with constants."""
    lamp = draft.objects("lantern", main=True)
    shines, oil = draft.declare("shines", STATE, "bool", lamp), draft.declare("oil", STATE, "int", lamp)
    own = {"?l": lamp}
    conditions = [draft.pick([draft.at(shines, "?l"), boolean(f"(%s {draft.comparison()} 3)", draft.at(oil, "?l")), draft.some_bool(own)]) for _ in range(draft.pick([1, 2, 3]))]
    numbers = [draft.pick(["0", "1", "2", "-1", "5"]) for _ in range(len(conditions) + 1)]
    cases = "".join(f"(if (%s) then {number} else " for number in numbers[1:]) + numbers[0] + ")" * len(conditions)
    level = draft.at(draft.interm("rung", own, integer(cases, *conditions)), "?l")

    def compared():
        return boolean(f"(%s {draft.comparison()} {draft.pick(['0', '1', '2', '-1', '5', '9'])})", level)

    draft.define(shines, ("?l",), draft.pick([compared(), boolean("(%s ^ ~%s)", compared(), draft.at(shines, "?l"))]))
    draft.define(oil, ("?l",), draft.small(integer("(if (%s) then %s - 1 else %s + 2)", compared(), draft.at(oil, "?l"), draft.at(oil, "?l"))))
    draft.earn(over("sum", "?l", lamp, draft.pick([compared(), integer("(%s * %s)", compared(), draft.at(oil, "?l"))])))


def alarms(draft: Draft) -> None:
    """An episode ends by the angles of joints."""
    joints = [draft.declare("joint", STATE, "real", default="0.25") for _ in range(draft.pick([2, 2, 3]))]
    for joint in joints:
        draft.define(joint, (), real("max[-4.0, min[4.0, 0.75 * %s + 0.5]]", draft.pick([draft.at(joint), draft.at(draft.pick(joints))])))
    if draft.problem.flavour == "plain":
        heights = [draft.at(joint) for joint in joints]
    else:
        heights = [real(f"{draft.pick(['cos', 'sin'])}[%s]", draft.pick([draft.at(joint), real("(%s + %s)", draft.at(joint), draft.at(joints[0]))])) for joint in joints]
    height = real("(" + draft.pick([" + ", " - "]).join(["%s"] * len(heights)) + ")", *heights)
    conditions = draft.pick([draft.problem.terminations, draft.problem.invariants])
    conditions.append(boolean(f"({draft.pick(['-', ''])}%s < {draft.pick(['1.75', '1.25', '2.5'])})", height))
    draft.earn(draft.revealed(height))
