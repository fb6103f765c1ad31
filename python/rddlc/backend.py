"""`rddlc.adapters.pyrddlgym`, under the name that programs use."""

from .adapters.pyrddlgym import RDDLSimulator, make

__all__ = ["RDDLSimulator", "make"]
