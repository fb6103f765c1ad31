"""Belts: what lies on them moves by one place in each step, and more is put where an index says."""

from domains.draft import ACTION, CONSTANT, STATE, Draft, boolean, integer, of, over, real
from rddl_problem import Type


def add(draft: Draft) -> None:
    is_plain = draft.chance(0.4)  # else nearly all belts have something about which registers give up
    belt, place = draft.objects("belt"), places(draft, is_plain)
    after = chain(draft, place, is_plain)
    number = draft.declare("NUMBER", CONSTANT, "int", place)
    number.values = {(member,): str(index) for index, member in enumerate(draft.problem.type(place).members)}
    carried = draft.declare("carried", STATE, "real" if is_plain else draft.pick(["real", "real", "real", "real", "int", "bool"]), belt, place)
    speed = draft.declare("speed", ACTION, "bool", belt, default="false")
    onward = moved(draft, place, after, carried)
    target, share = where(draft, belt, speed)
    feed = draft.bounded(draft.signed(draft.some_real({"?b": belt})))
    draft.define(carried, ("?b", "?p"), more(draft, carried, onward, number, target, share, feed, speed, is_plain))
    arrived = draft.interm("arrived", {"?b": belt}, arriving(draft, place, carried))
    draft.earn(over("sum", "?b", belt, draft.at(arrived, "?b")))
    if draft.chance(0.5):
        all_places = over("sum", "?p", place, draft.at(carried, "?b", "?p", prime=draft.chance(0.8)))
        draft.earn(over(draft.pick(["max", "min"]), "?b", belt, real("(%s + 0.0)", all_places)))
    if draft.chance(0.2) and carried.range != "bool":
        draft.problem.invariants.append(over("forall", "?b", belt, over("forall", "?p", place, boolean("(%s >= -1000)", draft.at(carried, "?b", "?p")))))


def arriving(draft: Draft, place: str, carried):
    """What lies on the head of a belt: one place, now and then others too."""
    head = draft.declare("HEAD", CONSTANT, "bool", place, default="false")
    for member in draft.problem.type(place).members[: draft.pick([1, 1, 1, 2])]:
        head.values[(member,)] = "true"
    here, what = draft.at(head, "?p"), draft.at(carried, "?b", "?p")
    if carried.range == "bool":
        return over("exists", "?p", place, boolean("(%s ^ %s)", here, what))
    arrived = over("sum", "?p", place, real("(%s * %s)", here, what))
    return draft.revealed(arrived) if draft.chance(0.5) else arrived


def places(draft: Draft, is_plain: bool) -> str:
    name = draft.fresh("slot")
    sizes = [12, 13, 16, 17, 24, 25] if is_plain else [1, 3, 8, 9, 12, 13, 16, 17, 21, 24]
    draft.problem.types.append(Type(name, False, [f"{name}-{i}" for i in range(draft.pick(sizes))]))
    return name


def chain(draft: Draft, place: str, is_plain: bool):
    """Each place and the one that comes to it: the next one, now and then the one before, in a ring, or with a gap."""
    table = draft.declare("AFTER", CONSTANT, "bool", place, place, default="false")
    members = draft.problem.type(place).members
    by = 1 if is_plain else draft.pick([1] * 8 + [-1, 2])
    is_ring, has_gap = (not is_plain and draft.chance(0.1) for _ in range(2))
    gap = draft.rng.randrange(len(members)) if has_gap else None
    for index, member in enumerate(members):
        if (is_ring or 0 <= index + by < len(members)) and index != gap:
            table.values[(member, members[(index + by) % len(members)])] = "true"
    return table


def moved(draft: Draft, place: str, after, carried):
    here, there = draft.at(after, "?p", "?o"), draft.at(carried, "?b", "?o")
    if carried.range == "bool":
        return over("exists", "?o", place, boolean("(%s ^ %s)", here, there))
    form = draft.pick(["(%s * %s)", "(%s * %s)", "(if (%s) then %s else 0)"])
    return over("sum", "?o", place, of(carried.range, form, here, there))


def where(draft: Draft, belt: str, speed):
    """The place of what is put down, which moves on, and the share that falls beside it."""
    reach = draft.declare("reach", STATE, "real", belt)
    step = draft.pick(["1.25", "0.5", "-1.0", "3.0"])
    draft.define(reach, ("?b",), draft.bounded(real(f"(%s + {step} * %s)", draft.at(reach, "?b"), draft.at(speed, "?b"))))
    way = draft.at(reach, "?b") if draft.chance(0.5) else real("abs[%s]", draft.bounded(draft.some_real({"?b": belt})))
    target = draft.interm("target", {"?b": belt}, integer("floor[%s]", way))
    share = draft.interm("share", {"?b": belt}, real("(%s - %s)", way, draft.at(target, "?b")))
    return target, share


def more(draft: Draft, carried, onward, number, target, share, feed, speed, is_plain: bool):
    is_here = boolean("(%s == %s)", draft.at(number, "?p"), draft.at(target, "?b"))
    is_beside = boolean("(%s == (%s + 1))", draft.at(number, "?p"), draft.at(target, "?b"))
    if carried.range == "bool":
        return boolean(draft.pick(["(%s | (%s ^ %s))", "(if (%s) then true else (%s ^ %s))"]), onward, is_here, draft.at(speed, "?b"))
    if carried.range == "int":
        return integer("max[-50, min[50, (%s + %s * %s)]]", onward, is_here, draft.at(speed, "?b"))
    rest = draft.at(share, "?b")
    put = real("(%s * (1 - %s) * %s)", is_here, rest, feed)
    if draft.chance(0.7):
        put = real("(%s + %s * %s * %s)", put, is_beside, rest, feed)
    if is_plain:
        return real("(%s + %s)", put, onward)
    both = real(draft.pick(["(%s + %s)"] * 4 + ["(%s - %s)"]), *draft.pick([(put, onward)] * 3 + [(onward, put)]))
    return both if draft.chance(0.85) else draft.bounded(both)
