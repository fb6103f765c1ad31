"""Continuous control: positions and speeds within limits, lines by pieces, goals."""

from domains.draft import ACTION, CONSTANT, STATE, Draft, boolean, over, real


def add(draft: Draft) -> None:
    body = draft.objects("body", main=True)
    place, speed = draft.declare("pos", STATE, "real", body), draft.declare("vel", STATE, "real", body)
    force = draft.declare("force", ACTION, "real", body, default="0.0")
    most = draft.declare("MOST", CONSTANT, "real", body, default=draft.pick(["1.0", "2.5", "10.0"]))
    step = draft.pick(["0.1", "0.25", "1.0"]) if draft.problem.flavour != "plain" else draft.pick(["0.25", "1.0"])
    push = clamp(draft, draft.at(force, "?b"), draft.at(most, "?b"))
    drag = draft.pick([draft.signed(draft.at(speed, "?b")), draft.zero(draft.at(speed, "?b")), slope(draft, draft.at(place, "?b"))])
    draft.define(speed, ("?b",), clamp(draft, real(f"(%s + {step} * (%s - 0.5 * %s))", draft.at(speed, "?b"), push, drag), draft.at(most, "?b")))
    moved = real(f"(%s + {step} * %s)", draft.at(place, "?b"), draft.at(speed, "?b", prime=draft.chance(0.6)))
    low, high = draft.pick([("-10.0", "10.0"), ("0.0", "10.0"), ("-1.2", "0.6")])
    hit = boolean(f"((%s <= {low}) | (%s >= {high}))", moved, moved)
    stopped = draft.pick([real(f"max[{low}, min[{high}, %s]]", moved), real(f"(if (%s) then %s else max[{low}, min[{high}, %s]])", hit, draft.zero(draft.at(place, "?b")), moved)])
    draft.define(place, ("?b",), stopped)
    limits(draft, body, place, force, most, low, high)
    for part in draft.rng.sample([goal, pieces, energy], draft.pick([1, 2, 3])):
        part(draft, body, place, speed, most)


def clamp(draft: Draft, value, most):
    form = draft.pick(["max[-%s, min[%s, %s]]", "min[%s, max[-%s, %s]]", "BRANCH"])
    if form == "BRANCH":
        return real("(if (%s > %s) then %s else (if (%s < -%s) then -%s else %s))", value, most, most, value, most, most, value)
    return real(form, most, most, value)


def slope(draft: Draft, place):
    if draft.problem.flavour == "plain":
        return real("(%s * %s)", place, place)
    return real(draft.pick(["(0.0025 * cos[3.0 * %s])", "sin[%s]", "exp[-abs[%s]]", "sqrt[abs[%s]]", "(%s * %s)"]).replace("(%s * %s)", "(%s * 0.3)"), place)


def limits(draft: Draft, body: str, place, force, most, low: str, high: str) -> None:
    bound = boolean("((%s >= -%s) ^ (%s <= %s))", draft.at(force, "?b"), draft.at(most, "?b"), draft.at(force, "?b"), draft.at(most, "?b"))
    if draft.chance(0.6):
        draft.problem.preconditions.append(over("forall", "?b", body, bound))
    if draft.chance(0.4):
        inside = boolean(f"((%s >= {low}) ^ (%s <= {high}))", draft.at(place, "?b"), draft.at(place, "?b"))
        draft.problem.invariants.append(over("forall", "?b", body, inside))


def goal(draft: Draft, body: str, place, speed, most) -> None:
    target = draft.declare("GOAL", CONSTANT, "real", body)
    near = boolean("(abs[%s - %s] <= 0.5)", draft.at(place, "?b"), draft.at(target, "?b"))
    if draft.chance(0.5):
        draft.problem.terminations.append(over("forall", "?b", body, near))
    distance = over("sum", "?b", body, real("(%s * (%s - %s))", near, draft.at(place, "?b"), draft.at(target, "?b")))
    draft.earn(draft.revealed(draft.pick([distance, real("(-%s)", distance)])))


def pieces(draft: Draft, body: str, place, speed, most) -> None:
    """A table of intervals side by side, one of which holds the position."""
    piece = draft.objects("piece")
    low, value = draft.declare("LOW", CONSTANT, "real", piece, default="-10.0"), draft.declare("PULL", CONSTANT, "real", piece)
    width = draft.pick([0.25, 0.5, 1.0])
    for index, member in enumerate(draft.problem.type(piece).members):
        low.values[(member,)] = str(index * width - 2.0)
    here = draft.at(place, "?b")
    inside = boolean(f"((%s <= %s) ^ (%s < %s + {width}))", draft.at(low, "?p"), here, here, draft.at(low, "?p"))
    pull = over("sum", "?p", piece, real("(%s * %s)", inside, draft.signed(draft.at(value, "?p"))))
    field = draft.interm("pull", {"?b": body}, pull)
    draft.earn(over(draft.pick(["sum", "max", "min"]), "?b", body, draft.revealed(draft.at(field, "?b"))))
    if draft.chance(0.4):
        draft.earn(over("sum", "?b", body, over("exists", "?p", piece, boolean("(%s ^ %s)", inside, draft.some_bool({"?p": piece})))))


def energy(draft: Draft, body: str, place, speed, most) -> None:
    term = real(draft.pick(["(%s * %s)", "(%s * %s * 0.5)", "(0.0 * %s * %s)"]), draft.at(speed, "?b"), draft.signed(draft.at(speed, "?b")))
    draft.earn(draft.revealed(over(draft.pick(["sum", "prod", "max"]), "?b", body, term)))
