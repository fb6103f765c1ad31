"""Rounds: rows of ints that are compared, what only rare actions read, visits by weights of a row, and cases of which few are dear."""

from domains.draft import ACTION, CONSTANT, MANY, STATE, Draft, boolean, integer, of, over, real
from rddl_problem import Type


def add(draft: Draft) -> None:
    for part in draft.rng.sample([springs, wards, visits, stocks], draft.pick([1, 2, 2])):
        part(draft)


def numerous(draft: Draft, stem: str, sizes: list[int]) -> str:
    name = draft.fresh(stem)
    draft.problem.types.append(Type(name, False, [f"{name}-{i}" for i in range(draft.pick(sizes))]))
    return name


def relation(draft: Draft, first: str, second: str):
    """Few objects of the second type for each of the first, now and then none."""
    table = draft.declare("NEAR", CONSTANT, "bool", first, second, default="false")
    members = draft.problem.type(second).members
    for member in draft.problem.type(first).members:
        for other in draft.rng.sample(members, min(len(members), draft.pick([0, 1, 2, 3, 3]))):
            table.values[(member, other)] = "true"
    return table


# Comparisons of ints, in rows that a relation chooses.


def springs(draft: Draft) -> None:
    spring = numerous(draft, "spring", [3, 5, 8, 9, 16, 17, 33, 63, 64, 65])
    kind = draft.pick(["int", draft.enumeration("fish", draft.pick([2, 3, 5])).name])
    lives, near = draft.declare("lives", STATE, kind, spring), relation(draft, spring, spring)
    goes, safe = draft.declare("goes", ACTION, "bool", spring, default="false"), draft.declare("safe", STATE, "bool", spring)
    draft.define(lives, ("?s",), next_of(draft, kind, draft.at(lives, "?s"), draft.at(goes, "?s")))
    rows = compared_rows(draft, spring, near, lives, kind)
    draft.define(safe, ("?s",), rows if draft.chance(0.5) else boolean(draft.pick(["(%s | %s)", "(%s ^ ~%s)"]), rows, draft.at(goes, "?s")))
    draft.earn(over("sum", "?s", spring, draft.at(safe, "?s")))


def next_of(draft: Draft, kind: str, now, goes):
    if kind == "int":
        return integer("mod[%s + 1 + %s, 4]", now, goes)
    return of(kind, "(if (%s) then %s else %s)", goes, literal_of(draft, kind), now)


def literal_of(draft: Draft, kind: str) -> str:
    if kind == "int":
        return draft.pick(["0", "1", "2", "(-1)"])
    return draft.problem.type(kind).literal(draft.pick(draft.problem.type(kind).members))


def compared_rows(draft: Draft, spring: str, near, lives, kind: str):
    """One quantifier, or two beside each other that compare the same ints."""

    def row():
        operator = draft.pick(["exists", "forall"])
        comparison = draft.pick(["==", "~="]) if kind != "int" else draft.comparison()
        there = boolean(f"(%s {comparison} {literal_of(draft, kind)})", draft.at(lives, "?t"))
        there = boolean("(~%s)", there) if draft.chance(0.3) else there
        form = "(%s ^ %s)" if operator == "exists" else "(%s => %s)"
        return over(operator, "?t", spring, boolean(form, draft.at(near, "?s", "?t"), there))

    return row() if draft.chance(0.6) else boolean(draft.pick(["(%s ^ %s)", "(%s | %s)", "(%s ~= %s)"]), row(), row())


# Tables that a CPF reads only where an action is true, which chooses few objects or none.


def wards(draft: Draft) -> None:
    ward = numerous(draft, "ward", [9, 16, 17, 24, *MANY])
    nurse = draft.objects("nurse")
    seen, full = draft.declare("seen", STATE, draft.pick(["bool", "int"]), ward), draft.declare("full", STATE, "bool", ward)
    use = draft.declare("use", ACTION, "bool", nurse, ward, default="false")
    draft.declare("help", ACTION, "bool", default="false")
    near = draft.interm("near", {"?w": ward}, looked_at(draft, ward, full))
    draft.define(full, ("?w",), draft.some_bool({"?w": ward}, (STATE, ACTION)))
    there = draft.at(near, "?w")
    used = boolean("(%s ^ %s)", draft.at(use, "?n", "?w"), draft.pick([there, boolean("(%s | ~%s)", there, draft.at(full, "?w"))]))
    used, here = over("exists", "?n", nurse, used), draft.at(seen, "?w")
    if seen.range == "bool":
        draft.define(seen, ("?w",), boolean(draft.pick(["(%s | %s)", "(%s ~= %s)"]), used, here))
    else:
        draft.define(seen, ("?w",), integer("(if (%s) then %s else %s)", used, draft.small(integer("(%s + 1)", here)), here))
    draft.problem.max_nondef_actions = draft.pick(["1", "1", "2"])
    if draft.chance(0.15):
        draft.earn(over("sum", "?w", ward, there))
    draft.earn(over("sum", "?w", ward, here))


def looked_at(draft: Draft, ward: str, full):
    here = boolean(draft.pick(["%s", "(~%s)"]), draft.at(full, "?w"))
    return boolean(draft.pick(["(%s | %s)", "(%s ^ ~%s)", "(%s ~= %s)"]), here, draft.some_bool({"?w": ward}, (STATE, CONSTANT)))


# Draws of which each has a row of weights.


def visits(draft: Draft) -> None:
    guest, area = numerous(draft, "guest", [1, 2, 3, 4, 5, 7, 7, 8]), draft.fresh("area")
    draft.problem.types.append(Type(area, draft.chance(0.7), [f"{area}-{letter}" for letter in "abcdefgh"[: draft.pick([7, *[8] * 8])]]))
    day = numerous(draft, "day", [1, 2, 2, 3, 4])
    open_, known = draft.declare("open", STATE, "bool", area), draft.declare("known", STATE, "bool", area, day)
    gain, less = (draft.declare(stem, CONSTANT, "real", guest, area) for stem in ("GAIN", "LESS"))
    count = draft.chance(0.5)

    def weight(at):
        first, second = (real("(abs[%s] + 0.25)", draft.at(each, "?g", at)) for each in (gain, less))
        if not count:
            return real("(if (%s) then %s else %s)", draft.at(open_, at), first, second)
        number = over("sum", "?n", day, draft.at(known, at, "?n"))
        return real(f"((%s == {reached}) * %s + (%s > {reached}) * %s + 0.125)", number, first, number, second)

    reached = draft.pick([0, 1])
    if draft.flavour.draws:
        chosen = by_shares(draft, draft.problem.type(area), weight)
    else:
        chosen = over("argmax", "?a", area, weight("?a"))
    to = draft.interm("to", {"?g": guest}, chosen)
    come = over("exists", "?g", guest, boolean("(%s == %s)", draft.at(to, "?g"), "?a"))
    draft.define(open_, ("?a",), boolean(draft.pick(["(%s | %s)", "(%s ~= %s)", "(%s ^ ~%s)"]), come, draft.at(open_, "?a")))
    stays = draft.at(known, "?a", "?n")
    draft.define(known, ("?a", "?n"), boolean(draft.pick(["(%s ~= %s)", "(%s | %s)", "(~%s ^ %s)"]), stays, draft.at(open_, "?a")))
    draft.earn(over("sum", "?a", area, draft.at(open_, "?a")))


def by_shares(draft: Draft, area: Type, weight):
    """Each weight is divided by the sum of all: over the objects, or object by object."""

    def share(at) -> real:
        return real("(%s / %s)", weight(at), over("sum", "?b", area.name, weight("?b")))

    if not area.enumerated or draft.chance(0.4):
        return of(area.name, f"(Discrete_{{?a : {area.name}}} [%s])", share("?a"))
    literals = [area.literal(member) for member in area.members]
    return of(area.name, f"Discrete({area.name}, " + ", ".join(f"{literal} : %s" for literal in literals) + ")", *map(share, literals))


# Cases that cost next to nothing before one that draws or computes.


def stocks(draft: Draft) -> None:
    tank = numerous(draft, "tank", [16, 17, 24, *MANY])
    stock, shut = draft.declare("stock", STATE, draft.pick(["int", "real", "bool"]), tank), draft.declare("shut", STATE, "bool", tank)
    fill, drain = (draft.declare(stem, ACTION, "bool", tank, default="false") for stem in ("fill", "drain"))
    kind = stock.range
    values = {"int": ["0", "2", "(-3)"], "real": ["0.5", "(-0.0)", "0.0", "4.0"], "bool": ["true", "false"]}[kind]
    cheap = draft.rng.sample([draft.at(shut, "?t"), draft.at(fill, "?t"), draft.at(drain, "?t"), boolean("(~%s)", draft.at(fill, "?t"))], draft.pick([1, 2, 3, 3]))
    form, parts = "%s", [dear_case(draft, kind, draft.at(stock, "?t"))]
    for condition in cheap:
        value = draft.at(stock, "?t") if draft.chance(0.3) else of(kind, draft.pick(values))
        form, parts = f"(if (%s) then %s else {form})", [condition, value, *parts]
    draft.define(stock, ("?t",), of(kind, form, *parts))
    draft.define(shut, ("?t",), boolean("(%s ~= %s)", draft.at(shut, "?t"), draft.at(drain, "?t")))
    draft.earn(over("sum", "?t", tank, draft.at(stock, "?t")))


def dear_case(draft: Draft, kind: str, here):
    drawn = boolean(draft.pick(["Bernoulli(0.5)", "Bernoulli(0.125)"])) if draft.flavour.draws else boolean("(sin[%s] > 0.25)", real("(%s * 1.0)", here))
    if kind == "bool":
        return boolean("(if (%s) then ~%s else %s)", drawn, here, here)
    if kind == "int":
        return integer("(if (%s) then %s else %s)", drawn, draft.small(integer("(%s + 1)", here)), here)
    return real("(if (%s) then %s else %s)", drawn, draft.bounded(draft.signed(real("sin[%s]", here))), here)
