"""Rulers along the canvas, and guides drawn out of them.

- ``commands``: the actions.  ``field``: the field on the canvas into which the place of a guide is typed.
- ``places``: a place as people type it.
"""
