"""Layers: groups in nothing but such groups, which may also be empty; what is new comes into one of them.

Pure functions like those of ``edits``. A layer is given by its name; empty it means what is in no layer.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from typing import NamedTuple

from msgspec.structs import replace

from .curve_edits import add_curve, remove_curve, with_each
from .curve_tree import OUTSIDE, Container, Node, NodeKind, layered_tree, layers_around
from .edits import AlreadySoError, EditError
from .empty_layer import EmptyLayer
from .layer_order import with_tidy_layers
from .model import Curve, Document
from .shape_edits import Gathered, contained, free_group_name, gathered
from .shapes import whole_shapes


class Front(NamedTuple):
    """The place in front of all that is in a layer, and the layers around it."""

    place: int
    container: Container = OUTSIDE


class Begun(NamedTuple):
    """A document, and the place of an empty curve in it that is drawn next."""

    document: Document
    place: int


# What there is


def layer_nodes(document: Document) -> Iterator[Node]:
    """Yield the layers, from the back to the front, each before those in it."""
    for top in layered_tree(document) if document.layers else ():
        yield from (node for node in top.walk() if node.kind is NodeKind.LAYER)


def layer_node(document: Document, layer: str) -> Node:
    """Return a layer of the tree."""
    found = next((node for node in layer_nodes(document) if node.name == layer), None)
    if found is None:
        raise EditError(f"There is no layer “{layer}”.")
    return found


def layer_of(document: Document, curve: int) -> str:
    """Return the innermost layer that a curve is in."""
    return next(reversed(layers_around(document, curve)), "") if document.layers else ""


def looks_of(document: Document, node: Node) -> tuple[bool, bool]:
    """Return whether anything in a layer is seen, and whether all of it is locked."""
    if not node.places:
        known = next(each for each in document.empty_layers if each.name == node.name)
        return known.visible, known.locked
    curves = document.curves[node.places.start : node.places.stop]
    return any(curve.visible for curve in curves), all(curve.locked for curve in curves)


def foremost_layer(document: Document) -> str:
    """Return the layer in front of all others that can be drawn in."""
    free = [node.name for node in layer_nodes(document) if looks_of(document, node) == (True, False)]
    return free[-1] if free else ""


# What is new


def front_of(document: Document, layer: str) -> Front:
    """Return the place of what is new in a layer.

    Raises
    ------
    EditError
        If it is hidden or locked, as it is or by one around it.
    """
    if not layer:
        return Front(len(document.curves))
    target = layer_node(document, layer)
    around = set(target.inside.groups)
    for node in layer_nodes(document):
        if node.name in around:
            visible, locked = looks_of(document, node)
            if locked or not visible:
                state, way = ("locked", "unlock") if locked else ("hidden", "show")
                raise EditError(f"The layer “{node.name}” is {state}; {way} it in the list to draw in it.")
    return Front(target.places.stop, target.inside)


def free_layer(document: Document, layer: str) -> str:
    """Return a layer if it can be drawn in, and else none."""
    try:
        front_of(document, layer)
    except EditError:
        return ""
    return layer


def begun(document: Document, active: int, layer: str, fresh: Callable[[], Curve]) -> Begun:
    """Return the document with the empty curve that is drawn next in front in a layer.

    That is the active one where it is empty and free, in the style of a `fresh` one, or else that.
    """
    model, new = document.curves[active], fresh()
    if model.points or model.locked:
        front = front_of(document, layer)
        return Begun(in_front(document, front, new), front.place)
    if model.style != new.style:
        model = replace(model, style=new.style)
        document = document.with_curve(active, model)
    if layer_of(document, active) == layer:
        return Begun(document, active)
    rest = without(document, active)
    front = front_of(rest, layer)
    return Begun(in_front(rest, front, model), front.place)


def begun_again(document: Document, before: Document, layer: str) -> Document:
    """Return a document, with the empty curve that is left where all were removed in front in a layer.

    `before` is what it was, with all its layers in order.
    """
    if not document.layers or len(document.curves) > 1 or document.curves[0].points:
        return document
    document = with_tidy_layers(document, before)
    return begun(document, 0, free_layer(document, layer), lambda: document.curves[0]).document


def without(document: Document, curve: int) -> Document:
    """Return the document without a curve, be it the last one."""
    curves = document.curves
    rest = replace(document, curves=(*curves[:curve], *curves[curve + 1 :]))
    return with_tidy_layers(rest, document)


def in_front(document: Document, front: Front, curve: Curve) -> Document:
    """Add a curve at the front of a layer, in no shape."""
    return add_curve(document, front.place, replace(curve, shape="", groups=front.container.groups))


def within(curves: Sequence[Curve], container: Container) -> list[Curve]:
    """Return curves with their groups in what they come into."""
    if not container.groups:
        return list(curves)
    return [replace(curve, groups=(*container.groups, *curve.groups)) for curve in curves]


def out_of_layers(document: Document) -> Document:
    """Return the document with what is in its layers in none: they stay behind where curves are copied."""
    if not document.layers:
        return document
    depths = [len(layers_around(document, place)) for place in range(len(document.curves))]
    curves = tuple(
        replace(curve, groups=curve.groups[depth:]) if depth else curve
        for curve, depth in zip(document.curves, depths, strict=True)
    )
    return replace(document, curves=curves, layers=(), empty_layers=())


# Layers themselves


def new_layer(document: Document, above: str) -> tuple[Document, str]:
    """Add an empty layer in front of another one, or of all, and return its name."""
    name = free_group_name(document, "Layer")
    order = list(document.layers)
    node = layer_node(document, above) if above else None
    inside = "".join(node.around.groups[-1:]) if node is not None else ""
    at = len(order)
    if node is not None:
        at = max(order.index(each.name) for each in node.walk() if each.kind is NodeKind.LAYER) + 1
    order.insert(at, name)
    empty = (*document.empty_layers, EmptyLayer(name, inside))
    return replace(document, layers=tuple(order), empty_layers=empty), name


def without_layer(document: Document, layer: str) -> Document:
    """Remove a layer with all that is in it."""
    node = layer_node(document, layer)
    gone = {each.name for each in node.walk() if each.kind is NodeKind.LAYER}
    for place in reversed(node.places):
        if document.curves[place].locked:
            raise EditError(
                f"“{document.curves[place].name}” in “{layer}” is locked; unlock it to delete it."
            )
        document = remove_curve(document, place)
    return replace(document, layers=tuple(each for each in document.layers if each not in gone))


def stepped_layer(document: Document, layer: str, step: int) -> Document:
    """Bring a layer in front of (1) or behind (−1) the next one beside it.

    Raises
    ------
    EditError
        If there is none.
    """
    node = layer_node(document, layer)
    beside = _beside(document, node)
    to = beside.index(node) + step
    if not 0 <= to < len(beside):
        where = "front" if step > 0 else "back"
        raise AlreadySoError(f"“{layer}” is the layer at the {where} already.")
    names = [each.name for each in beside]
    names.insert(to, names.pop(to - step))
    other = beside[to]
    # Those in them follow in the order of the tree.
    document = replace(document, layers=(*names, *(each for each in document.layers if each not in names)))
    if not node.places or not other.places:
        return document
    at = other.places.stop if step > 0 else other.places.start
    return gathered(document, {place: document.curves[place] for place in node.places}, at).document


def moved_layers(
    document: Document, layers: Collection[str], into: Container, behind: Sequence[str]
) -> Document:
    """Bring layers in front of the first one that stays of those they are to be in front of, or behind all.

    Where there are curves in them, these are there already; the others come into a layer.

    Raises
    ------
    EditError
        If one would be in itself.
    """
    if not set(layers).isdisjoint(into.groups):
        raise EditError("A layer cannot go into itself.")
    order = [each for each in document.layers if each not in layers]
    at = next((order.index(each) + 1 for each in behind if each in order), 0)
    order[at:at] = [each for each in document.layers if each in layers]
    inside = into.groups[-1] if into.groups else ""
    empty = tuple(
        replace(each, inside=inside) if each.name in layers else each for each in document.empty_layers
    )
    return replace(document, layers=tuple(order), empty_layers=empty)


def whole_layers(document: Document, curves: Collection[int]) -> list[str]:
    """Return the layers all of whose curves are among these, without those in one of them."""
    found = [node for node in layer_nodes(document) if node.places and set(node.places) <= set(curves)]
    names = {node.name for node in found}
    return [node.name for node in found if names.isdisjoint(node.around.groups)]


def layers_beside(document: Document, layer: str) -> list[str]:
    """Return a layer and those in the same one, from the back to the front."""
    return [each.name for each in _beside(document, layer_node(document, layer))]


def _beside(document: Document, node: Node) -> list[Node]:
    return [each for each in layer_nodes(document) if each.around == node.around]


def moved_to_layer(document: Document, curves: Collection[int], step: int) -> tuple[Gathered, str]:
    """Bring curves, whole shapes and groups to the front of the layer above (1) or below (−1) theirs.

    Also returns the name of that layer.
    """
    chosen = whole_shapes(document, curves)
    layer = neighbour_of(document, chosen, step)
    if not layer:
        raise EditError(f"There is no layer {'above' if step > 0 else 'below'}.")
    front = front_of(document, layer)
    moved = contained(document.curves, chosen, front.container, document.layers)
    return gathered(document, moved, front.place), layer


def neighbour_of(document: Document, curves: Collection[int], step: int) -> str:
    """Return the layer above (1) or below (−1) that of curves, or the curves themselves; empty for none."""
    if not curves or not document.layers:
        return ""
    nodes = list(layer_nodes(document))
    names = [node.name for node in nodes]
    curve = max(curves) if step > 0 else min(curves)
    if own := layer_of(document, curve):
        at = names.index(own) + step
    else:
        behind = sum(node.places.stop <= curve for node in nodes)
        at = behind if step > 0 else behind - 1
    return names[at] if 0 <= at < len(names) else ""


def with_layer_looks(
    document: Document, layer: str, *, visible: bool | None = None, locked: bool | None = None
) -> Document:
    """Show or hide a layer, lock or free it, with all that is in it; None leaves it as it is."""
    node = layer_node(document, layer)
    inner = {each.name for each in node.walk() if each.kind is NodeKind.LAYER}
    return _with_looks(document, node.places, inner, visible, locked)


def all_shown(document: Document) -> Document:
    """Show what is hidden, layers too."""
    if all(each.visible for each in document.curves) and all(each.visible for each in document.empty_layers):
        raise AlreadySoError("Nothing is hidden.")
    return _with_looks(document, range(len(document.curves)), set(document.layers), True, None)


def all_unlocked(document: Document) -> Document:
    """Free what is locked, layers too."""
    if not (
        any(each.locked for each in document.curves) or any(each.locked for each in document.empty_layers)
    ):
        raise AlreadySoError("Nothing is locked.")
    return _with_looks(document, range(len(document.curves)), set(document.layers), None, False)


def _with_looks(
    document: Document,
    places: Collection[int],
    layers: Collection[str],
    visible: bool | None,
    locked: bool | None,
) -> Document:
    """Show or hide curves and empty layers, lock or free them; None leaves it as it is."""
    given = {"visible": visible, "locked": locked}
    looks = {name: value for name, value in given.items() if value is not None}
    empty = tuple(replace(each, **looks) if each.name in layers else each for each in document.empty_layers)
    document = replace(document, empty_layers=empty)
    return with_each(document, places, lambda curve: replace(curve, **looks))
