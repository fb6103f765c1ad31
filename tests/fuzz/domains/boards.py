"""Pieces on a small board: ints that invariants bound, and that few of their steps leave."""

from domains.draft import ACTION, CONSTANT, INTERM, STATE, Draft, boolean, integer, over, real

WAYS = (("0", "0"), ("1", "0"), ("-1", "0"), ("0", "1"), ("0", "-1"))


def add(draft: Draft) -> None:
    piece = draft.objects("piece", main=True)
    # A byte holds the numbers of the first boards, and what is one beyond them of all but the last two.
    low, high = draft.pick([(0, 2), (0, 9), (-3, 3), (0, 60), (-100, 100), (-128, 127), (0, 127)])
    axes = [position(draft, piece, low, high) for _ in range(draft.pick([1, 2]))]
    ways = choices(draft, piece, len(axes))
    wanted = [draft.at(draft.interm(f"wanted-{axis.name}", {"?p": piece}, moved(draft, axis, way, low, high)), "?p") for axis, way in zip(axes, ways)]
    meets = [boolean("(%s == %s)", draft.at(axis, "?p"), draft.at(axis, "?q")) for axis in axes]
    together = boolean("((?p ~= ?q) ^ " + " ^ ".join(["%s"] * len(meets)) + ")", *meets)
    blocked = draft.interm("blocked", {"?p": piece}, over("exists", "?q", piece, together))
    for axis, next_ in zip(axes, wanted):
        kept = integer("(if (%s) then %s else %s)", draft.at(blocked, "?p"), draft.at(axis, "?p"), next_)
        draft.define(axis, ("?p",), draft.pick([next_, kept]))
    scores(draft, piece, axes, low, high)


def position(draft: Draft, piece: str, low: int, high: int):
    axis = draft.declare(draft.pick(["east", "north"]), STATE, "int", piece, default=str(draft.rng.randint(low, high)))
    for member in draft.problem.type(piece).members:
        if draft.chance(0.4):
            axis.values[(member,)] = str(draft.rng.randint(low, high))
    bounds = boolean(f"((%s >= {low}) ^ (%s <= {high}))", draft.at(axis, "?p"), draft.at(axis, "?p"))
    if draft.chance(0.9):
        draft.problem.invariants.append(over("forall", "?p", piece, bounds))
    return axis


def choices(draft: Draft, piece: str, axes: int):
    """How far each piece goes along each axis: by an enumeration, or by two bools."""
    if draft.chance(0.5):
        way = draft.enumeration("way", 5)
        step = draft.declare("step", ACTION, way.name, piece)
        literals = [way.literal(member) for member in way.members]

        def along(axis: int):
            form = "".join(f"(if (%s == {literal}) then {move[axis]} else " for literal, move in zip(literals, WAYS)) + "0" + ")" * len(literals)
            return integer(form, *[draft.at(step, "?p")] * len(literals))

        return [along(axis) for axis in range(axes)]
    pairs = [[draft.declare(name, ACTION, "bool", piece, default="false") for name in ("more", "less")] for _ in range(axes)]
    return [integer("(%s - %s)", *(draft.at(bool_, "?p") for bool_ in pair)) for pair in pairs]


def moved(draft: Draft, axis, way, low: int, high: int):
    own = draft.at(axis, "?p")
    return draft.pick([
        integer(f"max[{low}, min[{high}, (%s + %s)]]", own, way),
        integer(f"(if ((%s + %s > {high}) | (%s + %s < {low})) then %s else %s + %s)", own, way, own, way, own, own, way),
        integer(f"(if (%s == {high}) then {low} else (%s + ({high} > %s)))", own, own, own),
        integer("(%s + %s)", own, way),  # leaves the board: the episode ends
    ])  # fmt: skip


def scores(draft: Draft, piece: str, axes: list, low: int, high: int) -> None:
    goal = draft.declare("GOAL", CONSTANT, "int", piece, default=str(draft.pick([low, high, 0])))
    axis = draft.pick(axes)
    at_goal = boolean(f"(%s {draft.comparison()} %s)", draft.at(axis, "?p", prime=draft.chance(0.5)), draft.at(goal, "?p"))
    count = over("sum", "?p", piece, at_goal)
    draft.earn(draft.pick([count, integer("(-%s)", count), real("(%s * 0.5)", count), integer("(%s * (%s > 1))", count, count)]))
    if draft.chance(0.5):
        draft.earn(over(draft.pick(["sum", "max", "min"]), "?p", piece, draft.at(axis, "?p", prime=draft.chance(0.5))))
    if draft.chance(0.3):
        best = draft.declare("best", INTERM, "int")
        draft.define(best, (), over("max", "?p", piece, draft.at(axis, "?p")))
        draft.earn(boolean("(%s > %s)", draft.at(best), draft.pick([integer("0"), count])))
    if draft.chance(0.3):
        draft.problem.preconditions.append(boolean(f"(%s <= {draft.pick([1, 3])})", over("sum", "?p", piece, at_now(draft, axis, goal))))
    if draft.chance(0.3):
        draft.problem.terminations.append(over("forall", "?p", piece, at_now(draft, axis, goal)))


def at_now(draft: Draft, axis, goal):
    return boolean("(%s == %s)", draft.at(axis, "?p"), draft.at(goal, "?p"))
