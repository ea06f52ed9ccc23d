"""File format of documents: bytes to values and back, strictly.

A file is UTF-8 JSON, ``{"format": "curvebench", "version": 3, "curves": [...]}``. `decode` accepts a file
only if `encode` writes every float of it back bit for bit; it refuses any other file with the field and its
requirement. `validation` has the requirements that go beyond types.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from functools import cache
from itertools import count
from typing import Any, Literal, TypeVar

import msgspec
from msgspec.structs import replace

from ..document.fields import Value
from ..document.groups import tidy_shapes
from ..document.model import Curve, Document, Point
from ..document.style import PLAIN_STYLE
from .coding import decode_hook, encode_hook
from .format_error import FormatError, foreign_content_clause, in_words, line_and_column, not_json, quoted
from .migration import NOTHING, LeftOut, can_migrate, migrated
from .validation import settings_problem, validate, without_default_settings

Values = TypeVar("Values", bound=Value)

FORMAT = "curvebench"
VERSION = 3

_BYTE_ORDER_MARK = b"\xef\xbb\xbf"
_POINTS_AT_ONCE = 10_000
_LAST_CONCEIVABLE_VERSION = 10**6
_LONG_INTEGER = 20


class _Header(msgspec.Struct):
    """The head that every version of the format has; everything else in the file is skipped."""

    format: str
    version: int


class _File(Document, frozen=True, kw_only=True):
    """A whole file of this version."""

    format: Literal["curvebench"]
    version: Literal[3]

    @property
    def document(self) -> Document:
        """The document in it."""
        return Document(**{name: getattr(self, name) for name in Document.__struct_fields__})


class Decoded(msgspec.Struct, frozen=True):
    """A document, and what its file of an older version held besides."""

    document: Document
    left_out: LeftOut = NOTHING


@cache
def _file_decoder() -> msgspec.json.Decoder[_File]:
    """Return what reads files, made when there is one: it looks at every type in a document."""
    return msgspec.json.Decoder(_File, dec_hook=decode_hook)


_HEADER_DECODER = msgspec.json.Decoder(_Header)
_ENCODER = msgspec.json.Encoder(enc_hook=encode_hook)


def encode(document: Document) -> bytes:
    """Return the content of the file that holds `document`.

    Parameters
    ----------
    document
        Any document that `validate` accepts.

    Returns
    -------
    bytes
        UTF-8, one line per point, a newline at the end.

    Raises
    ------
    FormatError
        Where `decode` would not read the result; msgspec alone would write NaN as null.
    """
    validate(document)
    pieces = [f'{{\n  "format": "{FORMAT}",\n  "version": {VERSION},\n'.encode()]
    for key, value in _members(_without_defaults(replace(document, curves=()))):
        if key != "curves":
            pieces += [f'  "{key}": '.encode(), _one_line(value), b",\n"]
    pieces.append(b'  "curves": [\n')
    for index, curve in enumerate(document.curves):
        pieces += [b",\n" if index else b"", *_curve_pieces(curve)]
    pieces.append(b"\n  ]\n}\n")
    return b"".join(pieces)


def _curve_pieces(curve: Curve) -> Iterator[bytes]:
    """Yield the curve as JSON, indented, with one line per member and per point."""
    style = _without_defaults(curve.style)
    rest = replace(curve, points=(), style=PLAIN_STYLE if style == PLAIN_STYLE else style)
    yield b"    {\n"
    for index, (key, value) in enumerate(_members(without_default_settings(rest))):
        yield (b",\n" if index else b"") + b'      "' + key.encode() + b'": '
        if key == "points":
            yield from _points_pieces(curve.points)
        else:
            yield _one_line(value)
    yield b"\n    }"


def _without_defaults(value: Values) -> Values:
    """Return a value that has the very default where it has an equal one: msgspec leaves out no other."""
    given = {name: (getattr(value, name), default) for name, default in _defaults_of(type(value))}
    return type(value)(**{name: here for name, (here, default) in given.items() if here != default})


@cache
def _defaults_of(kind: type[msgspec.Struct]) -> list[tuple[str, object]]:
    """Return the names and the defaults of what a kind of value holds; msgspec reads its annotations anew."""
    return [(each.name, each.default) for each in msgspec.structs.fields(kind)]


def _members(value: Value) -> Iterable[tuple[str, msgspec.Raw]]:
    """Return the names and the JSON of what a value holds."""
    # Through Raw, the members keep the order and the omitted defaults that msgspec gives them.
    return msgspec.json.decode(_ENCODER.encode(value), type=dict[str, msgspec.Raw]).items()


def _points_pieces(points: tuple[Point, ...]) -> Iterator[bytes]:
    """Yield the points as a JSON list with one line each."""
    if not points:
        yield b"[]"
        return
    # Many at once: point by point a million of them take longer than all else that is done with them. Of
    # what a point holds only the point itself stands in braces.
    for start in range(0, len(points), _POINTS_AT_ONCE):
        text = _one_line(_ENCODER.encode(points[start : start + _POINTS_AT_ONCE]))
        yield b",\n        " if start else b"[\n        "
        yield text[1:-1].replace(b"}, {", b"},\n        {")
    yield b"\n      ]"


def _one_line(text: bytes | msgspec.Raw) -> bytes:
    """Return JSON on one line with a space after every comma and colon."""
    return msgspec.json.format(bytes(text), indent=0)


def decode(data: bytes) -> Document:
    """Return the document that the content of a file holds.

    Parameters
    ----------
    data
        The whole file.

    Raises
    ------
    FormatError
        With the place and the requirement, for anything that is not a valid document of this version.
    """
    return decode_counting(data).document


def decode_counting(data: bytes) -> Decoded:
    """Return what `decode` does, and what of a file of an older version is left out."""
    _refuse_other_text(data)
    try:
        header = _HEADER_DECODER.decode(data)
        _check_header(header)
        left_out = NOTHING
        if header.version == VERSION:
            file = _file_decoder().decode(data)
        else:
            file, left_out = _raised(data, header.version)
    except msgspec.ValidationError as problem:
        raise FormatError(in_words(str(problem))) from None
    except msgspec.DecodeError as problem:
        raise FormatError(not_json(str(problem), data)) from None
    except RecursionError:
        raise FormatError("it is not a Curvebench document; it is nested too deeply") from None
    _refuse_repeated_keys(data, file.curves if header.version == VERSION else ())
    document = tidy_shapes(file.document) if left_out else file.document
    validate(document)
    if any(curve.settings or curve.other_settings for curve in document.curves):
        document = replace(document, curves=tuple(map(_with_settings_checked, count(), document.curves)))
    return Decoded(document, left_out)


def _with_settings_checked(index: int, curve: Curve) -> Curve:
    """Return a curve without defaults among its settings; raise FormatError unless its family has them."""
    if problem := settings_problem(curve):
        raise FormatError(f"curves[{index}].{problem}")
    return without_default_settings(curve)


def version_of(data: bytes) -> int | None:
    """Return the version that the content of a file claims; None where it is no document of ours."""
    try:
        header = _HEADER_DECODER.decode(data)
    except (msgspec.MsgspecError, RecursionError, UnicodeDecodeError):
        return None
    return header.version if header.format == FORMAT else None


def _raised(data: bytes, version: int) -> tuple[_File, LeftOut]:
    """Return the content of a file of an older version as one of this, and what is left out of it."""
    values = _values_in(data)
    try:
        found = migrated(values, version, VERSION)
    except (LookupError, TypeError, ValueError, AttributeError) as problem:
        # A migration takes a file for what it claims to be.
        raise FormatError(
            f"it claims version {version}, but does not hold what that version has"
        ) from problem
    return msgspec.convert(found.values, _File, dec_hook=decode_hook), found.left_out


def _values_in(data: bytes) -> dict[str, Any]:
    """Return the values of a file; numbers beyond all bounds are infinite, for `validate` to refuse them."""
    try:
        return msgspec.json.decode(data, type=dict[str, Any])
    except msgspec.ValidationError:
        # Without types msgspec has no names for the place of such a number.
        with suppress(ValueError):
            return dict(json.loads(data, parse_int=_bounded))
        raise


def _bounded(text: str) -> int | float:
    return int(text) if len(text) < _LONG_INTEGER else float(text)


def _refuse_other_text(data: bytes) -> None:
    """Raise FormatError unless `data` is non-empty UTF-8 without a byte order mark."""
    if not data.strip():
        raise FormatError("the file is empty")
    if data.startswith(_BYTE_ORDER_MARK):
        raise FormatError("the file starts with a byte order mark; save it as UTF-8 without one")
    if clause := foreign_content_clause(data):
        raise FormatError(clause)
    try:
        data.decode("utf-8")
    except UnicodeDecodeError as problem:
        raise FormatError(f"it is not UTF-8 text; {line_and_column(data, problem.start)}") from None


def _check_header(header: _Header) -> None:
    """Raise FormatError unless the file is ours and of the version that this program reads."""
    if header.format != FORMAT:
        raise FormatError(
            f'it is not a Curvebench document; format must be "{FORMAT}", not {quoted(header.format)}'
        )
    if header.version > _LAST_CONCEIVABLE_VERSION:
        raise FormatError(f"version must be {VERSION}, not a number of many digits")
    if header.version > VERSION:
        raise FormatError(
            "it was written by a newer version of Curvebench "
            f"(format version {header.version}; this program reads {VERSION})"
        )
    if header.version < VERSION and not can_migrate(header.version, VERSION):
        raise FormatError(f"version must be {VERSION}, not {header.version}")


def _refuse_repeated_keys(data: bytes, curves: tuple[Curve, ...]) -> None:
    """Raise FormatError where an object has a key twice; msgspec would silently take the last."""
    place = repeated_key(data, [curve.points for curve in curves], _ENCODER.encode)
    if place is not None:
        raise FormatError(f"{place} appears twice; each key may appear only once")


# Keys that appear twice: typed decoding silently uses the last one


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
