"""Style, shapes, groups, unit, grid, guides and export in files; a colour of version 1."""

from __future__ import annotations

import json

import pytest
from msgspec.structs import replace

from app.document.model import Axis, Document, Export, Guide, make_curve
from app.document.style import FillRule, LineCap, LineJoin, Style
from app.storage.format import decode, encode
from app.storage.format_error import FormatError
from tests.rows import each_row

STYLE = Style(
    stroke="#0072b2",
    width=0.1 + 0.2,
    cap=LineCap.BUTT,
    join=LineJoin.MITER,
    miter_limit=3.0,
    dash=(3.0, 1.0 / 3.0),
    dash_offset=-0.5,
    stroke_opacity=0.25,
    fill="none",
    fill_rule=FillRule.EVENODD,
    fill_opacity=0.5,
)


def shape(**values):
    """Two curves of one shape."""
    parts = [
        replace(
            make_curve([(0.0, 0.0), (1.0, 1.0)], name=name), shape="R", groups=("Logo", "Letter"), style=STYLE
        )
        for name in ("outer", "inner")
    ]
    return Document(tuple(parts), **values)


def test_styles_shapes_and_groups_survive_saving():
    some = shape(
        unit="mm",
        grid_spacing=0.1,
        guides=(Guide(Axis.X, 1 / 3), Guide(Axis.Y, -2.0)),
        export=Export(".png", "logo.png", (("dpi", "600"), ("transparent", "false"))),
    )
    assert decode(encode(some)) == some


def test_computed_defaults_are_omitted():
    plain = make_curve([(0.0, 0.0), (1.0, 1.0)])
    computed = replace(plain, style=Style(fill_opacity=float("1"), miter_limit=float("4")))
    written = encode(Document((computed,), grid_spacing=float("0")))
    assert written == encode(Document((plain,)))
    assert json.loads(written)["curves"][0].keys() == {"name", "family", "parametrization", "points"}


def test_a_colour_of_version_1_becomes_the_stroke():
    rule = {"kind": "chord_length", "alpha": 0.5, "start": 0.0, "end": 1.0}
    points = [{"x": 0.0, "y": 0.0}, {"x": 1.0, "y": 1.0}]
    curves = [
        {"name": name, "family": "lagrange", "parametrization": rule, "points": points, **more}
        for name, more in (("a", {"colour": "#0072b2"}), ("b", {}))
    ]
    found = decode(json.dumps({"format": "curvebench", "version": 1, "curves": curves}).encode())
    assert [curve.style for curve in found.curves] == [Style(stroke="#0072b2"), Style()]
    assert json.loads(encode(found))["version"] == 4


@each_row(
    ("changed", "complaint"),
    [
        ({"stroke": "red"}, '.stroke must be written as "#rrggbb" in lower case, or "none", not "red"'),
        ({"fill": "#FFFFFF"}, '.fill must be written as "#rrggbb" in lower case, or "none", not "#FFFFFF"'),
        ({"width": -1.0}, ".width must be 0 or greater, not -1.0"),
        ({"stroke_opacity": 1.5}, ".stroke_opacity must lie between 0 and 1, not 1.5"),
        ({"fill_opacity": -0.5}, ".fill_opacity must lie between 0 and 1, not -0.5"),
        ({"miter_limit": 0.5}, ".miter_limit must be 1 or greater, not 0.5"),
        ({"dash": (1.0, -1.0)}, ".dash[1] must be 0 or greater, not -1.0"),
        ({"dash": (0.0, 0.0)}, ".dash must hold a number greater than 0"),
        ({"dash": (1.0,) * 65}, ".dash must hold at most 64 numbers, not 65"),
        ({"dash_offset": 1e13}, ".dash_offset must lie between"),
    ],
)
def test_an_invalid_style_is_refused_with_its_field(changed, complaint):
    curve = replace(make_curve([(0.0, 0.0), (1.0, 1.0)]), style=replace(Style(), **changed))
    with pytest.raises(FormatError) as refusal:
        encode(Document((curve,)))
    assert str(refusal.value).startswith(f"curves[0].style{complaint}")


@each_row(
    ("values", "complaint"),
    [
        ({"unit": "a" * 13}, "unit must be a name of at most 12 characters"),
        ({"grid_spacing": -1.0}, "grid_spacing must be 0 or greater, not -1.0"),
        ({"guides": (Guide(Axis.X, float("nan")),)}, "guides[0].position must lie between"),
        ({"export": Export(".png", "../a.png")}, "export.name must be the name of a file without its folder"),
        ({"export": Export(".png", "a\\b.png")}, "export.name must be the name of a file without its folder"),
        ({"export": Export(".png", "a" * 256)}, "export.name must be the name of a file without its folder"),
        ({"export": Export(".p\n")}, "export.ending must be the end of a name"),
        ({"export": Export(".png", "", (("a", "1"),) * 65)}, "export.options must be at most 64, not 65"),
        ({"export": Export(".png", "", (("dpi", "9" * 1001),))}, "export.options[0] must be printable texts"),
        ({"export": Export(".png", "", (("dpi", "\0"),))}, "export.options[0] must be printable texts"),
    ],
)
def test_an_invalid_plane_is_refused_with_its_field(values, complaint):
    with pytest.raises(FormatError) as refusal:
        encode(shape(**values))
    assert str(refusal.value).startswith(complaint)


def test_an_inconsistent_shape_is_refused():
    torn = shape()
    torn = torn.with_curve(1, replace(torn.curves[1], shape="S"))
    with pytest.raises(FormatError, match=r"curves\[0\]\.shape must name two or more curves"):
        encode(torn)


@each_row(
    ("values", "complaint"),
    [
        ({"shape": "\ud800"}, "curves[0].shape contains a character that UTF-8 cannot encode"),
        (
            {"groups": ("Letters", "\ud800")},
            "curves[0].groups[1] contains a character that UTF-8 cannot encode",
        ),
        ({"groups": ("",)}, "curves[0].groups must name 50 groups at most"),
        ({"groups": tuple(map(str, range(51)))}, "curves[0].groups must name 50 groups at most"),
    ],
)
def test_invalid_names_of_shapes_and_groups_are_refused(values, complaint):
    curves = tuple(replace(make_curve([(0, k), (1, k)], name=f"{k}"), **values) for k in range(2))
    with pytest.raises(FormatError) as refusal:
        encode(Document(curves))
    assert str(refusal.value).startswith(complaint)


def test_a_torn_group_is_refused():
    curves = [make_curve([(0, k), (1, k)], name=f"{k}") for k in range(3)]
    torn = (replace(curves[0], groups=("G",)), curves[1], replace(curves[2], groups=("G",)))
    with pytest.raises(FormatError, match=r"curves\[2\]\.groups must name .* curves that follow each other"):
        encode(Document(torn))
