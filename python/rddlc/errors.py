"""Errors that rddlc raises.

Error: the base of all of them
CompileError: a mistake in RDDL files, in the compiler's words: file, line, caret and hint
ArgumentError: an argument that cannot be; also a `ValueError` and a `TypeError`
"""

from ._native import ArgumentError, CompileError, Error

for each in ArgumentError, CompileError, Error:
    each.__module__ = "rddlc"

__all__ = ["ActionError", "ArgumentError", "CompileError", "Error", "EpisodeOver"]


class ActionError(Error):
    """An action that cannot be; nothing has been changed by it."""


class EpisodeOver(Error):
    """A step after the end of an episode."""
