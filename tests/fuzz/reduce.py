"""Makes a failing problem smaller while it still fails in the same way."""

import copy
import time
from collections.abc import Callable, Iterator

from rddl_problem import Expr, Problem, names_in

CONSTANTS = {
    "bool": [Expr("bool", "false"), Expr("bool", "true")],
    "int": [Expr("int", "0"), Expr("int", "1")],
    "real": [Expr("real", "0.0"), Expr("real", "1.0"), Expr("real", "0.5", (), 1, 1)],
}


def reduce(problem: Problem, fails: Callable[[Problem], bool], seconds: float) -> Problem:
    """Takes the first smaller problem that still fails, again and again."""
    end = time.monotonic() + seconds
    progress = True
    while progress and time.monotonic() < end:
        progress = False
        for smaller in smaller_problems(problem):
            if time.monotonic() > end:
                break
            if fails(smaller):
                problem, progress = smaller, True
                break
    return problem


def smaller_problems(problem: Problem) -> Iterator[Problem]:
    """Each simpler in one respect, those that save most first."""
    if problem.policy:
        yield changed(problem, lambda p: setattr(p, "policy", None))
    yield from with_simpler_bodies(problem)
    yield from without_conditions(problem)
    yield from without_fluents(problem)
    yield from without_initial_values(problem)
    yield from with_smaller_types(problem)
    yield from with_smaller_expressions(problem)


def with_simpler_bodies(problem: Problem) -> Iterator[Problem]:
    """A CPF that keeps its state, or is constant."""
    if str(problem.reward) not in ("0", "0.0"):
        yield changed(problem, lambda p: setattr(p, "reward", Expr("int", "0")))
    for name, (parameters, body) in problem.cpfs.items():
        fluent = problem.fluent(name.removesuffix("'"))
        head = f"({', '.join(parameters)})" if parameters else ""
        options = [Expr(fluent.range, fluent.name + head)] if name.endswith("'") else []
        options += CONSTANTS.get(fluent.range, [])[:1]
        if str(body) not in map(str, options):
            for option in options:
                yield changed(problem, lambda p: p.cpfs.update({name: (parameters, option)}))


def without_conditions(problem: Problem) -> Iterator[Problem]:
    for block in ("preconditions", "invariants", "terminations"):
        for index in range(len(getattr(problem, block))):
            yield changed(problem, lambda p: getattr(p, block).pop(index))


def without_fluents(problem: Problem) -> Iterator[Problem]:
    """Removes fluents that only their own CPFs mention."""
    for fluent in problem.fluents:
        own = {fluent.name, fluent.name + "'"}
        others = [str(body) for name, (_, body) in problem.cpfs.items() if name not in own]
        rest = problem.preconditions + problem.invariants + problem.terminations + [problem.reward]
        if problem.policy:
            if fluent.role == "action-fluent":
                continue
            rest += [body for _, body in problem.policy.cpfs.values()]
        if not any(fluent.name in names_in(text) for text in (*others, *map(str, rest))):

            def drop(p: Problem) -> None:
                p.fluents = [f for f in p.fluents if f.name != fluent.name]
                p.cpfs = {name: cpf for name, cpf in p.cpfs.items() if name not in own}

            yield changed(problem, drop)


def without_initial_values(problem: Problem) -> Iterator[Problem]:
    for fluent in problem.fluents:
        if fluent.values and fluent.default is not None:
            yield changed(problem, lambda p: p.fluent(fluent.name).values.clear())


def with_smaller_types(problem: Problem) -> Iterator[Problem]:
    """Removes its last members, half of them or one, unless the text names one."""
    used = " ".join(str(e) for e in problem.expressions())
    for type_ in problem.types:
        for count in sorted({len(type_.members) // 2, 1}, reverse=True):
            last = set(type_.members[len(type_.members) - count :])
            if count >= len(type_.members) or any(m in used or names_as_value(problem, m) for m in last):
                continue

            def shrink(p: Problem) -> None:
                del p.type(type_.name).members[-count:]
                for fluent in p.fluents:
                    fluent.values = {o: v for o, v in fluent.values.items() if not last & set(o)}

            yield changed(problem, shrink)


def names_as_value(problem: Problem, member: str) -> bool:
    values = [value for f in problem.fluents for value in (f.default, *f.values.values())]
    return member in [str(value).removeprefix("@") for value in values]


def with_smaller_expressions(problem: Problem) -> Iterator[Problem]:
    for name, (parameters, body) in problem.cpfs.items():
        for smaller in smaller_expressions(body, frozenset(parameters)):
            yield changed(problem, lambda p: p.cpfs.update({name: (parameters, smaller)}))
    for smaller in smaller_expressions(problem.reward, frozenset()):
        yield changed(problem, lambda p: setattr(p, "reward", smaller))
    for block in ("preconditions", "invariants", "terminations"):
        for index, condition in enumerate(getattr(problem, block)):
            for smaller in smaller_expressions(condition, frozenset()):
                yield changed(problem, lambda p: getattr(p, block).__setitem__(index, smaller))


def smaller_expressions(expr: Expr, scope: frozenset) -> Iterator[Expr]:
    """Replaces one node by a constant or by a part of itself of the same kind."""
    if expr.parts:
        for constant in CONSTANTS.get(expr.kind, []):
            yield constant
        for part in list(expr.all())[1:]:
            if fits(part, expr) and part.free_variables() <= scope:
                yield part
    inner = scope | expr.bound_variables()
    for index, part in enumerate(expr.parts):
        for smaller in smaller_expressions(part, inner):
            parts = (*expr.parts[:index], smaller, *expr.parts[index + 1 :])
            yield Expr(expr.kind, expr.form, parts, expr.magnitude, expr.fraction, expr.finite)


def fits(part: Expr, whole: Expr) -> bool:
    """No less is known about the part."""
    return (
        part.kind == whole.kind
        and part.magnitude <= whole.magnitude
        and part.fraction <= whole.fraction
        and part.finite >= whole.finite
    )


def changed(problem: Problem, change: Callable[[Problem], object]) -> Problem:
    result = copy.deepcopy(problem)
    change(result)
    return result
