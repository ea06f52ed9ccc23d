"""The picture to trace.

- ``commands``: add, find again, move and remove it.
- ``panel``: its numbers.  ``controller``: turns what is typed and dragged there into changes.
"""
