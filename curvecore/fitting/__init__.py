"""Least squares: curves of few points near many.

- ``least_squares``: the curve of given joints that is nearest to data with given parameters: one linear
  problem, for any family.
- ``linear_system``: how that is solved.  ``joints``: where the joints of such a curve should be: corners of
  the data, shares of the error.  ``feet``: where on a curve data belong.
- ``fitter``: a curve of so many points: all of these, round after round.
- ``search``: the fewest points within a tolerance.  ``fit``: the door to both.  ``records``: data, results.
"""
