"""Clones and originals of curves that come into a document together."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import count

from msgspec.structs import replace

from .along_edits import path_of, put_on
from .clone_maps import as_cloned
from .model import Curve, Document


def linked_up(document: Document) -> Document:
    """Return a document whose clones run as their originals do; without one they are none."""
    if not any(curve.clone is not None for curve in document.curves):
        return document
    originals = {curve.identity: curve for curve in document.curves if curve.identity}
    return replace(document, curves=tuple(_linked(curve, originals, ()) for curve in document.curves))


def _linked(curve: Curve, originals: dict[str, Curve], within: Sequence[str]) -> Curve:
    """Return a curve as the clone that it is, of an original which may be a clone itself."""
    clone = curve.clone
    if clone is None:
        return curve
    original = originals.get(clone.of)
    if original is None or clone.of in within:
        return replace(curve, clone=None)
    return as_cloned(curve, _linked(original, originals, (*within, clone.of)))


def with_own_links(curves: Sequence[Curve], there: Sequence[Curve]) -> list[Curve]:
    """Return curves for a document with others `there`, whose clones follow the originals among themselves.

    Of those that have the identity of a curve there, the ones with clones among them get another.
    """
    taken = {curve.identity for curve in there}
    followed = {curve.clone.of for curve in curves if curve.clone is not None} | {*map(path_of, curves)}
    own = {curve.identity for curve in curves if curve.identity}
    fresh: dict[str, str] = {}
    used = {*taken, *own}
    for identity in own & set(taken):
        fresh[identity] = _free(identity, used) if identity in followed else ""
        used.add(fresh[identity])
    if not fresh:
        return list(curves)
    return [_renewed(curve, fresh) for curve in curves]


def _free(identity: str, used: Collection[str]) -> str:
    stem = identity.partition("~")[0]
    return next(name for number in count(2) if (name := f"{stem}~{number}") not in used)


def _renewed(curve: Curve, fresh: dict[str, str]) -> Curve:
    clone = curve.clone
    if clone is not None and fresh.get(clone.of):
        curve = replace(curve, clone=replace(clone, of=fresh[clone.of]))
    if curve.form is not None and fresh.get(path_of(curve)):
        curve = put_on(curve, fresh[path_of(curve)])
    return replace(curve, identity=fresh[curve.identity]) if curve.identity in fresh else curve
