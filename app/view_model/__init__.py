"""Documents turned into arrays to draw. No Qt; otherwise only ``families`` and ``exchange`` call curvecore.

A *knot* is the index of a parameter of the core curve: that of a point, and where the curve is closed one
more at the end, which is the first point again.

- ``curve``: the view of a curve, and what changes while it moves; begin here.
- ``geometry``: vectors, parameters along a curve, insides of outlines.
- ``arc_lengths``: lengths of curves.  ``extents``: of cubic pieces, and of strokes.
- ``line_styles``, ``palette``: the look of lines and marks; colours of papers, curves and points.
- ``registry``: registries that read their records off the modules of a package.  ``settings``: settings that
  an overlay or a tool owns.

What a drag does to curves:

- ``bend``: the curve pulled somewhere.
- ``boxes``: the box of points or curves.  ``pivot``: the centre of transforms, and what they did.
  ``resize``: a box stretched, a width or a height given.  ``align``: curves aligned by their boxes.

Curves made of curves:

- ``reshape``: other points for the same curve.  ``convert``: the same curve as one of another family.
- ``fit``: curves of few points near others.  ``cubics``: cubic pieces as the points of a curve.
- ``split``, ``join``: two curves of one, one of several.  ``paste``: points and curves from elsewhere.
- ``append``, ``delete``: points appended, inserted and deleted.
- ``point_kinds``: corners, smooth points and straight segments.  ``match_curvature``: continuous curvature.
- ``point_columns``: columns of the point table.

What is said and shown of a curve:

- ``basis``: basis and cardinal functions, and the growth of errors.  ``basis_findings``: remarks on them.
- ``analysis``: overlays, plots, joints, the laboratory, warnings, the goals of lessons.
- ``motion``, ``motion_settings``: a dot that runs along the curve.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
