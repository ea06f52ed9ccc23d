"""The picture to trace.

- ``commands``: add, find again, move and remove it.  ``panel``: its numbers.
"""
