"""Tables of samples: right numbers, evenly spread, within the tolerance."""

import csv
import io

import numpy as np
import pytest
from msgspec.structs import replace

from app.document.model import Document, Parametrization, ParametrizationKind, make_curve
from app.exchange.errors import ExchangeError
from app.exchange.formats.tables import SAMPLES, TITLES, Spacing, polyline_deviation, sampled_table
from app.exchange.options import Options
from app.families import FAMILIES, HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.view_model.curve.curve_view import view_of
from curvecore import HermiteCurve, arc_length
from tests.rows import each_row


def table(document, **keywords):
    tolerance = keywords.pop("tolerance", None)
    written = sampled_table(document, Options(tolerance=tolerance, format_options=keywords))
    rows = list(csv.reader(io.StringIO(written.text)))
    values = np.array([[float(cell) if cell else np.nan for cell in row] for row in rows[1:]])
    return rows[0], values, written.deviation


def core(document):
    return view_of(document.curves[0]).curve


def test_equal_steps_of_t(kind):
    titles, values, _ = table(kind, samples=33)
    assert tuple(titles) == TITLES
    curve = core(kind)
    t = values[:, 0]
    assert (t[0], t[-1]) == curve.domain
    np.testing.assert_allclose(np.diff(t), (t[-1] - t[0]) / 32, rtol=1e-12)
    for order in range(3):
        np.testing.assert_array_equal(values[:, 1 + 2 * order : 3 + 2 * order], curve.evaluate(t, order))


def test_the_length_is_the_arc_length(kind):
    _, values, _ = table(kind, samples=50)
    length = arc_length(core(kind), 1e-10).value
    assert values[0, -1] == 0
    assert (np.diff(values[:, -1]) > 0).all()
    assert values[-1, -1] == pytest.approx(length, rel=2e-9)


def test_equal_arc_lengths(kind):
    _, values, _ = table(kind, samples=41, spacing=Spacing.LENGTH)
    steps = np.diff(values[:, -1])
    assert len(values) == 41
    np.testing.assert_allclose(steps, steps.mean(), rtol=1e-9)


@each_row("tolerance", [1e-1, 1e-2, 1e-3])
def test_samples_by_tolerance_stay_within_the_tolerance(kind, tolerance):
    _, values, deviation = table(kind, spacing=Spacing.TOLERANCE, tolerance=tolerance)
    assert deviation <= tolerance
    curve = core(kind)
    fine = curve.evaluate(np.linspace(*curve.domain, 5001))
    start, end = values[:-1, 1:3], values[1:, 1:3]
    along = end - start
    for point in fine[::50]:
        share = np.clip(((point - start) * along).sum(1) / (along**2).sum(1), 0, 1)
        assert np.hypot(*(point - start - share[:, None] * along).T).min() <= 1.01 * tolerance


def test_the_curvature_of_a_circle():
    # A fine natural spline through a unit circle.
    angles = np.linspace(0, 6, 200)
    document = Document(
        (make_curve(np.column_stack([np.cos(angles), np.sin(angles)]).tolist(), family=HERMITE),)
    )
    _, values, _ = table(document, samples=100)
    np.testing.assert_allclose(values[10:-10, 7], 1, rtol=2e-3)


def test_a_point_at_rest_has_no_curvature():
    document = Document((make_curve([(0, 0), (1, 1)], family=QUINTIC_HERMITE),))
    point = type(document.curves[0].points[0])
    points = (point(0.0, 0.0, velocity=(0.0, 0.0)), point(1.0, 1.0))
    curve = document.curves[0]
    document = Document((type(curve)(curve.name, curve.family, curve.parametrization, points),))
    _, values, _ = table(document, samples=5)
    assert np.isnan(values[0, 7])
    assert np.isfinite(values[1:]).all()


def test_several_curves_have_a_column_for_the_name(gallery):
    written = sampled_table(gallery, Options(format_options={"samples": 3}))
    rows = list(csv.reader(io.StringIO(written.text)))
    assert rows[0] == ["curve", *TITLES]
    assert {len(row) for row in rows} == {10}
    assert written.remarks


def test_a_name_never_becomes_a_formula():
    curve = make_curve([(0, 0), (1, 1)], name='=cmd|"/c calc"')
    written = sampled_table(Document((curve, curve)), Options(format_options={"samples": 2}))
    assert next(csv.reader(io.StringIO(written.text.splitlines()[1])))[0] == '\'=cmd|"/c calc"'


def test_tabs(sketch):
    text = sampled_table(sketch, Options(format_options={"samples": 2}), separator="\t").text
    assert text.splitlines()[0] == "\t".join(TITLES)


@each_row("samples", [-1, 1, 1_000_001])
def test_the_number_of_samples_has_limits(sketch, samples):
    with pytest.raises(ExchangeError, match="A table can have 2 to 1000000 samples"):
        sampled_table(sketch, Options(format_options={"samples": samples}))


def test_many_samples_are_computed_in_parts_that_fit_together(sketch, monkeypatch):
    whole = sampled_table(sketch, Options(format_options={"samples": 1500}))
    monkeypatch.setattr("app.exchange.formats.tables._ROWS_AT_ONCE", 100)
    told = []
    parts = sampled_table(
        sketch, Options(report=lambda share, _word: told.append(share), format_options={"samples": 1500})
    )
    one, other = (
        np.genfromtxt(io.StringIO(each.text), delimiter=",", skip_header=1) for each in (whole, parts)
    )
    np.testing.assert_array_equal(one[:, :8], other[:, :8])
    np.testing.assert_allclose(one[:, 8], other[:, 8], rtol=1e-13)
    assert parts.deviation == whole.deviation
    assert told == sorted(told)
    assert len(told) == 17  # a curve, its parameters and 15 parts


NEARLY_STILL = {
    "three points in one place": [(1.0, 1.0)] * 3,
    "small against its distance": [
        (1000.0 + 1e-8 * x, 1000.0 + 1e-8 * y) for x, y in ((0, 0), (1, 3), (2, 1), (3, 2))
    ],
    "one rounding wide": [(1.0, 1.0), (1.0 + 2.0**-52, 1.0), (1.0, 1.0 + 2.0**-52)],
}


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("points", NEARLY_STILL.values(), ids=NEARLY_STILL)
@pytest.mark.parametrize("spacing", [Spacing.T, Spacing.LENGTH])
def test_a_curve_that_is_nearly_still_is_sampled_in_few_evaluations(family, points, spacing, monkeypatch):
    """The table of three points (1, 1) had no end after 150 s and 4 GB: steps below rounding were halved."""
    rule = Parametrization(ParametrizationKind.UNIFORM)
    document = Document((replace(make_curve(points, family=family), parametrization=rule),))
    evaluations = []
    for each in {type(piece) for piece in view_of(document.curves[0]).pieces}:
        monkeypatch.setattr(each, "evaluate", counted(each.evaluate, evaluations))
    size = np.ptp(np.array(points), axis=0).max()
    # A rounding is a length for the Hermite families, whose lengths do not depend on where the origin is.
    may_refuse = size < 1e-12 and not (size > 0.0 and family in (HERMITE, QUINTIC_HERMITE))
    must_refuse = size == 0.0 or (size < 1e-12 and family is LAGRANGE)
    refusal = ""
    try:
        _, values, _ = table(document, samples=9, spacing=spacing)
    except ExchangeError as problem:
        refusal = str(problem)
    if refusal:
        assert refusal == "The curve has no length."
        assert spacing is Spacing.LENGTH
        assert may_refuse
    else:
        assert spacing is Spacing.T or not must_refuse
        assert 0 <= values[-1, -1] <= 10 * size + 1e-12
        assert (np.diff(values[:, -1]) >= 0).all()
    assert sum(evaluations) < 100_000


def counted(evaluate, counts):
    """An evaluation that notes at how many parameters it was asked."""

    def counting(self, t, order=0):
        counts.append(np.size(t))
        if sum(counts) > 1_000_000:
            raise AssertionError("the work has no end")
        return evaluate(self, t, order)

    return counting


def farthest(curve, t, count=200):
    """The largest distance of the curve from its chords, at so many places each."""
    s = (np.arange(count) + 0.5) / count
    points = curve.evaluate((t[:-1, None] + np.diff(t)[:, None] * s).ravel()).reshape(-1, count, 2)
    start, along = (each[:, None] for each in (curve.evaluate(t[:-1]), np.diff(curve.evaluate(t), axis=0)))
    square = np.maximum((along**2).sum(axis=2), 1e-300)
    share = np.clip(((points - start) * along).sum(axis=2) / square, 0, 1)
    return np.linalg.norm(points - start - share[..., None] * along, axis=2).max()


def test_rows_with_a_curvature_decided_by_rounding_are_counted():
    """Between points 1e-9 apart 1.5 was written for a curvature of -1.5."""
    chords = Parametrization(ParametrizationKind.CHORD_LENGTH)
    for gap, is_told in ((1e-3, False), (1e-9, True)):
        points = [(0, 0), (1, 1), (1 + gap, 1), (2, 0)]
        curve = replace(make_curve(points, family=HERMITE), parametrization=chords)
        # The middle of three rows lies between the two points.
        written = sampled_table(Document((curve,)), Options(format_options={SAMPLES.name: 3}))
        assert ("In 1 row rounding may change the curvature" in " ".join(written.remarks)) is is_told
    straight = Document((make_curve([(0, 0), (1, 1), (3, 3)]),))
    assert sampled_table(straight).remarks == ()


def test_a_tolerance_that_is_missed_is_not_stated(monkeypatch):
    """The vertices did not suffice; the table was 177 from a curve as large as 1e9."""
    points = np.random.default_rng(0).normal(size=(40, 2)).tolist()
    rule = Parametrization(ParametrizationKind.UNIFORM)
    document = Document((replace(make_curve(points), parametrization=rule),))
    _, values, deviation = table(document, spacing=Spacing.TOLERANCE, tolerance=1e-3, columns=("t", "x", "y"))
    curve = core(document)
    assert deviation > 100
    assert farthest(curve, values[:, 0], 16) <= deviation


@each_row("samples", [2, 5, 17])
@each_row("spacing", [Spacing.T, Spacing.LENGTH])
def test_the_deviation_stated_is_reached_nowhere(kind, samples, spacing):
    """Measured at seven places a chord, it was up to 1.6 % too small."""
    _, values, deviation = table(kind, samples=samples, spacing=spacing)
    assert farthest(core(kind), values[:, 0]) <= deviation


@each_row(
    ("points", "velocities", "parameters", "count", "failed"),
    [
        ([(3, -3), (2, 2), (1, -1)], [(-0.5, 2.5), (-0.75, -0.25), (-1, -3)], [0, 2, 3], 2, 3.1798),
        (
            [(-3, 1), (2, -3), (-3, 0), (1, 0)],
            [(5, -4), (-2.5, 1), (-4.5, 3), (1, 0)],
            [0, 0.5, 0.75, 2.75],
            6,
            0.6506,
        ),
    ],
)
def test_the_deviation_holds_just_before_a_joint(points, velocities, parameters, count, failed):
    """The end of a part did not count: it was stated 3.1798 of 3.1843, and 0.6506 of 0.6731."""
    curve = HermiteCurve(points, velocities, parameters)
    t = np.linspace(0.0, parameters[-1], count)
    stated, samples = polyline_deviation(curve, t), 20_000
    reached = farthest(curve, t, samples)
    assert failed < reached <= stated
    # Between places h apart the curve is at most h² / 8 max |c''| farther: here, and at eight steps a part.
    second = np.linalg.norm(curve.evaluate(np.linspace(0.0, parameters[-1], 2001), 2), axis=1).max()
    step = parameters[-1] / (count - 1)
    missed, margin = ((step / places) ** 2 / 8 * 1.5 * second for places in (samples, 8))
    assert missed < 1e-6
    assert stated <= reached + missed + margin
