"""The families of curves: one file from the formula to the bounds of its errors.

- ``curve``: the base class: what a family must say, what it may say, and what callers get.
- ``defaults``: what a family may override, each method with its default, and the results.
- ``immutable``: equality, copies and pickles of curves.  ``setting``: settings of a family.
- ``lagrange``: the interpolating polynomial.  ``products``: the faster way to its functions.
- ``hermite``: cubic, quintic and septic Hermite curves.  ``hermite_basis``: their functions, factored.
  ``hermite_taylor``: their expansions, the fastest way to many values.
- ``cubic_spline``: the twice continuously differentiable spline, with the system for its second derivatives.
- ``floater_hormann``: barycentric rational interpolation.
- ``bezier_curve``, ``b_spline``: curves over control points, which they do not pass.
- ``basis_curve``: a curve of any basis functions.
- ``chain``: curves end to end: corners.
- ``same_shape``: the data that write a curve of one family as one of another.

To add a family:

1. Write a file here with a class derived from `ParametricCurve`: its ``name`` (files store it), its ``title``
   (people read it) and ``_basis(t, order)``, the basis functions of the shape (m, n), or (m, n, R) where
   points have derivatives. Start from ``tests/data/families/cardinal_spline.py``, which has a setting of real
   numbers.
2. Say ``breaks`` where derivatives jump, ``degree`` where pieces are polynomials, ``interpolates = False``
   where the curve passes beside its points, ``can_close`` and ``is_local`` where they hold. Drawing, lengths,
   derivatives, exports and errors follow.
3. Override methods of ``defaults`` where the family knows a faster or an exact way.

Modules of this package are found by listing: menus, toolbar, tables and tests have the family from then on.
Who imports the class from `curvecore` needs its name in ``curvecore/__init__.pyi``.
"""
