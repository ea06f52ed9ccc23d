"""Transforms of points and curves: move, scale, rotate, align, distribute.

- ``commands``: the actions.
"""
