"""Documents turned into arrays to draw. No Qt; of app only ``families`` and ``exchange`` call curvecore, too.

A *knot* is the index of a parameter of the core curve: that of a point, and where the curve is closed one
more at the end, which is the first point again.

The rooms, each of which imports from those further down alone:

- ``animation``: a dot that runs along a curve.
- ``analysis``: overlays, plots, joints, the laboratory, cures, the goals of lessons.
- ``pieces``: two curves of one, one of several; points and curves from elsewhere.
- ``points``: kinds of points, corners, straight segments; points appended and deleted.
- ``bending``: the curve pulled somewhere.
- ``fitting``: the same curve by other data, exactly or as near as can be.
- ``boxes``: bounds, and what is aligned, stretched and turned by them.
- ``basis``: basis and cardinal functions, and the growth of errors.
- ``curve``: the view of a curve, and what changes while it moves.
- ``stroke_box``: boxes around cubic pieces and stroked lines.  ``arc_lengths``: lengths of curves.
- ``line_styles``, ``palette``: the look of lines and marks; colours of papers, curves and points.
- ``geometry``: vectors, parameters along a curve, insides of outlines.
- ``registry``: registries that read their records off the modules of a package.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
