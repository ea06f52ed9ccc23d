"""The core's curve of a curve of the document: made at once, or under a drag when somebody asks for it."""

from __future__ import annotations

from functools import cached_property
from typing import Generic, Self, TypeVar

import msgspec
import numpy as np

from curvecore import CurveError, ParametricCurve
from curvecore.arrays import FloatArray

from ...document.model import Curve
from ..geometry import at_knots
from .core_curve import Core, checked_parameters, core_after, core_anew
from .flattener import Polyline
from .jets import Sides
from .point_arrays import PointArrays
from .point_moves import Motion

Root = TypeVar("Root")


class Carry(msgspec.Struct, Generic[Root], frozen=True, eq=False, gc=False):
    """The map x -> x A^T + b from the curve of a view to another one.

    Attributes
    ----------
    root
        The view, whose curve is none that was carried itself.
    matrix
        A, (2, 2).
    shift
        b, (2,).
    stretch
        By how much the map makes lengths longer at most.
    """

    root: Root
    matrix: FloatArray
    shift: FloatArray
    stretch: float

    def mapped(self, line: Polyline) -> Polyline:
        """Return a polyline of the curve of the view, after the map."""
        points = line.points @ self.matrix.T + self.shift
        return Polyline(line.parameters, points, line.deviation * self.stretch)


class MadeCurve(msgspec.Struct, frozen=True, eq=False, dict=True):
    """A curve of the document and the core's curve that its points and rules give, or why they give none.

    While points are dragged and all else rests, and where all of them were mapped, what is drawn follows
    them, and the core's curve is made only when somebody asks for it.

    Attributes
    ----------
    source
        The document's value this was made from.
    points
        The points' positions, (n, 2).
    arrays
        All numbers in the points; the view made after this one takes from here what stays.
    motion
        How its points came here from those of a view before, where nothing but that has changed.
    carry
        The same where all came here by one map, with the curve.
    """

    source: Curve
    points: FloatArray
    arrays: PointArrays
    _made: Core | None = None
    motion: Motion | None = None
    carry: Carry[Self] | None = None

    @cached_property
    def _core(self) -> Core:
        if self._made is not None:
            return self._made
        if self.carry is not None:
            return core_anew(self.source, self.arrays, self.carry.root.curve)
        assert self.motion is not None
        return core_after(self.source, self.arrays, self.motion.moves.curve)

    @property
    def is_followed(self) -> bool:
        """Whether what is drawn follows points, and nobody has asked yet for the core's curve they give."""
        return self._made is None and "_core" not in self.__dict__

    def settle(self) -> None:
        """Make the core's curve: nothing is being dragged any more, and all that is shown is exact."""
        self._core  # noqa: B018 - kept from now on

    @property
    def curve(self) -> ParametricCurve | None:
        """The core's curve.

        The last good one where the present points and rules give none, None where there never was one.
        """
        return self._core.curve

    @property
    def known_curve(self) -> ParametricCurve | None:
        """The core's curve, or one with the same functions if it has yet to be made."""
        return self.carry.root.curve if self.carry is not None and self.is_followed else self.curve

    @property
    def has_curve(self) -> bool:
        """Whether there is a curve to draw, the present one or the last good one."""
        return self.is_followed or self._core.curve is not None

    @property
    def problem(self) -> str:
        """Why the present points and rules give no curve, as a sentence; empty where they do."""
        return "" if self.is_followed else self._core.problem

    @property
    def is_overdue(self) -> bool:
        """Whether there is none because functions of a file take too long."""
        return not self.is_followed and self._core.is_overdue

    @property
    def sides(self) -> Sides | None:
        """The jets before and after each knot, where the family has derivatives and `curve` is current."""
        return self._core.sides

    @property
    def is_current(self) -> bool:
        """Whether `curve` belongs to the present points and rules."""
        return self.is_followed or (self._core.curve is not None and not self._core.problem)

    @property
    def parameters(self) -> FloatArray:
        """The parameters of the knots of `curve`, empty without one."""
        if self.motion is not None:
            return self.motion.moves.curve.parameters
        return self.curve.parameters if self.curve is not None else np.empty(0)

    @cached_property
    def ticks(self) -> FloatArray:
        """The parameters that the present rule gives, one for each knot; empty where it gives none.

        The family may refuse them: then `curve` has other ones, or there is none.
        """
        if self.is_current:
            return self.parameters
        if not self.source.points:
            return np.empty(0)
        try:
            return checked_parameters(self.source, self.at_knots, self.arrays)
        except CurveError:
            return np.empty(0)

    @property
    def pieces(self) -> tuple[ParametricCurve, ...]:
        """The curves that `curve` is a chain of; one, unless it has corners."""
        return self.curve.pieces if self.curve is not None else ()

    @cached_property
    def basis_curve(self) -> ParametricCurve | None:
        """A curve with the basis functions of `curve`, one set for each knot: corners do not change them."""
        if self.motion is not None:
            return self.motion.moves.curve
        if self.curve is None or len(self.pieces) == 1:
            return self.curve
        nothing = np.zeros((len(self.parameters), self.curve.jets.shape[1], 2))
        return self.pieces[0].with_data(nothing, self.parameters)

    @property
    def at_knots(self) -> FloatArray:
        """The points' positions, of a closed curve the first one once more at the end, (k, 2)."""
        return at_knots(self.points, closed=self.source.is_closed)

    def owner(self, knot: int) -> int:
        """Return the point that a knot belongs to."""
        return knot % len(self.source.points)

    def spacing(self, index: int, *, ahead: bool) -> float | None:
        """Return the length in t of the segment ahead of or behind point `index`, None beyond the ends."""
        t = self.parameters
        if not self.is_current:
            return None
        if index == 0 and not ahead and self.source.is_closed:
            index = len(t) - 1
        other = index + 1 if ahead else index - 1
        return abs(float(t[other] - t[index])) if 0 <= other < len(t) else None
