"""Translates between the engine's records and rows of numbers, and the spaces that Gymnasium's
users see."""
