"""Updates of curves while a point, derivative or parameter is dragged, without computing all anew.

- ``frozen``: polylines whose vertices are kept from curve to curve, with and without Bezier pieces.
- ``moved_points``: polylines while some of the points move together, and nothing else.
- ``moved_parameters``: Lagrange curves and basis functions after a few parameters moved.
"""
