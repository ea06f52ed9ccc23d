"""Neighbouring curves that are drawn as one."""

from __future__ import annotations

from msgspec.structs import replace

from app.document.groups import expand_to_shapes, shape_of, shape_problem, shape_ranges, tidy_shapes
from app.document.model import Document, make_curve
from app.document.several_curves import set_appearance
from app.document.style import Style


def document(*names, **values):
    """Curves of shapes with these names, empty for none."""
    return Document(
        tuple(
            replace(make_curve([(i, 0.0), (i + 1.0, 1.0)], name=f"c{i}"), shape=name, **values)
            for i, name in enumerate(names)
        )
    )


def test_a_shape_is_a_run_of_neighbours_of_one_name():
    some = document("", "a", "a", "b", "b", "b", "")
    assert [list(each) for each in shape_ranges(some.curves)] == [[0], [1, 2], [3, 4, 5], [6]]
    assert shape_of(some, 4) == range(3, 6)
    assert expand_to_shapes(some, {0, 2, 3}) == {0, 1, 2, 3, 4, 5}
    assert tidy_shapes(some) is some
    assert shape_problem(some) == ""


def test_a_shape_of_one_curve_is_dissolved():
    assert [curve.shape for curve in tidy_shapes(document("a", "b", "b")).curves] == ["", "b", "b"]
    assert "curves[0].shape must name two or more" in shape_problem(document("a", "b", "b"))


def test_a_torn_shape_becomes_two():
    some = document("a", "a", "", "a", "a", "a 2", "a 2")
    assert [curve.shape for curve in tidy_shapes(some).curves] == [
        "a",
        "a",
        "",
        "a 2",
        "a 2",
        "a 2 2",
        "a 2 2",
    ]
    assert shape_problem(some).startswith("curves[3].shape must name")


def test_the_first_curve_decides_the_style_of_a_shape():
    some = document("a", "a", "a")
    torn = some.with_curve(1, replace(some.curves[1], style=Style(fill="#ff0000"), locked=True))
    assert (
        shape_problem(torn)
        == "curves[1].style must equal that of the curve before it, which belongs to the same shape"
    )
    assert tidy_shapes(torn) == some


def test_appearance_is_set_for_whole_shapes():
    some = set_appearance(document("", "a", "a"), {2}, visible=False, colour="#0072b2")
    assert [(curve.visible, curve.style.stroke) for curve in some.curves] == [
        (True, ""),
        (False, "#0072b2"),
        (False, "#0072b2"),
    ]
