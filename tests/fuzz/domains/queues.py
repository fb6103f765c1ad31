"""Queues and counters at their limits."""

from domains.draft import ACTION, CONSTANT, STATE, Draft, boolean, integer, over, real

GREAT = ("9007199254740991", "9007199254740992", "9007199254740993", "-9007199254740993", "9223372036854775807", "4611686018427387904")


def add(draft: Draft) -> None:
    queue = draft.objects("queue", main=True)
    length = draft.declare("length", STATE, "int", queue)
    room = draft.declare("ROOM", CONSTANT, "int", queue)
    serve = draft.declare("serve", ACTION, "bool", queue, default="false")
    passed = routing(draft, queue, length, serve)
    came = arrivals(draft, queue)
    rest = integer("(%s - (%s ^ (%s > 0)) + %s + %s)", draft.at(length, "?q"), draft.at(serve, "?q"), draft.at(length, "?q"), passed, came)
    form = draft.pick(["max[0, min[%s, %s]]", "min[%s, max[0, %s]]", "max[0, min[mod[%s, 6], %s]]"])
    draft.define(length, ("?q",), integer(form, draft.at(room, "?q"), rest))
    for part in draft.rng.sample([counter, losses, priorities], draft.pick([1, 2, 3])):
        part(draft, queue, length, room)
    full = boolean("(%s >= %s)", draft.at(length, "?q"), draft.at(room, "?q"))
    draft.earn(integer("(-%s)", over("sum", "?q", queue, full)))
    if draft.chance(0.4):
        draft.problem.preconditions.append(boolean("(%s <= 2)", over("sum", "?q", queue, draft.at(serve, "?q"))))
    if draft.chance(0.3):
        draft.problem.invariants.append(over("forall", "?q", queue, boolean("(%s <= 500)", draft.at(length, "?q"))))


def routing(draft: Draft, queue: str, length, serve):
    route = draft.declare("ROUTE", CONSTANT, draft.pick(["bool", "bool", "int"]), queue, queue)
    leaves = boolean("(%s ^ (%s > 0))", draft.at(serve, "?f"), draft.at(length, "?f"))
    return over("sum", "?f", queue, integer("(%s * %s)", draft.at(route, "?f", "?q"), leaves))


def arrivals(draft: Draft, queue: str):
    rate = draft.declare("RATE", CONSTANT, "real", queue)
    if not draft.flavour.draws:
        return integer("floor[abs[%s]]", draft.at(rate, "?q"))
    form = draft.pick(["Poisson(min[abs[%s], 3.0])", "Binomial(3, min[1.0, abs[%s]])", "(Uniform(0.0, 1.0) < %s)"])
    return integer(form, draft.at(rate, "?q"))


def counter(draft: Draft, queue: str, length, room) -> None:
    """Numbers near 2^53, beyond which reals no longer distinguish ints, or 2^63, where ints wrap
    around."""
    count = draft.declare("count", STATE, "int")
    total = over("sum", "?q", queue, integer("%s", draft.at(length, "?q")))
    if draft.flavour.wild:
        count.default = draft.pick(GREAT)
        more = integer(draft.pick(["(%s + %s)", "(%s * 3 + %s)", "(%s - 2 * %s)", "(%s + (%s > 0))"]), draft.at(count), total)
    else:
        more = draft.small(integer("(%s + %s)", draft.at(count), total))
    draft.define(count, (), more)
    limit = draft.pick(GREAT if draft.flavour.wild else ("0", "3", "9", "-1"))
    draft.earn(real(f"(if (%s {draft.comparison()} {limit}) then 1.0 else 0.0)", draft.at(count, prime=True)))
    rounded = real("((%s * 1.0) - %s)", draft.at(count), draft.at(count, prime=draft.chance(0.5)))
    draft.earn(draft.revealed(rounded))


def losses(draft: Draft, queue: str, length, room) -> None:
    """The weighted length of what is beyond the room, or what is left of it."""
    weight = draft.declare("WEIGHT", CONSTANT, "real", queue)
    beyond = integer("(%s - %s)", draft.at(length, "?q"), draft.at(room, "?q"))
    form = draft.pick(["(%s * max[0, %s])", "(%s * min[0, %s])", "(%s * (%s > 0))", "(%s * %s)"])
    loss = over(draft.pick(["sum", "sum", "max", "min", "avg"]), "?q", queue, real(form, draft.signed(draft.at(weight, "?q")), beyond))
    draft.earn(draft.revealed(draft.at(draft.interm("loss", {}, loss)) if draft.chance(0.5) else loss))


def priorities(draft: Draft, queue: str, length, room) -> None:
    chosen = draft.declare("first", STATE, queue)
    draft.define(chosen, (), over(draft.pick(["argmax", "argmin"]), "?q", queue, draft.pick([
        draft.at(length, "?q"), integer("(%s - %s)", draft.at(room, "?q"), draft.at(length, "?q")),
        real("(%s * %s)", draft.some_real({"?q": queue}), draft.at(length, "?q")),
    ])))  # fmt: skip
    draft.earn(real("(%s + 0.5)", draft.at(length, draft.at(chosen))))
    same = boolean("(?q == %s)", draft.at(chosen))
    draft.earn(draft.revealed(over("sum", "?q", queue, real("(%s * %s)", same, draft.signed(draft.some_real({"?q": queue}))))))
