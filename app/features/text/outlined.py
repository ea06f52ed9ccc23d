"""Texts of drawings as outlines: a shape for each letter, where the letters were."""

from __future__ import annotations

from collections.abc import Collection

from msgspec.structs import replace

from ...document.content import Lettering
from ...document.contents import corners_of
from ...document.limits import EditError
from ...document.model import Curve, Document
from ...document.shape_edits import names_of
from ...document.shapes import shape_of
from ...document.style import FillRule
from ...exchange.cubics_in import ImportedPath, Look, imported
from ...exchange.naming import Names, numbered
from ...qt.contents import letters_of
from ...view_model.shapes.regions import replaced


def with_outlines(document: Document, places: Collection[int]) -> tuple[Document, frozenset[int]]:
    """Return the document with outlines in the places of texts and forms, and where these are.

    Raises
    ------
    EditError
        If there is neither a text nor a form, or no font to draw a text in.
    """
    names, made = Names(names_of(document.curves)), dict[range, list[Curve]]()
    for place in sorted(places):
        curve = document.curves[place]
        if isinstance(curve.form, Lettering):
            made[range(place, place + 1)] = _letters(curve, curve.form, names)
        elif curve.form is not None and not curve.form.is_content:
            # Of those that are combined all: they are one path.
            whole = shape_of(document, place)
            made[whole] = [replace(document.curves[each], form=None) for each in whole]
    if not made:
        raise EditError("Choose a text, or a shape such as a rectangle.")
    return replaced(document, made)


def _letters(curve: Curve, text: Lettering, names: Names) -> list[Curve]:
    """Return the curves of the letters of a text, in a group if they are several."""
    letters = list(letters_of(text, corners_of(curve), curve.style))
    if not letters:
        raise EditError(f"There is no font here for “{curve.name}”.")
    groups = curve.groups if len(letters) == 1 else (*curve.groups, names.different(curve.name))
    made = list[Curve]()
    for glyph, style in letters:
        shape = names.different(glyph.letters) if len(glyph.contours) > 1 else ""
        look = Look(
            replace(style, fill_rule=FillRule.NONZERO),
            shape,
            groups,
            curve.visible,
            group_looks=curve.group_looks,
        )
        titles = numbered([shape or glyph.letters] * len(glyph.contours))
        paths = [
            ImportedPath(title, look, pieces, closed=True)
            for title, pieces in zip(titles, glyph.contours, strict=False)
        ]
        made += imported(paths).document.curves
    return made
