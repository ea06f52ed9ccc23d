"""Outlines of letters as curves of a document: a shape for each letter, in a group for the text."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from msgspec.structs import replace

from ...document.model import Curve, Document, Vector
from ...document.several_curves import add_imported
from ...document.shape_edits import names_of
from ...document.style import NO_PAINT, FillRule, Style
from ...exchange.cubics_in import ImportedPath, Look, imported
from ...exchange.naming import Names, numbered
from ...qt.glyphs import Glyph, Outlines

_LONGEST_NAME = 40


def name_of_text(text: str) -> str:
    """Return a text in a line, short enough for a name."""
    name = " ".join(text.split())
    return name if len(name) <= _LONGEST_NAME else f"{name[: _LONGEST_NAME - 1]}…"


def filled(style: Style) -> Style:
    """Return the style of letters where other curves have this one: without a line, filled as fonts want it.

    What is not filled elsewhere has the colour of the line.
    """
    fill = style.fill if style.has_fill else style.colour
    return replace(style, stroke=NO_PAINT, fill=fill, fill_rule=FillRule.NONZERO)


def with_text(
    document: Document, model: Curve, text: str, outlines: Outlines, place: Vector, size: float
) -> tuple[Document, range]:
    """Return the document with a text in front of all else, and the places of its curves; there must be some.

    Parameters
    ----------
    model
        The curve whose style the letters take.
    place
        Where the baseline begins.
    size
        What an em is long.
    """
    names = Names(names_of(document.curves))
    is_one = len(outlines.glyphs) == 1
    look = Look(filled(model.style), groups=() if is_one else (names.different(name_of_text(text)),))
    scale = size / outlines.em
    paths = [path for glyph in outlines.glyphs for path in _paths(glyph, look, names, place, scale)]
    new, first = add_imported(document, imported(paths).document)
    return new, range(first, len(new.curves))


def _paths(glyph: Glyph, look: Look, names: Names, place: Vector, scale: float) -> Iterator[ImportedPath]:
    """Yield the contours of a letter, which are one shape where there are several."""
    count = len(glyph.contours)
    shape = names.different(glyph.letters) if count > 1 else ""
    own = Look(look.style, shape, look.groups)
    for name, contour in zip(numbered([glyph.letters] * count), glyph.contours, strict=True):
        yield ImportedPath(name, own, np.array(place) + contour * scale, closed=True)
