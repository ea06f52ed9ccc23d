"""Least squares: curves of few points near many.

- ``fit``: a curve of so many points, or of the fewest within a tolerance: start here.
- ``fitter``: a curve of so many points: parameters and joints follow it, round after round.
- ``least_squares``: the curve of given joints that is nearest to data with given parameters: one linear
  problem, for any family.
- ``joints``: where the joints of such a curve should be: corners of the data, shares of the error.
- ``records``: data, results.
"""
