"""Undo as a list.

- ``commands``: undo and redo, and the list in the window.  ``panel``: the list of steps.
"""
