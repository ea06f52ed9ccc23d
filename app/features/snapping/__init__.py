"""Snapping, the grid's spacing and the unit.

- ``commands``: the actions.
"""
