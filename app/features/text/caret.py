"""Where the caret stands in a text that is typed: as its letters are shown, or where the first will be."""

from __future__ import annotations

from msgspec.structs import replace
from PySide6.QtGui import QTransform

from ...document.content import Lettering, TextRun, lettering
from ...document.contents import corners_of, plane_of
from ...document.flow import Flow
from ...document.model import Curve, Vector
from ...document.text import Text
from ...document.transforms import IDENTITY, Affine
from ...qt.caret_places import CaretPlaces, places_of
from ...qt.contents import line_step, way_of
from . import flowing
from .wording import WEIGHTS, Letters, Look, Typed, new_lines, said_lines

_NO_BOX = (0.0, 0.0, 1.0, 1.0)


def in_new(text: Text, typed: Typed) -> CaretPlaces:
    """Return the places in a new text."""
    return places_of(lettering(new_lines(text, typed), _NO_BOX), _way_to(text))


def in_new_frame(text: Text, typed: Typed, room: Vector) -> CaretPlaces:
    """Return the places in a frame so wide and so high, in which there are no letters yet."""
    lines = new_lines(text, typed)
    run = lines[0].runs[0]
    flow = Flow(text.line_spacing * line_step(run) / run.size)
    runs = [line.runs for line in lines]
    return places_of(flowing.filling(runs, (0.0, 0.0, *room), lines[0].anchor, flow), _way_to(text))


def in_shown(curve: Curve, before: Curve, begun: Text, now: Text, typed: Typed) -> CaretPlaces:
    """Return the places in a text as it is shown, which was another one before."""
    text, was = curve.form, before.form
    assert isinstance(text, Lettering)
    assert isinstance(was, Lettering)
    way = way_of(plane_of(text, corners_of(curve)))
    has_letters = any(words.strip() for line in typed for words, _ in line)
    if not has_letters or (text.flow is None and text.along is None):
        lines = said_lines(was, begun, now, typed)
        if text.along is not None:
            # A blank stands where the first letter will.
            lines = (replace(lines[0], runs=(replace(lines[0].runs[0], words=" "),)),)
        text = replace(text, lines=lines)
    return places_of(text, way)


def in_frame(curve: Curve) -> CaretPlaces:
    """Return the places in a text that fills a frame, or lies along a course."""
    assert isinstance(curve.form, Lettering)
    return places_of(curve.form, way_of(plane_of(curve.form, corners_of(curve))))


def in_outlines(text: Text, by: Affine = IDENTITY) -> CaretPlaces:
    """Return the places in a text whose letters are curves, which something else became of since."""
    run = TextRun("", (text.font,), text.size, WEIGHTS[text.bold], text.italic)
    typed = tuple((Letters(line, Look(run, 0)),) for line in text.words.split("\n"))
    x, y = by.point((0.0, 0.0))
    (right, up), (left, high) = by.vector((1.0, 0.0)), by.vector((0.0, 1.0))
    return in_new(text, typed).mapped(QTransform(right, up, left, high, x, y))


def _way_to(text: Text) -> QTransform:
    return QTransform(1.0, 0.0, 0.0, -1.0, text.x, text.y)
