"""Undo as a list.

- ``commands``: the list in the window.
- ``panel``: the list of steps.  ``controller``: names the state that it begins with.
"""
