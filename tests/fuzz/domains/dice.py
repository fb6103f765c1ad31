"""Dice that show faces: hands of equal faces, which an action names, and a rank that cases of one face move."""

from domains.draft import ACTION, CONSTANT, STATE, Draft, boolean, integer, of, over, real
from rddl_problem import Type


def add(draft: Draft) -> None:
    die = draft.fresh("die")
    draft.problem.types.append(Type(die, False, [f"{die}-{i}" for i in range(draft.pick([3, 4, 5, 5, 6, 6]))]))
    face = draft.enumeration("face", draft.pick([2, 3, 5, 6, 8]))
    shows, roll = draft.declare("shows", STATE, face.name, die), draft.declare("roll", ACTION, "bool", die, default="false")
    draft.define(shows, ("?d",), of(face.name, "(if (%s) then %s else %s)", draft.at(roll, "?d"), rolled(draft, face), draft.at(shows, "?d")))
    for part in draft.rng.sample([hands, rank, moves, seen], draft.pick([1, 2, 3])):
        part(draft, die, face, shows)
    if draft.chance(0.3):
        lose(draft, die, roll)


def rolled(draft: Draft, face: Type):
    literals = [face.literal(member) for member in face.members]
    if not draft.flavour.draws:
        return of(face.name, draft.pick(literals))
    weights = ", ".join(f"{literal} : {draft.pick(['1.0', '2.5', '0.25'])}" for literal in literals)
    return of(face.name, f"UnnormDiscrete({face.name}, {weights})")


def lose(draft: Draft, die: str, roll) -> None:
    """What only rolled dice draw, of which an action rolls few."""
    lost, chance = draft.declare("lost", STATE, "bool", die), draft.declare("LOSS", CONSTANT, "real", die)
    here = draft.at(lost, "?d")
    drawn = draft.coin(draft.pick([draft.at(chance, "?d"), real("0.5"), real("(if (%s) then 0.9 else %s)", here, draft.at(chance, "?d"))]))
    goes = boolean("(%s ^ %s)", draft.at(roll, "?d"), drawn)
    form = draft.pick(["(%s | %s)", "(if (%s) then true else %s)", "(%s ~= %s)", "(%s ^ ~%s)"])
    draft.define(lost, ("?d",), boolean(form, goes, draft.pick([here, boolean("(%s ^ %s)", here, draft.some_bool({"?d": die}))])))
    draft.problem.max_nondef_actions = draft.pick(["1", "1", "2", "3"])
    draft.earn(over("sum", "?d", die, draft.at(lost, "?d", prime=draft.chance(0.5))))


def hands(draft: Draft, die: str, face: Type, shows) -> None:
    """Each hand has a condition and a score; the first one that is named and there counts."""
    hand = draft.enumeration("hand", draft.pick([3, 5, 7]))
    named = draft.declare("named", ACTION, "bool", hand.name, default="false")
    form, parts = "0", []
    for member in reversed(hand.members):
        is_named = draft.at(named, hand.literal(member))
        condition = boolean("(%s ^ %s)", is_named, pattern(draft, die, shows)) if draft.chance(0.7) else is_named
        form, parts = f"(if (%s) then %s else {form})", [condition, score(draft, die, face, shows), *parts]
    cases = integer(form, *parts)
    if draft.chance(0.5):
        best = draft.declare("scored", STATE, "int")
        draft.define(best, (), cases)
        cases = draft.at(best)
    draft.earn(cases)


def score(draft: Draft, die: str, face: Type, shows):
    is_shown = boolean(f"(%s == {face.literal(draft.pick(face.members))})", draft.at(shows, "?d"))
    own = integer("(%s * (1 + %s))", pattern(draft, die, shows, "?d"), is_shown)
    return draft.pick([
        over("sum", "?d", die, is_shown), integer("(2 * %s)", over("sum", "?d", die, is_shown)),
        over("sum", "?d", die, own), integer("(25 * %s)", over("forall", "?d", die, boolean("(~%s)", is_shown))), integer("30"),
    ])  # fmt: skip


def pattern(draft: Draft, die: str, shows, given: str | None = None):
    """Different dice that show equal faces, in one group or two; now and then, something is missing."""
    variables = [f"?{letter}" for letter in "abce"[: draft.pick([1, 2] if given else [2, 2, 3, 4])]]
    dice = [*variables, *([given] if given else [])]
    middle = draft.pick([2, len(dice)]) if len(dice) > 3 else len(dice)
    is_exists = draft.chance(0.6)
    different, same = ("~=", "==") if is_exists else ("==", "~=")
    parts = [boolean(f"({a} {different} {b})") for index, a in enumerate(dice) for b in dice[index + 1 :]]
    if draft.chance(0.1):
        parts.pop()
    if draft.chance(0.15) and len(variables) <= len(draft.problem.type(shows.range).members):
        return straight(draft, die, shows, variables)
    for group in (dice[:middle], dice[middle:]):
        parts += [boolean(f"(%s {same} %s)", draft.at(shows, a), draft.at(shows, b)) for a, b in zip(group, group[1:])]
    body = boolean("(" + (" ^ " if is_exists else " | ").join(["%s"] * len(parts)) + ")", *parts)
    for variable in reversed(variables):
        body = over("exists" if is_exists else "forall", variable, die, body)
    return body


def straight(draft: Draft, die: str, shows, variables: list[str]):
    """Different dice, each of which shows a face of its own."""
    faces = draft.rng.sample(draft.problem.type(shows.range).members, len(variables))
    parts = [boolean(f"({a} ~= {b})") for index, a in enumerate(variables) for b in variables[index + 1 :]]
    parts += [boolean(f"(%s == @{face})", draft.at(shows, variable)) for variable, face in zip(variables, faces)]
    body = boolean("(" + " ^ ".join(["%s"] * len(parts)) + ")", *parts)
    for variable in reversed(variables):
        body = over("exists", variable, die, body)
    return body


def moves(draft: Draft, die: str, face: Type, shows) -> None:
    """A place moves by how many dice show the faces that an action names."""
    place, count = draft.declare("place", STATE, face.name), draft.pick([3, 4])
    asked = draft.rng.sample(face.members, draft.pick([2, min(3, len(face.members))]))
    wanted = [draft.declare("wanted", ACTION, "bool", default="false") for _ in asked]
    cases, parts = "", []
    for number in draft.rng.sample(range(5), count):
        shown = [over("sum", "?d", die, boolean(f"(%s == @{member})", draft.at(shows, "?d"))) for member in asked]
        met = [boolean(f"(%s ^ (%s == {number}))", draft.at(is_wanted), each) for is_wanted, each in zip(wanted, shown)]
        cases += "(if (%s) then %s else "
        parts += [boolean("(" + " | ".join(["%s"] * len(met)) + ")", *met), draft.at(draft.declare("TO", CONSTANT, face.name, face.name), draft.at(place))]
    draft.define(place, (), of(face.name, cases + "%s" + ")" * count, *parts, draft.at(place)))


def rank(draft: Draft, die: str, face: Type, shows) -> None:
    """All cases share a condition, before the comparison of the rank or behind it."""
    now, goes = draft.declare("rank", STATE, face.name), draft.declare("go", ACTION, "bool", default="false")
    other = draft.pick([draft.at(goes), draft.some_bool({}), pattern(draft, die, shows)])
    form = draft.pick(["(if (%s ^ (%s == {literal})) then {value} else ", "(if ((%s == {literal}) ^ %s) then {value} else "])
    asked = draft.rng.sample(face.members, draft.rng.randint(2, len(face.members)))
    cases = [form.format(literal=face.literal(member), value="@" + draft.pick(face.members)) for member in asked]
    order = [other, draft.at(now)] if form.startswith("(if (%s ^") else [draft.at(now), other]
    draft.define(now, (), of(face.name, "".join(cases) + "%s" + ")" * len(cases), *order * len(cases), draft.at(now)))
    bonus = draft.declare("BONUS", CONSTANT, "int", face.name)
    draft.earn(draft.at(bonus, draft.at(now)))


def seen(draft: Draft, die: str, face: Type, shows) -> None:
    """A bool of a pattern of the dice."""
    there = draft.declare("there", STATE, "bool")
    draft.define(there, (), boolean(draft.pick(["(%s | %s)", "(%s ^ %s)", "(%s ^ ~%s)"]), pattern(draft, die, shows), draft.some_bool({})))
    draft.earn(draft.at(there))
