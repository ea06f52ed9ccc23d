"""Edits of the style of curves, and the values that several styles have in common.

`curves` are indices of curves; an edit of one curve of a shape changes the whole shape.
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
"""Labels of the fields of a style, as steps of the history name them: "Stroke width of Leaf"."""


def set_style(document: Document, curves: Collection[int], **fields: object) -> Document:
    """Set some fields of the styles of curves."""
    return map_curves(
        document,
        expand_to_shapes(document, curves),
        lambda curve: replace(curve, style=replace(curve.style, **fields)),
    )


def colours_of(curves: Iterable[Curve]) -> list[str]:
    """Return the colours of the fills and strokes of curves, the most frequent first."""
    counts = Counter[str]()
    for curve in curves:
        counts.update([curve.style.fill, curve.style.stroke])
    return [paint for paint, _ in counts.most_common() if paint not in (INK, NO_PAINT)]


def swap_paints(document: Document, curves: Collection[int]) -> Document:
    """Exchange the paints of fill and stroke of curves."""
    return map_curves(
        document, expand_to_shapes(document, curves), lambda curve: replace(curve, style=curve.style.swapped)
    )


def common_values(styles: Iterable[Style]) -> dict[str, object]:
    """Return the values that all of the styles have in common, by their fields; empty for no styles."""
    styles = list(styles)
    if not styles:
        return {}
    first, *others = styles
    values = {name: getattr(first, name) for name in Style.__struct_fields__}
    return {name: value for name, value in values.items() if all(getattr(s, name) == value for s in others)}
