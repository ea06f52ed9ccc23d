"""The file format: what is read, what is refused and where, and that nothing changes on the way."""

import contextlib
import json
import math
import struct

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.document.derivatives import DERIVATIVES, AccelerationRule, JerkRule, VelocityRule
from app.document.limits import MAX_MAGNITUDE
from app.document.model import (
    Curve,
    Document,
    Parametrization,
    ParametrizationKind,
    Point,
    empty_document,
    make_curve,
)
from app.families import FAMILIES, HERMITE, LAGRANGE
from app.storage import format as file_format
from app.storage.format import decode, encode
from app.storage.format_error import FormatError
from app.storage.validation import validate
from tests.effort import calls_of
from tests.rows import each_row
from tests.texts import texts

numbers = st.floats(min_value=-MAX_MAGNITUDE, max_value=MAX_MAGNITUDE)
vectors = st.none() | st.tuples(numbers, numbers)
names = texts(20)


@st.composite
def parametrizations(draw, kinds=tuple(ParametrizationKind)):
    start, end = sorted(draw(st.lists(numbers, min_size=2, max_size=2, unique=True)))
    return Parametrization(draw(st.sampled_from(kinds)), draw(st.floats(0, 1)), start, end)


@st.composite
def curves(draw):
    rule = draw(parametrizations())
    count = draw(st.integers(0, 6))
    parameters = sorted(draw(st.lists(numbers, min_size=count, max_size=count, unique=True)))
    if rule.kind is not ParametrizationKind.MANUAL:
        parameters = [t if draw(st.booleans()) else None for t in parameters]
    points = tuple(
        Point(
            draw(numbers),
            draw(numbers),
            t,
            draw(vectors),
            draw(vectors),
            jerk=draw(vectors),
            jerk_after=draw(vectors),
        )
        for t in parameters
    )
    return Curve(
        draw(names),
        draw(st.sampled_from(FAMILIES)),
        rule,
        points,
        draw(st.sampled_from(VelocityRule)),
        draw(st.sampled_from(AccelerationRule)),
        draw(st.sampled_from(JerkRule)),
    )


documents = st.lists(curves(), min_size=1, max_size=3).map(lambda found: Document(tuple(found)))


def bits(document):
    """Every float of the document as its eight bytes: equality that tells -0.0 from 0.0."""
    found = []

    def visit(value):
        if isinstance(value, float):
            found.append(struct.pack("<d", value))
        elif isinstance(value, dict | list | tuple):
            for item in value.values() if isinstance(value, dict) else value:
                visit(item)

    visit(msgspec.to_builtins(document, enc_hook=str))
    return found


@given(documents)
def test_round_trip_keeps_every_value_bit_for_bit(document):
    data = encode(document)
    again = decode(data)
    assert again == document
    assert bits(again) == bits(document)
    assert encode(again) == data


@each_row("value", [0.1, 1 / 3, 5e-324, -0.0, 1e12, math.pi * 1e-300, 123456789012.34567])
def test_awkward_floats_survive(value):
    document = Document((make_curve([(value, -value)]),))
    assert bits(decode(encode(document))) == bits(document)


def test_numpy_floats_are_floats():
    document = Document((Curve("", LAGRANGE, Parametrization(), (Point(np.float64(0.1), 0.0),)),))
    assert decode(encode(document)).curves[0].points[0].x == 0.1


@pytest.mark.parametrize("count", [0, 1])
def test_a_curve_with_one_or_no_point_survives(count):
    document = Document((make_curve([(1.0, 2.0)] * count),))
    assert decode(encode(document)) == document


def test_a_file_has_one_line_per_member_and_point():
    curve = make_curve([(0, 1), (0.5, 2)], name="Größe ‖c′‖", family=HERMITE)
    assert encode(Document((curve,))).decode() == (
        "{\n"
        '  "format": "curvebench",\n'
        '  "version": 4,\n'
        '  "curves": [\n'
        "    {\n"
        '      "name": "Größe ‖c′‖",\n'
        '      "family": "hermite",\n'
        '      "parametrization": {"kind": "chord_length", "alpha": 0.5, "start": 0.0, "end": 1.0},\n'
        '      "points": [\n'
        '        {"x": 0.0, "y": 1.0},\n'
        '        {"x": 0.5, "y": 2.0}\n'
        "      ]\n"
        "    }\n"
        "  ]\n"
        "}\n"
    )


def test_only_explicit_jerks_are_written():
    points = (Point(0.0, 1.0), Point(2.0, 3.0, jerk=(4.0, 5.0)))
    curve = Curve("J", FAMILIES.named("septic_hermite"), Parametrization(), points)
    text = encode(Document((curve,))).decode()
    assert '{"x": 2.0, "y": 3.0, "jerk": [4.0, 5.0]}' in text
    assert '{"x": 0.0, "y": 1.0}' in text
    assert "jerk_rule" not in text
    changed = msgspec.structs.replace(curve, jerk_rule=JerkRule.ZERO)
    assert '"jerk_rule": "zero"' in encode(Document((changed,))).decode()


@pytest.mark.parametrize("each", DERIVATIVES)
def test_derivatives_match_the_fields_of_points_and_curves(each):
    assert {each.name, each.after} <= set(Point.__struct_fields__)
    assert type(getattr(make_curve(()), each.rule_field)) is each.rules
    of_derivatives = {name for each in DERIVATIVES for name in (each.name, each.after)}
    assert set(Point.__struct_fields__) - of_derivatives == {"x", "y", "t", "corner", "tied", "even"}


@each_row(
    ("point", "message"),
    [
        (Point(math.nan, 0.0), "curves[0].points[0].x must lie between -1e12 and 1e12, not nan"),
        (Point(0.0, -math.inf), "curves[0].points[0].y must lie between -1e12 and 1e12, not -inf"),
        (Point(0.0, 0.0, velocity=(0.0, math.nan)), "curves[0].points[0].velocity[1] must lie between"),
        (Point(0.0, 0.0, acceleration=(2e12, 0.0)), "curves[0].points[0].acceleration[0] must lie between"),
        (Point(0.0, 0.0, jerk=(0.0, -2e12)), "curves[0].points[0].jerk[1] must lie between"),
        (Point(0.0, 0.0, jerk_after=(math.inf, 0.0)), "curves[0].points[0].jerk_after[0] must lie between"),
        (Point(True, 0.0), "curves[0].points[0].x must be a number, not True"),
        (Point(10**5000, 0.0), "curves[0].points[0].x must lie between -1e12 and 1e12, not a larger one"),
    ],
)
def test_encode_refuses_documents_that_decode_refuses(point, message):
    document = Document((Curve("", LAGRANGE, Parametrization(), (point,)),))
    with pytest.raises(FormatError) as refusal:
        encode(document)
    assert str(refusal.value).startswith(message)


def test_a_name_that_is_no_text_is_refused():
    with pytest.raises(FormatError, match=r"curves\[0\]\.name contains a character"):
        validate(Document((make_curve((), name="\ud800"),)))


def good():
    """A small good file as plain values, to be spoiled."""
    points = [{"x": float(i), "y": 0.0, "t": i / 4} for i in range(4)]
    rule = {"kind": "manual", "alpha": 0.5, "start": 0.0, "end": 1.0}
    curve = {"name": "a", "family": "hermite", "parametrization": rule, "points": points}
    return {"format": "curvebench", "version": 4, "curves": [curve]}


def spoiled(path, value):
    """The good file with the value at `path` replaced, or removed where `value` is `...`."""
    content = good()
    *where, key = path
    target = content
    for step in where:
        target = target[step]
    if value is ...:
        del target[key]
    else:
        target[key] = value
    return json.dumps(content).encode()


POINT = ("curves", 0, "points", 3)
RULE = ("curves", 0, "parametrization")

REFUSED_VALUES = [
    (("format",), ..., "format is missing"),
    (("format",), "svg", 'it is not a Curvebench document; format must be "curvebench", not "svg"'),
    (("format",), 7, "format must be text, not a whole number"),
    (("version",), ..., "version is missing"),
    (
        ("version",),
        7,
        "it was written by a newer version of Curvebench (format version 7; this program reads 4)",
    ),
    (("version",), 0, "version must be 4, not 0"),
    (("version",), 10**400, "version must be 4, not a number of many digits"),
    (("version",), True, "version must be a whole number, not true or false"),
    (("version",), "1", "version must be a whole number, not text"),
    (("curves",), ..., "curves is missing"),
    (("curves",), [], "curves must hold at least one curve"),
    (("curves",), {}, "curves must be a list, not an object {…}"),
    (("curves", 0), 3, "curves[0] must be an object {…}, not a whole number"),
    (("surprise",), 1, 'the file has a key that this version does not know: "surprise"'),
    (("x" * 90,), 1, f'the file has a key that this version does not know: "{"x" * 40}…"'),
    ((*POINT, "z"), 1.0, 'curves[0].points[3] has a key that this version does not know: "z"'),
    (("curves", 0, "name"), 5, "curves[0].name must be text, not a whole number"),
    (("curves", 0, "name"), ..., "curves[0].name is missing"),
    (
        ("curves", 0, "family"),
        "Bézier curve",
        'curves[0].family is not a value that this version knows: "Bézier curve"',
    ),
    (
        ("curves", 0, "family"),
        "x" * 41,
        f'curves[0].family is not a value that this version knows: "{"x" * 40}…"',
    ),
    (("curves", 0, "family"), 3, "curves[0].family must be text, not a whole number"),
    (("curves", 0, "family"), None, "curves[0].family must be text, not null"),
    ((*RULE, "kind"), 3, "curves[0].parametrization.kind must be text, not a whole number"),
    ((*RULE, "alpha"), 1.5, "curves[0].parametrization.alpha must lie between 0 and 1, not 1.5"),
    ((*RULE, "alpha"), -0.1, "curves[0].parametrization.alpha must lie between 0 and 1, not -0.1"),
    ((*RULE, "start"), 1.0, "curves[0].parametrization.end must be greater than 1.0, the start, not 1.0"),
    (
        (*RULE, "end"),
        2e12,
        "curves[0].parametrization.end must lie between -1e12 and 1e12, not 2000000000000.0",
    ),
    ((*POINT, "x"), ..., "curves[0].points[3].x is missing"),
    ((*POINT, "x"), "3", "curves[0].points[3].x must be a number, not text"),
    ((*POINT, "x"), True, "curves[0].points[3].x must be a number, not true or false"),
    ((*POINT, "x"), None, "curves[0].points[3].x must be a number, not null"),
    ((*POINT, "x"), [1.0], "curves[0].points[3].x must be a number, not a list"),
    ((*POINT, "y"), 1.1e12, "curves[0].points[3].y must lie between -1e12 and 1e12, not 1100000000000.0"),
    ((*POINT, "velocity"), [1.0], "curves[0].points[3].velocity must be a list of 2 numbers"),
    ((*POINT, "velocity"), [1.0, 2.0, 3.0], "curves[0].points[3].velocity must be a list of 2 numbers"),
    ((*POINT, "velocity"), [1.0, "2"], "curves[0].points[3].velocity[1] must be a number, not text"),
    ((*POINT, "acceleration"), 1.0, "curves[0].points[3].acceleration must be a list or null, not a number"),
    ((*POINT, "jerk"), "1", "curves[0].points[3].jerk must be a list or null, not text"),
    (
        (*POINT, "jerk"),
        [1.0, 2e12],
        "curves[0].points[3].jerk[1] must lie between -1e12 and 1e12, not 2000000000000.0",
    ),
    ((*POINT, "jerk_after"), [1.0], "curves[0].points[3].jerk_after must be a list of 2 numbers"),
    (
        ("curves", 0, "jerk_rule"),
        "bessel",
        'curves[0].jerk_rule is not a value that this version knows: "bessel"',
    ),
    (
        (*POINT, "t"),
        0.5,
        "curves[0].points[3].t must be greater than 0.5, the t of the point before it, not 0.5",
    ),
    (
        (*POINT, "t"),
        ...,
        'curves[0].points[3].t is missing; under "manual" every point needs a parameter',
    ),
]


@each_row(("path", "value", "message"), REFUSED_VALUES)
def test_wrong_values_are_refused_with_their_fields(path, value, message):
    with pytest.raises(FormatError) as refusal:
        decode(spoiled(path, value))
    assert str(refusal.value) == message


def test_stored_parameters_must_increase():
    content = good()
    content["curves"][0]["parametrization"]["kind"] = "uniform"
    points = content["curves"][0]["points"]
    del points[1]["t"]
    points[2]["t"] = points[0]["t"]
    with pytest.raises(FormatError) as refusal:
        decode(json.dumps(content).encode())
    assert str(refusal.value) == (
        "curves[0].points[2].t must be greater than 0.0, the t of points[0], not 0.0"
    )


def with_number(text):
    """The good file with the text of one number replaced."""
    return json.dumps(good()).replace('"x": 3.0', f'"x": {text}').encode()


REFUSED_TEXTS = [
    (b"", "the file is empty"),
    (b" \n", "the file is empty"),
    (b"\x00" * 8, "it is not JSON; line 1, column 1: invalid character"),
    (b"\xef\xbb\xbf{}", "the file starts with a byte order mark; save it as UTF-8 without one"),
    (
        b"%PDF-1.5\n%\xb5\xed",
        "it is a PDF, which Curvebench cannot read; open it in Inkscape and save it as SVG",
    ),
    (b"%!PS-Adobe-3.0 EPSF-3.0\n", "it is PostScript, which Curvebench cannot read; open it in Inkscape"),
    (b'{"format":\n "\xc3\xa4\xff"}', "it is not UTF-8 text; line 2, column 4"),
    (b'{\n  "format": xx\n}', "it is not JSON; line 2, column 13: invalid character"),
    (b"[]", "the file must be an object {…}, not a list"),
    (b'{"format": "curvebench", "version": 4, "curves": [', "it is not JSON; the file ends too early"),
    (json.dumps(good()).encode() + b"\x00", "it is not JSON; line 1, column "),
    (json.dumps(good()).encode() + b"{}", "it is not JSON; line 1, column "),
    (with_number("NaN"), "it is not JSON; line 1, column "),
    (with_number("Infinity"), "it is not JSON; line 1, column "),
    (with_number("1e999"), "curves[0].points[3].x must lie between -1e12 and 1e12"),
    (with_number("1e308"), "curves[0].points[3].x must lie between -1e12 and 1e12, not 1e+308"),
    (with_number("1" * 10**6), "curves[0].points[3].x must lie between -1e12 and 1e12"),
    (with_number("01"), "it is not JSON; line 1, column "),
    (with_number("[" * 10**5), "it is not a Curvebench document; it is nested too deeply"),
    (with_number('1, "x": 2'), "curves[0].points[3].x appears twice; each key may appear only once"),
    (
        b'{"format": "curvebench", "version": ' + b"1" * 10**6 + b"}",
        "version must lie between -1e12 and 1e12",
    ),
    (b'{"q": ' + b"[" * 10**5, "it is not a Curvebench document; it is nested too deeply"),
    (
        json.dumps(good()).replace('"version": 4', '"version": 4, "version": 4').encode(),
        "version appears twice; each key may appear only once",
    ),
]


@each_row(("data", "message"), REFUSED_TEXTS, ids=range(len(REFUSED_TEXTS)))
def test_bad_text_is_refused(data, message):
    with pytest.raises(FormatError) as refusal:
        decode(data)
    assert str(refusal.value).startswith(message)


def test_every_truncation_is_refused():
    whole = encode(decode(json.dumps(good()).encode())).rstrip()
    for length in range(len(whole)):
        with pytest.raises(FormatError):
            decode(whole[:length])


@given(st.binary(max_size=60))
def test_random_bytes_are_refused_with_format_errors(data):
    with pytest.raises(FormatError):
        decode(data)


@given(st.integers(0, 10**6), st.binary(min_size=1, max_size=4))
def test_a_damaged_file_is_read_or_refused(position, damage):
    data = encode(empty_document())
    position %= len(data)
    damaged = data[:position] + damage + data[position + len(damage) :]
    with contextlib.suppress(FormatError):
        validate(decode(damaged))


def test_the_decoder_works_after_a_recursion_error():
    with pytest.raises(FormatError):
        decode(b"[" * 10**5)
    assert decode(encode(empty_document())) == empty_document()


def test_the_written_version_and_marker_are_read():
    content = json.loads(encode(empty_document()))
    assert content["format"] == file_format.FORMAT
    assert content["version"] == file_format.VERSION


def test_fields_of_a_value_are_looked_up_once_for_all_curves():
    """msgspec reads the annotations anew whenever it is asked: two seconds for five thousand curves."""
    curves = Document(tuple(make_curve([(i, 0), (i, 1)], name=str(i), family=HERMITE) for i in range(100)))
    encode(curves)
    assert calls_of(lambda: encode(curves)) < 400 * 100
