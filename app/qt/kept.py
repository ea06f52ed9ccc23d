"""Texts and pictures of other programs, painted: the same on the screen and in print."""

from __future__ import annotations

from base64 import b64decode
from collections.abc import Callable, Iterable
from functools import lru_cache
from typing import NamedTuple

from PySide6.QtCore import QLineF, QRectF, Qt
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

from ..document.kept import WHOLE, Anchor, KeptPicture, KeptRun, KeptText
from ..document.style import NO_PAINT
from .clips import clipped
from .glyphs import has_fonts
from .picture_data import ImageFileError, decoded
from .strokes import with_opacity

_EM = 1000
"""Pixels of an em in which outlines of letters are made: next to nothing of them is rounded."""

_SHARES = {Anchor.START: 0.0, Anchor.MIDDLE: 0.5, Anchor.END: 1.0}


def plane_of(kept: KeptText | KeptPicture) -> QTransform:
    """Return the way from the units of a text, or the sides of a picture, to the plane."""
    return QTransform(*kept.across, *kept.down, kept.x, kept.y)


def box_of(kept: KeptText | KeptPicture) -> QRectF:
    """Return the box in the plane that a line of text, or what is seen of a picture, lies in."""
    if isinstance(kept, KeptPicture):
        left, top, right, bottom = kept.part
        return plane_of(kept).mapRect(QRectF(left, top, right - left, bottom - top))
    box = QRectF()
    for _, path in outlines_of(kept):
        box = box.united(path.boundingRect())
    return plane_of(kept).mapRect(box)


class Inks(NamedTuple):
    """Colours of texts as they are seen on some paper, and of frames where pictures are not there."""

    seen: Callable[[str], QColor] = QColor
    frame: QColor | None = None


_AS_PRINTED = Inks()


def paint_kept(
    painter: QPainter,
    texts: Iterable[KeptText],
    pictures: Iterable[KeptPicture],
    way: QTransform,
    inks: Inks = _AS_PRINTED,
) -> None:
    """Paint texts over pictures where a way leads from the plane."""
    for picture in pictures:
        with clipped(painter, picture.clips, way):
            _paint_picture(painter, picture, plane_of(picture) * way, inks)
    for text in texts:
        with clipped(painter, text.clips, way):
            painter.setTransform(plane_of(text) * way, True)
            _paint_text(painter, text, inks)


def _paint_picture(painter: QPainter, picture: KeptPicture, way: QTransform, inks: Inks) -> None:
    image = _image_of(picture.data) if picture.data else None
    if image is not None:
        painter.setTransform(way, True)
        painter.setOpacity(painter.opacity() * picture.opacity)
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        if picture.part != WHOLE:
            left, top, right, bottom = picture.part
            painter.setClipRect(QRectF(left, top, right - left, bottom - top), Qt.ClipOperation.IntersectClip)
        painter.drawImage(QRectF(0, 0, 1, 1), image)
    elif inks.frame is not None:
        painter.setPen(QPen(inks.frame, 1, Qt.PenStyle.DashLine))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawPolygon(way.map(QPolygonF(QRectF(0, 0, 1, 1))))
        painter.drawLine(way.map(QLineF(0, 0, 1, 1)))
        painter.drawLine(way.map(QLineF(1, 0, 0, 1)))


def _paint_text(painter: QPainter, text: KeptText, inks: Inks) -> None:
    for run, path in outlines_of(text):
        if run.fill != NO_PAINT:
            painter.fillPath(path, with_opacity(inks.seen(run.fill), run.fill_opacity))
        if run.stroke != NO_PAINT and run.width > 0:
            pen = QPen(with_opacity(inks.seen(run.stroke), run.stroke_opacity), run.width)
            pen.setJoinStyle(Qt.PenJoinStyle.SvgMiterJoin)
            painter.strokePath(path, pen)


@lru_cache(maxsize=2000)
def outlines_of(text: KeptText) -> tuple[tuple[KeptRun, QPainterPath], ...]:
    """Return the outlines of each run of a line, in the units of the text; none where there are no fonts."""
    if not has_fonts():
        return ()
    found, x, y = list[tuple[KeptRun, QPainterPath]](), 0.0, 0.0
    for run in text.runs:
        font, scale = _font_of(run), run.size / _EM
        x, y = x + run.right, y + run.down
        path = QPainterPath()
        path.addText(0.0, 0.0, font, run.words)
        found.append((run, QTransform(scale, 0, 0, scale, x, y).map(path)))
        x += QFontMetricsF(font).horizontalAdvance(run.words) * scale
    # What follows the last letter is none of the text: so Inkscape has it.
    x -= text.runs[-1].spacing if text.runs else 0.0
    back = QTransform.fromTranslate(-x * _SHARES[text.anchor], 0.0)
    return tuple((run, back.map(path)) for run, path in found)


def _font_of(run: KeptRun) -> QFont:
    font = QFont()
    font.setFamilies(list(run.font) or ["sans-serif"])
    font.setPixelSize(_EM)
    font.setWeight(QFont.Weight(min(max(round(run.weight / 100), 1), 9) * 100))
    font.setItalic(run.italic)
    font.setHintingPreference(QFont.HintingPreference.PreferNoHinting)
    if run.spacing:
        font.setLetterSpacing(QFont.SpacingType.AbsoluteSpacing, run.spacing * _EM / run.size)
    return font


@lru_cache(maxsize=16)
def _image_of(data: str) -> QImage | None:
    """Return a picture that a file holds; None where it cannot be read."""
    try:
        return decoded(b64decode(data), "A picture")
    except ImageFileError:
        return None
