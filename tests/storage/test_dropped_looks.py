"""What files of version 2 said of looks that curves do not have: dropped, counted and told."""

from __future__ import annotations

import json

import pytest

from app.document.style import Style
from app.storage.format import decode_counting
from app.storage.format_error import FormatError

MASK = {
    "tile": {"body": "<rect width='1' height='1'/>", "view": [0.0, 0.0, 1.0, 1.0]},
    "start": [0.0, 0.0],
    "end": [1.0, 0.0],
    "side": [0.0, 1.0],
}


def older(*styles, **more):
    """The content of a file of version 2 whose curves have these styles, and all of them `more`."""
    points = [{"x": 0.0, "y": 0.0}, {"x": 1.0, "y": 1.0}]
    rules = {"family": "lagrange", "parametrization": {"kind": "uniform"}, "points": points}
    curves = [
        {"name": f"Curve {at}", **rules, "style": style, **more} for at, style in enumerate(styles, start=1)
    ]
    return json.dumps({"format": "curvebench", "version": 2, "curves": curves}).encode()


@pytest.mark.parametrize(
    ("styles", "words"),
    [
        ([{"start_marker": "dot", "end_marker": "arrow"}, {"end_marker": "bar"}], "3 arrowheads"),
        ([{"blur": 0.5}, {"blur": 2.0}], "2 blurs"),
        ([{"masks": [MASK, MASK]}, {"masks": [MASK | {"is_alpha": True}]}], "2 masks"),
        ([{"clips": [{}]}, {"clips": [{}]}], "1 clip"),
        ([{"paint_order": "stroke"}], "1 order of fill and line"),
        ([{"paint_order": "stroke"}] * 2, "2 orders of fill and line"),
    ],
)
def test_what_changes_how_it_looks_is_counted(styles, words):
    found = decode_counting(older(*styles))
    assert found.left_out.words == (words,)
    assert {each.style for each in found.document.curves} == {Style()}


def test_what_changes_nothing_is_not_counted():
    assert not decode_counting(
        older({"start_marker": "none", "paint_order": "normal", "blur": 0.0, "masks": [], "clips": []})
    ).left_out


def test_the_opacities_of_a_curve_and_of_its_groups_are_those_of_stroke_and_fill():
    looks = [{"name": "Outer", "opacity": 0.5}, {"name": "Inner"}]
    styles = {"opacity": 0.5, "fill_opacity": 0.25}, {}
    found = decode_counting(older(*styles, groups=["Outer", "Inner"], group_looks=looks))
    opacities = [(each.style.stroke_opacity, each.style.fill_opacity) for each in found.document.curves]
    assert opacities == [(0.25, 0.0625), (0.5, 0.5)]
    assert found.left_out.words == ("1 opacity of a group",)


@pytest.mark.parametrize("opacity", [1.5, -1, "half"])
def test_an_opacity_that_is_none_is_refused(opacity):
    with pytest.raises(FormatError, match=r"curves\[0\]\.style\.stroke_opacity must"):
        decode_counting(older({"opacity": opacity}))
