"""Errors that rddlc raises. All are `Error`s."""

from ._native import CompileError, Error

__all__ = ["ActionError", "ArgumentError", "CompileError", "Error", "EpisodeOver"]


class ArgumentError(Error, ValueError, TypeError):
    """An impossible argument, or a name that does not exist; it has changed nothing. It is also one
    of Python's own errors, for programs that catch these."""


class ActionError(Error):
    """An action that cannot be; nothing has been changed by it."""


class EpisodeOver(Error):
    """A step after the end of an episode."""
