"""The families of curves, one file each.

- ``curve``: the base class of all of them: everything follows from basis functions and breaks.
- ``lagrange``, ``hermite``, ``quintic_hermite``, ``septic_hermite``: the built-in families.
- ``basis_curve``: a curve of which nothing is known but its basis functions.
- ``chain``: curves end to end: corners.
- ``piecewise_hermite``, ``hermite_basis``, ``hermite_forms``, ``hermite_ends``: what the Hermite families
  share; their cardinal polynomials, factored, of cubics and quintics, and of any width; derivatives from the
  jets at both ends of a segment.
- ``product_form``, ``product_series``: the Lagrange basis as products, accurate for any parameters; its
  derivatives, as products of power series.  ``differentiation_matrix``: the same by a short cut.
- ``parameter_differences``: derivatives by the parameters, where a family has no formula.
- ``setting``: what may be chosen about the functions of a family beside the parameters.
- ``immutable``: copies and pickles of curves.
"""
