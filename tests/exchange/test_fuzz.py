"""Fuzz: whatever the bytes, a reader gives curves or its one kind of refusal."""

from __future__ import annotations

import io

import ezdxf
import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from app.document.model import Document, make_curve
from app.exchange.errors import ExchangeError
from app.exchange.formats.dxf import dxf_text, read_dxf
from app.exchange.formats.godot import read_curves
from app.exchange.formats.gpx import read_gpx
from app.exchange.formats.json_tables import read_json
from app.exchange.formats.robot_paths import read_pathplanner, read_pathweaver, read_trajectories
from app.exchange.formats.tables import points_table, read_array, sampled_table
from app.exchange.options import Options
from app.exchange.svg.reader import read_svg
from app.exchange.svg.shapes import read_path_data
from app.exchange.svg.writer import svg_of
from app.families import HERMITE, QUINTIC_HERMITE
from app.storage.format import decode, encode
from app.storage.format_error import FormatError
from app.storage.validation import validate
from tests.tables import document_of_table, read_table
from tests.texts import texts

POINTS = [(0.0, 0.0), (1.0, 2.5), (3.0, -1.0), (4.0, 4.0)]
SKETCH = Document((make_curve(POINTS, name="Kurve α", family=HERMITE),))
PAIR = Document((*SKETCH.curves, make_curve(POINTS[:3], name="=B", family=QUINTIC_HERMITE)))

SHAPES = (
    b'<svg xmlns="http://www.w3.org/2000/svg"><g transform="rotate(30 1 2) scale(2)" stroke="#f00">'
    b'<path id="a" d="M0 0C1 2 3 4 5 6S7 8 9 1Q2 3 4 5T6 7A3 2 30 1 0 8 9H4V2Z m1 1 2 2"/><circle r="3"/>'
    b'<rect x="1" y="2" width="3" height="4" rx="1"/><use href="#a" x="3"/><polygon points="0,0 1,1 2,0"/>'
    b"</g></svg>"
)
STYLED = (
    b'<svg xmlns="http://www.w3.org/2000/svg" width="70mm" height="2in" viewBox="0 0 140 100" '
    b'preserveAspectRatio="xMinYMid slice"><style>.a,g>.b{fill:hsl(38,92%,50%);stroke:#0af!important}</style>'
    b'<linearGradient id="g"><stop stop-color="red" stop-opacity=".5"/></linearGradient><clipPath id="c">'
    b'<rect width="9" height="9"/></clipPath><symbol id="s" viewBox="0 0 9 9"><path class="a" d="M0 0L9 9z'
    b'm1 1h4v4z"/></symbol><g id="G" opacity=".5" clip-path="url(#c)" style="stroke-width:2mm;'
    b'stroke-dasharray:4 1,2;stroke-dashoffset:3;stroke-miterlimit:7"><use href="#s" x="5%" width="40"/>'
    b'<path class="b" fill="url(#g) lime" d="M0 0C1 2 3 4 5 6" transform="scale(1 3)"/>'
    b"<text>hi</text></g></svg>"
)


def _shapes_as_dxf() -> bytes:
    drawing = ezdxf.new("R12")
    space = drawing.modelspace()
    space.add_line((0, 0), (1, 2))
    space.add_circle((1, 1), 2)
    space.add_arc((1, 1), 2, 10, 200)
    space.add_polyline2d([(0, 0, 0.5), (1, 1, 0), (2, 0, -1)], format="xyb")
    stream = io.StringIO()
    drawing.write(stream)
    return stream.getvalue().encode()


def _spline_as_dxf() -> bytes:
    # The entities alone: the tables of a whole file would take most of the blows.
    text = dxf_text(SKETCH).text
    start = text.index("  2\nENTITIES")
    end = text.index("ENDSEC", start)
    return f"  0\nSECTION\n{text[start:end]}ENDSEC\n  0\nEOF\n".encode()


def _npy(array) -> bytes:
    stream = io.BytesIO()
    np.save(stream, array)
    return stream.getvalue()


def _table(data: bytes) -> Document:
    return document_of_table(read_table(data)).document


READERS = {
    "document": (decode, [encode(SKETCH)]),
    "table": (
        _table,
        [
            sampled_table(SKETCH, Options(format_options={"samples": 5})).data,
            points_table(PAIR).data,
            b"x;y\n1,5;2\n3,25;4e3\n",
            b'"a" 1 2\n',
            b"NACA 1\n 2. 2.\n\n0 0\n1 1\n\n0 0\n1 -1\n",
            b",time,x\n-,s,m\n0,1,2\n1,2,nan\n\n2,3,4\n",
        ],
    ),
    "array": (
        lambda data: document_of_table(read_array(data)).document,
        [_npy(np.array(POINTS)), _npy(np.array([(1, 2.0), (3, 4.0)], dtype=[("x", "i2"), ("y", ">f8")]))],
    ),
    "json": (
        lambda data: document_of_table(read_json(data)).document,
        [
            b"[[0, 1], [2, 3], [null, 4], [5, 6.5e3]]",
            b'[{"x": 1, "y": 2, "n": "a"}, {"x": 2, "y": 3}]',
            b'{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"name":"a"},'
            b'"geometry":{"type":"MultiLineString","coordinates":[[[9,53],[10,54]],[[1,2],[3,4]]]}}]}',
        ],
    ),
    "pathweaver": (
        lambda data: document_of_table(read_pathweaver(data)).document,
        [
            b"X,Y,Tangent X,Tangent Y,Fixed Theta,Reversed,Name\n1,2,2,0,true,false,\n4,3,-1,1,true,true,a\n"
            b"6,6,0,2,,true,\n"
        ],
    ),
    "choreo": (
        lambda data: document_of_table(read_trajectories(data)).document,
        [
            b'{"name":"a","trajectory":{"samples":[{"t":0,"x":0,"y":1,"vx":1,"vy":0},{"t":1,"x":2,"y":1,"heading":1,'
            b'"vl":1,"vr":2}]}}',
            b'{"paths":{"a":{"trajectory":[{"timestamp":0,"x":0,"y":1,"velocityX":1,"velocityY":0},{"timestamp":1,'
            b'"x":1,"y":1,"velocityX":1,"velocityY":0}]}}}',
        ],
    ),
    "pathplanner": (
        lambda data: read_pathplanner(data).document,
        [
            b'{"waypoints":[{"anchor":{"x":0,"y":0},"prevControl":null,"nextControl":{"x":1,"y":2}},{"anchor":{"x":3,'
            b'"y":0},"prevControl":{"x":2,"y":1},"nextControl":null}],"eventMarkers":[{}]}'
        ],
    ),
    "godot": (
        lambda data: read_curves(data).document,
        [
            b'[gd_scene]\n[sub_resource type="Curve2D" id="a"]\n_data = {\n"points": PackedVector2Array('
            b'0, 0, 1, 2, 0, 0, -1, 3, 0, 0, 5, 1)\n}\n[node name="P"]\ncurve = SubResource("a")\n'
        ],
    ),
    "gpx": (
        lambda data: document_of_table(read_gpx(data)).document,
        [
            b'<gpx><trk><trkseg><trkpt lat="47.6" lon="-122.3"><time>2009-10-17T18:37:26Z</time>'
            b'</trkpt><trkpt lat="47.7" lon="-122.2"><time>2009-10-17T18:37:31Z</time></trkpt></trkseg></trk>'
            b"</gpx>"
        ],
    ),
    "svg": (lambda data: read_svg(data).document, [svg_of(SKETCH).data, SHAPES, STYLED]),
    "dxf": (lambda data: read_dxf(data).document, [_spline_as_dxf(), _shapes_as_dxf()]),
}

SPLICES = st.sampled_from(
    [b"", b"\0", b"nan", b"1e999", b"-", b"e", b",", b"\n", b"<", b">", b'"', b"&a;", b"{", b"]", b"\xff",
     b"=", b"%", b"(", b"url(#s)", b"9" * 400,
     b"M", b"A", b"Z", b"  0\nLINE\n", b"-1", b"0", b"1e-320", b"\xe2\x80\xa8", b"#", b";"]
)  # fmt: skip


@st.composite
def mutated(draw, seeds):
    """A good file with a few bytes cut out, doubled or replaced."""
    data = draw(st.sampled_from(seeds))
    for _ in range(draw(st.integers(1, 3))):
        start = draw(st.integers(0, len(data)))
        end = min(len(data), start + draw(st.sampled_from([0, 1, 1, 2, 5, 40, 400])))
        data = data[:start] + draw(SPLICES) + data[end:]
    return data


def read(name, data):
    """Read, and hold the reader to its word."""
    reader, _ = READERS[name]
    try:
        document = reader(data)
    except (ExchangeError, FormatError) as refusal:
        said = str(refusal)
    else:
        validate(document)
        said = "a document"
    assert said
    assert "\n" not in said


@pytest.mark.parametrize("name", READERS)
@settings(max_examples=60, suppress_health_check=list(HealthCheck))
@given(data=st.binary(max_size=200))
@example(data=b"")
@example(data=b"\xff\xfe")
@example(data=b"\xff\xfe1")
@example(data=b"<?xml version='1.0' encoding='utf-16'?><svg/>")
def test_any_bytes(name, data):
    read(name, data)


@pytest.mark.parametrize("name", READERS)
@settings(max_examples=150, suppress_health_check=list(HealthCheck))
@given(data=st.data())
def test_good_files_with_a_flaw(name, data):
    read(name, data.draw(mutated(READERS[name][1])))


@settings(max_examples=150)
@given(text=texts(40, "MmLlHhVvCcSsQqTtAaZz0123456789.-+eE, \n\té"))
def test_any_path_data(text):
    for subpath in read_path_data(f"M1 2{text}").subpaths:
        for before, after in zip(subpath.controls, subpath.controls[1:], strict=False):
            assert (before[3] == after[0]).all()
