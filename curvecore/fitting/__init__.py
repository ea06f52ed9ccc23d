"""Least squares: curves of few points near many.

- ``least_squares``: the curve of given joints that is nearest to data with given parameters: one linear
  problem, for any family.
- ``joints``: where the joints of such a curve should be: corners of the data, shares of the error.
- ``fit``: both, and the parameters of the data, round after round: so many points, or a tolerance.
"""
