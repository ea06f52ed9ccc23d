"""Shapes with an inside: boolean operations, larger and smaller ones, and the cubic pieces they are made of.

- ``regions``: boolean operations on shapes.  ``stroke_shapes``: larger and smaller ones, strokes as shapes.
- ``cubics``, ``cubic_joints``: curves as cubic pieces, and back.
- ``courses``: how curves run, for texts along them.
- ``clipping``: shapes cut by the outline of the one in front of them, and made whole again.
  ``clip_outlines``: the outlines of such clips as shapes, while they are edited.
- ``simplifying``: curves of fewer points near others.  ``cutting``: lines cut by those in front.
- ``formed``: what curves are still of the rectangle, the ellipse that they were drawn as.
"""
