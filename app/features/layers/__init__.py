"""Layers: the one that new curves come into, and what is done to layers as such.

- ``commands``: the actions.
"""
