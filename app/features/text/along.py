"""Texts of drawings put on paths and taken off."""

from __future__ import annotations

from collections.abc import Callable, Collection

from msgspec.structs import replace

from ...document.along_edits import along_of, with_along
from ...document.along_path import UPSIDE_DOWN, Along
from ...document.content import Anchor, Lettering, TextLine, TextRun, lettering, rough_box_along
from ...document.contents import corners_of, is_content, plane_of, texts_at
from ...document.form_edits import framed
from ...document.limits import EditError
from ...document.model import Curve, Document
from ...document.shapes import shape_of
from ...qt.contents import fitted
from ...session.along_paths import by_ground, straightened
from ...view_model.shapes.courses import course_at
from .wording import in_a_line


def text_and_path(document: Document, places: Collection[int]) -> tuple[int, int] | None:
    """Return the places of a text and of the curve beside it, the first of its shape; None of all else."""
    texts = [*texts_at(document, places)]
    if len(texts) != 1:
        return None
    others = sorted(at for at in places if not is_content(document.curves[at]))
    if not others or 1 + len(others) != len(places):
        return None
    if not set(others) <= set(shape_of(document, others[0])):
        return None
    return texts[0], shape_of(document, others[0]).start


def put_on_path(document: Document, text: int, path: int, identity: Callable[[], str]) -> Document:
    """Return the document with a text along a curve, as large as it is; `identity` makes one for the curve.

    It begins where the curve does, or has its middle or its end there where it is anchored so.

    Raises
    ------
    EditError
        If the text is locked, or the curve has no length.
    """
    course = course_at(document, path)
    if not course:
        raise EditError(f"“{document.curves[path].name}” has no length for letters to stand on.")
    line = _sized_line(document.curves[text])
    if not document.curves[path].identity:
        named = replace(document.curves[path], identity=identity())
        document = document.with_curve(path, named)
    along = Along(
        by_ground(UPSIDE_DOWN, course),
        document.curves[path].identity,
        start=line.anchor.share,
        is_share=line.anchor is not Anchor.START,
    )
    return document.with_curve(text, _lying(document.curves[text], (line,), along))


def _lying(curve: Curve, lines: tuple[TextLine, ...], along: Along) -> Curve:
    """Return a text along a course in the plane."""
    box = rough_box_along(lines, along)
    form = replace(lettering(lines, box), along=along)
    left, top, right, bottom = box
    corners = [(left, -top), (right, -top), (right, -bottom), (left, -bottom)]
    frame = framed(form, corners, curve.name)
    return fitted(replace(curve, form=form, points=frame.points, parametrization=frame.parametrization))


def _sized_line(curve: Curve) -> TextLine:
    """Return all words of a text in a line, as large as they are in the plane."""
    text = curve.form
    assert isinstance(text, Lettering)
    scale = plane_of(text, corners_of(curve)).scale
    line = in_a_line(text.lines)
    return replace(line, x=0.0, y=0.0, runs=tuple(_sized(each, scale) for each in line.runs))


def _sized(run: TextRun, by: float) -> TextRun:
    paint = run.paint and replace(run.paint, width=run.paint.width * by)
    return replace(run.resized(by), paint=paint)


def removed_from_path(document: Document, places: Collection[int]) -> Document:
    """Return the document with texts that lie along no path any more: straight, from where they began."""
    for place in places:
        document = document.with_curve(place, straightened(document.curves[place]))
    return document


def flipped(document: Document, places: Collection[int]) -> Document:
    """Return the document with texts on the other sides of their paths."""
    for place in places:
        curve = document.curves[place]
        along = along_of(curve)
        assert along is not None
        document = document.with_curve(
            place, fitted(with_along(curve, replace(along, is_flipped=not along.is_flipped)))
        )
    return document
