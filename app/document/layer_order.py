"""Order of the layers of a document: that of its curves, with the empty ones between."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from itertools import takewhile

from msgspec.structs import replace

from .empty_layer import EmptyLayer
from .model import Curve, Document


def with_tidy_layers(document: Document, before: Document | None = None) -> Document:
    """Return the document with its layers in order, and with what is known of those that are empty.

    A layer is in nothing but layers, or it is one no longer. One that was left without curves since `before`
    stays, and where it was.
    """
    if not document.layers:
        return replace(document, empty_layers=()) if document.empty_layers else document
    around = _parents(document.curves, document.layers)
    groups = {name for curve in document.curves for name in curve.groups}
    names = [
        name for name in dict.fromkeys(document.layers) if name and (name in around or name not in groups)
    ]
    empty = _empty(names, around, document, before)
    around |= {each.name: each.inside for each in empty.values()}
    order = tuple(_walked("", _beside_each_other(names, around, empty)))
    known = tuple(empty[name] for name in order if name in empty)
    if (order, known) == (document.layers, document.empty_layers):
        return document
    return replace(document, layers=order, empty_layers=known)


def _parents(curves: Sequence[Curve], layers: Collection[str]) -> dict[str, str]:
    """Return the layers in which there are curves, in their order, each with the one that it is in."""
    known, found = frozenset(layers), dict[str, str]()
    for groups in dict.fromkeys(curve.groups for curve in curves):
        outer = ""
        for name in takewhile(known.__contains__, groups):
            found.setdefault(name, outer)
            outer = name
    return found


def _empty(
    names: Sequence[str], around: Mapping[str, str], document: Document, before: Document | None
) -> dict[str, EmptyLayer]:
    """Return what is known of the layers in which there is no curve, each in one that there is."""
    known = {each.name: each for each in document.empty_layers}
    left = [name for name in names if name not in around and name not in known]
    was = _parents(before.curves, before.layers) if left and before is not None else {}
    known |= {name: _left_empty(name, was.get(name, ""), before) for name in left}
    found = dict[str, EmptyLayer]()
    for name in names:
        if name not in around:
            each = known[name]
            is_there = each.inside in names and not _is_in_itself(name, known)
            found[name] = each if is_there or not each.inside else replace(each, inside="")
    return found


def _left_empty(name: str, inside: str, before: Document | None) -> EmptyLayer:
    """Return what is known of a layer whose last curve has gone: it is seen and locked as that was."""
    curves = [curve for curve in before.curves if name in curve.groups] if before is not None else []
    visible = not curves or any(curve.visible for curve in curves)
    return EmptyLayer(name, inside, visible, bool(curves) and all(curve.locked for curve in curves))


def _is_in_itself(name: str, known: Mapping[str, EmptyLayer]) -> bool:
    seen, at = {name}, known[name].inside
    while at in known:
        if at in seen:
            return True
        seen.add(at)
        at = known[at].inside
    return False


def _beside_each_other(
    names: Sequence[str], around: Mapping[str, str], empty: Collection[str]
) -> dict[str, list[str]]:
    """Return the layers in each: those with curves in the order of these, the empty ones in their places."""
    found = dict[str, list[str]]()
    for name in names:
        found.setdefault(around[name], []).append(name)
    for outer, beside in found.items():
        filled: Iterable[str] = (name for name in around if name not in empty and around[name] == outer)
        in_order = iter(list(filled))
        found[outer] = [name if name in empty else next(in_order) for name in beside]
    return found


def _walked(outer: str, inside: Mapping[str, Sequence[str]]) -> Iterator[str]:
    for name in inside.get(outer, ()):
        yield name
        yield from _walked(name, inside)


def with_layer_named_anew(document: Document, old: str, new: str) -> Document:
    """Return the document with another name of a layer wherever the layers have it."""
    if old not in document.layers:
        return document
    names = {each: each for each in ("", *document.layers)} | {old: new}
    return replace(
        document,
        layers=tuple(names[each] for each in document.layers),
        empty_layers=tuple(
            replace(each, name=names[each.name], inside=names[each.inside]) for each in document.empty_layers
        ),
    )
