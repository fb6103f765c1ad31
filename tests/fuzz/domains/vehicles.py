"""Vehicles in the plane: angles, distances that are only compared, obstacles one of which may be hit. Fleets, all of whose vehicles turn."""

from domains.draft import ACTION, CONSTANT, STATE, Draft, boolean, over, real


def add(draft: Draft) -> None:
    for part in draft.pick([[one], [one], [fleet], [one, fleet]]):
        part(draft)


def one(draft: Draft) -> None:
    obstacle = draft.objects("obstacle", main=True)
    x, y, heading, speed = (draft.declare(name, STATE, "real") for name in ("x", "y", "heading", "speed"))
    turn, gas = draft.declare("turn", ACTION, "real", default="0.0"), draft.declare("gas", ACTION, "real", default="0.0")
    at_x, at_y, radius = (draft.declare(name, CONSTANT, "real", obstacle) for name in ("AT-X", "AT-Y", "RADIUS"))
    radius.default = draft.pick(["1.0", "0.5", "2.0"])
    if draft.chance(0.7):
        radius.values = {objects: value.replace("-", "") for objects, value in radius.values.items()}
    direction = [draft.at(heading), real("(%s + %s)", draft.at(heading), draft.at(turn)), real("(2.0 * %s)", draft.at(heading))]
    move(draft, x, real("(%s * %s)", draft.at(speed), turned(draft, "cos", direction)))
    move(draft, y, real("(%s * %s)", draft.at(speed), turned(draft, "sin", direction)))
    move(draft, heading, real("(%s * %s)", draft.at(turn), turned(draft, "cos", direction)))
    draft.define(speed, (), real("max[-2.0, min[2.0, %s + 0.25 * %s]]", draft.at(speed), draft.at(gas)))
    limit = draft.pick([draft.at(radius, "?o"), real("1.5"), real("0.1"), real("(%s + 0.25)", draft.at(radius, "?o"))])
    test = boolean(f"(%s {draft.comparison()} %s)", distance(draft, x, y, at_x, at_y), limit)
    quantifier = draft.pick(["exists", "exists", "forall"])
    if draft.chance(0.4):
        draft.problem.terminations.append(over(quantifier, "?o", obstacle, test))
    if draft.chance(0.3):
        test = boolean("(%s ^ %s)", test, draft.some_bool({"?o": obstacle}))
    violated = draft.interm("hit", {}, over(quantifier, "?o", obstacle, test))
    draft.earn(draft.pick([draft.at(violated), real("(if (%s) then -5.0 else %s)", draft.at(violated), draft.at(x))]))
    if draft.chance(0.4):
        draft.earn(over(draft.pick(["sum", "min", "max"]), "?o", obstacle, boolean("%s", test) if draft.chance(0.5) else distance(draft, x, y, at_x, at_y)))


def fleet(draft: Draft) -> None:
    """The sine and the cosine of a vehicle's heading stand in different CPFs."""
    vehicle = draft.objects("vehicle", main=True)
    x, y, heading = (draft.declare(name, STATE, "real", vehicle) for name in ("fleet-x", "fleet-y", "fleet-heading"))
    turn = draft.declare("fleet-turn", ACTION, "real", *draft.pick([(), (vehicle,)]), default="0.0")
    own = {"?v": vehicle}
    turned_by = draft.at(turn, *["?v"] * len(turn.parameters))
    directions = [draft.at(heading, "?v"), real("(%s + %s)", draft.at(heading, "?v"), turned_by)]
    directions = draft.pick([directions, directions[:1], directions[1:]])
    for fluent, function in ((x, "cos"), (y, "sin"), (heading, draft.pick(["cos", "sin"]))):
        step = turned(draft, function, directions)
        if draft.chance(0.3):
            step = real("(if (%s) then %s else %s)", draft.some_bool(own), step, draft.some_real(own))
        if draft.chance(0.3):
            step = real("(%s * %s)", draft.some_real(own), step)
        draft.define(fluent, ("?v",), real("max[-8.0, min[8.0, %s + 0.5 * %s]]", draft.at(fluent, "?v"), step))
    draft.earn(draft.revealed(over(draft.pick(["sum", "max", "min"]), "?v", vehicle, draft.at(draft.pick([x, y, heading]), "?v", prime=draft.chance(0.5)))))
    if draft.chance(0.5):
        draft.earn(over("sum", "?v", vehicle, turned(draft, draft.pick(["cos", "sin"]), directions)))


def move(draft: Draft, fluent, change) -> None:
    draft.define(fluent, (), real("max[-8.0, min[8.0, %s + 0.5 * %s]]", draft.at(fluent), change))


def turned(draft: Draft, function: str, directions):
    """A sine or cosine, perhaps times one of another angle, where functions need not be exact."""
    if draft.problem.flavour == "plain":
        return draft.pick(directions)
    other = draft.pick(["sin[%s]", "cos[%s]"])
    return draft.pick([real(f"{function}[%s]", draft.pick(directions)), real(f"({function}[%s] * {other})", *draft.rng.choices(directions, k=2))])


def distance(draft: Draft, x, y, at_x, at_y):
    dx, dy = real("(%s - %s)", draft.at(x), draft.at(at_x, "?o")), real("(%s - %s)", draft.at(y), draft.at(at_y, "?o"))
    form = draft.pick(["sqrt[pow[%s, 2] + pow[%s, 2]]", "(pow[%s, 2] + pow[%s, 2])", "(abs[%s] + abs[%s])", "max[abs[%s], abs[%s]]", "PRODUCTS"])
    return real("sqrt[%s * %s + %s * %s]", dx, dx, dy, dy) if form == "PRODUCTS" else real(form, dx, dy)
