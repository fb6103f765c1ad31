"""`rddlc.adapters.sb3`, under the name that programs use."""

from .adapters.sb3 import VecEnv, make, make_vec, takes_actions

__all__ = ["VecEnv", "make", "make_vec", "takes_actions"]
