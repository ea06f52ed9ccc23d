"""Cubic Bézier pieces in: a path from another program becomes a cubic Hermite curve, exactly.

Readers make an `ImportedPath` of each path; `import_paths` makes curves of them. Arcs become pieces within a
stated distance; the letters of the kinds of points are those of Inkscape: c corner, s smooth, z symmetric.

References
----------
.. [1] SVG 2, appendix B.2: from the ends of an arc to its centre.
.. [2] M. Goldapp, "Approximation of circular arcs by cubic polynomials", CAGD 8 (1991) 227-238: the
   error of a piece over the angle a is at most 2/27 sin(a/4)^6 / cos(a/4)^2 of the radius.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase
from itertools import compress
from typing import NamedTuple

import msgspec
import numpy as np

from curvecore.arrays import BoolArray, FloatArray

from ..document.groups import tidy_shapes
from ..document.limits import MAX_MAGNITUDE, EditError
from ..document.model import (
    Curve,
    Document,
    Parametrization,
    ParametrizationKind,
    Point,
    Vector,
    empty_document,
)
from ..document.style import PLAIN_STYLE, Style
from ..families import HERMITE
from ..storage.format_error import FormatError
from ..storage.validation import validate_changes
from ..view_model.cubics import CORNER, EVEN, TIED, WRITTEN_BY_PROGRAMS, are_alike, points_of_cubics
from .errors import LEFT_OUT, ExchangeError, Loss, Losses

MAX_PIECES = 100_000
"""Pieces of the longest path that is read."""

FAMILY = HERMITE
"""The family of imported curves."""

SINGLE_POINT = Loss("single point")

_TOO_LARGE = Loss("curve", f"with coordinates or velocities outside −1e12 to 1e12 {LEFT_OUT}")
_TOO_DIFFERENT = Loss("curve", f"with pieces of very different lengths {LEFT_OUT}")
_TOO_MANY = Loss("curve", f"of more than {MAX_PIECES} pieces {LEFT_OUT}")

_MANUAL = Parametrization(ParametrizationKind.MANUAL)
_ROUNDING = 2.0**-48
"""Share of the coordinates, for each piece: a bound of the rounding where programs add steps up."""

_OUTER = 3
_MOST_NAMES = 24
"""Limits of a list of groups: the three outermost of each curve, and 24 names."""


@dataclass(frozen=True)
class ImportResult:
    """Content of a file that was read.

    Attributes
    ----------
    document
        The curves; the only one has no points where the file has no curve.
    deviation
        Largest distance of its curves from those of the file, but for rounding.
    remarks
        One sentence for each kind of content that was left out or changed.
    """

    document: Document
    deviation: float = 0.0
    remarks: tuple[str, ...] = ()

    @property
    def has_curves(self) -> bool:
        """Whether any curve has a point."""
        return any(curve.points for curve in self.document.curves)

    def with_curves(self) -> ImportResult:
        """Return the result itself.

        Raises
        ------
        ExchangeError
            If there is no curve, with the remarks.
        """
        if not self.has_curves:
            raise ExchangeError(" ".join(["The file contains no curves.", *self.remarks]))
        return self

    def only(self, included: Sequence[bool]) -> ImportResult:
        """Return some of the curves, at least one; the deviation stays a bound."""
        curves = tuple(compress(self.document.curves, included))
        document = msgspec.structs.replace(self.document, curves=curves)
        return replace(self, document=tidy_shapes(document))

    def named(self, names: Sequence[str]) -> ImportResult:
        """Return the curves with one of these names, or in a group with one; “*” stands for any text.

        Raises
        ------
        ExchangeError
            If there is none, with the names in the file.
        """
        names_of_curves = [(*curve.groups, curve.shape, curve.name) for curve in self.document.curves]
        included = [
            any(fnmatchcase(name, pattern) for name in curve_names for pattern in names)
            for curve_names in names_of_curves
        ]
        if not any(included):
            raise ExchangeError(
                f"No curve or group is named “{', '.join(names)}”; the file contains {self.contents()}."
            )
        return self.only(included)

    def contents(self) -> str:
        """Return the names of the outer groups, or of the curves, with how many curves they hold."""
        names = [curve.groups[:_OUTER] or (curve.name,) for curve in self.document.curves]
        counts = Counter(name for curve_names in names for name in dict.fromkeys(curve_names))
        entries = [f"{name} ({count})" if count > 1 else name for name, count in counts.items()]
        more = len(entries) - _MOST_NAMES
        return ", ".join([*entries[:_MOST_NAMES], *([f"and {more} more"] if more > 0 else [])])


@dataclass(frozen=True)
class Look:
    """Look that a path shares with all others of its shape; see `Curve`."""

    style: Style = PLAIN_STYLE
    shape: str = ""
    groups: tuple[str, ...] = ()
    visible: bool = True
    locked: bool = False


@dataclass(frozen=True, eq=False)
class ImportedPath:
    """A path as cubic pieces.

    Attributes
    ----------
    name
        As in `Curve`.
    look
        Style, shape, groups, visibility and lock.
    pieces
        (k, 4, 2); each begins where the one before ends.
    closed
        Whether the path is meant to be closed: the last piece ends where the first begins.
    deviation
        Largest distance from the path of the file.
    letters
        Kinds of its points; see `letters_of`.
    has_dots
        Whether the path is a dot where it has no length.
    """

    name: str
    look: Look
    pieces: FloatArray
    closed: bool
    deviation: float = 0.0
    letters: str = ""
    has_dots: bool = False


@dataclass(frozen=True)
class PathThroughPoints:
    """A path that a file gives only by the points on it.

    Attributes
    ----------
    name, look
        As in `ImportedPath`.
    points
        The points in order; the first is not repeated at the end.
    closed
        As in `Curve`.
    """

    name: str
    look: Look
    points: tuple[Vector, ...]
    closed: bool


def import_paths(paths: Sequence[ImportedPath | PathThroughPoints], losses: Losses) -> ImportResult:
    """Return the curves of paths as a document; single points and curves out of range are losses."""
    curves, deviation = list[Curve](), 0.0
    for index, path in enumerate(paths):
        outcome = _curve(path)
        if isinstance(outcome, Loss):
            losses.note(outcome, index, path.name)
            continue
        try:
            validate_changes(None, Document((outcome.curve,)))
        except FormatError:
            losses.note(_TOO_LARGE, index, path.name)
            continue
        curves.append(outcome.curve)
        deviation = max(deviation, outcome.deviation)
    document = tidy_shapes(Document(tuple(curves))) if curves else empty_document()
    return ImportResult(document, deviation, losses.sentences)


def lines(points: FloatArray) -> FloatArray:
    """Return the polyline through points (n, 2) as cubic pieces (n - 1, 4, 2)."""
    start, end = points[:-1], points[1:]
    third = (end - start) / 3
    return np.stack([start, start + third, end - third, end], axis=1)


def rounding_of(pieces: FloatArray) -> float:
    """Return the largest distance between ends of pieces (k, 4, 2) that are meant to meet."""
    return _ROUNDING * len(pieces) * float(np.abs(pieces).max(initial=0.0))


def without_roundings(pieces: FloatArray, *, closed: bool) -> FloatArray:
    """Return pieces (k, 4, 2) without those that are as short as roundings; their neighbours meet exactly.

    Loops, whose ends meet while their handles are longer than that, are pieces. Of a closed path the last
    one ends where the first begins.
    """
    pieces = pieces[has_length(pieces)]
    bound = rounding_of(pieces)
    if not np.isfinite(bound):
        return pieces
    long = np.abs(pieces - pieces[:, :1]).max(axis=(1, 2)) > bound
    result = pieces if long.all() else _joined(pieces, bound)
    if closed and len(result) and np.abs(result[-1, 3] - pieces[0, 0]).max() <= bound:
        result = result.copy()
        put_end(result[-1], pieces[0, 0])
    return result


def _joined(pieces: FloatArray, bound: float) -> FloatArray:
    result, at = list[FloatArray](), pieces[0, 0]
    for piece in pieces:
        # Measured from the end of the last piece: many short ones in one direction add up.
        if np.abs(piece - at).max() > bound:
            result.append(piece.copy())
            put_end(result[-1][::-1], at)
            at = piece[3]
    return np.array(result).reshape(-1, 4, 2)


def has_length(pieces: FloatArray) -> BoolArray:
    """Return for each of the pieces (k, 4, 2) whether it is more than a point."""
    return np.asarray((pieces != pieces[:, :1]).any(axis=(1, 2)))


def put_end(piece: FloatArray, end: FloatArray) -> None:
    """Move the end of a piece (4, 2), in place; lines and handles without length stay such."""
    first, second = piece[1:3] + (end - piece[3]) * np.array([[1 / 3], [2 / 3]])
    piece[1] = piece[0] if (piece[1] == piece[0]).all() else first
    piece[2] = end if (piece[2] == piece[3]).all() else second
    piece[3] = end


class _CurveOfPath(NamedTuple):
    """A curve and a bound of its distance from the path of the file."""

    curve: Curve
    deviation: float = 0.0


def _dot(path: ImportedPath) -> _CurveOfPath:
    """Return a curve without length, of two points at one position, for the caps of its stroke."""
    x, y = path.pieces[0, 0].tolist()
    points = tuple(Point(x, y, t, (0.0, 0.0)) for t in (0.0, 1.0))
    return _CurveOfPath(_curve_with(replace(path, closed=False), _MANUAL, points))


def _curve_with(
    path: ImportedPath | PathThroughPoints, parametrization: Parametrization, points: tuple[Point, ...]
) -> Curve:
    look = path.look
    return Curve(
        path.name,
        FAMILY,
        parametrization,
        points,
        closed=path.closed,
        style=look.style,
        shape=look.shape,
        groups=look.groups,
        visible=look.visible,
        locked=look.locked,
    )


def _curve(path: ImportedPath | PathThroughPoints) -> _CurveOfPath | Loss:
    """Return a path as a curve, or the loss; through points it is the natural spline, by chord length."""
    if isinstance(path, PathThroughPoints):
        return _CurveOfPath(_curve_with(path, Parametrization(), tuple(Point(x, y) for x, y in path.points)))
    # Written so that NaN fails.
    if not (np.abs(path.pieces) <= MAX_MAGNITUDE).all():
        return _TOO_LARGE
    if len(path.pieces) > MAX_PIECES:
        return _TOO_MANY
    pieces = without_roundings(path.pieces, closed=path.closed)
    if len(pieces) == 0:
        return _dot(path) if path.has_dots else SINGLE_POINT
    try:
        cubics = points_of_cubics(
            pieces, closed=path.closed, most_turned=WRITTEN_BY_PROGRAMS, letters=path.letters
        )
    except EditError:
        return _TOO_DIFFERENT
    is_rounding = cubics.moved <= _ROUNDING * np.abs(pieces).max()
    curve = _curve_with(path, _MANUAL, cubics.points)
    return _CurveOfPath(curve, path.deviation + (0.0 if is_rounding else cubics.moved))


# Arcs


PIECES_OF_A_TURN = 4
"""Pieces of a whole turn, if no tolerance is given, as in drawing programs: within 2.8e-4 of the radius."""

MOST_PIECES = 1000


@dataclass(frozen=True, eq=False)
class Arc:
    """An arc as cubic pieces (k, 4, 2), with a bound of their distance from it."""

    pieces: FloatArray
    deviation: float


def arc(
    centre: FloatArray, axes: FloatArray, start: float, sweep: float, tolerance: float | None = None
) -> Arc:
    """Return the arc centre + cos(a) axes[0] + sin(a) axes[1], a from `start` over `sweep`, in radians.

    Parameters
    ----------
    centre
        (2,).
    axes
        Two half axes, (2, 2); they need be neither orthogonal nor of one length.
    tolerance
        Largest distance allowed; by default what `PIECES_OF_A_TURN` gives.
    """
    radius = float(np.linalg.norm(axes, 2))
    if not np.isfinite(radius):
        raise ExchangeError("The radius of an arc is out of range.")
    count = pieces_of_arc(radius, sweep, tolerance)
    angles = start + sweep * (np.arange(count + 1) / count)
    handle = 4 / 3 * math.tan(sweep / count / 4)
    circle = np.column_stack([np.cos(angles), np.sin(angles)])
    tangent = np.column_stack([-circle[:, 1], circle[:, 0]]) * handle
    pieces = np.stack([circle[:-1], circle[:-1] + tangent[:-1], circle[1:] - tangent[1:], circle[1:]], axis=1)
    return Arc(centre + pieces @ axes, radius * error_of_arc(sweep / count))


def arc_between(
    start: FloatArray,
    end: FloatArray,
    radii: tuple[float, float],
    rotation: float,
    large: bool,
    positive: bool,
    tolerance: float | None = None,
) -> Arc | None:
    """Return SVG's arc from start to end [1]_; None where it is a straight line.

    Parameters
    ----------
    radii
        Radii of the ellipse, enlarged where they are too small.
    rotation
        Rotation of its first axis, in degrees.
    large, positive
        The two flags: the longer arc, and the direction of growing angles.
    """
    rx, ry = abs(radii[0]), abs(radii[1])
    if rx == 0 or ry == 0 or (start == end).all():
        return None
    phi = math.radians(rotation % 360)
    turn = np.array([[math.cos(phi), math.sin(phi)], [-math.sin(phi), math.cos(phi)]])
    half = turn @ ((start - end) / 2) / (rx, ry)
    square = float(half @ half)
    if not math.isfinite(square) or square == 0:
        raise ExchangeError("The radii of an arc do not fit its ends.")
    grow = max(1.0, math.sqrt(square))
    middle, first, sweep = _on_unit_circle(half / grow, large, positive)
    axes = np.array([[rx], [ry]]) * grow * turn
    centre = (start + end) / 2 + middle @ axes
    result = arc(centre, axes, first, sweep, tolerance)
    # The ends meet their neighbours exactly, whatever the rounding.
    result.pieces[0, 0], result.pieces[-1, 3] = start, end
    return result


def _on_unit_circle(half: FloatArray, large: bool, positive: bool) -> tuple[FloatArray, float, float]:
    """Return the centre, first angle and sweep of an arc of radius 1 from `half` to its opposite."""
    away = math.sqrt(max(0.0, 1 / min(float(half @ half), 1.0) - 1)) * (1 if large != positive else -1)
    middle = away * np.array([half[1], -half[0]])
    first = math.atan2(half[1] - middle[1], half[0] - middle[0])
    last = math.atan2(-half[1] - middle[1], -half[0] - middle[0])
    return middle, first, (last - first) % math.tau if positive else -((first - last) % math.tau)


def pieces_of_arc(
    radius: float,
    sweep: float,
    tolerance: float | None = None,
    most: int = MOST_PIECES,
    *,
    turn: int = PIECES_OF_A_TURN,
) -> int:
    """Return the number of cubic pieces that an arc over `sweep` needs, at least `turn` of a turn."""
    count = max(1, math.ceil(abs(sweep) / math.tau * turn - 1e-9))
    while tolerance is not None and radius * error_of_arc(sweep / count) > tolerance and count < most:
        count += 1
    return count


def error_of_arc(angle: float) -> float:
    """Return a bound of the distance of a cubic piece over an angle from the unit circle [2]_."""
    quarter = abs(angle) / 4
    return 2 / 27 * math.sin(quarter) ** 6 / math.cos(quarter) ** 2


# Kinds of points


def letters_of(curve: Curve, pieces: FloatArray) -> str:
    """Return the letter of each point of a curve of these pieces, (k, 4, 2); empty for other curves."""
    segments = len(curve.points) - (not curve.is_closed)
    if curve.family is not HERMITE or len(pieces) != segments:
        return ""
    return _letters(curve.points, pieces, closed=curve.is_closed)


def guessed_letters(pieces: FloatArray, *, closed: bool) -> str:
    """Return the letters that a reader gives to pieces without letters in the file."""
    if not np.ptp(pieces, axis=1).any(axis=1).all():
        return ""  # a reader leaves out those of no length
    try:
        cubics = points_of_cubics(pieces, closed=closed, most_turned=WRITTEN_BY_PROGRAMS)
    except EditError:
        return ""
    return _letters(cubics.points, pieces, closed=closed)


def _letters(points: Sequence[Point], pieces: FloatArray, *, closed: bool) -> str:
    before, after = pieces[:, 3] - pieces[:, 2], np.roll(pieces[:, 1] - pieces[:, 0], -1, axis=0)
    even = np.roll(are_alike(np.hypot(*before.T), np.hypot(*after.T)), 1).tolist()
    if len(points) > len(even) + (not closed):
        # A single piece was imported as two.
        return ""
    inner = [_letter(point, is_even) for point, is_even in zip(points, even, strict=False)]
    return "".join(inner if closed else [CORNER, *inner[1:], CORNER])


def _letter(point: Point, is_even: bool) -> str:
    if point.corner and not point.tied:
        return CORNER
    return EVEN if (point.even if point.tied else is_even) else TIED


def joined_letters(outlines: Sequence[tuple[str, bool]]) -> str:
    """Return the letters of a path from those of its outlines, each open or closed; empty if some lack.

    The first letter of a closed outline is repeated at its end.
    """
    parts = [letters + (letters[:1] if closed else "") for letters, closed in outlines]
    return "".join(parts) if all(parts) else ""


def split_letters(letters: str, outlines: Sequence[tuple[int, bool]]) -> list[str]:
    """Return the letters of each outline, by its number of pieces; empty where the numbers do not fit."""
    ends = np.cumsum([count + 1 for count, _ in outlines]).tolist()
    if len(letters) != ends[-1]:
        return [""] * len(outlines)
    ranges = zip(outlines, ends, strict=True)
    return [letters[end - count - 1 : end - closed] for (count, closed), end in ranges]
