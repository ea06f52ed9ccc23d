"""Search for objects in JSON that have a key twice: typed decoding silently takes the last."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence

import msgspec

from ..document.model import Point


class _Place(str):
    """Place in an object of a key that is repeated, such as ``.points[3].x``."""


class _Points(msgspec.Struct):
    """The points of a curve as they are written."""

    points: msgspec.Raw = msgspec.Raw(b"[]")


class _Curves(msgspec.Struct):
    """The curves of a file of this version; everything else is skipped."""

    curves: list[_Points]


_POINTS_DECODER = msgspec.json.Decoder(_Curves)


def repeated_key(
    data: bytes, points: Sequence[tuple[Point, ...]], encode: Callable[[object], bytes]
) -> str | None:
    """Return the place of a key that an object has twice, such as ``curves[0].points[3].x``, or None.

    Parameters
    ----------
    data
        JSON that has been decoded as a document: nothing in it is deep.
    points
        The points of every curve that it was decoded to; empty for a file of an older version.
    encode
        Encodes points, and leaves out what has its default.
    """
    short = _without_plain_points(data, points, encode) if points else data
    place = _place_in(short)
    # Where it is only the whole file tells.
    return place if place is None or short is data else _place_in(data)


def _place_in(data: bytes) -> str | None:
    # Numbers become floats because Python refuses to make an int of many digits.
    place = json.loads(data, object_pairs_hook=_repeated, parse_int=float)
    return None if place is None else str(place.removeprefix("."))


def _without_plain_points(
    data: bytes, points: Sequence[tuple[Point, ...]], encode: Callable[[object], bytes]
) -> bytes:
    """Return the file without points of which the number of quotation marks tells that no key is repeated.

    Points hold no text but their keys. Written anew they have each key once, and none that need not be there:
    whatever the file has besides, a key twice or a default, adds quotation marks. One point after the other,
    a million would take longer than all else that is done with them.
    """
    pieces, end = [], 0
    for curve, plain in zip(_POINTS_DECODER.decode(data).curves, points, strict=True):
        written = bytes(curve.points)
        if b"\\" not in written and written.count(b'"') == encode(plain).count(b'"'):
            start = data.index(written, end)
            pieces += [data[end:start], b"[]"]
            end = start + len(written)
    return b"".join([*pieces, data[end:]])


def _repeated(members: list[tuple[str, object]]) -> _Place | None:
    """Return where in this object a key is repeated, or None; nested objects come as their answers."""
    seen: set[str] = set()
    for key, value in members:
        if key in seen:
            return _Place(f".{key}")
        seen.add(key)
        items = enumerate(value) if isinstance(value, list) else [(None, value)]
        for index, item in items:
            if isinstance(item, _Place):
                return _Place(f".{key}{'' if index is None else f'[{index}]'}{item}")
    return None
