"""Whole curves: new, join, split, reverse, close, name and order.

- ``commands``: the actions.
"""
