"""Updates of curves while a point, derivative or parameter moves, as under a hand: what stays is kept.

- ``frozen_samples``: polylines while points move and parameters stay.
- ``frozen_segments``: the same for curves of Bezier pieces, whatever moves.
- ``moved_points``: polylines while some of the points move together, and nothing else.
- ``moved_parameters``: Lagrange functions after a few parameters moved.
- ``left_out``: Lagrange curves of which a few points are left out and put back elsewhere.
"""
