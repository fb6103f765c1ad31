"""The parts of a problem: types, fluents, conditions."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

Source = tuple[str, int, int]
"""File, line and column (both from 1) of the RDDL text."""


@dataclass(frozen=True)
class ObjectType:
    """A type of objects. `enumerated`: its members stand in the domain, not in the instance."""

    name: str
    objects: tuple[str, ...]
    enumerated: bool


@dataclass(frozen=True, eq=False)
class Fluent:
    """A pvariable. Values of objects are their indices into `objects`."""

    index: int
    name: str
    role: str
    """"state-fluent", "action-fluent", "observ-fluent", "interm-fluent", "derived-fluent" or
    "non-fluent"."""
    scalar: str
    """The storage of values: "bool", "int" (also objects) or "real"."""
    range: str
    """"bool", "int", "real" or the name of a type of objects."""
    objects: tuple[str, ...] | None
    """Names of the values, if they are objects."""
    parameters: tuple[ObjectType, ...]
    lower: NDArray[np.float64] | None
    """Bounds from the constraints, of `shape`: -inf for a missing bound. None: not a number."""
    upper: NDArray[np.float64] | None
    source: Source
    offset: int
    """The offset in its record, in bytes; -1: it is in no record."""

    @property
    def shape(self) -> tuple[int, ...]:
        """An axis for each parameter, as long as its type has objects."""
        return tuple(len(parameter.objects) for parameter in self.parameters)

    @property
    def count(self) -> int:
        """How many values it has."""
        return math.prod(self.shape)

    @cached_property
    def groundings(self) -> tuple[str, ...]:
        """Names of its values, row-major: "rlevel___t1", as pyRDDLGym has them."""
        if not self.parameters:
            return (self.name,)
        objects = product(*(parameter.objects for parameter in self.parameters))
        return tuple(f"{self.name}___{'__'.join(each)}" for each in objects)


@dataclass(frozen=True)
class Condition:
    """A constraint, by its text."""

    text: str
    source: Source


# Attributes of pyRDDLGym's env.model that programs ask for, and the place where ours has each.
OF_PYRDDLGYM = {
    "state_fluents": "states",
    "action_fluents": "actions",
    "observ_fluents": "observed",
    "non_fluents": "with_role('non-fluent'), and env.problem.constants(name)",
    "interm_fluents": "with_role('interm-fluent')",
    "derived_fluents": "with_role('derived-fluent')",
    "type_to_objects": "types[...].objects",
    "domain_name": "domain",
    "instance_name": "instance",
    "variable_ranges": "fluents[...].range",
    "variable_types": "fluents[...].role",
    "variable_params": "fluents[...].parameters",
    "variable_groundings": "fluents[...].groundings",
}


@dataclass(frozen=True, eq=False)
class Model:
    """A problem as its instance describes it."""

    domain: str
    instance: str
    types: dict[str, ObjectType]
    fluents: dict[str, Fluent]
    """The fluents in declaration order."""
    horizon: int
    """Steps; 0: no horizon."""
    discount: float
    max_nondef_actions: int
    """How many action values may differ from their default; -1: all."""
    partially_observed: bool
    stochastic: bool
    """Whether anything is drawn at random."""
    preconditions: tuple[Condition, ...]
    invariants: tuple[Condition, ...]
    terminations: tuple[Condition, ...]
    state_size: int
    """Bytes of a record."""
    action_size: int
    observation_size: int

    if not TYPE_CHECKING:  # type checkers report what is missing by themselves

        def __getattr__(self, name: str) -> Any:
            ours = f"model.{OF_PYRDDLGYM[name]} has it; " if name in OF_PYRDDLGYM else ""
            theirs = "environments of rddlc.backend.make have pyRDDLGym's own model"
            raise AttributeError(f"rddlc's model has no '{name}'; {ours}{theirs}", name=name, obj=self)

    def with_role(self, role: str) -> list[Fluent]:
        """Fluents of a role, in declaration order."""
        return [fluent for fluent in self.fluents.values() if fluent.role == role]

    @property
    def states(self) -> list[Fluent]:
        return self.with_role("state-fluent")

    @property
    def actions(self) -> list[Fluent]:
        return self.with_role("action-fluent")

    @property
    def observed(self) -> list[Fluent]:
        """The fluents that an environment shows: observ-fluents if there are any, else
        state-fluents."""
        return self.with_role("observ-fluent") if self.partially_observed else self.states

    @property
    def limited_actions(self) -> int | None:
        """How many action values may differ from their default, if not all of them may."""
        limit = self.max_allowed_actions
        return limit if limit < sum(fluent.count for fluent in self.actions) else None

    @property
    def max_allowed_actions(self) -> int:
        """How many action values may differ from their default."""
        count = sum(fluent.count for fluent in self.actions)
        return min(self.max_nondef_actions, count) if self.max_nondef_actions >= 0 else count


def model_of(described: dict[str, Any]) -> Model:
    """Makes the model from a simulator's `describe()`."""
    types = {each["name"]: ObjectType(**each) for each in described.pop("types")}
    conditions: dict[str, Any] = {
        kind: tuple(Condition(*each) for each in described.pop(kind))
        for kind in ("preconditions", "invariants", "terminations")
    }
    fluents = [_fluent_of(each, types) for each in described.pop("fluents")]
    return Model(types=types, fluents={each.name: each for each in fluents}, **conditions, **described)


def _fluent_of(described: dict[str, Any], types: dict[str, ObjectType]) -> Fluent:
    described.pop("count")
    parameters = tuple(types[name] for name in described.pop("parameters"))
    shape = tuple(len(each.objects) for each in parameters)
    bounds: dict[str, Any] = {
        which: None if (values := described.pop(which)) is None else np.reshape(values, shape)
        for which in ("lower", "upper")
    }
    objects = types[described["range"]].objects if described["range"] in types else None
    return Fluent(parameters=parameters, objects=objects, **bounds, **described)
