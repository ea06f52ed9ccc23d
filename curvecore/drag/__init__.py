"""Updates of curves while one datum moves, as under a hand: what stays is not computed again.

- ``frozen_samples``: polylines while points move and parameters stay.
- ``frozen_segments``: the same for curves of Bezier pieces, whatever moves.
- ``moved_parameters``: Lagrange functions after a few parameters moved.
- ``left_out``: the curve then: some points left out and put back elsewhere.
"""
