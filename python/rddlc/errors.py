"""Errors that rddlc raises. All are `Error`s."""

from ._native import ArgumentError, CompileError, Error

for each in ArgumentError, CompileError, Error:
    each.__module__ = "rddlc"

__all__ = ["ActionError", "ArgumentError", "CompileError", "Error", "EpisodeOver"]


class ActionError(Error):
    """An action that cannot be; nothing has been changed by it."""


class EpisodeOver(Error):
    """A step after the end of an episode."""
