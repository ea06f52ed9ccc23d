"""Outlines of letters, as the fonts of the system have them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from itertools import pairwise
from typing import NamedTuple

import msgspec
import numpy as np
from msgspec.structs import replace
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import (
    QFont,
    QFontDatabase,
    QFontInfo,
    QFontMetricsF,
    QGlyphRun,
    QPainterPath,
    QRawFont,
    QTextLayout,
    QTextOption,
)

from curvecore.arrays import FloatArray

from ..document.model import Vector
from ..document.text import Setting

_USUAL = Setting()
_WIDE = 1e7
"""Width of a line, in units of the font, that no text reaches."""


class Face(msgspec.Struct, frozen=True):
    """A font as people choose it, of any size."""

    family: str
    bold: bool = False
    italic: bool = False


class Glyph(msgspec.Struct, frozen=True, eq=False):
    """Outline of a letter, or of several that the font draws as one.

    Attributes
    ----------
    letters
        What it stands for.
    contours
        Closed, each of cubic pieces (k, 4, 2), those of straight lines with control points at the thirds. In
        units of the font, y upwards, from where the baseline of the first line begins.
    """

    letters: str
    contours: tuple[FloatArray, ...]


class Outlines(msgspec.Struct, frozen=True, eq=False):
    """Glyphs of a text.

    Attributes
    ----------
    glyphs
        Those that leave anything on the paper, in order.
    em
        How many units of the font are its size.
    missing
        Letters that no font has, each once.
    lacks_bold
        Whether bold letters were wanted of a font that has none.
    """

    glyphs: tuple[Glyph, ...]
    em: int
    missing: tuple[str, ...] = ()
    lacks_bold: bool = False


NO_OUTLINES = Outlines((), 1)
"""Outlines of no text."""


class _Placed(NamedTuple):
    """A glyph of a font, and where it stands from the beginning of the baseline, y downwards."""

    font: QRawFont
    number: int
    x: float
    y: float


class _Drawn(NamedTuple):
    """Letters, and the glyphs that draw them."""

    letters: str
    glyphs: tuple[_Placed, ...]

    def is_part_of(self, before: _Drawn) -> bool:
        """Whether the same glyphs stand for the letters before these, too."""
        return bool(self.glyphs) and self.glyphs == before.glyphs

    @property
    def is_missing(self) -> bool:
        """Whether no font has it: glyph 0 of each stands for what it lacks, most often a box."""
        return any(glyph.number == 0 for glyph in self.glyphs)

    def contours(self, down: float) -> Iterator[FloatArray]:
        """Yield the contours, of a line so far down from the first."""
        for glyph in self.glyphs:
            yield from _contours(glyph.font.pathForGlyph(glyph.number), glyph.x, glyph.y + down)


def has_fonts() -> bool:
    """Whether there is any font: a computer without a screen may have none, and Qt then draws boxes."""
    # Of the font of boxes QRawFont.familyName ends the process (Qt 6.11).
    return bool(QFontInfo(QFont()).family())


def has_family(family: str) -> bool:
    """Whether there is a font of a name."""
    return QFontDatabase.hasFamily(family)


def weights_of(family: str) -> tuple[int, ...]:
    """Return the weights of letters that a family has, in hundreds, the lightest first."""
    found = (QFontDatabase.weight(family, style) for style in QFontDatabase.styles(family))
    return tuple(sorted({min(max(round(weight / 100), 1), 9) * 100 for weight in found}))


def outlines_of(text: str, face: Face, setting: Setting = _USUAL) -> Outlines:
    """Return the outlines of a text of one or more lines, kerned and with the ligatures of the font.

    Letters that the font lacks are of another that has them; letters with space between them have no
    ligatures.
    """
    font = _in_its_own_units(face)
    if font is None:
        return NO_OUTLINES
    between = setting.letter_spacing * font.pixelSize()
    if between:
        font.setLetterSpacing(QFont.SpacingType.AbsoluteSpacing, between)
    glyphs, missing = list[Glyph](), dict[str, None]()
    spacing = QFontMetricsF(font).lineSpacing() * setting.line_spacing
    for number, line in enumerate(text.split("\n")):
        for drawn in _drawn(line, font, setting.align.share):
            if drawn.is_missing:
                missing[drawn.letters] = None
            elif contours := tuple(drawn.contours(number * spacing)):
                glyphs.append(Glyph(drawn.letters, contours))
    lacks_bold = face.bold and bool(glyphs) and _is_drawn_alike(glyphs[0], face)
    return Outlines(tuple(glyphs), font.pixelSize(), tuple(missing), lacks_bold)


def letters_of(line: str, font: QFont) -> Iterator[Glyph]:
    """Yield the outlines of the letters of a line in a font, in its pixels; not of those that it lacks."""
    for drawn in _drawn(line, font, 0.0):
        if not drawn.is_missing and (contours := tuple(drawn.contours(0.0))):
            yield Glyph(drawn.letters, contours)


class Cluster(NamedTuple):
    """Letters that a font draws together, and the part of the line that they take, in its pixels."""

    letters: str
    glyphs: tuple[_Placed, ...]
    x: float
    width: float

    @property
    def path(self) -> QPainterPath:
        """Their outline, y downwards, from where the line begins."""
        whole = QPainterPath()
        whole.setFillRule(Qt.FillRule.WindingFill)
        for glyph in self.glyphs:
            whole.addPath(glyph.font.pathForGlyph(glyph.number).translated(glyph.x, glyph.y))
        return whole

    @property
    def contours(self) -> tuple[FloatArray, ...]:
        """The same as contours; see `Glyph`."""
        return tuple(_Drawn(self.letters, self.glyphs).contours(0.0))


def clusters_of(line: str, font: QFont) -> list[Cluster]:
    """Return the letters of a line in a font from left to right; those that it lacks have no outline."""
    found = [each for each in _drawn(line, font, 0.0) if each.glyphs]
    found.sort(key=_left)
    ends = [*map(_left, found[1:]), QFontMetricsF(font).horizontalAdvance(line)]
    return [
        Cluster(
            each.letters,
            () if each.is_missing else each.glyphs,
            _left(each),
            end - _left(each) - font.letterSpacing(),
        )
        for each, end in zip(found, ends, strict=True)
    ]


def _left(drawn: _Drawn) -> float:
    return min(glyph.x for glyph in drawn.glyphs)


def _is_drawn_alike(glyph: Glyph, face: Face) -> bool:
    """Whether the font has the same outline for letters that are not bold: the screen would smear them."""
    others = outlines_of(glyph.letters, replace(face, bold=False)).glyphs
    size = sum(map(_area, glyph.contours))
    return bool(others) and math.isclose(size, sum(map(_area, others[0].contours)), rel_tol=1e-9)


def _in_its_own_units(face: Face) -> QFont | None:
    """Return the font in the size in which its outlines are as they were drawn, in whole numbers."""
    font = QFont(face.family)
    font.setBold(face.bold)
    font.setItalic(face.italic)
    font.setHintingPreference(QFont.HintingPreference.PreferNoHinting)
    units = QRawFont.fromFont(font).unitsPerEm() if has_fonts() else 0.0
    if units <= 0:
        return None
    font.setPixelSize(round(units))
    return font


def _drawn(line: str, font: QFont, share: float) -> Iterator[_Drawn]:
    """Yield the letters of a line from the first to the last, those together that the font draws as one.

    So much of the line is before where it was asked for.
    """
    layout, option = QTextLayout(line, font), QTextOption()
    option.setUseDesignMetrics(True)
    option.setWrapMode(QTextOption.WrapMode.NoWrap)
    # From right to left, too, it begins where it was asked for.
    option.setAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignAbsolute)
    layout.setTextOption(option)
    layout.beginLayout()
    laid = layout.createLine()
    if not laid.isValid():
        return
    laid.setLineWidth(_WIDE)
    layout.endLayout()
    # What comes behind each letter comes behind the last one, too.
    width = laid.naturalTextRect().width() - font.letterSpacing()
    origin = QPointF(laid.naturalTextRect().left() + share * width, laid.ascent())
    # Qt counts in words of 16 bits; and of letters of several fonts the runs tell wrong places in the text.
    words, at = line.encode("utf-16-le", "surrogatepass"), 0
    before: _Drawn | None = None
    while at < len(words) // 2:
        end = layout.nextCursorPosition(at)
        letters = words[2 * at : 2 * end].decode("utf-16-le", "replace")
        drawn = _Drawn(letters, tuple(_glyphs(layout.glyphRuns(at, end - at), origin)))
        if before is not None and drawn.is_part_of(before):
            drawn = _Drawn(before.letters + letters, before.glyphs)
        elif before is not None:
            yield before
        before, at = drawn, end
    if before is not None:
        yield before


def _glyphs(runs: Iterable[QGlyphRun], origin: QPointF) -> Iterator[_Placed]:
    for run in runs:
        font = run.rawFont()
        for index, place in zip(run.glyphIndexes(), run.positions(), strict=True):
            x, y = (place - origin).toTuple()
            yield _Placed(font, index, x, y)


def _contours(path: QPainterPath, right: float, down: float) -> Iterator[FloatArray]:
    """Yield the contours of an outline, closed, those that are more than a point."""
    elements = [path.elementAt(index) for index in range(path.elementCount())]
    places = [(right + each.x, -(down + each.y)) for each in elements]
    starts = [index for index, each in enumerate(elements) if each.isMoveTo()]
    for first, end in pairwise([*starts, len(elements)]):
        pieces, index = [], first + 1
        while index < end:
            if elements[index].isCurveTo():
                pieces.append(places[index - 1 : index + 3])
                index += 3
            else:
                pieces.append(_line(places[index - 1], places[index]))
                index += 1
        if places[end - 1] != places[first]:
            pieces.append(_line(places[end - 1], places[first]))
        if pieces:
            yield np.array(pieces)


def _area(contour: FloatArray) -> float:
    """Return the area within the ends and control points of a contour, negative where it runs clockwise."""
    x, y = contour[:, :3].reshape(-1, 2).T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def _line(start: Vector, end: Vector) -> list[Vector]:
    (x, y), (to_x, to_y) = start, end
    third = ((to_x - x) / 3, (to_y - y) / 3)
    return [start, (x + third[0], y + third[1]), (to_x - third[0], to_y - third[1]), end]
