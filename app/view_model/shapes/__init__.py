"""Clips of shapes.

- ``regions``: the shapes among curves, and what comes in their place.
- ``courses``: how curves run, as cubic pieces.
- ``clipping``: shapes cut by the outline of the one in front of them, and made whole again.
  ``clip_outlines``: the outlines of such clips as shapes, while they are edited.
"""
