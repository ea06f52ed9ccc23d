"""File format of documents: bytes to values and back, strictly.

A file is UTF-8 JSON, ``{"format": "curvebench", "version": 4, "curves": [...]}``. `decode` accepts a file
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
from .migration import NOTHING, LeftOut, can_migrate, migrated, with_shapes_kept
from .validation import settings_problem, validate, without_default_settings

Values = TypeVar("Values", bound=Value)

FORMAT = "curvebench"
VERSION = 4

_BYTE_ORDER_MARK = b"\xef\xbb\xbf"
_POINTS_AT_ONCE = 10_000
_LAST_CONCEIVABLE_VERSION = 10**6
_LONG_INTEGER = 20


class _Header(msgspec.Struct):
    """Header of every version of the format; everything else in the file is skipped."""

    format: str
    version: int


class _File(Document, frozen=True, kw_only=True):
    """Complete file of this version."""

    format: Literal["curvebench"]
    version: Literal[4]

    @property
    def document(self) -> Document:
        """The document in the file."""
        return Document(**{name: getattr(self, name) for name in Document.__struct_fields__})


class Decoded(msgspec.Struct, frozen=True):
    """Document of a file, and the features of an older version that were left out."""

    document: Document
    left_out: LeftOut = NOTHING


@cache
def _file_decoder() -> msgspec.json.Decoder[_File]:
    """Return the decoder of files, made for the first file: it inspects every type of a document."""
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
        If `decode` would not read the result: msgspec alone would write NaN as null.
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
    """Yield a curve as indented JSON, one line per member and per point."""
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
    """Return a value with the default objects in place of equal ones: msgspec omits only these."""
    fields = {name: (getattr(value, name), default) for name, default in _defaults_of(type(value))}
    return type(value)(**{name: held for name, (held, default) in fields.items() if held != default})


@cache
def _defaults_of(kind: type[msgspec.Struct]) -> list[tuple[str, object]]:
    """Return the names and defaults of fields; cached, because msgspec parses the annotations each time."""
    return [(field.name, field.default) for field in msgspec.structs.fields(kind)]


def _members(value: Value) -> Iterable[tuple[str, msgspec.Raw]]:
    """Return the names and the JSON of the fields of a value."""
    # Raw keeps the order and the omitted defaults of msgspec.
    return msgspec.json.decode(_ENCODER.encode(value), type=dict[str, msgspec.Raw]).items()


def _points_pieces(points: tuple[Point, ...]) -> Iterator[bytes]:
    """Yield the points as a JSON list with one line each."""
    if not points:
        yield b"[]"
        return
    # Many at once: one by one, a million points would take longer than everything else. Braces occur only
    # around the points themselves.
    for start in range(0, len(points), _POINTS_AT_ONCE):
        text = _one_line(_ENCODER.encode(points[start : start + _POINTS_AT_ONCE]))
        yield b",\n        " if start else b"[\n        "
        yield text[1:-1].replace(b"}, {", b"},\n        {")
    yield b"\n      ]"


def _one_line(text: bytes | msgspec.Raw) -> bytes:
    """Return JSON on one line with a space after every comma and colon."""
    return msgspec.json.format(bytes(text), indent=0)


def decode(data: bytes) -> Document:
    """Return the document in the content of a file.

    Parameters
    ----------
    data
        The whole file.

    Raises
    ------
    FormatError
        With the field and its requirement, if the content is not a valid document.
    """
    return decode_counting(data).document


def decode_counting(data: bytes) -> Decoded:
    """Return the document in the content of a file, and the older features that were left out."""
    _refuse_other_text(data)
    try:
        header = _HEADER_DECODER.decode(data)
        _check_header(header)
        left_out = NOTHING
        if header.version == VERSION:
            file = _file_decoder().decode(data)
        else:
            file, left_out = _migrated(data, header.version)
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
    return Decoded(*with_shapes_kept(document, header.version, left_out))


def _with_settings_checked(index: int, curve: Curve) -> Curve:
    """Return a curve without default settings; raise FormatError if its family does not allow a setting."""
    if problem := settings_problem(curve):
        raise FormatError(f"curves[{index}].{problem}")
    return without_default_settings(curve)


def version_of(data: bytes) -> int | None:
    """Return the version that the content of a file claims, or None if it is not a document of Curvebench."""
    try:
        header = _HEADER_DECODER.decode(data)
    except (msgspec.MsgspecError, RecursionError, UnicodeDecodeError):
        return None
    return header.version if header.format == FORMAT else None


def _migrated(data: bytes, version: int) -> tuple[_File, LeftOut]:
    """Return the content of a file of an older version as one of this version, and the lost features."""
    values = _values_in(data)
    try:
        migration = migrated(values, version, VERSION)
    except (LookupError, TypeError, ValueError, AttributeError) as problem:
        # A migration relies on the version that the file claims.
        raise FormatError(
            f"it claims to be of version {version}, but its content is not valid in that version"
        ) from problem
    return msgspec.convert(migration.values, _File, dec_hook=decode_hook), migration.left_out


def _values_in(data: bytes) -> dict[str, Any]:
    """Return the values in a file; too large numbers become infinite, so that `validate` refuses them."""
    try:
        return msgspec.json.decode(data, type=dict[str, Any])
    except msgspec.ValidationError:
        # Without types msgspec cannot name the field of such a number.
        with suppress(ValueError):
            return dict(json.loads(data, parse_int=_bounded))
        raise


def _bounded(text: str) -> int | float:
    return int(text) if len(text) < _LONG_INTEGER else float(text)


def _refuse_other_text(data: bytes) -> None:
    """Raise FormatError unless the content is non-empty UTF-8 text without a byte order mark."""
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
    """Raise FormatError unless the file is a document of Curvebench in a version that can be read."""
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
    """Raise FormatError if an object has a key twice; msgspec would silently use the last one."""
    path = repeated_key(data, [curve.points for curve in curves], _ENCODER.encode)
    if path is not None:
        raise FormatError(f"{path} appears twice; each key may appear only once")


# Keys that appear twice: typed decoding silently uses the last one


class _KeyPath(str):
    """Path of a repeated key, such as ``.points[3].x``."""


class _Points(msgspec.Struct):
    """Points of a curve as they are written."""

    points: msgspec.Raw = msgspec.Raw(b"[]")


class _Curves(msgspec.Struct):
    """Curves of a file of this version; everything else is skipped."""

    curves: list[_Points]


_POINTS_DECODER = msgspec.json.Decoder(_Curves)


def repeated_key(
    data: bytes, points: Sequence[tuple[Point, ...]], encode: Callable[[object], bytes]
) -> str | None:
    """Return the path of a key that an object has twice, such as ``curves[0].points[3].x``, or None.

    Parameters
    ----------
    data
        JSON that was decoded as a document, so that its depth is limited.
    points
        The decoded points of every curve; empty for a file of an older version.
    encode
        Function that encodes points without fields at their defaults.
    """
    short = _without_plain_points(data, points, encode) if points else data
    path = _path_in(short)
    # Only the complete file has the right indices.
    return path if path is None or short is data else _path_in(data)


def _path_in(data: bytes) -> str | None:
    # Numbers become floats, because Python refuses integers of many digits.
    path = json.loads(data, object_pairs_hook=_repeated, parse_int=float)
    return None if path is None else str(path.removeprefix("."))


def _without_plain_points(
    data: bytes, points: Sequence[tuple[Point, ...]], encode: Callable[[object], bytes]
) -> bytes:
    """Return the file without points whose number of quotation marks proves that no key is repeated.

    Points contain no text but their keys. Encoded again they have each key once and no defaults: a key that
    the file has twice adds quotation marks. Parsing a million points one by one would take longer than
    everything else.
    """
    pieces, end = [], 0
    for curve, plain in zip(_POINTS_DECODER.decode(data).curves, points, strict=True):
        written = bytes(curve.points)
        if b"\\" not in written and written.count(b'"') == encode(plain).count(b'"'):
            start = data.index(written, end)
            pieces += [data[end:start], b"[]"]
            end = start + len(written)
    return b"".join([*pieces, data[end:]])


def _repeated(members: list[tuple[str, object]]) -> _KeyPath | None:
    """Return the path of a repeated key in an object, or None; nested objects are already such results."""
    keys: set[str] = set()
    for key, value in members:
        if key in keys:
            return _KeyPath(f".{key}")
        keys.add(key)
        items = enumerate(value) if isinstance(value, list) else [(None, value)]
        for index, item in items:
            if isinstance(item, _KeyPath):
                return _KeyPath(f".{key}{'' if index is None else f'[{index}]'}{item}")
    return None
