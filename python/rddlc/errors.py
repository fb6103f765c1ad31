"""What rddlc raises. All are `Error`s."""

from ._native import CompileError, Error

__all__ = ["ActionError", "CompileError", "Error", "EpisodeOver"]


class ActionError(Error):
    """An action that cannot be; nothing has been changed by it."""


class EpisodeOver(Error):
    """A step after the end of an episode."""
