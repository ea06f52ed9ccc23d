"""A text that is written anew where its letters are now, as they were moved, turned and scaled since."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from difflib import SequenceMatcher
from itertools import chain, repeat
from typing import NamedTuple

import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray

from ...document.curve_tree import group_around
from ...document.group_look import with_names
from ...document.model import Curve, Document
from ...document.shape_edits import names_of
from ...document.text import Text
from ...document.texts import text_around
from ...document.transforms import IDENTITY, Affine, transform_points
from ...exchange.naming import Names
from ...qt.glyphs import Face, Outlines, outlines_of
from ...view_model.shapes.formed import pieces_of
from .letters import lettered, name_of_text

_NEAR = 1e-6
"""Of the extent of the letters: as far may roundings take a point."""
_SAME = 1e-9


class Written(NamedTuple):
    """A text of a document that is edited.

    Attributes
    ----------
    places
        Of its letters.
    text
        What they were written as, at the place and of the size that they have now.
    by
        What else became of them: a turn, a stretch.
    is_changed
        Whether that does not tell all: they were changed by hand, or come from another font.
    """

    places: range
    text: Text
    by: Affine
    is_changed: bool

    @property
    def face(self) -> Face:
        """The font."""
        return Face(self.text.font, self.text.bold, self.text.italic)


def written_at(document: Document, curve: int) -> Written | None:
    """Return the text that a curve is a letter of; None where it is of none."""
    places = text_around(document, curve)
    text = document.curves[curve].text
    if text is None:
        return None
    outlines = outlines_of(text.words, Face(text.font, text.bold, text.italic), text.setting)
    found = [document.curves[place] for place in places]
    made = lettered(outlines, text, found[0].style) if outlines.glyphs else ()
    matrix, is_exact = _map_between([_marks(each) for each in made], [_marks(each) for each in found])
    size = math.sqrt(abs(np.linalg.det(matrix[:2])))
    if not size:
        matrix, size = np.vstack([np.eye(2), matrix[2]]), 1.0
    elif math.isclose(size, 1.0, rel_tol=_SAME):
        size = 1.0
    x, y = np.array([text.x, text.y, 1.0]) @ matrix
    (xx, yx), (xy, yy) = (matrix[:2] / size - np.eye(2)).tolist()
    centre = (float(x), float(y))
    rest = Affine(xx, xy, yx, yy, centre) if max(map(abs, (xx, xy, yx, yy))) > _SAME else IDENTITY
    now = replace(text, x=centre[0], y=centre[1], size=text.size * size, begins=False)
    return Written(places, now, rest, is_changed=not is_exact)


def _marks(curve: Curve) -> FloatArray:
    """Return the points of a curve with the ends of their handles, (n, 2)."""
    # Not the velocities: the file of another program may take a joint for another kind.
    pieces = pieces_of(curve)
    places = [point.position for point in curve.points] if pieces is None else pieces[:, :3]
    return np.array(places).reshape(-1, 2)


def _map_between(made: Sequence[FloatArray], found: Sequence[FloatArray]) -> tuple[FloatArray, bool]:
    """Return the affine map (3, 2) that takes most letters to where they are, and whether it takes all."""
    pairs = list(_pairs(made, found))
    if not pairs:
        return _moved_alone(made, found), False
    here, there = map(np.vstack, zip(*pairs, strict=True))
    near = _NEAR * float(np.ptp(np.vstack(found), axis=0).max())
    best, is_all = _fitted(here, there), len(pairs) == len(made) == len(found)
    far = _distances(best, here, there)
    if far.max() <= near:
        return best, is_all
    most = 0
    # Those that were changed must not turn the others.
    for one, other in pairs:
        if np.linalg.matrix_rank(one - one.mean(axis=0)) == 2:
            matrix = _fitted(one, other)
            count = int((_distances(matrix, here, there) <= near).sum())
            if count > max(most, len(one) if len(pairs) > 1 else 0):
                best, most = matrix, count
    return best, False


def _pairs(
    made: Sequence[FloatArray], found: Sequence[FloatArray]
) -> Iterator[tuple[FloatArray, FloatArray]]:
    """Yield the curves that stand for each other: of as many points, in the same order."""
    matcher = SequenceMatcher(
        None, [len(each) for each in made], [len(each) for each in found], autojunk=False
    )
    for first, second, count in matcher.get_matching_blocks():
        yield from zip(made[first : first + count], found[second : second + count], strict=True)


def _fitted(here: FloatArray, there: FloatArray) -> FloatArray:
    """Return the map (3, 2) that takes places to others with the least squares."""
    middle = here.mean(axis=0)
    matrix = np.linalg.lstsq(here - middle, there - there.mean(axis=0), rcond=None)[0]
    return np.vstack([matrix, there.mean(axis=0) - middle @ matrix])


def _distances(matrix: FloatArray, here: FloatArray, there: FloatArray) -> FloatArray:
    distances: FloatArray = np.hypot(*(here @ matrix[:2] + matrix[2] - there).T)
    return distances


def _moved_alone(made: Sequence[FloatArray], found: Sequence[FloatArray]) -> FloatArray:
    """Return the map that takes the lower left corner of the letters to where it is now."""
    shift = np.zeros(2)
    if made and any(map(len, found)):
        shift = np.vstack(found).min(axis=0) - np.vstack(made).min(axis=0)
    return np.vstack([np.eye(2), shift])


def rewritten(document: Document, written: Written, text: Text, outlines: Outlines) -> tuple[Document, range]:
    """Return the document with other letters in place of those of a text, and their places."""
    curves, places = document.curves, written.places
    before, behind = curves[: places.start], curves[places.stop :]
    first = curves[places.start]
    names = Names({*names_of((*before, *behind)), *document.layers})
    groups = _groups(document, places, text, outlines, names)
    # A group of its own is another one by name, and is seen as much as it was.
    looks = with_names(first.group_looks, dict(zip(first.groups, groups, strict=False)))
    letters = lettered(outlines, text, first.style, groups, names)
    made = Document(tuple(replace(each, group_looks=looks) for each in letters) if looks else letters)
    if written.by is not IDENTITY:
        for place, curve in enumerate(made.curves):
            made = transform_points(made, place, range(len(curve.points)), written.by)
    new = replace(document, curves=(*before, *made.curves, *behind))
    return new, range(places.start, places.start + len(made.curves))


def _groups(
    document: Document, places: range, text: Text, outlines: Outlines, names: Names
) -> tuple[str, ...]:
    """Return the groups of other letters: those that they were in, the own one by the name of the text.

    An own one comes to letters in none, where they are several; one with another name keeps that.
    """
    first = document.curves[places.start]
    groups, before, name = first.groups, first.text, name_of_text(text.words)
    if not groups or groups[-1] in document.layers:
        return groups if len(outlines.glyphs) == 1 else (*groups, names.different(name))
    old = name_of_text(before.words) if before is not None else ""
    is_own = group_around(document.curves, places.start, len(groups) - 1) == places
    if not is_own or old == name or not groups[-1].startswith(old):
        return groups
    return (*groups[:-1], names.different(name))


def with_curves_of(document: Document, shown: Document) -> Document:
    """Return the document, of the curves that are shown already the very same: their views are there."""
    before = chain(shown.curves, repeat(None))
    return replace(
        document,
        curves=tuple(old if old == new else new for new, old in zip(document.curves, before, strict=False)),
    )
