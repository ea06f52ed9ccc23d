"""Edits of how curves look, and what several of them have in common.

`curves` are places in the document. What is done to one curve of a shape is done to all of it.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable
from typing import Final

from msgspec.structs import replace

from .curve_edits import map_curves
from .fields import fields_of
from .groups import expand_to_shapes
from .model import Curve, Document
from .style import INK, NO_PAINT, Style

STYLE_WORDS: Final = {field.name: field.label for field in fields_of(Style)}
"""The fields of a style in words, as steps of the history name them: "Stroke width of Leaf"."""


def set_style(document: Document, curves: Collection[int], **fields: object) -> Document:
    """Give curves other values in some fields of their styles; the rest stays each curve's own."""
    return map_curves(
        document,
        expand_to_shapes(document, curves),
        lambda curve: replace(curve, style=replace(curve.style, **fields)),
    )


def colours_of(curves: Iterable[Curve]) -> list[str]:
    """Return the colours that curves are painted in, those of most of them first."""
    found = Counter[str]()
    for curve in curves:
        found.update([curve.style.fill, curve.style.stroke])
    return [paint for paint, _ in found.most_common() if paint not in (INK, NO_PAINT)]


def swap_paints(document: Document, curves: Collection[int]) -> Document:
    """Paint the insides of curves as their lines were, and their lines as their insides were."""
    return map_curves(
        document, expand_to_shapes(document, curves), lambda curve: replace(curve, style=curve.style.swapped)
    )


def common_values(styles: Iterable[Style]) -> dict[str, object]:
    """Return the values that all of the styles have, by their fields; what differs is left out.

    Of no styles there are none.
    """
    styles = list(styles)
    if not styles:
        return {}
    first, *others = styles
    found = {name: getattr(first, name) for name in Style.__struct_fields__}
    return {
        name: value for name, value in found.items() if all(getattr(each, name) == value for each in others)
    }
