"""Facts about the polynomials that a curve consists of, where it does."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from curvecore.arrays import FloatArray
from curvecore.errors import CurveError
from curvecore.families.records import Interpolant, Slopes

if TYPE_CHECKING:
    from curvecore.families.curve import ParametricCurve


class PolynomialFacts:
    """A part of `ParametricCurve`: nothing is known of the pieces of a curve unless its family says it."""

    __slots__ = ()

    title: ClassVar[str]
    follows: ClassVar[bool] = False
    """Whether `near` comes as close as is wanted to curves that do not consist of polynomials."""

    @property
    def kind(self) -> str:
        """Words for its functions where they are no polynomials; empty where they are, or it is not known."""
        return ""

    def bezier_pieces(self) -> FloatArray | None:
        """Return the Bezier control points of the pieces between `breaks`.

        Returns
        -------
        ndarray, shape (k - 1, degree + 1, dim), or None
            None where the pieces are no polynomials, or one of a degree as high as the number of points: its
            control points are of no use to draw it (see `lagrange_to_bezier`).
        """
        return None

    def exact_pieces(self) -> FloatArray | None:
        """Return the Bezier control points of the pieces between `breaks`, also of high degree.

        Returns
        -------
        ndarray, shape (k - 1, degree + 1, dim), or None
            For a change of basis; None where the curve is no polynomial, or one through too many points.
        """
        return self.bezier_pieces()

    @property
    def has_exact_pieces(self) -> bool:
        """Whether `exact_pieces` returns them; known before they are computed."""
        return self.exact_pieces() is not None

    def surely_exceeds(self, degree: int) -> bool:
        """Return whether the pieces are known to be of a higher degree before they are computed.

        Parameters
        ----------
        degree : int

        Returns
        -------
        bool
            False where only `exact_pieces` can tell.
        """
        return False

    @classmethod
    def near(cls, curve: ParametricCurve, tolerance: float) -> ParametricCurve:
        """Return a curve of this family that keeps within a distance of another one.

        Here the other one itself, by `same_shape_as`; a family that can follow any curve overrides it.

        Parameters
        ----------
        curve : ParametricCurve
            Of any family.
        tolerance : float
            Largest distance at equal parameters, greater than 0.

        Returns
        -------
        ParametricCurve
            A curve of this family, or several end to end.

        Raises
        ------
        CurveError
            If it can be none of this family, or no way to it is known.
        """
        return cls.same_shape_as(curve)

    @classmethod
    def check_shape(cls, curve: ParametricCurve) -> None:
        """Raise where no curve of this family is another one; the other work of `same_shape_as` is left out.

        Derivatives may jump at corners: one above the acceleration that jumps anywhere else is a reason, too.

        Parameters
        ----------
        curve : ParametricCurve
            Of another family.

        Raises
        ------
        CurveError
            The message says why. Here it is left to `same_shape_as`.
        """

    @classmethod
    def same_shape_as(cls, curve: ParametricCurve) -> ParametricCurve:
        """Return a curve of this family that is another one, written with other data.

        Parameters
        ----------
        curve : ParametricCurve
            Of another family.

        Returns
        -------
        ParametricCurve
            The same curve but for rounding.

        Raises
        ------
        CurveError
            If there is none, or no way to it is known: the message says why.
        """
        raise CurveError(f"no curve is known to be a {cls.title} curve as well")

    def bezier_slopes(self, exponent: int) -> Slopes | None:
        """Return the control points of the derivatives of `bezier_pieces`, from the data.

        Parameters
        ----------
        exponent : int
            They are divided by 2**exponent.

        Returns
        -------
        Slopes or None
            They do not depend on how far away the origin is. None where they are not known better than as
            differences of the control points.
        """
        return None

    def interpolants(self) -> list[Interpolant] | None:
        """Return what each polynomial piece between `breaks` interpolates.

        Returns
        -------
        list of Interpolant, or None
            What exact arithmetic needs to know of a curve; None where that is not known.
        """
        return None
