"""Letters as a PDF holds them: glyphs of fonts in the file, so that words are found, and copied.

A glyph that stands for other letters than its font says, as a ligature does, stays an outline, and so does
what no font holds as it is seen; the letters are over it, and clear.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import Final, NamedTuple

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import (
    QColor,
    QGlyphRun,
    QPainter,
    QPainterPath,
    QPen,
    QRawFont,
    QTransform,
)

from ..document.content import Lettering, TextRun
from ..document.contents import lettered_style, plane_of
from ..document.style import Style
from .contents import Corners, clusters_in, decorated, way_of
from .glyphs import Cluster

CLEAR: Final = QColor(0, 0, 0, 0)

_BOLD: Final = 700
_SELECTION, _WEIGHT, _MAC_STYLE = 62, 4, 44
"""Where the tables OS/2 and head of a font say what it is."""

_ITALIC, _HEAVY = (0x201, 2), (0x20, 1)
"""Bits of these that say so."""


class Sign(NamedTuple):
    """A glyph of a font and its place in pixels of that; clear over an outline of what it stands for."""

    font: QRawFont
    number: int
    place: QPointF
    is_clear: bool = False


class Writing(NamedTuple):
    """Letters that lie alike, for a painter.

    Attributes
    ----------
    way
        From the pixels of their font to the painter.
    signs
        Glyphs, in the order of the words.
    path
        The outlines of what no glyph is seen for.
    whole
        The outlines of all.
    style
        Of all of them.
    """

    way: QTransform
    signs: tuple[Sign, ...]
    path: QPainterPath
    whole: QPainterPath
    style: Style


def writings_of(text: Lettering, corners: Corners, way: QTransform, style: Style) -> Iterator[Writing]:
    """Yield the letters of a text where a way leads from the plane."""
    plane = plane_of(text, corners)
    whole = way_of(plane) * way
    for run, clusters, there in clusters_in(text):
        own = lettered_style(style, run.paint, plane.scale)
        yield _writing(run, clusters, there * whole, own)


def _writing(run: TextRun, clusters: Sequence[Cluster], way: QTransform, style: Style) -> Writing:
    signs, path, whole = list[Sign](), QPainterPath(), QPainterPath()
    for each in (path, whole):
        each.setFillRule(Qt.FillRule.WindingFill)
    for line in decorated(run, clusters):
        path.addPath(line.path)
        whole.addPath(line.path)
    for cluster in clusters:
        outline = cluster.path
        whole.addPath(outline)
        if _is_named(cluster) and _is_as_drawn(cluster.glyphs[0].font, run):
            signs += (Sign(each.font, each.number, QPointF(each.x, each.y)) for each in cluster.glyphs)
        else:
            path.addPath(outline)
            signs += _letter_by_letter(cluster)
    return Writing(way, tuple(signs), way.map(path), way.map(whole), style)


def _is_named(cluster: Cluster) -> bool:
    """Whether a font has the glyphs of letters for these letters and nothing else: a file can say that."""
    numbers = [each.number for each in cluster.glyphs]
    return bool(numbers) and numbers == _numbers(cluster.glyphs[0].font, cluster.letters)


def _numbers(font: QRawFont, letters: str) -> list[int]:
    # A file names no letters beyond these (QFontSubset).
    is_known = all(letter <= "\uffff" for letter in letters)
    return list(font.glyphIndexesForString(letters)) if is_known else []


def _is_as_drawn(font: QRawFont, run: TextRun) -> bool:
    """Whether letters are those of a font; what is bold or slanted without it, or varied, is so only here."""
    about, head = font.fontTable("OS/2").data(), font.fontTable("head").data()
    if len(about) < _SELECTION + 2 or len(head) < _MAC_STYLE + 2 or not font.fontTable("fvar").isEmpty():
        return False
    (bits,) = struct.unpack_from(">H", about, _SELECTION)
    (weight,) = struct.unpack_from(">H", about, _WEIGHT)
    (style,) = struct.unpack_from(">H", head, _MAC_STYLE)
    is_heavy = bool(bits & _HEAVY[0] or style & _HEAVY[1] or weight >= _BOLD)
    is_slanted = bool(bits & _ITALIC[0] or style & _ITALIC[1])
    return (is_heavy or run.weight < _BOLD) and (is_slanted or not run.italic)


def _letter_by_letter(cluster: Cluster) -> Iterator[Sign]:
    """Yield a clear glyph for each of the letters of a cluster, side by side in the room of that."""
    if not cluster.glyphs:
        return
    font = cluster.glyphs[0].font
    numbers = [number for letter in cluster.letters for number in _numbers(font, letter) if number]
    ways = [way.x() for way in font.advancesForGlyphIndexes(numbers)]
    scale, x = cluster.width / (sum(ways) or 1.0), cluster.x
    for number, way in zip(numbers, ways, strict=True):
        yield Sign(font, number, QPointF(x, cluster.glyphs[0].y), is_clear=True)
        x += way * scale


def write(painter: QPainter, writing: Writing, colour: QColor) -> None:
    """Paint glyphs in a colour, those that are clear in none."""
    painter.save()
    painter.setTransform(writing.way, True)
    for (font, is_clear), same in groupby(writing.signs, lambda sign: (sign.font, sign.is_clear)):
        run, glyphs = list(same), QGlyphRun()
        painter.setPen(QPen(CLEAR if is_clear else colour))
        glyphs.setRawFont(font)
        glyphs.setGlyphIndexes([each.number for each in run])
        glyphs.setPositions([each.place for each in run])
        painter.drawGlyphRun(QPointF(0.0, 0.0), glyphs)
    painter.restore()
