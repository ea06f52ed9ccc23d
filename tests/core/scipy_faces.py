"""Curves behind the face of SciPy's interpolators: adapters through which SciPy's own tests try them.

A face does what the library leaves to its user: it puts the axis of the data first and back, sorts nodes, and
translates what a constructor of SciPy's takes into a curve of curvecore. Everything computed is the curve's.
"""

import numpy as np

from curvecore import (
    CubicSplineCurve,
    CurveError,
    FloaterHormannCurve,
    HermiteCurve,
    LagrangeCurve,
    akima_velocities,
    monotone_velocities,
)


class Face:
    """Values of any shape along an axis, as a curve of as many coordinates."""

    extrapolates = True

    def __init__(self, x, y, *more, axis=0, extrapolate=None):
        self.x, y = np.asarray(x), np.asarray(y, dtype=float)
        self.axis = axis % max(y.ndim, 1)
        self.extrapolate = self.extrapolates if extrapolate is None else extrapolate
        values = np.moveaxis(y, self.axis, 0) if y.ndim else y
        self.shape = values.shape[1:]
        self.curve = self._curve(
            self.x, *(self._rows(np.moveaxis(np.asarray(each), self.axis, 0)) for each in (y, *more))
        )

    def _rows(self, values):
        """The values as points; where there are none one coordinate of 0, for a curve has one at least."""
        rows = values.reshape(len(values), -1) if values.size else np.zeros((len(values), 1))
        self.is_empty = not values.size
        return rows

    def _curve(self, x, *data):
        raise NotImplementedError

    def _of(self, curve):
        """The same face of another curve."""
        face = object.__new__(Face)
        face.__dict__.update(self.__dict__, curve=curve)
        return face

    def __call__(self, x, nu=0, extrapolate=None):
        x = np.asarray(x)
        values = self.curve(x, nu, self.extrapolate if extrapolate is None else extrapolate)
        return self._shaped(values[..., : 0 if self.is_empty else None], x.ndim)

    def _shaped(self, values, ndim, leading=0):
        """Values of shape (*leading, *x, dim) as (*leading, *before the axis, *x, *behind it)."""
        values = values.reshape(values.shape[:-1] + self.shape)
        first = leading + ndim
        before = range(first, first + self.axis)
        order = [*range(leading), *before, *range(leading, first), *range(first + self.axis, values.ndim)]
        return values.transpose(order)

    def derivative(self, nu=1):
        return self._of(self.curve.derivative(nu))

    def antiderivative(self, nu=1):
        return self._of(self.curve.antiderivative(nu))

    def roots(self):
        return self.curve.roots()

    @property
    def c(self):
        found = self.curve.to_ppoly().c
        return found.reshape(*found.shape[:2], *self.shape)


class PolynomialFace(Face):
    """KroghInterpolator and BarycentricInterpolator: nodes in any order, derivatives in rows."""

    def __init__(self, xi, yi=None, axis=0, *, rng=None, random_state=None):
        self.xi = np.asarray(xi)
        self.yi = np.zeros(self.xi.shape) if yi is None else np.asarray(yi)
        self.n = len(self.xi)
        try:
            super().__init__(self.xi, self.yi, axis=axis)
        except CurveError as problem:
            raise ValueError("Interpolation points xi must be distinct.") from problem

    def _curve(self, x, y):
        self._order = np.argsort(x)
        return LagrangeCurve(y[self._order], x[self._order])

    @property
    def wi(self):
        """The barycentric weights, of which only ratios count."""
        return self.curve.weight_ratios(0)[np.argsort(self._order)]

    def derivatives(self, x, der=None):
        x = np.asarray(x)
        orders = range(self.n if der is None else der)
        rows = np.stack([self.curve(x, order) for order in orders])
        return self._shaped(rows[..., : 0 if self.is_empty else None], x.ndim, leading=1)

    def derivative(self, x, der=1):
        return self(x, der)


def polynomial_interpolate(xi, yi, x, der=0, axis=0, *, rng=None):
    """krogh_interpolate and barycentric_interpolate."""
    face = PolynomialFace(xi, yi, axis)
    return face(x, der) if np.ndim(der) == 0 else face.derivatives(x, max(der) + 1)[list(der)]


class CubicHermiteFace(Face):
    """CubicHermiteSpline."""

    def __init__(self, x, y, dydx, axis=0, extrapolate=None):
        super().__init__(x, y, dydx, axis=axis, extrapolate=extrapolate)

    def _curve(self, x, y, dydx):
        return HermiteCurve(y, dydx, x)


class CubicSplineFace(Face):
    """CubicSpline, with the same condition at both ends; make_interp_spline of degree 3."""

    def __init__(self, x, y, axis=0, bc_type="not-a-knot", extrapolate=None):
        self.bc_type = bc_type
        if extrapolate is None and bc_type == "periodic":
            extrapolate = "periodic"
        super().__init__(x, y, axis=axis, extrapolate=extrapolate)

    def _curve(self, x, y):
        return CubicSplineCurve(y, x, ends=self.bc_type.replace("-", "_"))


class FloaterHormannFace(Face):
    """FloaterHormannInterpolator."""

    def __init__(self, points, values, *, d=3, axis=0):
        self.degree = d
        super().__init__(points, values, axis=axis)

    def _curve(self, x, y):
        return FloaterHormannCurve(y, x, degree=self.degree)


class RuleFace(Face):
    """A cubic Hermite curve with estimated velocities: what PCHIP and Akima interpolators are."""

    rule = None

    def __init__(self, x, y, axis=0, extrapolate=None):
        super().__init__(x, y, axis=axis, extrapolate=extrapolate)

    def _curve(self, x, y):
        return HermiteCurve(y, type(self).rule(y, x), x)


class PchipFace(RuleFace):
    """PchipInterpolator."""

    rule = staticmethod(monotone_velocities)


def pchip_interpolate(xi, yi, x, der=0, axis=0):
    face = PchipFace(xi, yi, axis)
    return face(x, der) if np.ndim(der) == 0 else [face(x, order) for order in der]


class AkimaFace(RuleFace):
    """Akima1DInterpolator, which has no values outside its points unless it is asked for them."""

    extrapolates = False
    rule = staticmethod(akima_velocities)

    def __init__(self, x, y, axis=0, *, method="akima", extrapolate=None):
        if method != "akima":
            raise NotImplementedError(f"`method`={method} is unsupported.")
        super().__init__(x, y, axis, extrapolate)
