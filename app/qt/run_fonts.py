"""The fonts of runs of text, and what they measure."""

from __future__ import annotations

import struct
from functools import lru_cache
from typing import Final

from PySide6.QtGui import QFont, QFontMetricsF, QGuiApplication, QRawFont

from ..document.content import TextRun
from ..document.wrapping import Measure, measure_with
from .glyphs import has_fonts

EM: Final = 1000
"""Pixels of an em in which outlines of letters are made: next to nothing of them is rounded."""

_TYPOGRAPHIC = 68
"""Where the table OS/2 of a font has its ascent and its descent."""


def font_of(run: TextRun) -> QFont:
    """Return the font of a run, an em of which is so many pixels."""
    font = QFont()
    font.setFamilies(list(run.font) or ["sans-serif"])
    font.setPixelSize(EM)
    font.setWeight(QFont.Weight(min(max(round(run.weight / 100), 1), 9) * 100))
    font.setItalic(run.italic)
    font.setHintingPreference(QFont.HintingPreference.PreferNoHinting)
    if run.spacing:
        font.setLetterSpacing(QFont.SpacingType.AbsoluteSpacing, run.spacing * EM / run.size)
    if run.word_spacing:
        font.setWordSpacing(run.word_spacing * EM / run.size)
    return font


def _advance(run: TextRun) -> float:
    return QFontMetricsF(font_of(run)).horizontalAdvance(run.words) * run.size / EM


def _ascent_share(run: TextRun) -> float:
    return _typographic_share(font_of(run).key())


@lru_cache(maxsize=256)
def _typographic_share(key: str) -> float:
    font = QFont()
    font.fromString(key)
    table = QRawFont.fromFont(font).fontTable("OS/2").data()
    if len(table) >= _TYPOGRAPHIC + 4:
        above, below = struct.unpack_from(">hh", table, _TYPOGRAPHIC)
    else:
        metrics = QFontMetricsF(font)
        above, below = metrics.ascent(), -metrics.descent()
    return above / (above - below) if above > 0 >= below else 0.8


def _has_fonts() -> bool:
    return QGuiApplication.instance() is not None and has_fonts()


measure_with(Measure(_has_fonts, _advance, _ascent_share))
