"""Whole little domains, composed of families: docs/fuzzing.md."""

from domains import belts, boards, chances, control, dice, flows, grids, machines, markets, networks, places, pointers, queues, rounds, shapes, tours, vehicles, zeros
from domains.draft import ACTION, OBSERVATION, STATE, Draft, of, over
from rddl_problem import Expr, Fluent, Policy, Problem

FAMILIES = (grids, places, queues, pointers, machines, networks, control, flows, markets, chances, vehicles, zeros, tours, boards, dice, belts, shapes, rounds)


def generate(seed: int, flavour: str = "plain") -> Problem:
    """One to three families, which read each other's fluents."""
    draft = Draft(seed, flavour)
    count = 1 if draft.scale[0] > 30 else draft.pick([1, 2, 2, 3])
    for family in draft.rng.sample(FAMILIES, count):
        family.add(draft)
    problem = draft.problem
    problem.reward = of("real", "(" + " + ".join(["%s"] * len(draft.rewards)) + " + 0.0)", *draft.rewards)
    problem.horizon = draft.pick([5, 20, 40])
    if draft.chance(0.3):
        add_observations(draft)
    if draft.flavour.wild and draft.chance(0.15):
        add_policy(draft)
    elif any(f.role == ACTION for f in problem.fluents) and draft.chance(0.3):
        problem.max_nondef_actions = str(draft.rng.randint(1, 3))
    if draft.flavour.wild and draft.flavour.draws and draft.chance(0.2):
        draw_initial_values(draft)
    return problem


def add_observations(draft: Draft) -> None:
    """Some states are seen, one by one or in sum."""
    states = [f for f in draft.problem.fluents if f.role == STATE]
    for state in draft.rng.sample(states, min(len(states), draft.pick([1, 2]))):
        variables = tuple(f"?v{i}" for i in range(len(state.parameters)))
        seen = draft.at(state, *variables, prime=True)
        scope = dict(zip(variables, state.parameters))
        if len(variables) == 1 and state.range in ("bool", "int", "real") and draft.chance(0.4):
            scope, seen = {}, over("sum", "?v0", state.parameters[0], seen)
        draft.observe(f"seen-{state.name}", scope, seen)


def add_policy(draft: Draft) -> None:
    """Acts by what it sees."""
    policy = Policy()
    seen = OBSERVATION if any(f.role == OBSERVATION for f in draft.problem.fluents) else STATE
    for action in [f for f in draft.problem.fluents if f.role == ACTION]:
        variables = {f"?v{i}": p for i, p in enumerate(action.parameters)}
        policy.cpfs[action.name] = (tuple(variables), action_of_policy(draft, action, variables, seen))
    draft.problem.policy = policy


def action_of_policy(draft: Draft, action: Fluent, variables: dict[str, str], seen: str) -> Expr:
    if action.range == "bool":
        return draft.some_bool(variables, (seen,))
    if action.range == "int":
        return of("int", "(if (%s) then 1 else 0)", draft.some_bool(variables, (seen,)))
    if action.range == "real":
        return of("real", "max[-1.0, min[1.0, %s]]", draft.some_real(variables, (seen,)))
    return of(action.range, draft.problem.type(action.range).literal(draft.problem.type(action.range).members[-1]))


def draw_initial_values(draft: Draft) -> None:
    forms = {"bool": "Bernoulli(0.5)", "int": "Poisson(2.0)", "real": "Uniform(-1, 2)"}
    for fluent in draft.problem.fluents:
        if fluent.role == STATE and fluent.range in forms and draft.chance(0.3):
            fluent.values = {o: forms[fluent.range] for o in draft.problem.groundings(fluent) if draft.chance(0.5)}


