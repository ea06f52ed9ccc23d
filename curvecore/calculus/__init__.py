"""Derivatives, integrals and equations of curves, and their way to SciPy.

- ``methods``: the methods of `ParametricCurve`, which call what is below, imported when first used.
- ``derivative``: `Derivative` and `Antiderivative`: both are curves, linear in the same data.
- ``integrals``: Gauss-Legendre quadrature between breaks.
- ``solutions``: parameters at which a coordinate has a value.
- ``scipy_objects``: ``BPoly`` and ``PPoly``; the one module that imports SciPy, in its functions.
"""

from curvecore.late_names import late_names

__getattr__, __dir__, __all__ = late_names(__name__, __file__)
