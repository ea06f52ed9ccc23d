"""Shapes, and the cubic pieces they are made of.

- ``regions``: the shapes among curves, and what comes in their place.
- ``cubics``, ``cubic_joints``: curves as cubic pieces, and back.
- ``courses``: how curves run, as cubic pieces.
- ``clipping``: shapes cut by the outline of the one in front of them, and made whole again.
  ``clip_outlines``: the outlines of such clips as shapes, while they are edited.
- ``simplifying``: curves of fewer points near others.
"""
