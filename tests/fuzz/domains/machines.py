"""Machines whose modes are enumerated: switch, tables of transitions, drawn modes."""

from domains.draft import ACTION, CONSTANT, STATE, Draft, boolean, integer, of, over, real


def add(draft: Draft) -> None:
    machine = draft.objects("machine", main=True)
    mode, event = draft.enumeration("mode", draft.pick([1, 2, 3, 4, 8])), draft.enumeration("event", draft.pick([1, 2, 3]))
    now = draft.declare("now", STATE, mode.name, machine)
    command = draft.declare("command", ACTION, event.name, machine, default="@" + event.members[0])
    table = draft.declare("BECOMES", CONSTANT, mode.name, mode.name, event.name)
    by_table = draft.at(table, draft.at(now, "?m"), draft.at(command, "?m"))
    by_switch = switch(draft, mode, draft.at(now, "?m"), lambda: of(mode.name, "@" + draft.pick(mode.members)))
    condition = draft.some_bool({"?m": machine})
    body = draft.pick([by_table, by_switch, of(mode.name, "(if (%s) then %s else %s)", condition, by_table, by_switch)])
    if draft.flavour.draws and draft.chance(0.4):
        body = of(mode.name, "(if (%s) then %s else %s)", draft.coin("0.25"), drawn(draft, mode), body)
    draft.define(now, ("?m",), body)
    for part in draft.rng.sample([wear, census, output], draft.pick([1, 2, 3])):
        part(draft, machine, mode, now, table, event)


def switch(draft: Draft, mode, subject, value):
    """A switch with cases for all members, or for some and a default."""
    members = list(mode.members)
    draft.rng.shuffle(members)
    shown = members if draft.chance(0.5) else members[: max(1, len(members) // 2)]
    values = [value() for _ in shown]
    cases = ", ".join(f"case @{member} : %s" for member in shown)
    if len(shown) < len(members) or draft.chance(0.2) and len(shown) > 1:
        cases, values = cases + ", default : %s", [*values, value()]
    return of(values[0].kind, f"(switch (%s) {{ {cases} }})", subject, *values)


def drawn(draft: Draft, mode):
    weights = ", ".join(f"@{member} : {draft.pick(['0.0', '1.0', '2.5', '0.25'])}" for member in mode.members[1:])
    return of(mode.name, f"UnnormDiscrete({mode.name}, @{mode.members[0]} : 1.0{', ' + weights if weights else ''})")


def wear(draft: Draft, machine: str, mode, now, table, event) -> None:
    used, rate = draft.declare("used", STATE, "real", machine), draft.declare("RATE", CONSTANT, "real", mode.name)
    more = draft.signed(draft.at(rate, draft.at(now, "?m")))
    changes = switch(draft, mode, draft.at(now, "?m"), lambda: draft.pick([more, draft.zero(more), real("%s", draft.at(used, "?m")), real("(-0.0)")]))
    draft.define(used, ("?m",), draft.bounded(real("(%s + %s)", draft.at(used, "?m"), changes)))
    same = boolean("(%s == ?x)", draft.at(now, "?m"))
    by_sum = over("sum", "?x", mode.name, real("(%s * %s)", same, draft.signed(draft.at(rate, "?x"))))
    draft.earn(over("sum", "?m", machine, draft.revealed(draft.pick([by_sum, changes]))))


def census(draft: Draft, machine: str, mode, now, table, event) -> None:
    """How many are in each mode, in which the most are."""
    same = boolean(draft.pick(["(%s == ?x)", "(?x == %s)"]), draft.at(now, "?m"))
    count = draft.interm("census", {"?x": mode.name}, over("sum", "?m", machine, same))
    usual = draft.declare("usual", STATE, mode.name)
    draft.define(usual, (), over(draft.pick(["argmax", "argmin"]), "?x", mode.name, draft.at(count, "?x")))
    draft.earn(draft.at(count, draft.at(usual)))
    draft.earn(draft.revealed(real("(%s - %s)", draft.at(count, "@" + mode.members[0]), draft.at(count, "@" + mode.members[-1]))))


def output(draft: Draft, machine: str, mode, now, table, event) -> None:
    lamp = draft.declare("lamp", STATE, "bool", machine)
    body = switch(draft, mode, draft.at(now, "?m", prime=draft.chance(0.4)), lambda: draft.some_bool({"?m": machine}))
    draft.define(lamp, ("?m",), body)
    leads = boolean("(%s == %s)", draft.at(table, "?x", "?e"), draft.at(now, "?m"))
    ways = over("sum", "?x", mode.name, over("sum", "?e", event.name, leads))
    draft.earn(over("sum", "?m", machine, integer("(%s * %s)", draft.at(lamp, "?m"), ways)))
    if draft.chance(0.4):
        all_same = over("forall", "?m", machine, boolean(f"(%s == @{mode.members[-1]})", draft.at(now, "?m")))
        draft.problem.terminations.append(all_same)
