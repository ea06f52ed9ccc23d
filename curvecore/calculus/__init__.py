"""Derivatives, integrals and equations of curves, and their way to SciPy.

- ``methods``: the methods of `ParametricCurve`, which call what is below, imported when first used.
- ``derivative``, ``antiderivative``: both are curves, linear in the same data (``of_a_curve``).
- ``integrals``: Gauss-Legendre quadrature between breaks.
- ``solutions``: where a coordinate has a value.
- ``polynomials``: curves as piecewise polynomials, and those as curves.
- ``scipy_objects``: ``BPoly`` and ``PPoly``; the one module that imports SciPy, in its functions.
"""

from curvecore.late_names import late_names

__getattr__, __dir__, __all__ = late_names(__name__, __file__)
