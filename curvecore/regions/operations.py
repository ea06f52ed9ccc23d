"""Boolean operations on regions.

All of them arrange the contours once (`arrangement`): an edge of which one
side is inside of what is asked for, and the other is not, bounds it. So
operations differ in a function from the insides of the regions to that of
the result, and shapes of any number and kind of contours are combined at
once [1]_.

References
----------
.. [1] B. R. Vatti, "A generic solution to polygon clipping", Communications
   of the ACM 35 (1992) 56-63, section 5: winding rules as functions of what
   lies on both sides; here over an arrangement of curves in place of a sweep.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from curvecore.arrays import BoolArray, FloatArray, IntArray
from curvecore.errors import CurveError
from curvecore.regions.arrangement import Arrangement, arranged
from curvecore.regions.assembly import contours_of
from curvecore.regions.nesting import connected_parts
from curvecore.regions.outlines import Outlines, outlines_of
from curvecore.regions.region import Region, is_sliver

_TOLERANCE = 1e-9
"""Share of the size of everything within which things are together; then what is tried if that fails."""

_TRIED = (1.0, 1e2, 1e-1, 1e4)
_SLIVER = 4.0
"""In tolerances: contours that are thinner than that bound nothing."""

Progress = Callable[[float], object]
"""Hears the share that is done, between 0 and 1, now and then; what it raises ends the work."""

_Inside = Callable[[BoolArray], BoolArray]
"""Returns what is inside of a result, (k,), by what is inside of the regions, (k, regions)."""


def unheard(_share: float) -> None:
    """Report to nobody."""


def union(regions: Sequence[Region], *, progress: Progress = unheard) -> Region:
    """Return what is inside of any of some regions.

    Parameters
    ----------
    regions : sequence of Region
        Any number of them.
    progress : callable, optional
        Hears the share that is done, between 0 and 1, now and then; what it raises ends the work.

    Returns
    -------
    Region
        Its contours run to the left around the inside, and cross neither themselves nor each other. What
        was not cut has the control points it had.

    Raises
    ------
    CurveError
        If roundings hide how the contours lie.

    See Also
    --------
    intersection, difference, exclusion, division, simplified : Other operations.

    Notes
    -----
    What is nearer together than a billionth of the size of everything is taken for one: contours that
    share an edge, or touch, do so exactly.

    Examples
    --------
    >>> from curvecore import Region, union
    >>> left = Region.of_polygon([[0, 0], [2, 0], [2, 1], [0, 1]])
    >>> right = Region.of_polygon([[1, 0], [3, 0], [3, 1], [1, 1]])
    >>> union([left, right]).area
    3.0
    """
    return _combined(regions, _in_any, progress)


def intersection(regions: Sequence[Region], *, progress: Progress = unheard) -> Region:
    """Return what is inside of all of some regions.

    Parameters
    ----------
    regions : sequence of Region
        Any number of them.
    progress : callable, optional
        Hears the share that is done, between 0 and 1, now and then; what it raises ends the work.

    Returns
    -------
    Region
        As of `union`.

    Raises
    ------
    CurveError
        If roundings hide how the contours lie.

    See Also
    --------
    union : What results look like.

    Examples
    --------
    >>> from curvecore import Region, intersection
    >>> left = Region.of_polygon([[0, 0], [2, 0], [2, 1], [0, 1]])
    >>> right = Region.of_polygon([[1, 0], [3, 0], [3, 1], [1, 1]])
    >>> round(intersection([left, right]).area, 12)
    1.0
    """
    return _combined(regions, _in_all, progress)


def exclusion(regions: Sequence[Region], *, progress: Progress = unheard) -> Region:
    """Return what is inside of an odd number of some regions.

    Parameters
    ----------
    regions : sequence of Region
        Any number of them.
    progress : callable, optional
        Hears the share that is done, between 0 and 1, now and then; what it raises ends the work.

    Returns
    -------
    Region
        As of `union`.

    Raises
    ------
    CurveError
        If roundings hide how the contours lie.

    See Also
    --------
    union : What results look like.

    Examples
    --------
    >>> from curvecore import Region, exclusion
    >>> left = Region.of_polygon([[0, 0], [2, 0], [2, 1], [0, 1]])
    >>> right = Region.of_polygon([[1, 0], [3, 0], [3, 1], [1, 1]])
    >>> round(exclusion([left, right]).area, 12)
    2.0
    """
    return _combined(regions, _in_odd, progress)


def difference(region: Region, others: Sequence[Region], *, progress: Progress = unheard) -> Region:
    """Return what is inside of a region and of none of some others.

    Parameters
    ----------
    region : Region
        From which is taken.
    others : sequence of Region
        What is taken away.
    progress : callable, optional
        Hears the share that is done, between 0 and 1, now and then; what it raises ends the work.

    Returns
    -------
    Region
        As of `union`.

    Raises
    ------
    CurveError
        If roundings hide how the contours lie.

    See Also
    --------
    division : The parts that are taken, too.
    union : What results look like.

    Examples
    --------
    >>> from curvecore import Region, difference
    >>> left = Region.of_polygon([[0, 0], [2, 0], [2, 1], [0, 1]])
    >>> right = Region.of_polygon([[1, 0], [3, 0], [3, 1], [1, 1]])
    >>> round(difference(left, [right]).area, 12)
    1.0
    """
    return _combined([region, *others], _in_first_alone, progress)


def division(region: Region, others: Sequence[Region], *, progress: Progress = unheard) -> list[Region]:
    """Return the parts into which a region is cut by the contours of the insides of others.

    Parameters
    ----------
    region : Region
        Which is divided.
    others : sequence of Region
        What divides it.
    progress : callable, optional
        Hears the share that is done, between 0 and 1, now and then; what it raises ends the work.

    Returns
    -------
    list of Region
        Each a connected one, perhaps with holes; those outside of the others come first.

    Raises
    ------
    CurveError
        If roundings hide how the contours lie.

    See Also
    --------
    difference : The parts outside of the others alone.

    Examples
    --------
    >>> from curvecore import Region, division
    >>> bar = Region.of_polygon([[0, 0], [3, 0], [3, 1], [0, 1]])
    >>> cutter = Region.of_polygon([[1, -1], [2, -1], [2, 2], [1, 2]])
    >>> [round(part.area, 12) for part in division(bar, [cutter])]
    [1.0, 1.0, 1.0]
    """
    kinds: list[_Inside] = [_in_first_alone, lambda inside: inside[:, 0] & _in_any(inside[:, 1:])]
    found = _each([region, *others], kinds, progress)
    return [Region(part) for parts in found for part in parts]


def simplified(region: Region, *, progress: Progress = unheard) -> Region:
    """Return a region with contours that cross neither themselves nor each other.

    Parameters
    ----------
    region : Region
        Any.
    progress : callable, optional
        Hears the share that is done, between 0 and 1, now and then; what it raises ends the work.

    Returns
    -------
    Region
        The same inside, with contours as `union` makes them.

    Raises
    ------
    CurveError
        If roundings hide how the contours lie.

    See Also
    --------
    union : What results look like.

    Examples
    --------
    >>> from curvecore import Region, simplified
    >>> bow_tie = Region.of_polygon([[0, 0], [2, 2], [2, 0], [0, 2]])
    >>> bow_tie.area, round(simplified(bow_tie).area, 12)
    (0.0, 2.0)
    """
    return union([region], progress=progress)


def _in_any(inside: BoolArray) -> BoolArray:
    result: BoolArray = np.logical_or.reduce(inside, axis=1)
    return result


def _in_all(inside: BoolArray) -> BoolArray:
    result: BoolArray = np.logical_and.reduce(inside, axis=1)
    return result


def _in_odd(inside: BoolArray) -> BoolArray:
    result: BoolArray = np.logical_xor.reduce(inside, axis=1)
    return result


def _in_first_alone(inside: BoolArray) -> BoolArray:
    return inside[:, 0] & ~_in_any(inside[:, 1:])


def _combined(regions: Sequence[Region], inside: _Inside, progress: Progress) -> Region:
    parts = _each(regions, [inside], progress)[0]
    return Region([contour for part in parts for contour in part])


_Parts = list[tuple[FloatArray, ...]]
"""Contours of connected parts, each with its holes."""


def _each(regions: Sequence[Region], kinds: Sequence[_Inside], progress: Progress) -> list[_Parts]:
    """Return the parts of what is inside in several ways."""
    if not any(region.contours for region in regions):
        return [[] for _ in kinds]
    outlines = outlines_of([region.contours for region in regions])
    for factor in _TRIED:
        tolerance = max(_TOLERANCE * factor, outlines.rounding)
        found = arranged(outlines, len(regions), tolerance, progress)
        results = [_parts(outlines, found, regions, inside, tolerance) for inside in kinds]
        closed = [each for each in results if each is not None]
        if len(closed) == len(results):
            return closed
    raise CurveError("the contours lie so close together that nothing tells them apart")


def _parts(
    outlines: Outlines, found: Arrangement, regions: Sequence[Region], inside: _Inside, tolerance: float
) -> _Parts | None:
    """Return the parts of what is inside, to the left of their contours; None where these do not close."""
    left, right = (inside(_insides(regions, each)) for each in (found.left, found.right))
    bounds = left != right
    contours = contours_of(outlines, found.edges.taken(bounds), left[bounds])
    thin = _SLIVER * tolerance * outlines.size
    if contours is None:
        return None
    return connected_parts([each for each in contours if not is_sliver(each, thin)])


def _insides(regions: Sequence[Region], windings: IntArray) -> BoolArray:
    columns = [region.rule.is_inside(windings[:, place]) for place, region in enumerate(regions)]
    return np.stack(columns, axis=1)
