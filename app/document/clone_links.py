"""Texts and the curves that they lie along, which come into a document together."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import count

from msgspec.structs import replace

from .along_edits import path_of, put_on
from .model import Curve


def with_own_links(curves: Sequence[Curve], there: Sequence[Curve]) -> list[Curve]:
    """Return curves for a document with others `there`, whose texts lie along the curves among themselves.

    Of those that have the identity of a curve there, the ones with such texts among them get another.
    """
    taken = {curve.identity for curve in there}
    followed = {*map(path_of, curves)}
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
    if curve.form is not None and fresh.get(path_of(curve)):
        curve = put_on(curve, fresh[path_of(curve)])
    return replace(curve, identity=fresh[curve.identity]) if curve.identity in fresh else curve
