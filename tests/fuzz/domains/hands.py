"""Hands of dice: an action throws some and scores others, and counts of what they show decide."""

from domains.draft import ACTION, CONSTANT, STATE, Draft, boolean, integer, of, over, real
from rddl_problem import Type


def add(draft: Draft) -> None:
    die, face = dice(draft), draft.enumeration("face", draft.pick([2, 3, 4, 6]))
    shows = draft.declare("shows", STATE, face.name, die)
    throw = draft.declare("throw", ACTION, "bool", die, default="false")
    score = draft.declare("score", ACTION, "bool", face.name, default="false")
    thrown = draft.at(throw, "?d")
    draft.define(shows, ("?d",), of(face.name, "(if (%s) then %s else %s)", thrown, thrown_face(draft, face, die), draft.at(shows, "?d")))
    draft.problem.max_nondef_actions = draft.pick(["1", "1", "2", "3"])
    for part in draft.rng.sample([lost_dice, rank, straight, categories], draft.pick([1, 2, 3])):
        part(draft, die, face, shows, throw, score)


def dice(draft: Draft) -> str:
    """Few: counts of a hand are small."""
    if draft.chance(0.2):
        return draft.objects("die")
    name = draft.fresh("die")
    draft.problem.types.append(Type(name, False, [f"{name}-{i}" for i in range(draft.rng.randint(2, 7))]))
    return name


def thrown_face(draft: Draft, face, die: str):
    """By weights that are the same for all dice, or of a table."""
    literals = [face.literal(member) for member in face.members]
    if not draft.flavour.draws:
        return of(face.name, draft.pick(literals))
    pull = draft.declare("PULL", CONSTANT, "real", face.name, die)
    weights = [real("(abs[%s] + 0.25)", draft.at(pull, literal, "?d")) for literal in literals]
    if draft.chance(0.5):
        weights = [real(draft.pick(["1.0", "2.0", "0.5"])) for _ in literals]
    cases = ", ".join(f"{literal} : %s" for literal in literals)
    return of(face.name, f"UnnormDiscrete({face.name}, {cases})", *weights)


def lost_dice(draft: Draft, die: str, face, shows, throw, score) -> None:
    """What only a thrown die draws."""
    lost, chance = draft.declare("lost", STATE, "bool", die), draft.declare("LOSS", CONSTANT, "real", die)
    here = draft.at(lost, "?d")
    drawn = draft.coin(draft.pick([draft.at(chance, "?d"), real("0.5"), real("(if (%s) then 0.9 else %s)", here, draft.at(chance, "?d"))]))
    goes = boolean("(%s ^ %s)", draft.at(throw, "?d"), drawn)
    form = draft.pick(["(%s | %s)", "(if (%s) then true else %s)", "(%s ~= %s)", "(%s ^ ~%s)"])
    draft.define(lost, ("?d",), boolean(form, goes, draft.pick([here, boolean("(%s ^ %s)", here, draft.some_bool({"?d": die}))])))
    draft.earn(over("sum", "?d", die, draft.at(lost, "?d", prime=draft.chance(0.5))))


def count_of(draft: Draft, die: str, shows, literal: str, prime: bool):
    same = boolean("(%s == %s)", draft.at(shows, "?d", prime=prime), literal)
    return over("sum", "?d", die, same)


def rank(draft: Draft, die: str, face, shows, throw, score) -> None:
    """Moves through a table by how many dice show a face that the action scores."""
    grade = draft.enumeration("grade", draft.pick([2, 3, 5]))
    tables = [move(draft, grade) for _ in range(draft.pick([2, 3, 4]))]
    now, prime = draft.declare("grade-now", STATE, grade.name), draft.chance(0.6)
    scored = draft.rng.sample(face.members, min(len(face.members), draft.pick([1, 2, 3])))
    literals = [face.literal(member) for member in scored]
    counts = [count_of(draft, die, shows, literal, prime) for literal in literals]
    body = draft.at(now)
    for table in tables:
        limit = draft.rng.randint(0, draft.size(die) + draft.pick([0, 0, 1]))
        compare = "==" if draft.chance(0.8) else draft.comparison()
        cases = [boolean(f"(%s ^ (%s {compare} {limit}))", draft.at(score, literal), count) for literal, count in zip(literals, counts)]
        met = boolean("(" + " | ".join(["%s"] * len(cases)) + ")", *cases)
        body = of(grade.name, "(if (%s) then %s else %s)", met, draft.at(table, draft.at(now)), body)
    draft.define(now, (), body)
    for number, member in enumerate(grade.members):
        draft.earn(real(f"({number}.0 * %s)", boolean("(%s == %s)", draft.at(now), grade.literal(member))))


def move(draft: Draft, grade):
    """A table from which grade to which."""
    table = draft.declare("MOVE", CONSTANT, grade.name, grade.name)
    table.values = {(member,): "@" + draft.pick(grade.members) for member in grade.members}
    return table


def straight(draft: Draft, die: str, face, shows, throw, score) -> None:
    """Different dice with different faces; now and then the same face twice."""
    wanted = draft.rng.sample(face.members, min(len(face.members), draft.pick([2, 3])))
    if draft.chance(0.3):
        wanted[-1] = wanted[0]
    variables = [f"?d{i}" for i in range(len(wanted))]
    parts = [boolean("(%s == %s)", draft.at(shows, variable), face.literal(member)) for variable, member in zip(variables, wanted)]
    pairs = [(a, b) for i, a in enumerate(variables) for b in variables[i + 1 :]]
    parts += [boolean("(%s ~= %s)", a, b) for a, b in pairs if draft.chance(0.9)]
    if draft.chance(0.3):
        parts.append(draft.some_bool({variables[0]: die}))
    draft.rng.shuffle(parts)
    body = boolean("(" + " ^ ".join(["%s"] * len(parts)) + ")", *parts)
    for variable in reversed(variables):
        body = over("exists", variable, die, body)
    draft.earn(real("(if (%s) then 3.0 else %s)", body, over("sum", "?d", die, draft.some_bool({"?d": die}))))


def categories(draft: Draft, die: str, face, shows, throw, score) -> None:
    """What the scored face is worth: a chain of cases, all of one table of the action."""
    value = draft.declare("VALUE", CONSTANT, "real", face.name)
    total = over("sum", "?d", die, draft.at(value, draft.at(shows, "?d")))
    body = real(draft.pick(["0.0", "(-0.0)", "-1.0"]))
    for member in draft.rng.sample(face.members, len(face.members)):
        literal = face.literal(member)
        count = count_of(draft, die, shows, literal, False)
        enough = boolean(f"(%s {draft.pick(['>=', '>', '=='])} {draft.rng.randint(0, draft.size(die))})", count)
        worth = draft.pick([total, integer("(%s * 2)", count), real("(%s + 0.5)", draft.at(value, literal))])
        body = real("(if (%s) then %s else %s)", boolean("(%s ^ %s)", draft.at(score, literal), enough), worth, body)
    draft.earn(draft.revealed(body) if draft.chance(0.4) else body)
