"""Units that are linked by sparse weights."""

from domains.draft import ACTION, CONSTANT, STATE, Draft, boolean, over, real

FUNCTIONS = ("%s", "max[0.0, %s]", "tanh[%s]", "(1.0 / (1.0 + exp[-%s]))", "(%s > 0.0)", "sgn[%s]", "abs[%s]", "min[-0.0, %s]")
EXACT = ("%s", "max[0.0, %s]", "(%s > 0.0)", "sgn[%s]", "abs[%s]", "min[-0.0, %s]")


def add(draft: Draft) -> None:
    unit = draft.objects("unit", main=True)
    weight = draft.declare("W", CONSTANT, "real", unit, unit)
    keep_sparse(draft, weight)
    out = draft.declare("out", STATE, draft.pick(["real", "real", "bool"]), unit)
    push = draft.declare("push", ACTION, draft.pick(["bool", "real"]), unit, default=None)
    bias = draft.declare("BIAS", CONSTANT, "real", unit)
    link = draft.at(weight, *draft.pick([("?u", "?v"), ("?v", "?u")]))
    signal = draft.pick([draft.at(out, "?v"), real("(%s - %s)", draft.at(out, "?v"), draft.at(out, "?u")), draft.signed(draft.at(out, "?v"))])
    form = draft.pick(["(%s * %s)", "(%s * (%s * 0.5))", "(%s * (%s * 1.0))"])
    net = draft.interm("net", {"?u": unit}, over("sum", "?v", unit, real(form, link, signal)))
    drive = real("(%s + %s * %s)", draft.at(net, "?u"), draft.signed(draft.at(bias, "?u")), draft.at(push, "?u"))
    if out.range == "bool":
        draft.define(out, ("?u",), boolean(f"(%s {draft.comparison()} %s)", drive, draft.pick(["0.0", "0.25", "(-0.0)", "1.0"])))
    else:
        function = draft.pick(EXACT if draft.problem.flavour == "plain" else FUNCTIONS)
        draft.define(out, ("?u",), draft.bounded(real(function, drive)))
    for part in draft.rng.sample([shares, strongest, balance], draft.pick([1, 2, 3])):
        part(draft, unit, weight, net, out)


def keep_sparse(draft: Draft, weight) -> None:
    """A few entries, both signs of zero among them."""
    weight.default = draft.pick(["0.0", "0.0", "-0.0", weight.default])
    share = draft.pick([0.05, 0.2, 0.6, 1.0])
    for objects in draft.problem.groundings(weight):
        if draft.chance(share) and len(weight.values) < 600:
            weight.values[objects] = draft.pick(["1.0", "-1.0", "0.5", "-2.25", "0.0", "-0.0", "3.0"])


def shares(draft: Draft, unit: str, weight, net, out) -> None:
    """Divided by a sum that may be zero."""
    total = over("sum", "?v", unit, real("%s", draft.at(weight, "?u", "?v")))
    part = real("(%s / %s)", draft.at(out, "?u"), total if draft.reveals else real("(1.0 + abs[%s])", total))
    draft.earn(over("sum", "?u", unit, draft.revealed(draft.pick([part, total]))))


def strongest(draft: Draft, unit: str, weight, net, out) -> None:
    chosen = draft.declare("strongest", STATE, unit)
    draft.define(chosen, (), over(draft.pick(["argmax", "argmin"]), "?u", unit, draft.signed(draft.at(net, "?u"))))
    draft.earn(draft.revealed(draft.at(net, draft.at(chosen))))
    least = over(draft.pick(["min", "max"]), "?u", unit, draft.pick([draft.signed(draft.at(net, "?u")), draft.zero(draft.at(net, "?u"))]))
    draft.earn(draft.revealed(least))


def balance(draft: Draft, unit: str, weight, net, out) -> None:
    """The inflow less the outflow cancels, or nearly."""
    pair = real("(%s * %s - %s * %s)", draft.at(weight, "?u", "?v"), draft.at(out, "?v"), draft.at(weight, "?v", "?u"), draft.at(out, "?u"))
    draft.earn(draft.revealed(over("sum", "?u", unit, over("sum", "?v", unit, pair))))
    linked = boolean(f"(%s {draft.comparison()} 0.0)", draft.at(weight, "?u", "?v"))
    term = real("(%s * %s)", linked, draft.signed(draft.at(out, "?v")))
    draft.earn(over("max", "?u", unit, draft.revealed(over("sum", "?v", unit, term))))
