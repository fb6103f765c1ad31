"""Signs of zeros, and what compares with zeros and infinities."""

from domains.draft import CONSTANT, STATE, Draft, boolean, over, real

IDENTITIES = (
    "(%s * 1.0)", "(1.0 * %s)", "(%s + 0.0)", "(0.0 + %s)", "(%s - 0.0)", "(0.0 - %s)", "(-%s)", "(%s / 1.0)", "(-(-%s))",
    "(%s * true)", "(%s + false)", "max[%s, 0.0]", "max[0.0, %s]", "min[%s, -0.0]", "min[0.0, %s]", "max[-0.0, %s]", "abs[%s]",
    "(%s * -1.0)", "(%s - (-0.0))", "(-0.0 + %s)", "sgn[%s]", "round[%s]", "floor[%s]", "ceil[%s]",
)  # fmt: skip


def add(draft: Draft) -> None:
    item = draft.objects("item", main=True)
    debt, mask = draft.declare("debt", STATE, "real", item), draft.declare("open", STATE, "bool", item)
    link = draft.declare("LINK", CONSTANT, draft.pick(["bool", "real"]), item, item)
    draft.define(mask, ("?i",), draft.pick([draft.at(mask, "?i"), draft.some_bool({"?i": item}), draft.coin("0.5")]))
    kept = draft.pick([draft.at(debt, "?i"), identity(draft, draft.at(debt, "?i")), draft.zero(draft.at(debt, "?i"))])
    form = draft.pick(["(if (%s) then %s else %s)", "(%s * %s + 0.5 * %s)", "(%s * %s - %s)"])
    draft.define(debt, ("?i",), draft.bounded(real(form, draft.at(mask, "?i"), kept, draft.signed(draft.at(debt, "?i")))))
    for part in draft.rng.sample([rows, everything, branches, infinities], draft.pick([2, 3, 4])):
        part(draft, item, debt, mask, link)


def identity(draft: Draft, number):
    for _ in range(draft.pick([1, 1, 2, 3])):
        number = real(draft.pick(IDENTITIES), number)
    return number


def term(draft: Draft, debt, mask, variable: str):
    number = identity(draft, draft.at(debt, variable)) if draft.chance(0.5) else draft.signed(draft.at(debt, variable))
    return real(draft.pick(["(%s * %s)", "(%s * (%s * 2.0))", "(if (%s) then %s else 0.0)", "(if (%s) then %s else -0.0)"]), draft.at(mask, variable), number)


def rows(draft: Draft, item: str, debt, mask, link) -> None:
    """Sums of a row of a table: of one term, of no term, of many."""
    inside = real("(%s * %s)", draft.at(link, *draft.pick([("?i", "?j"), ("?j", "?i")])), draft.pick([draft.signed(draft.at(debt, "?j")), term(draft, debt, mask, "?j")]))
    row = draft.interm("row-sum", {"?i": item}, over("sum", "?j", item, inside))
    draft.earn(over(draft.pick(["sum", "max", "min"]), "?i", item, draft.revealed(draft.at(row, "?i"))))
    draft.earn(draft.revealed(over("sum", "?i", item, draft.at(row, "?i"))))


def everything(draft: Draft, item: str, debt, mask, link) -> None:
    total = over(draft.pick(["sum", "sum", "prod", "max", "min"]), "?i", item, term(draft, debt, mask, "?i"))
    draft.earn(draft.revealed(total))
    draft.earn(draft.revealed(identity(draft, total)))


def branches(draft: Draft, item: str, debt, mask, link) -> None:
    """Branches that differ by the sign of a zero alone."""
    number = draft.at(debt, "?i")
    test = draft.pick([draft.at(mask, "?i"), boolean(f"(%s {draft.comparison()} 0.0)", number), boolean("(%s == -0.0)", number)])
    first, second = (draft.pick([real("0.0"), real("(-0.0)"), number, identity(draft, number), draft.zero(number)]) for _ in range(2))
    draft.earn(over("sum", "?i", item, draft.revealed(real("(if (%s) then %s else %s)", test, first, second))))


def infinities(draft: Draft, item: str, debt, mask, link) -> None:
    """Compared with infinities, where a problem may have them."""
    number = term(draft, debt, mask, "?i")
    if not draft.reveals:
        return draft.earn(over("max", "?i", item, draft.revealed(number)))
    inverse = real(draft.pick(["(1.0 / %s)", "(-1.0 / %s)", "ln[abs[%s]]", "(%s / 0.0)"]), number)
    limit = draft.pick(["(1.0 / 0.0)", "(-1.0 / 0.0)", "0.0", "(1.0 / -0.0)"])
    count = over("sum", "?i", item, boolean(f"(%s {draft.comparison()} {limit})", inverse))
    draft.earn(draft.pick([count, real(f"max[-9.0, min[9.0, %s]]", over("sum", "?i", item, inverse))]))
