"""The view of a document's curve: core curve, polyline, derivatives, and their changes while it moves.

- ``curve_view``: the view of one curve; begin here.
- ``core_curve``: the core's curve through the points, its derivatives and cardinal functions, refusals.
- ``point_arrays``: the numbers in the points as arrays, which one view hands on to the next.
- ``moving``: polylines of a curve that changes.  ``transformed``: views of many curves that were mapped.
- ``handles``: the Bézier control points by which derivatives are dragged.
- ``distances``: the nearest point of a curve; the distance of two curves.
- ``rounded_parameters``: the effect of the rounding of parameters that a rule gives.
"""
