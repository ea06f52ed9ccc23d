"""Split at Intersections with real events; cuts and shapes by exact arithmetic."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from msgspec.structs import replace

from app.document.model import Document, Parametrization, ParametrizationKind, Point, make_curve
from app.document.style import Style
from app.families import FAMILIES, HERMITE
from tests.exact_pieces import at, pieces_of, value

RED = Style(stroke="#d55e00")


def hermite(name, *jets, closed=False, end=1.0, **fields):
    """A cubic curve with manual parameters from 0: at each point x, y, vx, vy and t."""
    points = tuple(Point(x, y, velocity=(vx, vy), t=t) for x, y, vx, vy, t in jets)
    rule = Parametrization(ParametrizationKind.MANUAL, end=end)
    curve = replace(make_curve([(0, 0), (1, 1)], family=HERMITE, name=name), parametrization=rule)
    return replace(curve, points=points, closed=closed, **fields)


def line(name, start, end, **fields):
    vector = (end[0] - start[0], end[1] - start[1])
    return hermite(name, (*start, *vector, 0.0), (*end, *vector, 1.0), **fields)


def cubic(name="Cubic", **fields):
    """The curve y = x³ − x for x from −2 to 2: it meets y = 0 at t = 1/4, 1/2 and 3/4."""
    return hermite(name, (-2.0, -6.0, 4.0, 44.0, 0.0), (2.0, 6.0, 4.0, 44.0, 1.0), **fields)


def circle(name, x, y=0.0):
    """Something round of four cubic pieces around (x, y)."""
    k = 2 * math.pi * 1.0
    jets = [(x + 1, y, 0, k, 0.0), (x, y + 1, -k, 0, 0.25), (x - 1, y, 0, -k, 0.5), (x, y - 1, k, 0, 0.75)]
    return hermite(
        name, *((float(a), float(b), float(c), float(d), t) for a, b, c, d, t in jets), closed=True
    )


def begin(editor, *curves, whole=True):
    editor.session.commit(Document(curves), "Begin", active=0)
    editor.fit()
    if whole:
        editor.session.selected.select_whole(range(len(curves)))
        editor.settle()
    return editor


def split(editor):
    """Split, and return the curves by their names."""
    editor.trigger("splitAtIntersections")
    return {curve.name: curve for curve in editor.session.document.curves}


def ends(curve):
    return curve.points[0].position, curve.points[-1].position


def is_part_of(pieces, view):
    """Whether a curve is a stretch of exact pieces, within a rounding, a third within each of its own."""
    rounding = Fraction(1, 10**14)
    first, last = pieces[0][0], pieces[-1][1]
    for start, end, points in pieces_of(view):
        t = start + (end - start) / 3
        # Parts of a closed curve go on beyond its end.
        was = at(pieces, t - (last - first) if t > last else t)
        if any(abs(a - b) > rounding for a, b in zip(value(points, Fraction(1, 3)), was, strict=True)):
            return False
    return True


def test_the_menu_of_whole_curves_splits_both_at_all_of_their_crossings(editor):
    begin(editor, cubic(style=RED, groups=("G",)), line("Line", (-2.0, 0.0), (2.0, 0.0), groups=("G",)))
    document = editor.session.document
    exact = {
        name: pieces_of(view) for name, view in zip(("Cubic", "Line"), editor.session.views, strict=True)
    }
    editor.open_menu((2.0, 0.0))
    editor.choose("splitAtIntersections")
    curves = editor.session.document.curves
    assert [curve.name for curve in curves] == [f"{name} {letter}" for name in exact for letter in "abcd"]
    for curve, view in zip(curves, editor.session.views, strict=True):
        assert is_part_of(exact[curve.name[:-2]], view), curve.name
        assert (curve.style, curve.groups) == (RED if "Cubic" in curve.name else Style(), ("G",))
    inner = [ends(curve)[1] for curve in (*curves[:3], *curves[4:7])]
    assert np.array(inner) == pytest.approx(np.array([(-1, 0), (0, 0), (1, 0)] * 2), abs=1e-15)
    assert editor.status.startswith("Split at the intersections into 8 curves: shape kept, largest change ")
    assert editor.session.selected.whole_curves == set(range(8))
    assert editor.session.undo_stack.undoText().startswith("Split ")
    editor.trigger("undo")
    assert editor.session.document == document


def test_the_palette_splits_a_curve_where_it_crosses_itself(editor):
    begin(editor, hermite("Loop", (0.0, 0.0, 9.0, 9.0, 0.0), (1.0, 0.0, 9.0, -9.0, 1.0)), whole=False)
    (exact,) = map(pieces_of, editor.session.views)
    editor.run_command("Split at Intersections")
    first, loop, last = editor.session.document.curves
    assert [curve.name for curve in (first, loop, last)] == ["Loop a", "Loop b", "Loop c"]
    # x(t) = x(1 − t) + … by symmetry: the loop closes at (1 ∓ √(3/4)) / 2.
    assert loop.points[0].t == pytest.approx(0.5 - math.sqrt(3) / 4, abs=1e-15)
    assert ends(loop)[0] == pytest.approx(ends(loop)[1], abs=1e-15)
    assert all(is_part_of(exact, view) for view in editor.session.views)


def test_curves_that_touch_are_split_once_and_an_end_on_a_line_splits_the_line_alone(editor):
    parabola = hermite("Parabola", (-1.0, 1.0, 2.0, -4.0, 0.0), (1.0, 1.0, 2.0, 4.0, 1.0))
    begin(editor, parabola, line("Tangent", (-1.0, 0.0), (2.0, 0.0)))
    assert list(split(editor)) == ["Parabola a", "Parabola b", "Tangent a", "Tangent b"]
    begin(editor, line("Post", (0.5, 0.0), (0.5, 2.0)), line("Ground", (-1.0, 0.0), (2.0, 0.0)))
    curves = split(editor)
    assert list(curves) == ["Post", "Ground a", "Ground b"]
    assert ends(curves["Ground a"])[1] == (0.5, 0.0)


def test_curves_are_split_at_a_common_point_without_another_one(editor):
    knee = hermite("Knee", (-2.0, 1.0, 3.0, 0.0, 0.0), (0.0, 0.0, 2.0, 2.0, 0.5), (2.0, 1.0, 0.0, 3.0, 1.0))
    cross = hermite(
        "Cross", (0.0, 2.0, 0.0, -4.0, 0.0), (0.0, 0.0, 0.0, -4.0, 0.5), (0.0, -2.0, 0.0, -4.0, 1.0)
    )
    begin(editor, knee, cross)
    curves = split(editor)
    assert {name: len(curve.points) for name, curve in curves.items()} == {
        "Knee a": 2, "Knee b": 2, "Cross a": 2, "Cross b": 2,
    }  # fmt: skip
    assert all((0.0, 0.0) in ends(curve) for curve in curves.values())


def test_closed_curves_open_and_fall_into_the_parts_between_their_crossings(editor):
    begin(editor, circle("One", 0.0), circle("Two", 1.0))
    exact = {view.source.name: pieces_of(view) for view in editor.session.views}
    curves = split(editor)
    assert list(curves) == ["One a", "One b", "Two a", "Two b"]
    assert not any(curve.closed for curve in curves.values())
    assert [x for curve in curves.values() for x, _ in ends(curve)] == pytest.approx([0.5] * 8, abs=1e-14)
    assert all(is_part_of(exact[view.source.name[:3]], view) for view in editor.session.views)
    # They touch where one of them begins, which is their only cut: both are opened there.
    begin(editor, circle("One", 0.0), circle("Two", 2.0))
    curves = split(editor)
    assert list(curves) == ["One", "Two"]
    assert all(ends(curve) == ((1.0, 0.0), (1.0, 0.0)) for curve in curves.values())


def test_overlapping_curves_are_named_and_locked_ones_stay(editor):
    begin(editor, line("One", (0.0, 0.0), (2.0, 0.0)), line("Two", (1.0, 0.0), (3.0, 0.0)))
    document = editor.session.document
    split(editor)
    assert editor.session.document is document
    along = "They run along each other, where they are not split."
    assert editor.status == f"The selected curves do not cross. {along}"
    # Two curves on each other, which meet at hundreds of the points looked at, and a line across them.
    begin(editor, cubic("One"), cubic("Two"), line("Line", (-1.5, -3.0), (-1.5, 1.5)))
    assert list(split(editor)) == ["One a", "One b", "Two a", "Two b", "Line a", "Line b"]
    assert editor.status.endswith(along)
    begin(editor, cubic(), replace(line("Line", (-2.0, 0.0), (2.0, 0.0)), locked=True))
    document = editor.session.document
    split(editor)
    assert editor.session.document is document


def test_curves_that_do_not_cross_and_families_that_cannot_be_split_say_so(editor):
    begin(editor, cubic(), line("Line", (-2.0, 9.0), (2.0, 9.0)))
    document = editor.session.document
    split(editor)
    assert editor.session.document is document
    assert editor.status == "The selected curves do not cross."
    rational = make_curve([(0, -1), (1, 1), (2, -1), (3, 1)], family=FAMILIES.named("floater_hormann"))
    begin(editor, rational, line("Line", (0.0, 0.0), (3.0, 0.0)))
    document = editor.session.document
    split(editor)
    assert editor.session.document is document
    assert "cannot be split" in editor.status


@pytest.mark.parametrize("family", FAMILIES)
def test_curves_of_families_are_split_at_a_line_or_say_why_not(editor, family):
    wave = make_curve([(0, -1), (1, 1.5), (2, -1), (3, 1)], family=family, name="Wave")
    begin(editor, wave, line("Line", (-1.0, 0.0), (4.0, 0.0)))
    curves = split(editor)
    if len(curves) == 2:
        assert "cannot be split: the parts would be off by up to" in editor.status
        assert family.name in ("cubic_spline", "floater_hormann")
        return
    parts = [curve for name, curve in curves.items() if name.startswith("Wave")]
    assert len(parts) == len(curves) - len(parts) > 1
    middles = [position for part in parts for position in ends(part)][1:-1]
    assert [y for _, y in middles] == pytest.approx([0.0] * len(middles), abs=1e-9)
    assert "shape kept" in editor.status
