"""`rddlc.adapters.skdecide`, under the name that programs use."""

from .adapters.skdecide import (
    RDDLDomain,
    RDDLDomainRL,
    RDDLDomainSimplifiedSpaces,
    RDDLPlanning,
    RDDLSimulation,
)

__all__ = [
    "RDDLDomain",
    "RDDLDomainRL",
    "RDDLDomainSimplifiedSpaces",
    "RDDLPlanning",
    "RDDLSimulation",
]
