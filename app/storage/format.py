"""The document's file format: bytes to values and back, strictly.

A file is UTF-8 JSON, ``{"format": "curvebench", "version": 1, "curves": [...]}``. What `decode` accepts,
`encode` writes back with every float equal bit for bit; what it does not accept, it refuses with the
place in the file and the requirement. `validate` states the requirements that go beyond types.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from itertools import count
from typing import Literal

import msgspec
from msgspec.structs import replace

from ..document.derivatives import VECTORS
from ..document.model import (
    MAX_MAGNITUDE,
    Curve,
    Document,
    ParametrizationKind,
    Point,
    ReferenceImage,
    Value,
    Vector,
)
from .all_within import all_within
from .coding import from_plain, to_plain
from .migration import can_migrate, migrated
from .repeated_keys import repeated_key
from .setting_check import settings_problem, without_default_settings

FORMAT = "curvebench"
VERSION = 1

_BYTE_ORDER_MARK = b"\xef\xbb\xbf"
_LONGEST_QUOTE = 40
_POINTS_AT_ONCE = 10_000
_LAST_CONCEIVABLE_VERSION = 10**6


class FormatError(ValueError):
    """The bytes are no Curvebench document, or the values cannot be written as one.

    The message is a clause to follow the file's name and a colon: "it is not JSON; the file ends too early".
    """


class _Header(msgspec.Struct):
    """The head that every version of the format has; everything else in the file is skipped."""

    format: str
    version: int


class _File(Value, frozen=True):
    """A whole file of this version."""

    format: Literal["curvebench"]
    version: Literal[1]
    curves: tuple[Curve, ...]
    image: ReferenceImage | None = None


_HEADER_DECODER = msgspec.json.Decoder(_Header)
_FILE_DECODER = msgspec.json.Decoder(_File, dec_hook=from_plain)
_ENCODER = msgspec.json.Encoder(enc_hook=to_plain)


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
    if document.image is not None:
        pieces += [b'  "image": ', _one_line(_ENCODER.encode(document.image)), b",\n"]
    pieces.append(b'  "curves": [\n')
    for index, curve in enumerate(document.curves):
        pieces += [b",\n" if index else b"", *_curve_pieces(curve)]
    pieces.append(b"\n  ]\n}\n")
    return b"".join(pieces)


def _curve_pieces(curve: Curve) -> Iterator[bytes]:
    """Yield the curve as JSON, indented, with one line per member and per point."""
    # Through Raw, the members keep the order and the omitted defaults that msgspec gives them.
    without_points = _ENCODER.encode(without_default_settings(replace(curve, points=())))
    members = msgspec.json.decode(without_points, type=dict[str, msgspec.Raw])
    yield b"    {\n"
    for index, (key, value) in enumerate(members.items()):
        yield (b",\n" if index else b"") + b'      "' + key.encode() + b'": '
        if key == "points":
            yield from _points_pieces(curve.points)
        else:
            yield _one_line(value)
    yield b"\n    }"


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
    _refuse_other_text(data)
    try:
        header = _HEADER_DECODER.decode(data)
        _check_header(header)
        file = _FILE_DECODER.decode(data) if header.version == VERSION else _raised(data, header.version)
    except msgspec.ValidationError as problem:
        raise FormatError(_in_words(str(problem))) from None
    except msgspec.DecodeError as problem:
        raise FormatError(not_json(str(problem), data)) from None
    except RecursionError:
        raise FormatError("it is not a Curvebench document; it is nested too deeply") from None
    _refuse_repeated_keys(data, file.curves if header.version == VERSION else ())
    document = Document(file.curves, file.image)
    validate(document)
    if any(curve.settings or curve.other_settings for curve in document.curves):
        document = replace(document, curves=tuple(map(_with_settings_checked, count(), document.curves)))
    return document


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


def _raised(data: bytes, version: int) -> _File:
    """Return the content of a file of an older version as one of this."""
    try:
        values = migrated(msgspec.json.decode(data), version, VERSION)
    except (LookupError, TypeError, ValueError, AttributeError) as problem:
        # A migration takes a file for what it claims to be.
        raise FormatError(
            f"it claims version {version}, but does not hold what that version has"
        ) from problem
    return msgspec.convert(values, _File, dec_hook=from_plain)


def _refuse_other_text(data: bytes) -> None:
    """Raise FormatError unless `data` is non-empty UTF-8 without a byte order mark."""
    if not data.strip():
        raise FormatError("the file is empty")
    if data.startswith(_BYTE_ORDER_MARK):
        raise FormatError("the file starts with a byte order mark; save it as UTF-8 without one")
    try:
        data.decode("utf-8")
    except UnicodeDecodeError as problem:
        raise FormatError(f"it is not UTF-8 text; {_line_and_column(data, problem.start)}") from None


def _check_header(header: _Header) -> None:
    """Raise FormatError unless the file is ours and of the version that this program reads."""
    if header.format != FORMAT:
        raise FormatError(
            f'it is not a Curvebench document; format must be "{FORMAT}", not {_quoted(header.format)}'
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


def validate(document: Document) -> None:
    """Raise FormatError, with the place, unless `document` may be saved.

    A document has at least one curve. Every number is finite, its magnitude at most `MAX_MAGNITUDE`.
    A parametrization has start < end and alpha in [0, 1]. The parameters that the points carry increase
    strictly in the order of the points, also where a rule is in force and they are only remembered; under
    the manual parametrization every point carries one. A curve may have one point or none. An image has a
    path to a file of this computer, a positive size and an opacity in [0, 1].
    """
    if not document.curves:
        raise FormatError("curves must hold at least one curve")
    for index, curve in enumerate(document.curves):
        _validate_curve(curve, f"curves[{index}]")
    if document.image is not None:
        _validate_image(document.image)


def validate_changes(before: Document, after: Document) -> None:
    """Raise FormatError, as `validate` does, for what in `after` is not the same object as in `before`."""
    known = {id(curve) for curve in before.curves}
    for index, curve in enumerate(after.curves):
        if id(curve) not in known:
            _validate_curve(curve, f"curves[{index}]")
    if after.image is not None and after.image is not before.image:
        _validate_image(after.image)


def _validate_image(image: ReferenceImage) -> None:
    for key in ("x", "y", "width", "height", "opacity"):
        _check_number(getattr(image, key), f"image.{key}")
    for key in ("width", "height"):
        if not getattr(image, key) > 0:
            raise FormatError(f"image.{key} must be greater than 0, not {getattr(image, key)!r}")
    if not 0 <= image.opacity <= 1:
        raise FormatError(f"image.opacity must lie between 0 and 1, not {image.opacity!r}")
    if not image.path.strip() or not image.path.isprintable():
        raise FormatError(f"image.path must be the name of a file, not {_quoted(image.path)}")
    if image.path.startswith(("//", "\\\\")):
        # Opening one would knock at another computer, and on some systems with the person's password.
        raise FormatError("image.path must lead to a file of this computer, not to one of the network")


def _validate_curve(curve: Curve, place: str) -> None:
    try:
        curve.name.encode("utf-8")
    except UnicodeEncodeError:
        raise FormatError(f"{place}.name holds a character that UTF-8 cannot carry") from None
    rule = curve.parametrization
    for key in ("alpha", "start", "end"):
        _check_number(getattr(rule, key), f"{place}.parametrization.{key}")
    if not 0 <= rule.alpha <= 1:
        raise FormatError(f"{place}.parametrization.alpha must lie between 0 and 1, not {rule.alpha!r}")
    if not rule.start < rule.end:
        raise FormatError(
            f"{place}.parametrization.end must be greater than {rule.start!r}, the start, not {rule.end!r}"
        )
    if curve.colour and not re.fullmatch("#[0-9a-f]{6}", curve.colour):
        raise FormatError(
            f'{place}.colour must be written as "#rrggbb" in lower case, not {_quoted(curve.colour)}'
        )
    if not all_within(curve.points):
        for index, point in enumerate(curve.points):
            for key, value in _numbers(point):
                _check_number(value, f"{place}.points[{index}].{key}")
    _validate_parameters(curve, place)


def _numbers(point: Point) -> Iterator[tuple[str, float]]:
    """Yield every number of the point with its place in it."""
    yield "x", point.x
    yield "y", point.y
    if point.t is not None:
        yield "t", point.t
    for _, key in VECTORS:
        vector: Vector | None = getattr(point, key)
        for index, value in enumerate(vector or ()):
            yield f"{key}[{index}]", value


def _check_number(value: float, place: str) -> None:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise FormatError(f"{place} must be a number, not {value!r}")
    # Written so that NaN fails.
    if not -MAX_MAGNITUDE <= value <= MAX_MAGNITUDE:
        raise FormatError(f"{place} {_RANGE}, not {_short(value)}")


def _validate_parameters(curve: Curve, place: str) -> None:
    """Raise FormatError unless the parameters that the points carry increase strictly."""
    # No list of pairs: of a million points it would take half of what these take themselves.
    times = [point.t for point in curve.points]
    if curve.is_manual and None in times:
        raise FormatError(
            f"{place}.points[{times.index(None)}].t is missing; "
            f'under "{ParametrizationKind.MANUAL}" every point carries its parameter'
        )
    before, low = -1, None
    for index, high in enumerate(times):
        if high is None:
            continue
        if low is not None and not low < high:
            whose = "the point before it" if before == index - 1 else f"points[{before}]"
            raise FormatError(
                f"{place}.points[{index}].t must be greater than {low!r}, the t of {whose}, not {high!r}"
            )
        before, low = index, high
    if curve.closed and curve.is_manual and low is not None and not low < curve.parametrization.end:
        raise FormatError(
            f"{place}.parametrization.end must be greater than {low!r}, the t of the last point: "
            "there the closed curve returns to its first point"
        )


# What msgspec says, and the same for people. Its message ends with the place, "- at `$.curves[0].x`".
_RANGE = f"must lie between -{MAX_MAGNITUDE:g} and {MAX_MAGNITUDE:g}".replace("e+", "e")
_TYPES = {
    "float": "a number",
    "int": "a whole number",
    "str": "text",
    "array": "a list",
    "object": "an object {…}",
    "bool": "true or false",
    "null": "null",
}


def _in_words(message: str) -> str:
    """Return msgspec's objection to a value as a sentence that starts with the place in the file."""
    complaint, _, path = message.partition(" - at `$")
    place = path.rstrip("`").removeprefix(".")
    if match := re.fullmatch(r"Object missing required field `(.*)`", complaint):
        return f"{place}.{match[1]} is missing".removeprefix(".")
    if match := re.fullmatch(r"Object contains unknown field `(.*)`", complaint, re.DOTALL):
        return f"{place or 'the file'} has a key that this version does not know: {_quoted(match[1])}"
    return f"{place or 'the file'} {_requirement(complaint)}"


def _requirement(complaint: str) -> str:
    """Return what msgspec says of a value as a clause that follows its place."""
    if match := re.fullmatch(r"Expected `array` of length (\d+)(?:, got \d+)?", complaint):
        return f"must be a list of {match[1]} numbers"
    if match := re.fullmatch(r"Expected `(.*)`, got `(.*)`", complaint):
        return f"must be {_kinds(match[1])}, not {_kinds(match[2])}"
    if match := re.fullmatch(r"Invalid enum value (.*)", complaint, re.DOTALL):
        return f"is not a choice that this version knows: {_quoted(match[1].strip(chr(39)))}"
    if complaint in ("Number out of range", "Integer value out of range"):
        return _RANGE
    return f"is not valid: {complaint}"


def _kinds(names: str) -> str:
    """Return msgspec's ``float | null`` in words."""
    return " or ".join(_TYPES.get(name, name) for name in names.split(" | "))


def not_json(message: str, data: bytes) -> str:
    """Return msgspec's objection to the text with its line and column."""
    match = re.fullmatch(r"JSON is malformed: (.*) \(byte (\d+)\)", message)
    if match is None:
        return "it is not JSON; the file ends too early"
    return f"it is not JSON; {_line_and_column(data, int(match[2]))}: {match[1]}"


def _line_and_column(data: bytes, position: int) -> str:
    """Return the place of a byte as an editor of text shows it."""
    line = data.count(b"\n", 0, position) + 1
    line_start = data.rfind(b"\n", 0, position) + 1
    column = len(data[line_start:position].decode("utf-8", "replace")) + 1
    return f"line {line}, column {column}"


def _quoted(text: str) -> str:
    shortened = text if len(text) <= _LONGEST_QUOTE else f"{text[:_LONGEST_QUOTE]}…"
    return json.dumps(shortened, ensure_ascii=not shortened.isprintable())


def _short(value: float) -> str:
    """Return a number that may be an int of a million digits."""
    return repr(value) if isinstance(value, float) else "a larger one"
