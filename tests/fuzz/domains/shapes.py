"""Shapes of few parts, whose places constants give: which rows do they meet, and where do rows fall?"""

from domains.draft import ACTION, CONSTANT, STATE, Draft, boolean, integer, over
from rddl_problem import Type


def add(draft: Draft) -> None:
    row, part, column = objects(draft, "line", (4, 5, 7, 8, 12, 16, 17)), objects(draft, "part", (2, 3, 4)), objects(draft, "file", (2, 5, 6))
    full, shape = draft.declare("full", STATE, "bool", column, row), draft.declare("shape", STATE, "bool", part, column)
    turn = draft.declare("turn", ACTION, "bool", part, default="false")
    draft.define(shape, ("?p", "?c"), boolean("(%s ~= %s)", draft.at(shape, "?p", "?c"), draft.at(turn, "?p")))
    met = draft.at(draft.interm("met", {"?c": column, "?r": row}, meets(draft, row, part, full, shape)), "?c", "?r")
    here = draft.at(full, "?c", "?r")
    after = boolean(draft.pick(["(%s | %s)", "(%s ^ ~%s)", "(%s ~= %s)"]), here, met)
    if draft.chance(0.5):
        after = fallen(draft, row, column, full, after)
    draft.define(full, ("?c", "?r"), after)
    draft.earn(over("sum", "?c", column, over("sum", "?r", row, here)))


def objects(draft: Draft, stem: str, sizes: tuple[int, ...]) -> str:
    name = draft.fresh(stem)
    draft.problem.types.append(Type(name, False, [f"{name}-{i}" for i in range(draft.pick(sizes))]))
    return name


def meets(draft: Draft, row: str, part: str, full, shape):
    """Whether a part lies where something is, or outside."""
    next_, open_ = draft.declare("NEXT", CONSTANT, row, row, part), draft.declare("OPEN", CONSTANT, "bool", row, part)
    there, may = draft.at(full, "?c", draft.at(next_, "?r", "?p")), draft.at(open_, "?r", "?p")
    form = draft.pick(["(%s ^ %s ^ %s)", "(%s ^ (%s | ~%s))", "(%s | (%s ^ %s))", "((%s => %s) ^ %s)"])
    return over(draft.pick(["exists", "exists", "forall"]), "?p", part, boolean(form, draft.at(shape, "?p", "?c"), may, there))


def fallen(draft: Draft, row: str, column: str, full, after):
    """A row takes what was so many rows above it, by numbers that are counted anew in each step."""
    number = draft.declare("NUMBER", CONSTANT, "int", row)
    number.values = {(member,): str(index) for index, member in enumerate(draft.problem.type(row).members)}
    whole = over("forall", "?k", column, draft.at(full, "?k", "?r"))
    below = draft.interm("below", {"?r": row}, integer("(%s * 1)", draft.pick([whole, draft.some_bool({"?r": row})])))
    apart = integer("(%s - %s)", draft.at(number, "?o"), draft.at(number, "?r"))
    moves = draft.interm("moves", {"?r": row, "?o": row}, boolean("(%s == %s)", apart, draft.at(below, "?o")))
    lies = boolean("(%s ^ %s)", draft.at(moves, "?r", "?o"), draft.at(full, "?c", "?o"))
    return boolean(draft.pick(["(%s | %s)", "(%s ~= %s)"]), over("exists", "?o", row, lies), after)
