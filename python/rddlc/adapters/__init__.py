"""Environments as other libraries take them, whose packages need not be installed."""
