"""The picture to trace.

- ``commands``: the panel with its numbers; actions that add, find, move and remove it.
"""
