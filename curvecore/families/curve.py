"""Base class of all curves: the duties of a family, its options, and the interface for callers.

A family must say what its basis functions are (`ParametricCurve._basis`). It may say where their derivatives
jump (`breaks`), the degree of polynomial pieces (`degree`), the class attributes below, and override any
method of `FamilyDefaults`. Callers get all of it, and the methods of `Calculus`.
"""

from __future__ import annotations

from abc import abstractmethod
from typing import ClassVar, Literal, NamedTuple, Self, TypeAlias, final

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arithmetic import LARGEST
from curvecore.arrays import (
    BoolArray,
    FloatArray,
    integer,
    jet_array,
    parameter_array,
    parameter_values,
    read_only,
    stacked_jets,
)
from curvecore.calculus.methods import Calculus
from curvecore.errors import CurveError
from curvecore.families.defaults import FamilyDefaults
from curvecore.families.immutable import Immutable
from curvecore.families.setting import FamilySetting, SettingValue, chosen_values

Extrapolate: TypeAlias = bool | Literal["periodic"]
_DOUBLE = np.dtype(np.float64)


class ParametricCurve(FamilyDefaults, Calculus, Immutable):
    """A parametric curve that is linear in its data.

    c(t) = sum over i, r of B_ir(t) d_ir, where d_i0 = p_i = c(t_i) and, for
    the families that have them, d_i1 = c'(t_i), d_i2 = c''(t_i) and so on, all
    per unit of t. Curves are immutable: their arrays are read-only copies.

    A family says what its basis functions are, by `_basis`, and where their
    derivatives may jump, by `breaks`. All else is derived (`FamilyDefaults`),
    correct if slower; families override what they know how to do faster or
    exactly. One with derivatives in its data has a constructor of its own.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i, finite; n >= 2, dim >= 1. Copied.
    parameters : array_like, shape (n,)
        t_i, finite and strictly increasing. Copied.
    **settings : int, float or str
        Values of the family's `settings`, by their names; the defaults where none is given.

    Raises
    ------
    CurveError
        If an argument does not have the shape or values above, or a setting is not allowed.

    Attributes
    ----------
    name : str
        The name of the family in files: of one name, one set of functions for given parameters and settings.
    settings : tuple of FamilySetting
        Choices about the functions beside the parameters.
    title : str
        The name of the family for people.
    functions : str
        The name of the basis functions, to begin a sentence, where they have one.
    derivatives : int
        The number of derivatives of each point: R - 1.
    full_title : str
        A title that is clear by itself: cubic Hermite; the title, if it is not given.
    short_title : str
        A short title; the first word of the title, if it is not given.
    rank : int
        The position of the family in menus, in ascending order.
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
        Whether curves through points alone stay near them, whatever the parameters: such a family is
        suggested for a curve that swings out between its points.
    follows : bool
        Whether `near` comes within any tolerance of curves that do not consist of polynomials.
    most_points : int or None
        The largest number of points: the defaults take m * n numbers. None for any number, in a family that
        overrides `_evaluate`, `bezier_pieces` and other methods that can do with less.

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
    ...         return np.stack([np.cos(angle), np.sin(angle)], axis=1)
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
    rank: ClassVar[int] = 1000
    can_close: ClassVar[bool] = False
    interpolates: ClassVar[bool] = True
    is_continuous: ClassVar[bool] = True
    is_local: ClassVar[bool] = False
    is_one_polynomial: ClassVar[bool] = False
    is_calm: ClassVar[bool] = False
    follows: ClassVar[bool] = False
    most_points: ClassVar[int | None] = 2000

    _chosen: tuple[tuple[str, SettingValue], ...]
    _jets: FloatArray
    _parameters: FloatArray

    # What a family must say

    @abstractmethod
    def _basis(self, t: FloatArray, order: int) -> FloatArray:
        """Return B_ir^(order) at finite t (m,), inside the domain or not, as (m, n, R); order >= 0.

        At a break the piece to the right counts. Where R is 1, the shape may be (m, n). Numbers may overflow
        or be invalid: they are made finite, without warnings.
        """

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

    # Curves with other data

    @classmethod
    def from_jets(cls, jets: ArrayLike, parameters: ArrayLike, **settings: SettingValue) -> Self:
        """Return a curve of this family.

        Parameters
        ----------
        jets : array_like, shape (n, R, dim)
            Finite numbers; n >= 2.
        parameters : array_like, shape (n,)
            Finite and strictly increasing.
        **settings : int, float or str
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

    # Values

    @final
    def basis(self, t: ArrayLike, order: int = 0) -> FloatArray:
        """Return all basis functions, or their derivatives with respect to t.

        Parameters
        ----------
        t : float or array_like of any shape
            Finite, inside the domain or not. At a break the piece to the right counts.
        order : int, optional
            Order of the derivative, at least 0.

        Returns
        -------
        ndarray, shape (*shape of t, n, R)
            ``[..., i, r]`` is B_ir; of a single t of the shape (n, R).

        Raises
        ------
        CurveError
            If t is not finite, or order is negative.

        See Also
        --------
        evaluate : The sum of the functions times the data.

        Examples
        --------
        >>> from curvecore import LagrangeCurve
        >>> curve = LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2])
        >>> curve.basis(0.5)[:, 0].round(9).tolist()
        [0.375, 0.75, -0.125]
        """
        at = parameter_values(t)
        return at.shaped(self._finite_basis(at.values, integer(order, "order", 0)))

    @final
    def evaluate(self, t: ArrayLike, order: int = 0, extrapolate: Extrapolate = True) -> FloatArray:
        """Return the curve, or a derivative with respect to t.

        Parameters
        ----------
        t : float or array_like of any shape
            Finite, inside the domain or not.
        order : int, optional
            Order of the derivative, at least 0.
        extrapolate : bool or "periodic", optional
            Outside the domain: True, the first or the last piece goes on; False, NaN; "periodic", the curve
            repeats itself, so that the end of the domain counts as its beginning.

        Returns
        -------
        ndarray, shape (*shape of t, dim)
            At a parameter t_i and order 0 exactly p_i, if the family interpolates.

        Raises
        ------
        CurveError
            If t is not finite, order is negative, or extrapolate something else.

        See Also
        --------
        derivative : The derivative as a curve.

        Examples
        --------
        >>> from curvecore import LagrangeCurve
        >>> curve = LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2])
        >>> curve.evaluate([0.5, 1]).round(9).tolist()
        [[0.25, 1.5], [1.0, 2.0]]
        >>> curve.evaluate(0.5, order=1).round(9).tolist()
        [1.0, 2.0]
        >>> curve.evaluate([-1, 3], extrapolate="periodic").round(9).tolist()
        [[1.0, 2.0], [1.0, 2.0]]
        """
        if extrapolate is True:
            if type(t) is np.ndarray and t.dtype is _DOUBLE and t.ndim == 1:
                if (values := self._evaluate_at_once(t, order)) is not None:
                    return values
            elif type(t) is float and (values := self._evaluate_at_once(np.array([t]), order)) is not None:
                return values[0]
        at = parameter_values(t)
        rank = integer(order, "order", 0)
        inside, outside = at.values, None
        if extrapolate is not True:
            inside, outside = _within_domain(at.values, self.domain, extrapolate)
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            curve = self._evaluate(inside, rank)
        if outside is not None:
            curve[outside] = np.nan
        return at.shaped(curve)

    @final
    def __call__(self, t: ArrayLike, order: int = 0, extrapolate: Extrapolate = True) -> FloatArray:
        """Return the curve, or a derivative with respect to t: `evaluate`."""
        return self.evaluate(t, order, extrapolate)

    def _finite_basis(self, t: FloatArray, order: int) -> FloatArray:
        """Return the basis functions at finite t (m,), with finite numbers and the shape (m, n, R)."""
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            functions = self._basis(t, order)
        if functions.ndim == 2:
            functions = functions[:, :, None]
        return functions if np.isfinite(functions).all() else np.nan_to_num(functions, nan=LARGEST)


class _WithinDomain(NamedTuple):
    """Parameters at which a curve is to be evaluated in place of those asked for.

    Attributes
    ----------
    t : ndarray, shape (m,)
        Inside the domain where `extrapolate` is not True.
    outside : ndarray of bool, shape (m,)
        Where the curve has no value.
    """

    t: FloatArray
    outside: BoolArray


def _within_domain(t: FloatArray, domain: tuple[float, float], extrapolate: Extrapolate) -> _WithinDomain:
    """Return parameters inside [a, b] that stand for t, (m,).

    "periodic" takes a + (t - a) mod (b - a), as SciPy does: the period is half open.
    """
    first, last = domain
    nowhere = np.zeros(t.shape, dtype=np.bool_)
    rule = checked_extrapolate(extrapolate)
    if rule == "periodic":
        # The sum may exceed b by rounding.
        return _WithinDomain(np.minimum(first + np.remainder(t - first, last - first), last), nowhere)
    if rule:
        return _WithinDomain(t, nowhere)
    return _WithinDomain(np.clip(t, first, last), (t < first) | (t > last))


def checked_extrapolate(extrapolate: object) -> Extrapolate:
    """Return `extrapolate` if it is one of the three values."""
    if isinstance(extrapolate, (bool, np.bool_)):
        return bool(extrapolate)
    if isinstance(extrapolate, str) and extrapolate == "periodic":
        return "periodic"
    raise CurveError(f"extrapolate must be True, False or 'periodic', not {extrapolate!r}")
