"""Tangents at points: smooth, corner, straight, estimated, pulled out.

- ``commands``: the actions.
"""
