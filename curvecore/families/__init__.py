"""The families of curves, one file each.

- ``curve``: the base class of all of them; what follows from basis functions and breaks.
- ``lagrange``, ``hermite``, ``quintic_hermite``: the built-in families.
- ``basis_curve``: a curve of which nothing is known but its basis functions.
- ``chain``: curves end to end: corners.
- ``piecewise_hermite``, ``hermite_basis``, ``hermite_ends``: what the Hermite families share; their cardinal
  polynomials, factored; what follows from the jets at both ends of a segment.
- ``product_form``, ``product_series``: the Lagrange basis as products, accurate on any nodes; its
  derivatives, as products of power series.  ``nodal_derivatives``: those of a polynomial, by a short cut.
- ``immutable``: what copies and pickles of curves are.
"""
