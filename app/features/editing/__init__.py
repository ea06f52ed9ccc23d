"""Editing of points, families and parameters.

- ``commands``: the actions.
"""
