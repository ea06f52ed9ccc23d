"""The view of a document's curve: core curve, polyline, derivatives, and what changes while it moves.

- ``curve_view``: the view of a document's curve: core curve, polyline, derivatives, or why there is none.
  ``made_curve``: the part of it that is the core's curve, made when it is asked for.
  ``views_ahead``: the views of many, made beside the window.
- ``core_curve``: the core's curve through points at knots.
- ``point_arrays``, ``flattener``: the arrays and polylines that one view hands on to the next.
  ``point_moves``: points that move together while all else rests, as under a drag.
- ``carried_views``: many curves that were moved, turned or mapped whole.
- ``jets``, ``handles``: derivatives set and estimated; the Bézier control points by which they are dragged.
  ``handle_arms``: these as values.
- ``cardinals``: cardinal functions, estimates included.
- ``rounded_parameters``: the effect of the rounding of parameters that a rule gives.
- ``refusals``: the reasons for having no curve, in the program's words.
- ``nearest``: the point nearest to a place.  ``measure``: the distance of two curves.
"""
