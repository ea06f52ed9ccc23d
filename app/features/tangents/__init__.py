"""Kinds of points: corner, smooth, symmetric, estimated; straight segments, velocities pulled out.

- ``commands``: the actions.
"""
