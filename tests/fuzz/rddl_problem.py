"""A problem as data: what the generator makes, what is written as RDDL, what reduction shrinks."""

import itertools
import re
from dataclasses import dataclass, field

UNSURE = 999  # fraction bits of a real whose last digits depend on rounding


@dataclass(frozen=True)
class Expr:
    """An expression, and facts about its value.

    Reals of which few bits are in use are computed without rounding, so that they must be equal
    everywhere; magnitude and fraction say how many.
    """

    kind: str  # bool, int, real or the name of a type
    form: str  # RDDL with a %s for each part
    parts: tuple["Expr", ...] = ()
    magnitude: int = 1  # bits before the point
    fraction: int = 0  # bits behind it
    finite: bool = True

    def __str__(self) -> str:
        return self.form % self.parts

    def is_exact(self) -> bool:
        return self.magnitude + self.fraction <= 50

    def all(self):
        """This and everything below."""
        yield self
        for part in self.parts:
            yield from part.all()

    def bound_variables(self) -> frozenset[str]:
        """Variables that the expression itself binds: the binder is a part of its form."""
        return frozenset(variables_in(self.form)) if "_{" in self.form else frozenset()

    def free_variables(self) -> frozenset[str]:
        inside = frozenset().union(*(part.free_variables() for part in self.parts))
        if bound := self.bound_variables():
            return inside - bound
        return inside | frozenset(variables_in(self.form))

    def names(self) -> set[str]:
        """Fluents, with their primes; also other words."""
        return set(re.findall(r"(?<![?@\w])[A-Za-z](?:[\w-]*[A-Za-z0-9])?'?", str(self)))


@dataclass
class Type:
    name: str
    enumerated: bool
    members: list[str]  # without @

    def literal(self, member: str) -> str:
        return "@" + member if self.enumerated else member


@dataclass
class Fluent:
    name: str
    role: str  # state-fluent, ...
    range: str
    parameters: tuple[str, ...] = ()
    default: str | None = None
    values: dict[tuple[str, ...], str] = field(default_factory=dict)  # in the instance
    # Properties of all its values, at all times.
    magnitude: int = 6
    fraction: int = 2
    finite: bool = True

    def is_exact(self) -> bool:
        return self.magnitude + self.fraction <= 50


@dataclass
class Policy:
    """A policy block, whose fluents are its own."""

    fluents: list[Fluent] = field(default_factory=list)
    cpfs: dict[str, tuple[tuple[str, ...], Expr]] = field(default_factory=dict)

    def text(self) -> str:
        lines = ["policy p {", "    pvariables {"]
        lines += ["        " + declaration(fluent) for fluent in self.fluents]
        lines += ["    };", "    cpfs {", *definitions(self.cpfs), "    };", "}", ""]
        return "\n".join(lines)


@dataclass
class Problem:
    flavour: str = "plain"  # generate.py
    name: str = "i"  # of the instance
    types: list[Type] = field(default_factory=list)
    fluents: list[Fluent] = field(default_factory=list)
    cpfs: dict[str, tuple[tuple[str, ...], Expr]] = field(default_factory=dict)  # left-hand side
    reward: Expr = Expr("int", "0")
    preconditions: list[Expr] = field(default_factory=list)
    invariants: list[Expr] = field(default_factory=list)
    terminations: list[Expr] = field(default_factory=list)
    horizon: int = 20
    max_nondef_actions: str = "pos-inf"
    policy: Policy | None = None

    def type(self, name: str) -> Type | None:
        return next((t for t in self.types if t.name == name), None)

    def fluent(self, name: str) -> Fluent:
        own = self.policy.fluents if self.policy else []
        return next(f for f in (*self.fluents, *own) if f.name == name)

    def groundings(self, fluent: Fluent):
        members = [self.type(parameter).members for parameter in fluent.parameters]
        return itertools.product(*members)

    def expressions(self) -> list[Expr]:
        own = self.policy.cpfs if self.policy else {}
        cpfs = [body for _, body in (*self.cpfs.values(), *own.values())]
        return cpfs + [self.reward] + self.preconditions + self.invariants + self.terminations

    def text(self) -> str:
        """Domain and instance in one."""
        return self.domain_text() + self.instance_text() + self.policy_text()

    def policy_text(self) -> str:
        return self.policy.text() if self.policy else ""

    def domain_text(self) -> str:
        enumerated = [t for t in self.types if t.enumerated]
        objects = [t for t in self.types if not t.enumerated]
        lines = ["domain fuzz {", "    types {"]
        lines += [f"        {t.name} : object;" for t in objects]
        for t in enumerated:
            lines.append(f"        {t.name} : {{ {', '.join('@' + m for m in t.members)} }};")
        lines += ["    };", "    pvariables {"]
        lines += ["        " + declaration(fluent) for fluent in self.fluents]
        lines += ["    };", "    cpfs {", *definitions(self.cpfs)]
        lines += ["    };", f"    reward = {self.reward};"]
        for block, conditions in (
            ("action-preconditions", self.preconditions),
            ("state-invariants", self.invariants),
            ("termination", self.terminations),
        ):
            if conditions:
                lines += [f"    {block} {{", *(f"        {c};" for c in conditions), "    };"]
        return "\n".join([*lines, "}", ""])

    def instance_text(self) -> str:
        objects = [t for t in self.types if not t.enumerated]
        lines = ["non-fluents nf {", "    domain = fuzz;"]
        if objects:
            lists = [f"{t.name} : {{ {', '.join(t.members)} }};" for t in objects]
            lines.append(f"    objects {{ {' '.join(lists)} }};")
        lines += self._values("non-fluents", "non-fluent")
        lines += ["}", f"instance {self.name} {{", "    domain = fuzz;", "    non-fluents = nf;"]
        lines += self._values("init-state", "state-fluent")
        lines += [f"    max-nondef-actions = {self.max_nondef_actions};"]
        lines += [f"    horizon = {self.horizon};", "    discount = 0.9;", "}", ""]
        return "\n".join(lines)

    def _values(self, block: str, role: str) -> list[str]:
        lines = []
        for fluent in self.fluents:
            if fluent.role == role:
                types = [self.type(parameter) for parameter in fluent.parameters]
                for objects, value in fluent.values.items():
                    arguments = ", ".join(t.literal(o) for t, o in zip(types, objects))
                    head = f"{fluent.name}({arguments})" if objects else fluent.name
                    lines.append(f"        {head} = {value};")
        return [f"    {block} {{", *lines, "    };"] if lines else []


def definitions(cpfs: dict[str, tuple[tuple[str, ...], Expr]]) -> list[str]:
    lines = []
    for name, (parameters, body) in cpfs.items():
        head = f"{name}({', '.join(parameters)})" if parameters else name
        lines.append(f"        {head} = {body};")
    return lines


def declaration(fluent: Fluent) -> str:
    parameters = f"({', '.join(fluent.parameters)})" if fluent.parameters else ""
    default = f", default = {fluent.default}" if fluent.default is not None else ""
    return f"{fluent.name}{parameters} : {{ {fluent.role}, {fluent.range}{default} }};"


def work_of(expr: Expr, problem: Problem) -> int:
    """Operations of one evaluation, about."""
    inside = sum(work_of(part, problem) for part in expr.parts)
    if "_{" not in expr.form:
        return 1 + inside
    for type_ in re.findall(r"\?[\w-]+ : ([\w-]+)", expr.form):
        inside *= len(problem.type(type_).members)
    return 1 + inside


def variables_in(text: str) -> set[str]:
    return set(re.findall(r"\?[A-Za-z0-9_-]+", text))


def names_in(text: str) -> set[str]:
    """Fluents by name, primes removed."""
    return set(re.findall(r"(?<![?@\w])[A-Za-z](?:[\w-]*[A-Za-z0-9])?", text))
