"""Consumers, items and providers: sums within sums, of which the inner ones depend on less."""

from domains.draft import ACTION, CONSTANT, STATE, Draft, boolean, integer, of, over, real


def add(draft: Draft) -> None:
    consumer, item, provider = draft.objects("consumer", main=True), draft.objects("item"), draft.objects("provider")
    wants, holds = draft.declare("WANTS", CONSTANT, "bool", consumer, item), draft.declare("HOLDS", CONSTANT, "bool", provider, item)
    offer = draft.declare("offer", ACTION, "bool", item, default="false")
    buys = draft.declare("buys", STATE, "bool", consumer, item)
    sold = draft.declare("sold", STATE, draft.pick(["int", "real"]), provider)
    taste = draft.declare("taste", STATE, "real", consumer, item)
    chance = real("(0.25 + 0.5 * %s)", draft.at(offer, "?i"))
    draft.define(buys, ("?c", "?i"), boolean("(%s ^ %s)", draft.at(wants, "?c", "?i"), draft.coin(chance)))
    count = sales(draft, consumer, item, holds, buys, sold)
    draft.define(sold, ("?p",), draft.small(count) if sold.range == "int" else draft.bounded(real("(%s * 1.0)", count)))
    learned = real("(if (%s) then %s else %s)", draft.at(offer, "?i"), draft.signed(draft.at(taste, "?c", "?i")), draft.at(taste, "?c", "?i"))
    draft.define(taste, ("?c", "?i"), draft.bounded(learned))
    for part in draft.rng.sample([fits, parts, extremes, seasons], draft.pick([1, 2, 3])):
        part(draft, consumer, item, provider, taste, offer, buys)
    draft.earn(over("sum", "?p", provider, draft.revealed(real("(%s - 1.0)", draft.at(sold, "?p")))))


def sales(draft: Draft, consumer: str, item: str, holds, buys, sold):
    """The sales of each provider, in the order of consumers or of items."""
    bought = draft.at(buys, "?c", "?i")
    both = integer("(%s ^ %s)", bought, draft.at(holds, "?p", "?i"))
    by_consumer = over("sum", "?c", consumer, over("sum", "?i", item, boolean("%s", both)))
    by_item = over("sum", "?i", item, integer("(%s * %s)", draft.at(holds, "?p", "?i"), over("sum", "?c", consumer, bought)))
    any_at_all = over("sum", "?c", consumer, over("exists", "?i", item, boolean("%s", both)))
    if sold.range == "int" or draft.flavour.wild or draft.chance(0.6):
        return draft.pick([by_consumer, by_item, any_at_all])
    weight = draft.declare("WEIGHT", CONSTANT, "real", item)
    inner = over("sum", "?c", consumer, real("(%s * 0.5)", bought))
    weighted = over("sum", "?i", item, real("(%s * (%s * %s))", draft.at(holds, "?p", "?i"), draft.signed(draft.at(weight, "?i")), inner))
    return weighted


def fits(draft: Draft, consumer: str, item: str, provider: str, taste, offer, buys) -> None:
    """Expensive terms, of which a bool lets few count."""
    distance = over("sum", "?c", consumer, real("(%s * %s)", draft.at(taste, "?c", "?i"), draft.at(taste, "?c", "?i")))
    term = real(draft.pick(["sqrt[%s]", "(-sqrt[%s])", "(0.0 - %s)"]), distance)
    form = draft.pick(["(%s * %s)", "(%s * (-%s))", "(if (%s) then %s else -0.0)"])
    chosen = draft.pick([draft.at(offer, "?i"), boolean("(%s ^ %s)", draft.at(offer, "?i"), draft.some_bool({"?i": item}))])
    draft.earn(draft.revealed(over("sum", "?i", item, real(form, chosen, term))))


def parts(draft: Draft, consumer: str, item: str, provider: str, taste, offer, buys) -> None:
    """Divides by numbers of the instance, of which some may be zero, but not with --fast-math."""
    divisor = draft.declare("PARTS", CONSTANT, "real", item, default=draft.pick(["1.0", "2.0", "-4.0"]))
    numbers = ["1.0", "-2.0", "8.0", "0.5"] + (["0.0", "-0.0"] if draft.reveals and draft.chance(0.3) else [])
    for objects in draft.problem.groundings(divisor):
        if draft.chance(0.4):
            divisor.values[objects] = draft.pick(numbers)
    part = draft.interm("part", {"?c": consumer, "?i": item}, real("(%s / %s)", draft.at(taste, "?c", "?i"), draft.at(divisor, "?i")))
    term = real("(%s * %s)", draft.at(buys, "?c", "?i"), draft.at(part, "?c", "?i"))
    draft.earn(over("sum", "?c", consumer, draft.revealed(over("sum", "?i", item, term))))


def extremes(draft: Draft, consumer: str, item: str, provider: str, taste, offer, buys) -> None:
    """The least and the greatest taste of the buyers."""
    term = real(draft.pick(["(%s * %s)", "(if (%s) then %s else -9.0)"]), draft.at(buys, "?c", "?i"), draft.signed(draft.at(taste, "?c", "?i")))
    outer, inner = draft.pick(["sum", "max", "min"]), draft.pick(["max", "min", "avg"])
    draft.earn(draft.revealed(over(outer, "?i", item, over(inner, "?c", consumer, term))))


def seasons(draft: Draft, consumer: str, item: str, provider: str, taste, offer, buys) -> None:
    """A demand by the step, by a constant of each consumer and by a draw."""
    season, size = draft.declare("season", STATE, "int", default="0"), draft.declare("SIZE", CONSTANT, "real", consumer)
    season.values.clear()
    now = draft.at(season)
    draft.define(season, (), draft.pick([integer("(%s + 1)", now), integer("(if (%s == 3) then 0 else %s + 1)", now, now)]))
    wave = real("(0.5 * %s)" if draft.problem.flavour == "plain" else draft.pick(["sin[%s / 2.0]", "(1.0 + cos[0.5 * %s])"]), now)
    usual = draft.pick([real("(%s * %s)", draft.at(size, "?c"), wave), draft.at(size, "?c")])
    more = draft.coin(draft.pick(["0.5", "0.25"]))
    demand = draft.declare("demand", STATE, draft.pick(["int", "real"]), consumer)
    forms = {"int": ["min[floor[%s + %s], 9]", "max[0, min[9, round[%s - 2 * %s]]]"], "real": ["min[9.0, 0.5 * abs[%s - %s]]", "max[-4.0, -(0.25 * %s * %s)]"]}
    draft.define(demand, ("?c",), of(demand.range, draft.pick(forms[demand.range]), usual, more))
    draft.earn(draft.revealed(over("sum", "?c", consumer, real("(1.0 * %s)", draft.at(demand, "?c", prime=draft.chance(0.5))))))
