"""Draws: by chances that neighbours multiply, where few bools reach, for what few actions choose, by weights of one form, from rows of tables."""

from domains.draft import ACTION, CONSTANT, MANY, STATE, Draft, boolean, of, over, real
from rddl_problem import Type


def add(draft: Draft) -> None:
    for part in draft.rng.sample([infection, wanderers, lessons, arrivals, spinners, moods], draft.pick([2, 2, 3])):
        part(draft)


def numerous(draft: Draft, stem: str) -> str:
    """Enough objects that loops over them are worth registers."""
    name = draft.fresh(stem)
    draft.problem.types.append(Type(name, False, [f"{name}-{i}" for i in range(draft.pick([9, 16, 24, *MANY]))]))
    return name


def neighbours(draft: Draft, type_name: str, offsets: list[int]):
    """A relation of each object with those that stand so many places further on in a ring."""
    members = draft.problem.type(type_name).members
    relation = draft.declare("BESIDE", CONSTANT, "bool", type_name, type_name, default="false")
    for index, member in enumerate(members):
        for offset in offsets:
            relation.values[(member, members[(index + offset) % len(members)])] = "true"
    return relation


def infection(draft: Draft) -> None:
    """Each infected neighbour multiplies the chance to stay well by the same factor."""
    host = draft.objects("host", main=True)
    ill = draft.declare("ill", STATE, "bool", host)
    near = draft.declare("NEAR", CONSTANT, "bool", host, host)
    exposed = boolean(draft.pick(["(%s ^ %s)", "(%s ^ ~%s)", "(%s | %s)"]), draft.at(near, "?h", "?g"), draft.at(ill, "?g"))
    factor, form = draft.pick(["0.5", "0.9", "0.3", "0.0", "1.0"]), draft.pick(["(if (%s) then FACTOR else 1.0)", "(if (%s) then 1.0 else FACTOR)"])
    well = draft.interm("stays-well", {"?h": host}, over("prod", "?g", host, real(form.replace("FACTOR", factor), exposed)))
    draft.define(ill, ("?h",), draft.coin(real("(1.0 - %s)", draft.at(well, "?h"))))
    draft.earn(over(draft.pick(["sum", "min", "max"]), "?h", host, draft.at(well, "?h")))


def wanderers(draft: Draft) -> None:
    """A cell becomes taken by a draw, if the cell beside it or itself is; at first, few are."""
    cell = numerous(draft, "cell")
    members = draft.problem.type(cell).members
    taken = draft.declare("taken", STATE, "bool", cell, default="false")
    taken.values[(draft.pick(members),)] = "true"
    chance = draft.declare("CHANCE", CONSTANT, "real", cell)
    beside = neighbours(draft, cell, [draft.pick([1, 2])])
    comes = over("exists", "?d", cell, boolean("(%s ^ %s)", draft.at(beside, "?c", "?d"), draft.at(taken, "?d")))
    drawn = draft.coin(draft.pick([draft.at(chance, "?c"), real("0.75")]))
    draft.define(taken, ("?c",), draft.pick([
        boolean("(if (%s) then %s else false)", comes, drawn), boolean("(%s ^ %s)", draft.at(taken, "?c"), drawn),
        boolean("((%s | %s) ^ %s)", comes, draft.at(taken, "?c"), drawn),
        boolean("(if (%s) then %s else %s)", comes, drawn, draft.at(taken, "?c")),
    ]))  # fmt: skip
    draft.earn(over("sum", "?c", cell, draft.at(taken, "?c")))


def lessons(draft: Draft) -> None:
    """What the action does not choose stays as it is."""
    lesson = numerous(draft, "lesson")
    learn = draft.declare("learn", ACTION, "bool", lesson, default="false")
    known, chance = draft.declare("known", STATE, "bool", lesson), draft.declare("CHANCE", CONSTANT, "real", lesson)
    here = draft.at(known, "?l")
    drawn = draft.coin(draft.pick([draft.at(chance, "?l"), real("(if (%s) then 0.9 else %s)", here, draft.at(chance, "?l"))]))
    if draft.flavour.draws and draft.chance(0.3):
        drawn = guided(draft, lesson)
    draft.define(known, ("?l",), boolean(draft.pick(["(if (%s) then %s else %s)", "((%s ^ %s) | %s)"]), draft.at(learn, "?l"), drawn, here))
    draft.problem.max_nondef_actions = draft.pick(["1", "1", "2"])
    draft.earn(over("sum", "?l", lesson, draft.at(known, "?l")))


def guided(draft: Draft, lesson: str):
    """Whether the guide of a lesson comes, drawn among all by weights that change."""
    guide = draft.objects("guide")
    of_lesson, skill = draft.declare("OF", CONSTANT, guide, lesson), draft.declare("skill", STATE, "real", lesson)
    draft.define(skill, ("?l",), draft.bounded(real("(%s * -0.5)", draft.at(skill, "?l"))))
    comes = of(guide, f"(UnnormDiscrete_{{?m : {guide}}} [(min[9.0, abs[%s]] + 0.25)])", draft.at(skill, "?l"))
    return boolean("(%s == %s)", comes, draft.at(of_lesson, "?l"))


def arrivals(draft: Draft) -> None:
    """A gate that is open or no entry does not draw; others do, by chances that change."""
    gate = numerous(draft, "gate")
    go, entry = draft.declare("go", ACTION, "bool", gate, default="false"), draft.declare("ENTRY", CONSTANT, "bool", gate)
    up, rate = draft.declare("up", STATE, "bool", gate), draft.declare("rate", STATE, "real", gate)
    kept = boolean(draft.pick(["(%s ^ %s)", "(%s ^ ~%s)", "(%s | %s)"]), draft.at(up, "?g"), draft.at(go, "?g"))
    for offset in draft.rng.sample([1, 2, 3, 5, 8], draft.pick([0, 3, 4])):
        beside = over("exists", "?n", gate, boolean("(%s ^ %s)", draft.at(neighbours(draft, gate, [offset]), "?g", "?n"), draft.at(up, "?n")))
        kept = boolean(draft.pick(["(%s ^ %s)", "(%s | ~%s)", "(%s ~= %s)"]), kept, beside)
    open_ = boolean("(%s | ~%s)", draft.at(up, "?g"), draft.at(entry, "?g"))
    draft.define(up, ("?g",), boolean("(if (%s) then %s else %s)", open_, kept, draft.coin(draft.at(rate, "?g"))))
    draft.define(rate, ("?g",), draft.pick([draft.at(rate, "?g"), real("max[0.0, min[1.0, %s + 0.25 * %s - 0.125]]", draft.at(rate, "?g"), draft.at(up, "?g"))]))
    draft.earn(over("sum", "?g", gate, draft.at(up, "?g")))


def spinners(draft: Draft) -> None:
    """Weights of one form for each side of an enumeration, divided by their sum or not."""
    spinner = draft.objects("spinner")
    side = draft.enumeration("side", draft.pick([2, 3, 5, 8]))
    shows, pull = draft.declare("shows", STATE, side.name, spinner), draft.declare("PULL", CONSTANT, "real", side.name, spinner)

    def weight(of_side) -> real:
        number = draft.at(pull, of_side, "?s")
        return real("(min[9.0, abs[%s]] + 0.5 * (%s == %s))", number, draft.at(shows, "?s"), of_side) if softened else real("(abs[%s] + 0.25)", number)

    softened = draft.chance(0.5)
    literals = [side.literal(member) for member in side.members]
    if draft.flavour.draws:
        cases = ", ".join(f"{literal} : %s" for literal in literals)
        drawn = of(side.name, f"UnnormDiscrete({side.name}, {cases})", *(real("(%s + 0.125)", weight(literal)) for literal in literals))
    else:
        drawn = over(draft.pick(["argmax", "argmin"]), "?x", side.name, weight("?x"))
    draft.define(shows, ("?s",), drawn)
    draft.earn(over("sum", "?s", spinner, boolean("(%s == %s)", draft.at(shows, "?s"), draft.pick(literals))))


def moods(draft: Draft) -> None:
    """Markov chains: enumerated values choose a row of weights from a table. Some rows do not add up to 1."""
    owner = draft.objects("owner")
    mood = draft.enumeration("mood", draft.pick([2, 3, 5]))
    now, command = draft.declare("feels", STATE, mood.name, owner), draft.declare("CHEER", ACTION, mood.name, owner, default="@" + mood.members[0])
    after, chance = draft.declare("AFTER", CONSTANT, mood.name, mood.name), draft.declare("SHIFT", CONSTANT, "real", mood.name, mood.name, default="0.0")
    for member in mood.members:
        shares = [draft.pick([0, 0, 1, 3]) for _ in mood.members[1:]]
        is_wrong = draft.reveals and draft.chance(0.1)
        shares.append(draft.pick([-4, 0, 16]) if is_wrong else 16 - sum(shares))
        draft.rng.shuffle(shares)
        chance.values |= {(member, to): str(share / 16) for to, share in zip(mood.members, shares)}
    present, other = draft.at(now, "?w"), draft.at(command, "?w")
    is_calm = boolean("(%s == @%s)", other, mood.members[0])
    chosen = draft.at(draft.interm("inner", {"?w": owner}, of(mood.name, "(if (%s) then %s else %s)", is_calm, present, other)), "?w")
    row = draft.pick([present, draft.at(after, present), chosen, draft.at(after, chosen)])

    def weight(of_mood) -> real:
        number = draft.at(chance, row, of_mood)
        return real("(0.75 * %s + 0.25 * %s)", number, draft.at(chance, other, of_mood)) if is_mixed else number

    is_mixed = draft.chance(0.3)
    literals = [mood.literal(member) for member in mood.members]
    if not draft.flavour.draws:
        drawn = over("argmax", "?x", mood.name, weight("?x"))
    elif draft.chance(0.5):
        drawn = over("Discrete", "?x", mood.name, weight("?x"))
    else:
        cases = ", ".join(f"{literal} : %s" for literal in literals)
        drawn = of(mood.name, f"Discrete({mood.name}, {cases})", *(weight(literal) for literal in literals))
    draft.define(now, ("?w",), drawn)
    draft.earn(over("sum", "?w", owner, boolean("(%s == %s)", present, draft.pick(literals))))
