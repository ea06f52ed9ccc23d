"""The families of curves, one file each.

- ``curve``: the base class of all of them: everything follows from basis functions and breaks.
- ``records``: its named results.
- ``part``: its methods in groups.  ``evaluation``: `evaluate` and `basis`: t of any shape, inside the domain
  or not.  ``polynomial_facts``: polynomial pieces.  ``approximating``: points that curves pass by.
  ``parameter_derivatives``: derivatives by the parameters, where a family has no formula.
- ``lagrange``, ``hermite``, ``quintic_hermite``, ``septic_hermite``, ``cubic_spline``: the built-in
  families.
- ``floater_hormann``: barycentric rational interpolation.  ``rational_form``: its basis functions, accurate
  for any parameters.  ``rational_series``: their derivatives.
- ``bezier_curve``, ``b_spline``: curves over control points, which they do not pass.
- ``bernstein_window``: Bezier curves of high degree, by the functions that count.
- ``same_shape``: the data that write a curve of one family as one of another.
- ``basis_curve``: a curve of which nothing is known but its basis functions.
- ``chain``: curves end to end: corners.
- ``piecewise_hermite``, ``hermite_basis``, ``hermite_forms``, ``hermite_ends``: what the Hermite families
  share; their cardinal polynomials, factored, of cubics and quintics, and of any width; derivatives from the
  jets at both ends of a segment.
- ``taylor_pieces``: Hermite segments expanded about the places where one of their
  functions vanishes: fast and accurate derivatives, and values of cubics.
- ``product_form``, ``product_series``: the Lagrange basis as products, accurate for any parameters; its
  derivatives, as products of power series.  ``product_kernels``: values and derivatives up to the
  third, faster.  ``differentiation_matrix``: derivatives by a short cut.
- ``spline_system``: the derivatives of cubic splines at their joints, under conditions at the ends.
- ``setting``: what may be chosen about the functions of a family beside the parameters.
- ``immutable``: copies and pickles of curves.
"""
