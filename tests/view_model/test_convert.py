"""Conversions to other families keep the shape to rounding, or give the reason."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from msgspec.structs import replace

from app.document import point_edits, rule_edits
from app.document.derivatives import VelocityRule
from app.document.limits import EditError
from app.document.model import Document, ParametrizationKind, make_curve
from app.families import FAMILIES
from app.view_model.convert import converted, outlook
from app.view_model.curve.curve_view import view_of
from app.view_model.curve.distances import keeps_shape
from app.view_model.point_kinds import jolts_of, with_corners
from curvecore import CurveError, LagrangeCurve
from tests.rows import each_row

POINTS = ((0.0, 0.0), (1.0, 2.0), (2.5, 1.0), (4.0, 3.0), (5.0, 0.5), (6.0, 2.0))
TAKERS = [family for family in FAMILIES if family.takes_shapes]
PAIRS = [(one, other) for one, other in product(FAMILIES, TAKERS) if one != other]


def view(family, count=6, *, manual=False, closed=False):
    curve = replace(make_curve(POINTS[:count], family=family), closed=closed)
    made = view_of(curve)
    if not manual:
        return made
    frozen = rule_edits.freeze_parameters(Document((curve,)), 0, made.parameters.tolist())
    return view_of(frozen.curves[0])


def apart(before, after):
    t = np.linspace(*before.curve.domain, 2001)
    return np.abs(before.curve.evaluate(t) - after.curve.evaluate(t)).max()


@pytest.mark.parametrize("manual", [False, True])
@each_row("count", [2, 3, 4, 6])
@each_row(("one", "other"), PAIRS)
def test_a_conversion_keeps_the_shape_or_gives_the_reason(one, other, count, manual):
    before = view(one, count, manual=manual)
    size = np.ptp(before.points, axis=0).max()
    told = outlook(before, other)
    try:
        other.curve_class.near(before.curve, 1e-4 * size)
        assert told.within or other.curve_class.check_shape(before.curve) is None
    except CurveError:
        with pytest.raises(EditError, match="This curve is not ") as refusal:
            converted(before, other)
        # Known before anybody tries.
        assert told.refusal == str(refusal.value)
        return
    assert told.refusal == ""
    made = converted(before, other)
    after = view_of(made.curve)
    assert made.curve.family == other
    # Coordinates of 6, and some operations on each; what is no polynomial is followed.
    most = 1e-13 if before.curve.degree is not None else 1e-4 * size
    assert apart(before, after) <= most
    assert made.residual <= most
    words = (
        "Shape kept, largest change"
        if keeps_shape(made.residual, (before.source,))
        else "Shape changed by up to"
    )
    assert made.sentence.startswith(f"{words} ")
    assert words == "Shape kept, largest change" or before.curve.degree is None
    assert told.within == pytest.approx(0.0 if before.curve.degree is not None else 1e-4 * size, rel=0.5)
    assert [point.corner for point in made.curve.points].count(True) == made.note.count("jumps at") * (
        len(made.curve.points) - 2
    )
    assert made.left_rule is (made.curve.is_manual and not manual)
    assert ("now manual" in made.sentence) is made.left_rule


@each_row(
    ("one", "other", "count"),
    [
        ("b_spline", "hermite", 6),
        ("b_spline", "quintic_hermite", 6),
        ("hermite", "b_spline", 6),
        ("quintic_hermite", "b_spline", 6),
        ("bezier", "hermite", 4),
        ("bezier", "quintic_hermite", 6),
        ("hermite", "bezier", 2),
        ("lagrange", "bezier", 6),
        ("bezier", "lagrange", 6),
    ],
)
def test_a_conversion_that_is_possible_gives_the_same_curve(one, other, count):
    made = converted(view(FAMILIES.named(one), count), FAMILIES.named(other))
    assert made.residual < 1e-14


@each_row(
    ("one", "other", "words"),
    [
        (
            "hermite",
            "bezier",
            "a Bézier curve: a Bézier curve is one polynomial from end to end, and this curve has 5 pieces.",
        ),
        (
            "lagrange",
            "hermite",
            "it is one polynomial of degree 5, the pieces of a Hermite curve have degree 3.",
        ),
        (
            "bezier",
            "b_spline",
            "it is one polynomial of degree 5, the pieces of a B-spline curve have degree 3.",
        ),
        (
            "septic_hermite",
            "hermite",
            "its pieces are polynomials of degree 7, the pieces of a Hermite curve have degree 3.",
        ),
        (
            "b_spline",
            "septic_hermite",
            "its jerk jumps at 2 joints, and that of a septic Hermite curve is continuous.",
        ),
        ("floater_hormann", "bezier", "it does not consist of polynomials, and a Bézier curve does."),
    ],
)
def test_a_conversion_that_is_impossible_gives_the_reason(one, other, words):
    with pytest.raises(EditError, match="This curve is not ") as refusal:
        converted(view(FAMILIES.named(one)), FAMILIES.named(other))
    assert words in str(refusal.value)


def test_a_velocity_set_by_hand_makes_the_acceleration_jump():
    """Only there; it is no B-spline without knots that stand twice."""
    before = view(FAMILIES.named("hermite"), manual=True)
    document = point_edits.set_velocity(Document((before.source,)), 0, 2, (3.0, 9.0))
    with pytest.raises(EditError, match=r"its acceleration jumps at t = 0\.36603,"):
        converted(view_of(document.curves[0]), FAMILIES.named("b_spline"))


def test_corners_prevent_a_conversion():
    before = view(FAMILIES.named("hermite"))
    cornered = view_of(with_corners(before, [2]))
    with pytest.raises(EditError, match="a B-spline curve has no corners inside, and this curve has 1"):
        converted(cornered, FAMILIES.named("b_spline"))


@pytest.mark.parametrize("name", ["quintic_hermite", "septic_hermite"])
@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("corners", [[], [2], [0, 3]])
def test_a_hermite_curve_is_one_of_higher_degree_and_back(name, closed, corners):
    """With two sides where the acceleration jumps, which the family's own curves do not let jump.

    By the Bessel rule that is at all joints: a jerk alone that jumps is no reason to make a corner.
    """
    source = replace(make_curve(POINTS, family=FAMILIES.named("hermite")), closed=closed)
    source = replace(source, velocity_rule=VelocityRule.BESSEL)
    parameters = view_of(source).parameters.tolist()
    before = view_of(rule_edits.freeze_parameters(Document((source,)), 0, parameters).curves[0])
    source = point_edits.set_velocity(Document((before.source,)), 0, 1, (3.0, 9.0)).curves[0]
    before = view_of(source)
    inner = [index for index in corners if closed or index]
    if inner:
        before = view_of(with_corners(before, inner))
    made = converted(before, FAMILIES.named(name))
    after = view_of(made.curve)
    assert after.source.is_closed is closed
    assert apart(before, after) < 1e-13
    new = (6 if closed else 4) - len(inner)
    points = "the points there have"
    assert made.note == f"The acceleration jumps at {new} joints: {points} derivatives before and after."
    # These are no corners: the velocity goes on.
    assert len(jolts_of(after)) == new + len(inner)
    back = converted(after, FAMILIES.named("hermite")).curve
    assert apart(before, view_of(back)) < 1e-13
    assert [point.corner for point in back.points] == [False] * 6


def test_the_preview_of_a_conversion_computes_nothing(monkeypatch):
    """The exact control points of one polynomial through 60 points take seconds, and are not asked for."""
    monkeypatch.setattr(LagrangeCurve, "exact_pieces", lambda _curve: pytest.fail("computed"))
    wild = view_of(make_curve([(float(x), float(x % 2)) for x in range(60)]))
    told = [outlook(wild, family) for family in TAKERS if family != wild.source.family]
    assert [each.refusal for each in told if each.refusal.count("of degree 59")] == [
        each.refusal for each in told if each.refusal
    ]
    assert sum(not each.refusal for each in told) == 1


def test_closed_curves_stay_closed_in_families_that_can_close():
    before = view(FAMILIES.named("hermite"), closed=True)
    quintic = converted(before, FAMILIES.named("quintic_hermite")).curve
    assert quintic.is_closed
    assert len(quintic.points) == 6
    spline = converted(before, FAMILIES.named("b_spline")).curve
    assert not spline.closed
    assert apart(before, view_of(spline)) < 1e-13


def test_a_conversion_reports_the_growth_of_errors():
    made = converted(view(FAMILIES.named("lagrange")), FAMILIES.named("bezier"))
    assert made.note == "An error of a point grows by a factor of up to 31 in the control points."
    wild = make_curve([(float(x), float(x % 2)) for x in range(40)])
    wild = replace(wild, parametrization=replace(wild.parametrization, kind=ParametrizationKind.UNIFORM))
    with pytest.raises(EditError, match="through rounding"):
        converted(view_of(wild), FAMILIES.named("bezier"))


def test_a_missing_curve_is_not_converted():
    with pytest.raises(EditError, match="at least two points"):
        converted(view_of(make_curve([(1.0, 1.0)])), FAMILIES.named("bezier"))
