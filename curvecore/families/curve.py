"""Base class of all curves: everything follows from basis functions and breaks."""

from __future__ import annotations

from typing import ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arithmetic import UNIT_ROUNDOFF, made_finite
from curvecore.arrays import (
    FloatArray,
    jet_array,
    parameter_array,
    read_only,
    stacked_jets,
)
from curvecore.calculus.methods import Calculus
from curvecore.errors import CurveError
from curvecore.families.approximating import Approximating
from curvecore.families.evaluation import Evaluation
from curvecore.families.immutable import Immutable
from curvecore.families.parameter_derivatives import ParameterDerivatives
from curvecore.families.polynomial_facts import PolynomialFacts
from curvecore.families.records import JOINT_ORDERS, JOINT_ROUNDINGS, JointDerivatives, LocalBasis
from curvecore.families.setting import FamilySetting, SettingValue, chosen_values


class ParametricCurve(Calculus, Approximating, ParameterDerivatives, PolynomialFacts, Evaluation, Immutable):
    """A parametric curve that is linear in its data.

    c(t) = sum over i, r of B_ir(t) d_ir, where d_i0 = p_i = c(t_i) and, for
    the families that have them, d_i1 = c'(t_i), d_i2 = c''(t_i) and so on, all
    per unit of t. Curves are immutable: their arrays are read-only copies.

    A family says what its basis functions are, by `_basis`, and where their
    derivatives may jump, by `breaks`. All else is derived here, correct if
    slower; families override what they know how to do faster or exactly. One with
    derivatives in its data has a constructor of its own.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i, finite; n >= 2, dim >= 1. Copied.
    parameters : array_like, shape (n,)
        t_i, finite and strictly increasing. Copied.
    **settings : int or str
        Values of the family's `settings`, by their names; the defaults where none is given.

    Raises
    ------
    CurveError
        If an argument does not have the shape or values above, or a setting is not allowed.

    Attributes
    ----------
    name : str
        The family's, as files store it: of one name, one set of functions for given parameters and settings.
    settings : tuple of FamilySetting
        What may be chosen about the functions beside the parameters.
    title : str
        The family's, as people read it.
    functions : str
        The name of the basis functions, to begin a sentence, where they have one.
    derivatives : int
        How many derivatives belong to each point: R - 1.
    full_title : str
        The title where nothing else says what it is: cubic Hermite.
    short_title : str
        The title where room is short; the title's first word, if it is not given.
    place : int
        Where it stands among the families of a program that lists them, in ascending order.
    can_close : bool
        Whether a last segment may lead back to the first point as smoothly as all others.
    interpolates : bool
        Whether curves run through their points: B_ir(t_j) is 1 for i = j and r = 0, else 0.
    is_continuous : bool
        Whether no B_ir jumps at a break.
    is_local : bool
        Whether B_ir is 0 outside of the two segments that meet at t_i; then there is a `local_basis`.
    is_one_polynomial : bool
        Whether it is the polynomial of degree n - 1 through its n points.
    is_calm : bool
        Whether it is offered as a cure for a curve that swings out between its points: through points alone
        it stays near them, whatever their parameters.
    most_points : int or None
        How many points a curve can have: what is derived from `_basis` takes m * n numbers. None, any
        number, in a family that overrides `_evaluate`, `bezier_pieces` and whatever else it can do with less.

    See Also
    --------
    LagrangeCurve, HermiteCurve, QuinticHermiteCurve : Families.
    BasisCurve : A curve of any functions.
    Chain : Curves end to end.

    Examples
    --------
    >>> import numpy as np
    >>> from curvecore import ParametricCurve
    >>> class Ellipse(ParametricCurve):
    ...     name = title = "ellipse"
    ...     interpolates = False
    ...     def _basis(self, t, order):
    ...         angle = t + order * np.pi / 2
    ...         return np.stack([np.cos(angle), np.sin(angle)], axis=1)[:, :, None]
    >>> ellipse = Ellipse([[2, 0], [0, 1]], [0, 2 * np.pi])
    >>> ellipse
    Ellipse(n=2, dim=2, domain=(0, 6.28319))
    >>> ellipse.integrate(0, np.pi / 2).round(9).tolist()
    [2.0, 1.0]
    >>> ellipse.solve(1.0, axis=0).round(9).tolist()
    [1.047197551, 5.235987756]
    """

    __slots__ = ("_chosen", "_jets", "_parameters")

    name: ClassVar[str]
    title: ClassVar[str]
    functions: ClassVar[str] = "Basis functions"
    settings: ClassVar[tuple[FamilySetting, ...]] = ()
    derivatives: ClassVar[int] = 0
    full_title: ClassVar[str] = ""
    short_title: ClassVar[str] = ""
    place: ClassVar[int] = 1000
    can_close: ClassVar[bool] = False
    interpolates: ClassVar[bool] = True
    is_continuous: ClassVar[bool] = True
    is_local: ClassVar[bool] = False
    is_one_polynomial: ClassVar[bool] = False
    is_calm: ClassVar[bool] = False
    most_points: ClassVar[int | None] = 2000

    _chosen: tuple[tuple[str, SettingValue], ...]
    _jets: FloatArray
    _parameters: FloatArray

    def __init__(self, points: ArrayLike, parameters: ArrayLike, **settings: SettingValue) -> None:
        self._keep(stacked_jets(points), parameters, **settings)

    def _keep(self, jets: FloatArray, parameters: ArrayLike, **settings: SettingValue) -> None:
        """Store jets that are checked, and parameters and settings, which are checked here."""
        self._chosen = tuple(chosen_values(self.settings, settings, self.title).items())
        self._jets = read_only(jets)
        self._parameters = read_only(parameter_array(parameters, len(jets)))
        for name in self._caches:
            setattr(self, name, None)

    def __repr__(self) -> str:
        """Return a short description: class, number of points, dimension, domain and settings."""
        settings = "".join(f", {name}={value!r}" for name, value in self._chosen)
        return f"{type(self).__name__}({self._shape_in_words()}{settings})"

    def _shape_in_words(self) -> str:
        first, last = self.domain
        return f"n={len(self._parameters)}, dim={self._jets.shape[2]}, domain=({first:.6g}, {last:.6g})"

    # What a family says

    # `_basis` is abstract in `Evaluation`.

    def _evaluate(self, t: FloatArray, order: int) -> FloatArray:
        """Return the order-th derivative of the curve at finite t (m,), as (m, dim)."""
        basis = self._basis(t, order)
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            data = self.jets.reshape(-1, self.jets.shape[2])
            curve = made_finite(basis.reshape(len(basis), len(data)) @ data)
        if order == 0 and self.passes_points:
            self._put_points(curve, t)
        return curve

    @property
    def breaks(self) -> FloatArray:
        """The parameters at which derivatives may jump, ascending, the ends included; shape (k,)."""
        return self._parameters[[0, -1]]

    # What the data are

    @property
    def points(self) -> FloatArray:
        """The points p_i, shape (n, dim)."""
        return self.jets[:, 0]

    @property
    def parameters(self) -> FloatArray:
        """The parameters t_i, shape (n,), strictly increasing."""
        return self._parameters

    @property
    def jets(self) -> FloatArray:
        """The data d_ir, shape (n, R, dim)."""
        return self._jets

    @property
    def domain(self) -> tuple[float, float]:
        """The first and the last parameter."""
        return float(self._parameters[0]), float(self._parameters[-1])

    @property
    def degree(self) -> int | None:
        """The degree of the polynomial, or of each polynomial piece; None where they are none."""
        return None

    @property
    def chosen(self) -> dict[str, SettingValue]:
        """The values of all settings, by their names."""
        return dict(self._chosen)

    @property
    def functions_key(self) -> tuple[object, ...]:
        """The class and the settings: curves of one key and the same parameters have the same functions."""
        return (type(self), *self._chosen)

    @property
    def pieces(self) -> tuple[ParametricCurve, ...]:
        """The curves that this one is a chain of: itself, unless it is a `Chain`."""
        return (self,)

    @classmethod
    def from_jets(cls, jets: ArrayLike, parameters: ArrayLike, **settings: SettingValue) -> Self:
        """Return a curve of this family.

        Parameters
        ----------
        jets : array_like, shape (n, R, dim)
            Finite numbers; n >= 2.
        parameters : array_like, shape (n,)
            Finite and strictly increasing.
        **settings : int or str
            Values of the family's `settings`, by their names; the defaults where none is given.

        Returns
        -------
        ParametricCurve
            Of this class.

        Raises
        ------
        CurveError
            If they are no such numbers, or more than `most_points`, or a setting is not allowed.
        """
        cls._check_count(np.shape(jets)[0] if np.ndim(jets) else 0, cls.name)
        chosen_values(cls.settings, settings, cls.title)
        data = jet_array(jets, (len(np.asarray(jets)), cls.derivatives + 1))
        return cls(*data.swapaxes(0, 1), parameters, **settings)  # type: ignore[call-arg]

    @classmethod
    def _check_count(cls, count: int, name: str) -> None:
        if cls.most_points is not None and count > cls.most_points:
            raise CurveError(f"a curve of {name} can have {cls.most_points} points, not {count}")

    def with_data(self, jets: ArrayLike, parameters: ArrayLike) -> Self:
        """Return a curve of the same family and settings with other data and parameters.

        Parameters
        ----------
        jets : array_like, shape (n, R, dim)
            Finite numbers, of any n that the family may have.
        parameters : array_like, shape (n,)
            Finite and strictly increasing.

        Returns
        -------
        ParametricCurve
            Of the same class.
        """
        return self.from_jets(jets, parameters, **self.chosen)

    def with_jets(self, jets: ArrayLike) -> Self:
        """Return the curve with other data; its parameters are shared and not checked again.

        Parameters
        ----------
        jets : array_like, shape (n, R, dim)
            Finite numbers of any dim; n and R as they are.

        Returns
        -------
        ParametricCurve
            Of the same class.
        """
        curve = object.__new__(type(self))
        curve.__setstate__({**self.__getstate__(), "_jets": jet_array(jets, self._jets.shape[:2])})
        return curve

    # What follows from the basis

    def _put_points(self, curve: FloatArray, t: FloatArray) -> None:
        """Put p_i into rows of `curve` where t is t_i."""
        joint = np.minimum(np.searchsorted(self._parameters, t), len(self._parameters) - 1)
        hit = t == self._parameters[joint]
        curve[hit] = self.points[joint[hit]]

    def derivatives_at(self, t: FloatArray, orders: tuple[int, ...]) -> list[FloatArray]:
        """Return derivatives of several orders at many places, where that takes less than one by one.

        Parameters
        ----------
        t : ndarray, shape (m,)
            Finite.
        orders : tuple of int
            Each at least 0.

        Returns
        -------
        list of ndarray, shape (m, dim)
            As from `evaluate`; a family says by how much they may be less accurate.
        """
        return [self.evaluate(t, order) for order in orders]

    def local_basis(self, t: ArrayLike, order: int = 0) -> LocalBasis:
        """Return the basis functions that live on each t's segment, where `is_local`.

        Parameters
        ----------
        t : float or array_like, shape (m,)
            Finite; a scalar counts as m = 1.
        order : int, optional
            Order of the derivative, at least 0.

        Returns
        -------
        LocalBasis
            The two functions of each kind that are not 0 there, and which they are.

        Raises
        ------
        CurveError
            If the family's functions reach further.
        """
        raise CurveError("curve must be of a family whose functions are local")

    def support(self, index: int) -> tuple[float, float]:
        """Return the interval outside of which all functions of a point are 0, as far as that is known.

        Parameters
        ----------
        index : int
            Of the point, from 0 to n - 1.

        Returns
        -------
        tuple of float
            Its ends; the whole domain where it is not known.
        """
        if not self.is_local:
            return self.domain
        t = self._parameters
        return float(t[max(index - 1, 0)]), float(t[min(index + 1, len(t) - 1)])

    @property
    def is_positive(self) -> bool:
        """Whether no B_i0 is negative in the domain; they add up to 1, so that no error grows there."""
        return False

    def joint_derivatives(self, *, before: bool) -> JointDerivatives:
        """Return c to c''' at the ends of all segments.

        Parameters
        ----------
        before : bool
            Whether before t_1, ..., t_(n-1), or after t_0, ..., t_(n-2).

        Returns
        -------
        JointDerivatives
            Of n - 1 ends.
        """
        t, h = self._parameters, np.diff(self._parameters)
        at = np.where(before & np.isin(t, self.breaks), np.nextafter(t, -np.inf), t)
        shorter = np.minimum(np.concatenate((h[:1], h)), np.concatenate((h, h[-1:])))
        orders = [self._about_a_point(at, order, shorter) for order in range(JOINT_ORDERS + 1)]
        values, sizes = (np.stack(each, axis=1) for each in zip(*orders, strict=True))
        # From beside a break to it: without this step, parameters far from 0 would make derivatives jump.
        values = values[:, :-1] + (t - at)[:, None, None] * values[:, 1:]
        values[:, 0] = self.evaluate(t)
        side = slice(1, None) if before else slice(-1)
        return JointDerivatives(values[side], sizes[side, :-1])

    def _about_a_point(self, t: FloatArray, order: int, h: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return derivatives (m, dim) and the sizes of their terms (m,), with the first point as the origin.

        Derivatives of functions that add up to 1 add up to 0: where the origin lies counts for nothing. Those
        that are differences, over lengths h, are off by the digits they lose, as terms of that size would be.
        """
        basis = self._basis(t, order)
        origin = self.jets[0, 0]
        data = self.jets.copy()
        data[:, 0] -= origin
        digits = self.difference_digits[order - 1 : order] if order else ()
        lost = sum(2.0 * 10.0**-each for each in digits) / h**order
        shifts = basis[:, :, 0].sum(axis=1)
        if order:
            roundings = 64.0 * UNIT_ROUNDOFF * np.abs(basis[:, :, 0]).sum(axis=1)
            shifts[np.abs(shifts) <= roundings + lost] = 0.0
        flat, rows = basis.reshape(len(t), -1), data.reshape(basis[0].size, -1)
        values = flat @ rows + shifts[:, None] * origin
        size = (np.abs(flat) @ np.abs(rows) + np.abs(shifts[:, None] * origin)).max(axis=1)
        reach = np.abs(data[:, 0]).max() + (shifts != 0.0) * np.abs(origin).max()
        return values, size + lost / JOINT_ROUNDINGS * reach
