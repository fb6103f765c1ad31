"""What rddlc raises. All are `Error`s."""

from ._native import CompileError, Error

__all__ = ["ActionError", "ArgumentError", "CompileError", "Error", "EpisodeOver"]


class ArgumentError(Error, ValueError, TypeError):
    """An argument that cannot be, or a name that does not exist; nothing has been changed by it. It is
    one of Python's own errors, too, for programs that catch these."""


class ActionError(Error):
    """An action that cannot be; nothing has been changed by it."""


class EpisodeOver(Error):
    """A step after the end of an episode."""
