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
   points have derivatives. Start from a copy of ``tests/data/families/cardinal_spline.py``. A file of this
   package imports from modules (``curvecore.families.curve``), never from `curvecore`, which imports them.
2. Say the ``rank`` in menus: above 80, or the number keys of later families change. The ninth family gets the
   key 9, those from the tenth on none; ``resources/manual/09_keyboard.md`` lists the keys.
3. Say ``full_title`` where the title is not clear by itself ("cubic Hermite"), ``short_title`` where its
   first word is no good short name, and ``settings``, numbers or choices that the functions depend on
   (`FamilySetting`; ``chosen`` has the values, a number as ``float(self.chosen["tension"])``).
4. Say ``breaks`` where derivatives jump, ``degree`` where pieces are polynomials, ``interpolates = False``
   where the curve passes beside its points, ``can_close`` and ``is_local`` where they hold. Drawing, lengths,
   derivatives, exports and errors follow.
5. Override methods of ``defaults`` where the family knows a faster or an exact way.
6. Add its row to the README, in order of rank, an icon ``resources/icons/NAME.svg`` (hyphens for underscores;
   without one it has that of splines) and, for who imports the class from `curvecore`, its name to
   ``curvecore/__init__.pyi`` and the file to the list above.

Modules of this package are found by listing: menus, toolbar, tables and tests have the family from then on.
Tests over all families are ``test_families.py`` and ``test_fitting.py`` in ``tests/core`` (its `LIMITS` are
stricter for families named there), every ``test_any_family.py`` and most of ``tests/exchange``. A family that
passes beside its points needs its functions, computed by another method, in `TRUE_BASIS` of
``tests/own_families.py``. For its formulas copy ``tests/core/test_cubic_spline.py``, for settings
``tests/families/test_settings.py`` and ``tests/gui/test_family_settings.py``.
"""
