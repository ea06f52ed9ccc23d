"""Opacity of what is chosen: of whole groups as such, and of shapes.

Pure functions like those of ``edits``.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping

from msgspec.structs import replace

from .curve_edits import with_each
from .curve_tree import Node, NodeKind, whole_nodes
from .group_look import opacity_of, with_opacity
from .model import Curve, Document
from .shapes import whole_shapes
from .style_edits import with_style

_DIGITS = 6
"""Of products of opacities, without the noise of their last digits."""


def opacities_of(document: Document, curves: Collection[int]) -> list[float]:
    """Return the opacities of the groups that curves are, and of the shapes beside them."""
    return [_opacity_of(document, node) for node in _things(document, curves)]


def with_overall_opacity(document: Document, curves: Collection[int], opacity: float) -> Document:
    """Give an opacity to the groups that curves are, as a whole, and to the shapes beside them."""
    groups = dict[int, str]()
    for node in _things(document, curves):
        groups |= dict.fromkeys(node.places, node.name if node.kind is NodeKind.GROUP else "")

    def edit(place: int, curve: Curve) -> Curve:
        if group := groups[place]:
            looks = with_opacity(curve.group_looks, curve.groups, group, opacity)
            return replace(curve, group_looks=looks)
        return replace(curve, style=replace(curve.style, opacity=opacity))

    new = (edit(*each) if each[0] in groups else each[1] for each in enumerate(document.curves))
    return replace(document, curves=tuple(new))


def with_looks(document: Document, curves: Collection[int], fields: Mapping[str, object]) -> Document:
    """Give curves other values of their styles; the opacity is that of the groups that they are."""
    others = {name: value for name, value in fields.items() if name != "opacity"}
    if isinstance(opacity := fields.get("opacity"), float):
        document = with_overall_opacity(document, curves, opacity)
    return with_style(document, curves, **others) if others else document


def with_share(curve: Curve, depth: int, share: float) -> Curve:
    """Return a curve of which, or of the group around it at a depth, only a share is seen."""
    if share >= 1:
        return curve
    if depth < len(curve.groups):
        name = curve.groups[depth]
        opacity = round(share * opacity_of(curve.group_looks, name), _DIGITS)
        return replace(curve, group_looks=with_opacity(curve.group_looks, curve.groups, name, opacity))
    return replace(curve, style=replace(curve.style, opacity=round(share * curve.style.opacity, _DIGITS)))


def without_groups_seen_through(document: Document) -> Document:
    """Return the document with all that is in groups seen as little as these are, each by itself."""
    places = [place for place, curve in enumerate(document.curves) if curve.group_looks]
    return with_each(document, places, _by_itself) if places else document


def _by_itself(curve: Curve) -> Curve:
    share = 1.0
    for look in curve.group_looks:
        share *= look.opacity
    return replace(with_share(curve, len(curve.groups), share), group_looks=())


def _opacity_of(document: Document, node: Node) -> float:
    curve = document.curves[node.places.start]
    if node.kind is NodeKind.GROUP:
        return opacity_of(curve.group_looks, node.name)
    return curve.style.opacity


def _things(document: Document, curves: Collection[int]) -> list[Node]:
    return whole_nodes(document.curves, whole_shapes(document, curves), document.layers)
