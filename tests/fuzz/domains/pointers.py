"""Objects that name objects: chains, tours, carriers, the best and the drawn one."""

from domains.draft import ACTION, CONSTANT, STATE, Draft, boolean, of, over, real


def add(draft: Draft) -> None:
    node = draft.objects("node", main=True)
    after = draft.declare("after", draft.pick([CONSTANT, STATE]), node, node)
    head = draft.declare("head", STATE, node)
    worth = draft.declare("worth", STATE, "real", node)
    jump = draft.declare("jump", ACTION, "bool", default="false")
    if after.role == STATE:
        draft.define(after, ("?n",), changed_link(draft, node, after, head))
    draft.define(head, (), of(node, "(if (%s) then %s else %s)", draft.at(jump), chain(draft, node, after, head), choice(draft, node, head, worth)))
    gain = draft.signed(draft.some_real({}))
    grown = real("(%s + (?n == %s) * %s)", draft.at(worth, "?n"), draft.at(head), gain)
    shared = real("(%s - %s)", draft.at(worth, "?n"), draft.at(worth, draft.at(after, "?n")))
    draft.define(worth, ("?n",), draft.bounded(draft.pick([grown, shared])))
    for part in draft.rng.sample([carriers, sums_at_head, loops, walkers, watched, near_head], draft.pick([1, 2, 3])):
        part(draft, node, after, head, worth)
    draft.earn(draft.revealed(draft.at(worth, chain(draft, node, after, head))))


def chain(draft: Draft, node: str, after, head):
    place = draft.at(head)
    for _ in range(draft.pick([1, 2, 2, 3])):
        place = draft.at(after, place)
    return place


def changed_link(draft: Draft, node: str, after, head):
    """Paths become shorter, or turn to the head."""
    shorter = draft.at(after, draft.at(after, "?n"))
    condition = draft.pick([boolean("(?n == %s)", draft.at(head)), draft.some_bool({"?n": node}), boolean("(%s == ?n)", shorter)])
    return of(node, "(if (%s) then %s else %s)", condition, draft.pick([shorter, draft.at(head)]), draft.at(after, "?n"))


def choice(draft: Draft, node: str, head, worth):
    value = draft.pick([
        draft.at(worth, "?m"), real("(%s * (?m ~= %s))", draft.at(worth, "?m"), draft.at(head)),
        real("(%s * %s)", draft.signed(draft.at(worth, "?m")), draft.some_bool({"?m": node})),
        real("(1.0 / %s)", draft.at(worth, "?m")) if draft.reveals else draft.at(worth, "?m"),
    ])  # fmt: skip
    if draft.flavour.draws and draft.chance(0.4):
        return of(node, f"(UnnormDiscrete_{{?m : {node}}} [(min[9.0, abs[%s]] + 0.25)])", value)
    return over(draft.pick(["argmax", "argmin"]), "?m", node, value)


def carriers(draft: Draft, node: str, after, head, worth) -> None:
    """Things on carriers on nodes."""
    thing, carrier = draft.objects("thing"), draft.objects("carrier")
    on, stands = draft.declare("on", STATE, carrier, thing), draft.declare("stands", STATE, node, carrier)
    load = draft.declare("LOAD", CONSTANT, "real", thing)
    draft.define(on, ("?t",), over(draft.pick(["argmax", "argmin"]), "?r", carrier, draft.at(worth, draft.at(stands, "?r"))))
    draft.define(stands, ("?r",), draft.at(after, draft.at(stands, "?r")))
    there = boolean("(%s == ?n)", draft.at(stands, draft.at(on, "?t")))
    burden = over("sum", "?t", thing, real("(%s * %s)", there, draft.signed(draft.at(load, "?t"))))
    total = draft.interm("burden", {"?n": node}, burden)
    draft.earn(over(draft.pick(["sum", "max"]), "?n", node, draft.revealed(draft.at(total, "?n"))))


def sums_at_head(draft: Draft, node: str, after, head, worth) -> None:
    """Sums with one term that is not zero."""
    place = draft.pick([draft.at(head), draft.at(after, draft.at(head))])
    same = boolean(draft.pick(["(?m == %s)", "(%s == ?m)"]), place)
    term = real(draft.pick(["(%s * %s)", "(%s * (%s + 0.0))", "(if (%s) then %s else 0.0)"]), same, draft.signed(draft.at(worth, "?m")))
    draft.earn(draft.revealed(over("sum", "?m", node, real(draft.pick(["%s", "(%s * 2.0)", "(-%s)"]), term))))
    draft.earn(over("exists", "?m", node, boolean("(%s ^ %s)", same, draft.some_bool({"?m": node}))))


def loops(draft: Draft, node: str, after, head, worth) -> None:
    fixed = over("sum", "?m", node, boolean("(%s == ?m)", draft.pick([draft.at(after, "?m"), draft.at(after, draft.at(after, "?m"))])))
    draft.earn(fixed)
    if draft.chance(0.5):
        draft.problem.terminations.append(boolean("(%s > %s)", fixed, draft.pick(["1", "3", "60"])))


def walkers(draft: Draft, node: str, after, head, worth) -> None:
    """The nodes on which walkers stand, of each team."""
    team, walker = draft.objects("team"), draft.objects("walker")
    stands = draft.declare("walks", STATE, node, walker)
    draft.define(stands, ("?w",), draft.at(after, draft.at(stands, "?w")))
    seen = draft.declare("seen", STATE, "bool", *draft.pick([(node,), (team, node)]))
    variables = ("?t", "?n")[-len(seen.parameters) :]
    scope = dict(zip(variables, seen.parameters))
    same = boolean(draft.pick(["(?n == %s)", "(%s == ?n)"]), draft.at(stands, "?w"))
    walks = boolean(draft.pick(["(%s ^ %s)", "(%s ^ %s)", "(%s | %s)"]), draft.some_bool({"?w": walker}), same)
    there = over("exists", "?w", walker, walks)
    form = draft.pick(["(%s | %s)", "(~%s ^ %s)", "(if (%s) then true else %s)", "(if (%s) then false else %s)"])
    row = boolean(form, there, draft.pick([draft.at(seen, *variables), draft.some_bool(scope)]))
    if draft.chance(0.5):
        row = boolean("(if (%s) then %s else %s)", draft.some_bool({}), draft.some_bool(scope), row)
    draft.define(seen, variables, row)
    if draft.chance(0.5):
        found = over("exists", "?w", walker, boolean("(%s == ?n)", draft.at(stands, "?w", prime=True)))
        draft.observe("found", {"?n": node}, boolean(draft.pick(["%s", "~%s"]), found))
    total = draft.at(seen, *variables)
    for variable, type_name in reversed(scope.items()):
        total = over("sum", variable, type_name, total)
    draft.earn(total)


def watched(draft: Draft, node: str, after, head, worth) -> None:
    """A constant for each node on which somebody stands, and another one for the others."""
    sitter = draft.objects("sitter")
    sits = draft.declare("sits", STATE, node, sitter)
    gain = draft.declare("GAIN", CONSTANT, "real", node)
    draft.define(sits, ("?w",), draft.at(after, draft.at(sits, "?w")))
    place = draft.at(sits, "?w", prime=draft.chance(0.3))
    same = boolean("(%s == ?n)", place)
    if draft.chance(0.5):
        same = boolean("(%s ^ %s)", same, draft.some_bool({"?w": sitter}))
    stands = over("exists", "?w", sitter, same)
    form = draft.pick(["%s", "~%s", "(%s ^ %s)", "(%s ^ ~%s)", "(%s | %s)", "(%s => %s)"])
    condition = boolean(form, *[stands, draft.some_bool({"?n": node})][: form.count("%s")])
    constants = [draft.at(gain, "?n"), real(draft.pick(["0.0", "(-0.0)", "-5.3", "0.1", "2.5"]))]
    draft.rng.shuffle(constants)
    term = draft.pick([
        real("(if (%s) then %s else %s)", condition, *constants), real("(%s * %s)", condition, constants[0]),
        real("(%s + 0.1 * %s)", constants[0], condition),
    ])  # fmt: skip
    total = over("sum", "?n", node, term)
    draft.earn(draft.pick([total, total, draft.revealed(total)]))


def near_head(draft: Draft, node: str, after, head, worth) -> None:
    """Counts in the row that the state chooses."""
    near = draft.declare("near", draft.pick([STATE, CONSTANT]), "bool", node, node)
    if near.role == STATE:
        draft.define(near, ("?n", "?m"), draft.pick([draft.at(near, "?m", "?n"), draft.some_bool({"?n": node, "?m": node})]))
    other = draft.pick([draft.at(near, draft.at(after, "?m"), "?m"), draft.some_bool({"?m": node})])
    draft.earn(over("sum", "?m", node, boolean(draft.pick(["(%s ^ %s)", "(%s | %s)"]), draft.at(near, draft.at(head), "?m"), other)))
