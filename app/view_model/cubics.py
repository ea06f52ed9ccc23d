"""Cubic Bézier pieces as the points of a cubic Hermite curve, with joints that are smooth, tied, or corners.

A Hermite curve has one velocity at a smooth point, while a path has two handles of different lengths
there. The lengths of the segments in t make up for it: the next segment is as long, in t, as makes its
first handle fit the velocity that the one before ends with. Where the handles do not lie on a line, the
point becomes a corner with two velocities.

Programs write few digits: handles that a person has drawn on one line miss it by a rounding. Where that is
all, and the numbers are those of a file, the shorter one is turned to the other, and both are tied, as are
handles of different lengths that lie on one line to the last bit.
"""

from __future__ import annotations

import math

import msgspec
import numpy as np
from msgspec.structs import replace

from curvecore.arrays import BoolArray, FloatArray

from ..document.constraints import tie
from ..document.limits import EditError
from ..document.model import Point, Vector

SMOOTH = 1e-9
"""Share of the size of the path by which a control point may move to make a joint smooth."""

WRITTEN_BY_PROGRAMS = math.radians(1.0)
EXACT = 1e-7
"""Angles by which a handle may be turned to be tied to the other: in files, and in documents."""

_TURNED = 5e-4
"""Share of the size of the path by which the tip of such a handle may move.

Coordinates of two decimals in an icon of 24 units turn one that is a unit long by 0.6°, and move its tip by
4e-4. A corner of 1° is not visible, and the curve moves by 4/9 of that at most: a fifth of a pixel where it
fills a thousand.
"""

_ALIKE = 0.01
"""Share by which the lengths of handles of equal length may differ."""

CORNER, TIED, EVEN = "csz"
"""Letters that programs write for the kinds of points: free, smooth, or symmetric as well."""

_SHORTEST = 2.0**-48

_FASTEST = 1e3  # factor between the speed of a segment and that of the first after a corner


class Joints:
    """Smoothness of the joints of a path, and lengths of segments in t up to a common factor.

    Attributes
    ----------
    smooth
        For each piece, whether the joint at its end is smooth.
    tied
        Whether the velocities there are tied: not at smooth joints whose handles are always equally long.
    even
        Whether tied handles are equally long.
    steps
        For each piece its length in t.
    moved
        The largest distance by which a control point is moved.
    """

    def __init__(
        self,
        leaving: FloatArray,
        arriving: FloatArray,
        lengths: FloatArray,
        tolerance: float,
        closed: bool,
        most_turned: float,
        letters: str = "",
    ) -> None:
        count = len(lengths)
        self._most_turned = most_turned
        self._tolerance = tolerance
        self.moved = 0.0
        self.smooth = [False] * count
        self.steps = lengths.copy()
        self._letters = np.array([*(letters[1:] + letters[:1])[:count]] if letters else [""] * count)
        after = np.roll(leaving, -1, axis=0)
        self._smoothen(arriving, after, lengths, closed)
        if min(self.steps) < _SHORTEST * sum(self.steps):
            # At the speeds of smooth joints the shortest piece would vanish in t.
            self.smooth, self.steps, self.moved = [False] * count, lengths.copy(), 0.0
        self.tied = self._tied(arriving, after, tolerance / SMOOTH)
        if not closed:
            self.tied[-1] = False
        alike = are_alike(np.hypot(*arriving.T), np.hypot(*after.T))
        self.even = list(self.tied & alike & (self._letters == EVEN))

    def _smoothen(self, arriving: FloatArray, after: FloatArray, lengths: FloatArray, closed: bool) -> None:
        """Make joints smooth where possible, one after the other, by the lengths in t of their pieces."""
        count, apart = len(lengths), self._apart(arriving, after)
        candidates = (apart <= self._tolerance) & (self._letters != CORNER)
        if not closed:
            candidates[-1] = False
        # A closed path is followed from one of its corners, so that its start does not become a corner.
        first = int(np.argmin(candidates)) + 1 if not candidates.all() else 0
        for step_index in range(first, first + count):
            here, following = step_index % count, (step_index + 1) % count
            if not candidates[here]:
                continue
            step = self._fitting_step(arriving[here], after[here], here, lengths[following])
            last = step_index == first + count - 1
            if step is None or (last and not self._agrees(step, following, after[here])):
                continue
            self.smooth[here] = True
            self.moved = max(self.moved, float(apart[here]))
            if not last:
                self.steps[following] = step

    def _tied(self, arriving: FloatArray, leaving: FloatArray, size: float) -> list[bool]:
        """Return the mask of joints with handles on one line, of two lengths or beside a line."""
        a, b = np.hypot(*arriving.T), np.hypot(*leaving.T)
        with np.errstate(all="ignore"):
            cross = np.abs(arriving[:, 0] * leaving[:, 1] - arriving[:, 1] * leaving[:, 0]) / (a * b)
        goes_on = (np.einsum("kd,kd->k", arriving, leaving) > 0) & (cross <= self._most_turned)
        miss = np.minimum(a, b) / 3 * cross
        # Behind and ahead of each joint.
        straight = np.abs(arriving - np.roll(leaving, 1, axis=0)).max(axis=1) <= SMOOTH * size
        beside_line = straight | np.roll(straight, -1)
        is_one = are_alike(a, b) & ~beside_line & (self._letters != TIED)
        is_smooth = np.array(self.smooth)
        goes_on &= self._letters != CORNER
        tied = np.where(is_smooth, goes_on & ~is_one, goes_on & (miss <= _TURNED * size))
        self.moved = max(self.moved, float(miss[tied & ~is_smooth].max(initial=0.0)))
        ties: list[bool] = tied.tolist()
        return ties

    @staticmethod
    def _apart(arriving: FloatArray, leaving: FloatArray) -> FloatArray:
        """Return distances of control points from the lines of those before; inf where these turn back."""
        a, b = np.hypot(*arriving.T), np.hypot(*leaving.T)
        with np.errstate(all="ignore"):
            cross = np.abs(arriving[:, 0] * leaving[:, 1] - arriving[:, 1] * leaving[:, 0]) / a / 3
        dot = np.einsum("kd,kd->k", arriving, leaving)
        both_rest = (a == 0) & (b == 0)
        return np.where(both_rest, 0.0, np.where((a > 0) & (b > 0) & (dot > 0), cross, np.inf))

    def _fitting_step(
        self, arriving: FloatArray, leaving: FloatArray, here: int, length: float
    ) -> float | None:
        speed, wanted = float(np.hypot(*arriving)), float(np.hypot(*leaving))
        if speed == 0:
            return float(length)
        step = float(self.steps[here]) * wanted / speed
        return step if 1 / _FASTEST < step / length < _FASTEST else None

    def _agrees(self, step: float, following: int, leaving: FloatArray) -> bool:
        """Whether following a closed path around gives its first segment the length that it has."""
        change = abs(step / float(self.steps[following]) - 1) * float(np.hypot(*leaving)) / 3
        return change <= self._tolerance


def are_alike(one: FloatArray, other: FloatArray) -> BoolArray:
    """Return the mask of the handles whose two lengths are the same within the digits of files."""
    return np.asarray(np.abs(one - other) <= _ALIKE * np.maximum(one, other))


def points_of(
    pieces: FloatArray,
    leaving: FloatArray,
    arriving: FloatArray,
    t: FloatArray,
    joints: Joints,
    *,
    closed: bool,
) -> tuple[Point, ...]:
    """Return the points of a path of pieces (k, 4, 2) with these velocities at their ends, (k, 2)."""
    start, end, steps = _pairs(leaving), _pairs(arriving), joints.steps.tolist()
    positions, at = _pairs(pieces[:, 0]), t.tolist()
    points = []
    for i, (x, y) in enumerate(positions):
        # At one speed, the longer handle knows the direction best: a straight piece stays straight.
        through = end[i - 1] if steps[i - 1] >= steps[i] else start[i]
        if i == 0 and not closed:
            points.append(Point(x, y, at[0], start[0]))
        elif joints.tied[i - 1]:
            before, after = (through, through) if joints.smooth[i - 1] else (end[i - 1], start[i])
            point = tie(Point(x, y, at[i]), before, after, (steps[i - 1], steps[i]))
            points.append(replace(point, even=True) if joints.even[i - 1] else point)
        elif joints.smooth[i - 1]:
            points.append(Point(x, y, at[i], through))
        else:
            points.append(Point(x, y, at[i], end[i - 1], corner=True, velocity_after=start[i]))
    if not closed:
        x, y = pieces[-1, 3].tolist()
        points.append(Point(x, y, at[-1], end[-1]))
    return tuple(points)


def _pairs(values: FloatArray) -> list[Vector]:
    return [(x, y) for x, y in values.tolist()]


RELATIVE_TOLERANCE = 1e-5
"""Usual tolerance of what is computed further, against the larger side of a curve."""

# A control point moves the curve by at most the largest value of its Bernstein polynomial.
_INFLUENCE = 4.0 / 9.0


class CubicPoints(msgspec.Struct, frozen=True):
    """Points that make a cubic Hermite curve of pieces.

    Attributes
    ----------
    points
        With velocities, and manual parameters from 0 to 1.
    moved
        The largest change of the curve where joints were made smooth.
    """

    points: tuple[Point, ...]
    moved: float


def points_of_cubics(
    pieces: FloatArray, *, closed: bool, most_turned: float = EXACT, letters: str = ""
) -> CubicPoints:
    """Return the points of pieces (k, 4, 2), each of some length and beginning where the one before ends.

    Parameters
    ----------
    closed
        Whether the last piece ends where the first begins, on purpose.
    most_turned
        Largest angle by which a handle is turned to continue the one before.
    letters
        `CORNER`, `TIED` or `EVEN` for each point, which is of that kind where possible; others are ignored.

    Raises
    ------
    EditError
        If their lengths are too different for one curve.
    """
    if closed and len(pieces) == 1:
        pieces = _halves(pieces[0])
    if len(letters) != len(pieces) + (not closed):
        letters = ""
    leaving, arriving = 3 * (pieces[:, 1] - pieces[:, 0]), 3 * (pieces[:, 3] - pieces[:, 2])
    size = float(np.ptp(pieces.reshape(-1, 2), axis=0).max())
    joints = Joints(leaving, arriving, _lengths(pieces), SMOOTH * size, closed, most_turned, letters)
    t = np.append(0.0, np.cumsum(joints.steps))
    t /= t[-1]
    if not (np.diff(t) > 0).all():
        raise EditError("The lengths of the pieces differ too much for one curve.")
    h = np.diff(t)[:, None]
    points = points_of(pieces, leaving / h, arriving / h, t, joints, closed=closed)
    return CubicPoints(points, _INFLUENCE * joints.moved)


def _halves(piece: FloatArray) -> FloatArray:
    """Return a cubic piece (4, 2) as two (de Casteljau)."""
    a, b, c, d = piece
    ab, bc, cd = (a + b) / 2, (b + c) / 2, (c + d) / 2
    abc, bcd = (ab + bc) / 2, (bc + cd) / 2
    middle = (abc + bcd) / 2
    return np.array([[a, ab, abc, middle], [middle, bcd, cd, d]])


def _lengths(pieces: FloatArray) -> FloatArray:
    return np.asarray(np.hypot(*np.moveaxis(np.diff(pieces, axis=1), 2, 0)).sum(axis=1))
