"""Texts and pictures in their frames, as paths and images of Qt: the same on the screen and in print."""

from __future__ import annotations

import re
from base64 import b64decode
from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import chain
from unicodedata import bidirectional

import numpy as np
from msgspec.structs import replace
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import (
    QColor,
    QFontMetricsF,
    QImage,
    QPainter,
    QPainterPath,
    QPen,
    QPolygonF,
    QTransform,
)

from ..document.along_path import Along
from ..document.content import WHOLE, Lettering, Picture, RunPaint, TextLine, TextRun
from ..document.contents import Plane, corners_of, lettered_style, plane_of
from ..document.form_edits import framed
from ..document.model import Curve, Document, Vector
from ..document.style import Style
from ..document.wrapping import laid_out, lines_of
from . import glyphs
from .decorations import Decoration, decorations_of
from .glyphs import Cluster, Glyph, clusters_of, has_fonts
from .letters_along import placed_letters
from .picture_data import ImageFileError, decoded
from .run_fonts import EM, font_of

_WIDEST = 4.0
"""Widths of its line that a letter may reach beyond its outline, by miters."""

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
    for paint, path, box in _turned_letters(lines_of(text), text.along, linear):
        own = lettered_style(style, paint, plane.scale)
        reach = _WIDEST * (own.width or 0.0) * way.m11() + 1.0 if own.has_stroke else 1.0
        if box.adjusted(-reach, -reach, reach, reach).intersects(seen):
            yield path.translated(whole.dx(), whole.dy()), own


@lru_cache(maxsize=200)
def _turned_letters(
    lines: tuple[TextLine, ...], along: Along | None, linear: tuple[float, float, float, float]
) -> tuple[tuple[RunPaint | None, QPainterPath, QRectF], ...]:
    """Return the outlines of words, turned and scaled, and their boxes; under a drag they are only moved."""
    way = QTransform(*linear, 0.0, 0.0)
    mapped = ((paint, way.map(path)) for paint, path in painted_letters(lines, along))
    return tuple((paint, path, path.controlPointRect()) for paint, path in mapped)


@lru_cache(maxsize=2000)
def painted_letters(
    lines: tuple[TextLine, ...], along: Along | None = None
) -> tuple[tuple[RunPaint | None, QPainterPath], ...]:
    """Return the outlines of words in the units of the text, each with the paint of its own."""
    if along is not None:
        placed = placed_letters(lines, along, font_of) if has_fonts() else ()
        paths = (
            (run.paint, way.map(path))
            for run, cluster, way in placed
            for path in (*(each.path for each in decorated(run, (cluster,))), cluster.path)
        )
        return tuple((paint, path) for paint, path in paths if not path.isEmpty())
    runs = (each for line in lines for each in _seen_runs(line))
    return tuple(
        (run.paint, path)
        for run, place in runs
        for path in chain(
            (_way_of_run(run, place).map(each.path) for each in _with_run(run)), _words(run, place)
        )
    )


def _way_of_run(run: TextRun, place: Vector) -> QTransform:
    """Return the way from the pixels of the font of a run, from its beginning, to the units of the text."""
    scale = run.size / EM
    return QTransform(scale, 0, 0, scale, *place)


def _with_run(run: TextRun) -> Iterator[Decoration]:
    font = font_of(run)
    return decorations_of(run, font, 0.0, QFontMetricsF(font).horizontalAdvance(run.words))


def decorated(run: TextRun, clusters: Sequence[Cluster]) -> Iterator[Decoration]:
    """Yield the lines that go with letters of a run that stand side by side."""
    if not clusters:
        return
    font, first, last = font_of(run), clusters[0], clusters[-1]
    yield from decorations_of(run, font, first.x, last.x + last.width + font.letterSpacing() - first.x)


def clusters_in(text: Lettering) -> Iterator[tuple[TextRun, Sequence[Cluster], QTransform]]:
    """Yield letters that lie alike, and the way from the pixels of their font to the units of the text."""
    if text.along is not None:
        for run, cluster, way in placed_letters(text.lines, text.along, font_of) if has_fonts() else ():
            yield run, (cluster,), way
        return
    for run, place in (each for line in lines_of(text) for each in _seen_runs(line)):
        yield run, clusters_of(run.words, font_of(run)), _way_of_run(run, place)


def _runs_left(letter: str) -> bool:
    return bidirectional(letter) in ("R", "AL")


def _words(run: TextRun, place: Vector) -> Iterator[QPainterPath]:
    """Yield the outlines of the words of a run: Qt fills many short paths far sooner than a long one."""
    font, way = font_of(run), _way_of_run(run, place)
    metrics = QFontMetricsF(font)
    # Where it runs from right to left the first word is not the leftmost.
    pattern = ".+" if any(map(_runs_left, run.words)) else r"\S+"
    for each in re.finditer(pattern, run.words):
        start, word = each.start(), each[0]
        path = QPainterPath()
        path.setFillRule(Qt.FillRule.WindingFill)
        path.addText(metrics.horizontalAdvance(run.words[:start]) if start else 0.0, 0.0, font, word)
        yield way.map(path)


def placed_runs(line: TextLine) -> list[tuple[TextRun, Vector]]:
    """Return where each run of a line begins, in the units of the text; none where there are no fonts."""
    if not has_fonts():
        return []
    found, x, y = list[tuple[TextRun, Vector]](), 0.0, 0.0
    for run in line.runs:
        x, y = x + run.right, y + run.down
        found.append((run, (x, y - run.raised)))
        x += QFontMetricsF(font_of(run)).horizontalAdvance(run.words) * run.size / EM
    # What follows the last letter is none of the text: so Inkscape has it.
    x -= line.runs[-1].spacing if line.runs else 0.0
    left = line.x - x * line.anchor.share
    return [(run, (left + right, line.y + down)) for run, (right, down) in found]


def _seen_runs(line: TextLine) -> list[tuple[TextRun, Vector]]:
    """Return where each run begins, without the blanks that the line ends with: no line is under them."""
    placed = placed_runs(line)
    if placed:
        run, place = placed[-1]
        placed[-1] = replace(run, words=run.words.rstrip(" ")), place
    return placed


def letters_of(text: Lettering, corners: Corners, style: Style) -> Iterator[tuple[Glyph, Style]]:
    """Yield the outlines of the letters of a text in the plane, each with its style."""
    plane = plane_of(text, corners)
    if text.along is not None:
        yield from _letters_on_course(text, text.along, plane, style)
        return
    for run, place in (each for line in lines_of(text) for each in _seen_runs(line)):
        own = lettered_style(style, run.paint, plane.scale)
        across, down = np.array(plane.across) * run.size / EM, np.array(plane.down) * run.size / EM
        origin = np.array(plane.place(*place))
        lines = (Glyph(each.name, (each.contour,)) for each in _with_run(run))
        for glyph in chain(lines, glyphs.letters_of(run.words, font_of(run))):
            # Outlines have y upwards, texts downwards.
            contours = tuple(
                origin + each[..., :1] * across - each[..., 1:] * down for each in glyph.contours
            )
            yield Glyph(glyph.letters, contours), own


def _letters_on_course(
    text: Lettering, along: Along, plane: Plane, style: Style
) -> Iterator[tuple[Glyph, Style]]:
    for run, cluster, way in placed_letters(text.lines, along, font_of) if has_fonts() else ():
        whole = way * way_of(plane)
        # Outlines have y upwards, texts downwards.
        linear = np.array([[whole.m11(), whole.m12()], [-whole.m21(), -whole.m22()]])
        found = [(each.name, (each.contour,)) for each in decorated(run, (cluster,))]
        for name, drawn in (*found, (cluster.letters, cluster.contours)):
            if contours := tuple(each @ linear + (whole.dx(), whole.dy()) for each in drawn):
                yield Glyph(name, contours), lettered_style(style, run.paint, plane.scale)


def is_at_letters(text: Lettering, corners: Corners, place: Vector) -> bool:
    """Whether a place of the plane is where letters of a text along a course stand; of others anywhere."""
    if text.along is None or not has_fonts():
        return True
    back, _ = way_of(plane_of(text, corners)).inverted()
    there = back.map(QPointF(*place))
    rule = Qt.FillRule.WindingFill
    return any(each.containsPoint(there, rule) for each in _boxes_along(text.lines, text.along))


@lru_cache(maxsize=200)
def _boxes_along(lines: tuple[TextLine, ...], along: Along) -> tuple[QPolygonF, ...]:
    """Return what the letters along a course take, each as high as its font."""
    found = list[QPolygonF]()
    for run, cluster, way in placed_letters(lines, along, font_of):
        metrics = QFontMetricsF(font_of(run))
        box = QRectF(cluster.x, -metrics.ascent(), cluster.width, metrics.height())
        found.append(way.map(QPolygonF(box)))
    return tuple(found)


def line_step(run: TextRun) -> float:
    """Return the way from line to line that the font of a run has, in its units."""
    return QFontMetricsF(font_of(run)).lineSpacing() * run.size / EM


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
    if text.flow is not None:
        return _grown(curve, text) if text.flow.grows and has_fonts() else curve
    box = QRectF()
    for _, path in painted_letters(text.lines, text.along):
        box = box.united(path.boundingRect())
    if box.width() <= 0 or box.height() <= 0:
        return curve
    inner = (box.left(), box.top(), box.right(), box.bottom())
    return curve if inner == text.box else in_box(curve, text, inner)


def _grown(curve: Curve, text: Lettering) -> Curve:
    """Return the curve of a text with a frame as high as what fills it."""
    laid, (left, _, right, _) = laid_out(text), text.box
    inner = (left, laid.top, right, laid.bottom)
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
