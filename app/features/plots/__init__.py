"""Plots over t.

- ``commands``: the actions.
"""
