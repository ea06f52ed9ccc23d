"""Texts and pictures in their frames, as paths and images of Qt: the same on the screen and in print."""

from __future__ import annotations

import re
from base64 import b64decode
from collections.abc import Iterator, Sequence
from functools import lru_cache
from unicodedata import bidirectional

import numpy as np
from msgspec.structs import replace
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontMetricsF,
    QImage,
    QPainter,
    QPainterPath,
    QPen,
    QPolygonF,
    QTransform,
)

from ..document.content import WHOLE, Lettering, Picture, RunPaint, TextLine, TextRun
from ..document.contents import Plane, corners_of, lettered_style, plane_of
from ..document.form_edits import framed
from ..document.model import Curve, Document, Vector
from ..document.style import Style
from . import glyphs
from .glyphs import Glyph, has_fonts
from .picture_data import ImageFileError, decoded

_WIDEST = 4.0
"""Widths of its line that a letter may reach beyond its outline, by miters."""

_EM = 1000
"""Pixels of an em in which outlines of letters are made: next to nothing of them is rounded."""

_PNG = "iVBOR"
"""How a PNG file begins in Base64."""

Corners = Sequence[Vector]
"""Those of a frame in the plane, from the upper left one on clockwise."""


def way_of(plane: Plane) -> QTransform:
    """Return the way from the units of what a frame shows to the plane."""
    return QTransform(*plane.across, *plane.down, plane.x, plane.y)


# Texts


def inked(
    text: Lettering, corners: Corners, way: QTransform, style: Style, area: QRectF
) -> Iterator[tuple[QPainterPath, Style]]:
    """Yield the words of a text where a way leads from the plane, each with its style; not those far away.

    That is as far beyond an area as the lines of letters may reach.
    """
    plane = plane_of(text, corners)
    whole = way_of(plane) * way
    linear = (whole.m11(), whole.m12(), whole.m21(), whole.m22())
    seen = area.translated(-whole.dx(), -whole.dy())
    for paint, path, box in _letters_along(text.lines, linear):
        own = lettered_style(style, paint, plane.scale)
        reach = _WIDEST * (own.width or 0.0) * way.m11() + 1.0 if own.has_stroke else 1.0
        if box.adjusted(-reach, -reach, reach, reach).intersects(seen):
            yield path.translated(whole.dx(), whole.dy()), own


@lru_cache(maxsize=200)
def _letters_along(
    lines: tuple[TextLine, ...], linear: tuple[float, float, float, float]
) -> tuple[tuple[RunPaint | None, QPainterPath, QRectF], ...]:
    """Return the outlines of words, turned and scaled, and their boxes; under a drag they are only moved."""
    way = QTransform(*linear, 0.0, 0.0)
    mapped = ((paint, way.map(path)) for paint, path in painted_letters(lines))
    return tuple((paint, path, path.controlPointRect()) for paint, path in mapped)


@lru_cache(maxsize=2000)
def painted_letters(lines: tuple[TextLine, ...]) -> tuple[tuple[RunPaint | None, QPainterPath], ...]:
    """Return the outlines of words in the units of the text, each with the paint of its own."""
    runs = (each for line in lines for each in _placed_runs(line))
    return tuple((run.paint, path) for run, place in runs for path in _words(run, place))


def _runs_left(letter: str) -> bool:
    return bidirectional(letter) in ("R", "AL")


def _words(run: TextRun, place: Vector) -> Iterator[QPainterPath]:
    """Yield the outlines of the words of a run: Qt fills many short paths far sooner than a long one."""
    font, scale, (x, y) = _font_of(run), run.size / _EM, place
    metrics = QFontMetricsF(font)
    # Where it runs from right to left the first word is not the leftmost.
    pattern = ".+" if any(map(_runs_left, run.words)) else r"\S+"
    for each in re.finditer(pattern, run.words):
        start, word = each.start(), each[0]
        path = QPainterPath()
        path.setFillRule(Qt.FillRule.WindingFill)
        path.addText(metrics.horizontalAdvance(run.words[:start]) if start else 0.0, 0.0, font, word)
        yield QTransform(scale, 0, 0, scale, x, y).map(path)


def _placed_runs(line: TextLine) -> list[tuple[TextRun, Vector]]:
    """Return where each run of a line begins, in the units of the text; none where there are no fonts."""
    if not has_fonts():
        return []
    found, x, y = list[tuple[TextRun, Vector]](), 0.0, 0.0
    for run in line.runs:
        x, y = x + run.right, y + run.down
        found.append((run, (x, y)))
        x += QFontMetricsF(_font_of(run)).horizontalAdvance(run.words) * run.size / _EM
    # What follows the last letter is none of the text: so Inkscape has it.
    x -= line.runs[-1].spacing if line.runs else 0.0
    left = line.x - x * line.anchor.share
    return [(run, (left + right, line.y + down)) for run, (right, down) in found]


def letters_of(text: Lettering, corners: Corners, style: Style) -> Iterator[tuple[Glyph, Style]]:
    """Yield the outlines of the letters of a text in the plane, each with its style."""
    plane = plane_of(text, corners)
    for run, place in (each for line in text.lines for each in _placed_runs(line)):
        own = lettered_style(style, run.paint, plane.scale)
        across, down = np.array(plane.across) * run.size / _EM, np.array(plane.down) * run.size / _EM
        origin = np.array(plane.place(*place))
        for glyph in glyphs.letters_of(run.words, _font_of(run)):
            # Outlines have y upwards, texts downwards.
            contours = tuple(
                origin + each[..., :1] * across - each[..., 1:] * down for each in glyph.contours
            )
            yield Glyph(glyph.letters, contours), own


def _font_of(run: TextRun) -> QFont:
    font = QFont()
    font.setFamilies(list(run.font) or ["sans-serif"])
    font.setPixelSize(_EM)
    font.setWeight(QFont.Weight(min(max(round(run.weight / 100), 1), 9) * 100))
    font.setItalic(run.italic)
    font.setHintingPreference(QFont.HintingPreference.PreferNoHinting)
    if run.spacing:
        font.setLetterSpacing(QFont.SpacingType.AbsoluteSpacing, run.spacing * _EM / run.size)
    return font


def line_step(run: TextRun) -> float:
    """Return the way from line to line that the font of a run has, in its units."""
    return QFontMetricsF(_font_of(run)).lineSpacing() * run.size / _EM


def measured(document: Document) -> Document:
    """Return the document with frames around the letters of its texts, as the fonts here have them.

    A text that is read somewhere else comes in a frame that is about as large.
    """
    curves = tuple(map(fitted, document.curves))
    is_same = all(new is old for new, old in zip(curves, document.curves, strict=True))
    return document if is_same else replace(document, curves=curves)


def fitted(curve: Curve) -> Curve:
    """Return a curve with the frame that fits the letters which it is around; any other as it is."""
    text = curve.form
    if not isinstance(text, Lettering):
        return curve
    box = QRectF()
    for _, path in painted_letters(text.lines):
        box = box.united(path.boundingRect())
    if box.width() <= 0 or box.height() <= 0:
        return curve
    inner = (box.left(), box.top(), box.right(), box.bottom())
    return curve if inner == text.box else in_box(curve, text, inner)


def in_box(curve: Curve, text: Lettering, inner: tuple[float, float, float, float]) -> Curve:
    """Return the curve of a text with another frame: the letters stay where they are."""
    plane = plane_of(text, corners_of(curve))
    left, top, right, bottom = inner
    places = ((left, top), (right, top), (right, bottom), (left, bottom))
    before = text.box
    across, down = (text.width / (before[2] - before[0]), text.height / (before[3] - before[1]))
    new = replace(
        text,
        box=inner,
        x=text.x + (left - before[0]) * across,
        y=text.y + (before[3] - bottom) * down,
        width=(right - left) * across,
        height=(bottom - top) * down,
    )
    frame = framed(new, [plane.place(*each) for each in places], curve.name)
    return replace(curve, form=new, points=frame.points, parametrization=frame.parametrization)


# Pictures


def paint_picture(
    painter: QPainter,
    picture: Picture,
    corners: Corners,
    way: QTransform,
    opacity: float,
    frame: QColor | None,
) -> None:
    """Paint a picture where a way leads from the plane; of one that is not there a frame in a colour."""
    image = image_of(picture.data) if picture.data else None
    painter.save()
    if image is not None:
        left, top, right, bottom = picture.part
        painter.setTransform(way_of(plane_of(picture, corners)) * way, True)
        painter.setOpacity(painter.opacity() * opacity)
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        # A PDF has a drawing with sharp edges as a JPEG otherwise.
        painter.setRenderHint(QPainter.RenderHint.LosslessImageRendering, picture.data.startswith(_PNG))
        if picture.part != WHOLE:
            painter.setClipRect(QRectF(left, top, right - left, bottom - top), Qt.ClipOperation.IntersectClip)
        painter.drawImage(QRectF(0, 0, 1, 1), image)
    elif frame is not None:
        box = way.map(QPolygonF([QPointF(*place) for place in corners]))
        painter.setPen(QPen(frame, 1, Qt.PenStyle.DashLine))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawPolygon(box)
        for start, end in ((0, 2), (1, 3)):
            painter.drawLine(QLineF(box.at(start), box.at(end)))
    painter.restore()


@lru_cache(maxsize=16)
def image_of(data: str) -> QImage | None:
    """Return a picture that a file holds; None where it cannot be read."""
    try:
        return decoded(b64decode(data), "A picture")
    except ImageFileError:
        return None
