"""Outlines of letters as curves of a document: a shape for each letter, in a group for the text."""

from __future__ import annotations

import unicodedata
from functools import lru_cache
from itertools import repeat

import numpy as np
from msgspec.structs import replace

from ...document.model import Curve, Document, Vector
from ...document.several_curves import add_imported
from ...document.shape_edits import names_of
from ...document.style import NO_PAINT, FillRule, Style
from ...document.text import Text
from ...exchange.cubics_in import ImportedPath, Look, imported
from ...exchange.naming import Names, numbered
from ...qt.glyphs import Outlines

_LONGEST_NAME = 40
_NO_LETTERS = ("Cc", "Cs")
"""Categories of control characters and of halves of letters."""


def name_of_text(text: str) -> str:
    """Return a text in a line, short enough for a name, without what no file could hold."""
    words = "".join(each if unicodedata.category(each) not in _NO_LETTERS else " " for each in text).split()
    name = " ".join(words)
    return name if len(name) <= _LONGEST_NAME else f"{name[: _LONGEST_NAME - 1]}…"


def filled(style: Style) -> Style:
    """Return the style of letters where other curves have this one: without a line, filled as fonts want it.

    What is not filled elsewhere has the colour of the line.
    """
    flat = style.flat
    fill = flat.fill if flat.has_fill else flat.colour
    return replace(flat, stroke=NO_PAINT, fill=fill, fill_rule=FillRule.NONZERO)


def with_text(
    document: Document,
    model: Curve,
    name: str,
    outlines: Outlines,
    text: Text,
    layer: str = "",
) -> tuple[Document, range]:
    """Return the document with a text in front in a layer, and the places of its curves; there must be some.

    Parameters
    ----------
    model
        The curve whose style the letters take.
    name
        Of the group that they are in, where there are several.
    text
        What they are written as.

    Raises
    ------
    ExchangeError
        If the numbers are beyond what a document may hold.
    """
    names = Names(names_of(document.curves))
    groups = () if len(outlines.glyphs) == 1 else (names.different(name),)
    curves = lettered(outlines, text, filled(model.style), groups, names)
    new, first = add_imported(document, Document(curves), layer)
    return new, range(first, first + len(curves))


def lettered(
    outlines: Outlines, text: Text, style: Style, groups: tuple[str, ...] = (), names: Names | None = None
) -> tuple[Curve, ...]:
    """Return the curves of the letters of a text where it was written, a shape for each of several curves."""
    names, curves = names or Names(), list[Curve]()
    for glyph in outlines.glyphs:
        shape = names.different(glyph.letters) if len(glyph.contours) > 1 else ""
        contours = tuple(each.tobytes() for each in glyph.contours)
        look = Look(style, shape, groups)
        curves += _letter(glyph.letters, contours, look, (text.x, text.y), text.size / outlines.em)
    return tuple(curves)


@lru_cache(maxsize=1000)
def _letter(
    letters: str, contours: tuple[bytes, ...], look: Look, place: Vector, scale: float
) -> tuple[Curve, ...]:
    """Return the curves of a letter, one shape; those of letters before the one that is typed are kept."""
    pieces = [np.array(place) + np.frombuffer(each).reshape(-1, 4, 2) * scale for each in contours]
    names = numbered([letters] * len(pieces))
    paths = [ImportedPath(*each, closed=True) for each in zip(names, repeat(look), pieces, strict=False)]
    return imported(paths).document.curves
