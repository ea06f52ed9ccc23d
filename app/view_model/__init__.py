"""Documents turned into arrays to draw. No Qt; of app only ``families`` and ``exchange`` call curvecore, too.

A *knot* is the index of a parameter of the core curve: that of a point, and where the curve is closed one
more at the end, which is the first point again.

A curve:

- ``curve_view``: the view of a document's curve: core curve, polyline, derivatives, or why there is none.
  ``made_curve``: the part of it that is the core's curve, made when it is asked for.
  ``views_ahead``: the views of many, made beside the window.
  ``core_curve``: the core's curve through points at knots.
- ``point_arrays``, ``flattener``: the arrays and polylines that one view hands on to the next.
  ``point_moves``: points that move together while all else rests, as under a drag.
- ``carried_views``: many curves that were moved, turned or mapped whole.  ``carry``: the map of one.
- ``jets``, ``handles``: derivatives set and estimated; the Bézier control points by which they are dragged.
- ``basis_view``, ``cardinal_view``: basis and cardinal functions sampled for the basis panel.
- ``basis_findings``: what is wrong with the functions and what is to be known, in sentences.
- ``cardinals``, ``growth``: cardinal functions, estimates included; the growth of errors of points.
- ``parameter_slopes``: the effect of a parameter, estimates included.
- ``refusals``: the reasons for having no curve, in the program's words.
- ``nearest``, ``arc_lengths``: the point nearest to a place; lengths to a relative accuracy.
- ``plane``, ``sampling``: vectors of the plane; parameters all along a curve.
  ``fills``: insides of outlines.  ``clips``: of what cuts them, and
  ``clipping``: set and taken off.

A curve changed:

- ``bend``: the curve pulled somewhere.  ``hold``: the data that give way.  ``bend_together``: a pull divided.
- ``cutting_out``: segments deleted.  ``retracting``: handles retracted.
- ``deleting``: points deleted with the shape kept.  ``segment_fit``: one segment for several.
  ``wanted``: derivatives set where rules estimate others.  ``rounded``: corners made arcs.
  ``corner_arc``, ``touching_arc``: arcs between straight sides, and beside curved ones.  ``curve_with_arcs``:
  the curve with them.
- ``appending``: points appended, curves closed, and the curve as it would be with a point more.
  ``pen_corners``: the same with corners.
- ``formed``: what curves are still of the rectangle, the ellipse that they were drawn as.
- ``convert``: the same curve as one of another family.  ``least_squares``: fewer points for nearly the same.
- ``reshape``, ``splitting``, ``joining``: other points for the same curve, two curves of one, one of several.
  ``smoothness``, ``straight``: smooth points and corners, straight segments.  ``point_kinds``: the kinds of
  points.  ``midpoints``: a point more in the middle of segments.  ``measure``: the change of shape.
- ``least_squares``: curves of few points near many.
- ``regions``: boolean operations on shapes.  ``stroke_shapes``: larger and smaller ones, strokes as shapes.
  ``cubics``, ``cubic_joints``: curves as cubic pieces, and back.
- ``bounds``: the box of points or curves.  ``exact_boxes``: those of many curves at once.
  ``stroked``: with strokes.  ``markers``: what stands at their ends.
  ``stretch``: what fills another.
- ``fixed_point``: equations whose values take a while.  ``shape_boxes``: the box of a whole shape.
  ``resizing``: a width, a height.  ``alignment``: curves by theirs.  ``pivot``: the place that transforms are
  about, and what they did.  ``last_transform``: the last of them, done again.
  ``copies``: many in a circle or a row.
- ``pasting``: points carried from one curve to another.  ``arrivals``: curves from elsewhere.
- ``point_columns``: the columns of the point table.

Beside the curve:

- ``motion``, ``motion_settings``: a dot that runs along it.  ``motion_picture``: its picture.
- ``analysis``: overlays, plots, joints, the laboratory, cures.
- ``goals``: the goals of lessons.
- ``line_styles``, ``palette``: the look of lines and marks; the colours of points.
- ``records``: registries that read their records off the modules of a package.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
