"""Regions of the plane: closed contours of cubic Bezier pieces, and the rule that says what is inside."""

from __future__ import annotations

from collections.abc import Iterable
from enum import Enum

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import BoolArray, FloatArray, IntArray, contour_array, plane_points, read_only
from curvecore.bezier.bernstein_algebra import binomials
from curvecore.regions.outlines import closed_contour, without_specks
from curvecore.regions.rays import windings_at


class WindingRule(Enum):
    """Rule that says which winding numbers are those of the inside.

    See Also
    --------
    Region : Has one.

    Examples
    --------
    >>> from curvecore import WindingRule
    >>> bool(WindingRule.EVEN_ODD.is_inside(2)), bool(WindingRule.NONZERO.is_inside(2))
    (False, True)
    """

    NONZERO = "nonzero"
    EVEN_ODD = "even_odd"

    def is_inside(self, winding: IntArray | int) -> BoolArray:
        """Tell of which winding numbers a place is inside.

        Parameters
        ----------
        winding : int or ndarray of int
            How often contours run around places, to the left.

        Returns
        -------
        ndarray of bool
            Of the same shape.
        """
        number = np.asarray(winding)
        result: BoolArray = number % 2 == 1 if self is WindingRule.EVEN_ODD else number != 0
        return result


class Region:
    """The inside of closed contours of cubic Bezier pieces.

    Parameters
    ----------
    contours : iterable of array_like, each of shape (k, 4, 2)
        Control points of pieces, each of which begins where the one before it
        ends. A contour that does not end where it begins is closed by a
        straight line. They may cross themselves and each other.
    rule : WindingRule, optional
        Which winding numbers are those of the inside.

    Raises
    ------
    CurveError
        If a contour has another shape, a gap, or numbers that are not finite.

    See Also
    --------
    union, intersection, difference, exclusion, division, simplified : Of regions.

    Examples
    --------
    >>> from curvecore import Region
    >>> triangle = Region.of_polygon([[0, 0], [4, 0], [0, 3]])
    >>> triangle
    Region(contours=1, pieces=3)
    >>> triangle.area
    6.0
    >>> triangle.contains([[1, 1], [4, 3]]).tolist()
    [True, False]
    """

    __slots__ = ("_contours", "_rule")

    def __init__(self, contours: Iterable[ArrayLike], rule: WindingRule = WindingRule.NONZERO) -> None:
        checked = (contour_array(each, f"contours[{place}]") for place, each in enumerate(contours))
        self._contours = tuple(read_only(closed_contour(each)) for each in checked)
        self._rule = rule

    @classmethod
    def of_polygon(cls, points: ArrayLike) -> Region:
        """Return the inside of a polygon.

        Parameters
        ----------
        points : array_like, shape (k, 2)
            Its vertices, k >= 2.

        Returns
        -------
        Region
            Whose pieces are straight, and run through at an even pace.
        """
        vertices = plane_points(points, "points")
        steps = np.arange(4)[:, None] / 3.0
        starts, ends = vertices[:, None], np.roll(vertices, -1, axis=0)[:, None]
        return cls([(1.0 - steps) * starts + steps * ends])

    @property
    def contours(self) -> tuple[FloatArray, ...]:
        """The closed contours, each (k, 4, 2), read-only."""
        return self._contours

    @property
    def rule(self) -> WindingRule:
        """Which winding numbers are those of the inside."""
        return self._rule

    @property
    def area(self) -> float:
        """The signed area: positive around what contours run to the left of, as often as they do.

        Of what an operation returned it is the area of the inside.
        """
        return sum(contour_area(each) for each in self._contours)

    def without_specks(self, length: float) -> Region:
        """Return the region without the pieces that are too short to be seen.

        Parameters
        ----------
        length : float
            Pieces next to each other that are shorter than this, together, become a point. Contours move by
            less than that.

        Returns
        -------
        Region
            With the same rule; what consists of such pieces alone stays as it is.
        """
        return Region([without_specks(each, length) for each in self._contours], self._rule)

    def winding_numbers(self, points: ArrayLike) -> IntArray:
        """Return how often the contours run around points.

        Parameters
        ----------
        points : array_like, shape (m, 2)
            Places in the plane.

        Returns
        -------
        ndarray of int, shape (m,)
            To the left counts as positive. On a contour it is that of one side or the other.
        """
        return windings_at(self._contours, plane_points(points, "points"))

    def contains(self, points: ArrayLike) -> BoolArray:
        """Tell which points are inside.

        Parameters
        ----------
        points : array_like, shape (m, 2)
            Places in the plane.

        Returns
        -------
        ndarray of bool, shape (m,)
            On a contour it is one or the other.
        """
        return self._rule.is_inside(self.winding_numbers(points))

    def __repr__(self) -> str:
        """Return how many contours and pieces there are."""
        pieces = sum(map(len, self._contours))
        rule = "" if self._rule is WindingRule.NONZERO else f", rule={self._rule.name}"
        return f"Region(contours={len(self._contours)}, pieces={pieces}{rule})"


def contour_area(contour: FloatArray) -> float:
    """Return the signed area that a closed contour (k, 4, 2) encloses: the integral of (x dy - y dx) / 2."""
    # About a point of the contour: far from the origin the products would cancel.
    local = contour - contour[0, 0]
    moments = np.einsum("kid,ij,kjd->k", local, _MOMENTS, local[:, :, ::-1] * [1.0, -1.0])
    return float(moments.sum()) / 2.0


def is_sliver(contour: FloatArray, thin: float) -> bool:
    """Tell whether a closed contour (k, 4, 2) encloses no more than a line of that width along it."""
    length = float(np.hypot(*np.moveaxis(np.diff(contour, axis=1), 2, 0)).sum())
    return abs(contour_area(contour)) <= thin * length


def _moments() -> FloatArray:
    """Return the integrals of b_i b_j' over [0, 1] for the cubic Bernstein polynomials, (4, 4)."""
    products = binomials(3)[:, None] * binomials(2) / binomials(5)[np.add.outer(range(4), range(3))] / 6.0
    result = np.zeros((4, 4))
    result[:, 1:] += 3.0 * products
    result[:, :-1] -= 3.0 * products
    return result


_MOMENTS = read_only(_moments())
