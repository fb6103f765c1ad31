"""Resources that actions make and use: sums of terms of both signs, which may cancel."""

from domains.draft import ACTION, CONSTANT, STATE, Draft, boolean, over, real


def add(draft: Draft) -> None:
    good, plant = draft.objects("good", main=True), draft.objects("plant")
    stock = draft.declare("stock", STATE, "real", good)
    run = draft.declare("run", ACTION, draft.pick(["bool", "bool", "real"]), plant, default=None)
    makes, uses = (draft.declare(name, CONSTANT, draft.pick(["real", "bool"]), plant, good) for name in ("MAKES", "USES"))
    made = over("sum", "?p", plant, real("(%s * %s)", draft.at(makes, "?p", "?g"), draft.at(run, "?p")))
    used = over("sum", "?p", plant, real("(%s * %s)", draft.at(uses, "?p", "?g"), draft.at(run, "?p")))
    net = over("sum", "?p", plant, real("((%s - %s) * %s)", draft.at(makes, "?p", "?g"), draft.at(uses, "?p", "?g"), draft.at(run, "?p")))
    change = draft.interm("change", {"?g": good}, draft.pick([real("(%s - %s)", made, used), net]))
    noise = real("Normal(0.0, 1.0)") if draft.flavour.draws and draft.chance(0.3) else real("0.0")
    draft.define(stock, ("?g",), draft.bounded(real("(%s + %s + %s)", draft.at(stock, "?g"), draft.at(change, "?g"), noise)))
    draft.earn(over(draft.pick(["sum", "min", "max"]), "?g", good, draft.revealed(draft.at(change, "?g"))))
    for part in draft.rng.sample([prices, needs, round_trip], draft.pick([1, 2, 3])):
        part(draft, good, plant, stock, change, run, uses)


def prices(draft: Draft, good: str, plant: str, stock, change, run, uses) -> None:
    """Shares of a total that may be zero."""
    price = draft.declare("PRICE", CONSTANT, "real", good)
    value = real("(%s * %s)", draft.signed(draft.at(price, "?g")), draft.at(stock, "?g"))
    total = over("sum", "?g", good, value)
    average = real("(%s / %s)", total, draft.pick([over("sum", "?g", good, draft.at(stock, "?g")), over("sum", "?p", plant, draft.at(run, "?p"))]))
    draft.earn(draft.revealed(average if draft.reveals else total))


def needs(draft: Draft, good: str, plant: str, stock, change, run, uses) -> None:
    need = draft.declare("NEED", CONSTANT, "bool", good, good)
    short = over("exists", "?h", good, boolean("(%s ^ (%s <= 0.0))", draft.at(need, "?g", "?h"), draft.at(stock, "?h")))
    lacks = draft.interm("lacks", {"?g": good}, short)
    draft.earn(over("sum", "?g", good, real("(%s * %s)", draft.at(lacks, "?g"), draft.signed(draft.at(stock, "?g")))))
    if draft.chance(0.5) and run.range == "bool":
        enough = over("forall", "?g", good, boolean("((%s ^ %s ~= 0.0) => (%s > 0.0))", draft.at(run, "?p"), real("(%s * 1.0)", draft.at(uses, "?p", "?g")), draft.at(stock, "?g")))
        draft.problem.preconditions.append(over("forall", "?p", plant, enough))


def round_trip(draft: Draft, good: str, plant: str, stock, change, run, uses) -> None:
    """Terms whose sum is zero: all are -0.0, or they cancel."""
    amount = draft.at(stock, "?g")
    term = draft.pick([
        draft.zero(amount), real("(%s - %s)", amount, amount), real("(%s * %s)", draft.zero(amount), draft.some_bool({"?g": good})),
        real("(-0.0 * abs[%s])", amount), real("(%s * false)", amount), real("((%s > 0.0) * (-0.0))", amount),
        real("(%s + (-%s))", draft.at(change, "?g"), draft.at(change, "?g")),
    ])  # fmt: skip
    draft.earn(draft.revealed(over(draft.pick(["sum", "sum", "prod", "max", "min", "avg"]), "?g", good, term)))
