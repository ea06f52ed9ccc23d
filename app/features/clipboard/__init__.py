"""Clipboard: points, derivatives and curves.

- ``commands``: the actions.  ``curve_clipboard``: several whole curves.
"""
