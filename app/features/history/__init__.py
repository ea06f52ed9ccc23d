"""Undo as a list.

- ``panel``: the list of steps.  ``controller``: names the state that it begins with.
"""
