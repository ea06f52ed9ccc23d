"""Files in and out of every family, some known by a basis alone: within the deviation that is stated."""

from __future__ import annotations

import importlib.util
import json
import re

import numpy as np
import pytest
from PIL import Image
from scipy.spatial import cKDTree

from app.document.model import Document, ParametrizationKind
from app.exchange.drawing.film import Film, write_film
from app.exchange.facts import facts_of
from app.exchange.files import ImportOptions, export, import_file
from app.exchange.formats import FORMATS
from app.exchange.options import Options
from app.families import FAMILIES
from app.storage.files import load
from app.view_model.curve.curve_view import view_of
from curvecore.bezier.flatten import segment_distance
from tests.own_families import EVERY, OWN, TRUE_BASIS
from tests.rows import each_row
from tests.view_model.test_any_family import curve_of

pytestmark = pytest.mark.usefixtures("own_families")

TOLERANCE = 1e-4
NUMBER = r"-?\d+(?:\.\d+)?(?:e-?\d+)?"


@pytest.fixture(params=EVERY)
def document(request):
    return Document((curve_of(request.param),))


@pytest.fixture
def written(document, tmp_path):
    def write(ending, **options):
        path = tmp_path / f"curve{ending}"
        done = export(document, path, Options(tolerance=TOLERANCE, **options))
        return path, done

    return write


def truth_of(document, t):
    """The curve at t, from the functions as the tests know them."""
    (curve,) = document.curves
    view = view_of(curve)
    if curve.family.name not in OWN:
        return view.curve.evaluate(t)  # which other tests compare with exact numbers
    return TRUE_BASIS[curve.family.name](t, view.parameters) @ view.points


def is_own(document):
    """Whether nothing but functions of t is known of the family: its curves are approximated."""
    return document.curves[0].family.name in OWN


def dense(document, count=6001):
    return truth_of(document, np.linspace(1.0, 3.5, count))


def to_line(points, line):
    """How far points are from a polyline, by the chords at its four nearest corners: never too little."""
    at = cKDTree(line).query(points, k=4)[1]
    beside = (np.maximum(at - 1, 0), np.minimum(at + 1, len(line) - 1))
    away = [segment_distance(points[:, None], line[at], line[corner]) for corner in beside]
    return np.minimum(*away).min(axis=1).max()


def bezier_points(controls, scale=(1.0, 1.0)):
    """Points all along cubics whose control points follow each other, (3 k + 1, 2)."""
    controls = np.array(controls) * scale
    # Of few pieces more each: chords lie 1e-5 off at most.
    s = np.linspace(0.0, 1.0, max(65, 9000 // len(controls)))[:, None]
    basis = np.hstack([(1 - s) ** 3, 3 * (1 - s) ** 2 * s, 3 * (1 - s) * s**2, s**3])
    return np.vstack([basis @ controls[k : k + 4] for k in range(0, len(controls) - 1, 3)])


def reads_again(path):
    """The curve that a file holds."""
    document = load(path) if path.name.endswith(".curve.json") else import_file(path).document
    return document.curves[0]


def test_every_format_states_a_deviation_within_the_tolerance(document, written):
    limits = {ending: form.deviation_limit for form in FORMATS.written for ending in form.endings}
    for ending, limit in limits.items():
        # A picture in its usual size takes as long as all others together.
        path, done = written(ending, width=200 if ending == ".png" else None)
        assert path.stat().st_size > 0
        assert done.remarks == ()
        if done.deviation is None:
            continue
        assert 0.0 <= done.deviation <= limit * TOLERANCE
        # What says that it holds the curve itself is read as that, family and all.
        if is_own(document):
            assert done.deviation > 0.0 or reads_again(path).family is document.curves[0].family
        assert (done.deviation == 0.0) or ending not in (".curve.json", ".points.csv", ".points.tsv")


def test_a_document_and_a_table_of_points_are_the_same_curve_again(document, written):
    assert load(written(".curve.json")[0]) == document
    for ending in (".points.csv", ".points.tsv"):
        again = import_file(written(ending)[0]).document.curves[0]
        assert again.family is document.curves[0].family
        t = np.linspace(1.0, 3.5, 101)
        assert view_of(again).curve.evaluate(t) == pytest.approx(truth_of(document, t), abs=1e-12)


@pytest.mark.parametrize("ending", [".py", ".scipy.py"])
def test_code_is_the_curve_within_its_deviation(document, written, ending):
    if ending == ".scipy.py" and importlib.util.find_spec("scipy") is None:
        pytest.skip("SciPy is not here")
    path, done = written(ending)
    namespace = {}
    exec(compile(path.read_text(), str(path), "exec"), namespace)
    name = next(key for key in namespace if key.startswith("a_"))
    t = np.linspace(1.0, 3.5, 3001)
    away = np.linalg.norm(namespace[name](t) - truth_of(document, t), axis=1)
    # The deviation is measured at other parameters: where it is rounding alone, it is another one here.
    assert away.max() <= done.deviation + (0.0 if is_own(document) else 1e-13)
    assert away.max() > done.deviation / 20 or not is_own(document)


def test_coefficients_are_the_curve_within_the_stated_deviation(document, written):
    path, done = written(".coefficients.json")
    content = json.loads(path.read_text())
    (curve,) = content["curves"]
    assert curve["family"] == document.curves[0].family.name
    worst = 0.0
    for part in curve["segments"]:
        s = np.linspace(0.0, 1.0, 40)
        at = part["start"] + s * (part["end"] - part["start"])
        values = np.column_stack([np.polynomial.polynomial.polyval(s, part[axis]) for axis in ("x", "y")])
        worst = max(worst, np.linalg.norm(values - truth_of(document, at), axis=1).max())
    assert worst <= done.deviation + (0.0 if is_own(document) else 1e-13)


@each_row("ending", [".path.txt", ".pgfplots.tex", ".tikz"])
def test_drawn_cubics_are_the_curve_within_the_stated_deviation(document, written, ending):
    path, done = written(ending)
    text = path.read_text()
    if ending == ".path.txt":
        controls = np.array(re.findall(NUMBER, text), dtype=float).reshape(-1, 2)
        points = bezier_points(controls, (1.0, -1.0))
    else:
        drawn = re.search(r"\\draw(.*?);", text, re.DOTALL)[1]
        pairs = re.findall(rf"\((?:axis cs:)?({NUMBER}),({NUMBER})\)", drawn)
        unit = re.search(rf"One centimetre is ({NUMBER})", text)
        points = bezier_points(np.array(pairs, dtype=float))
        if unit:
            size = float(unit[1])
            # The picture's corner is where its first point says.
            points = points * size + (dense(document, 2)[0] - points[0] * size)
    line = dense(document)
    # What polylines of 6001 and 64 points a piece are off themselves is below 1e-5.
    assert to_line(points[::8], line) <= done.deviation + 1e-5
    assert to_line(line[::20], points) <= done.deviation + 1e-5


@pytest.mark.parametrize("ending", [".svg", ".dxf"])
def test_a_drawing_that_is_read_back_is_the_curve_within_both_deviations(
    document, written, ending, drawings_read_here
):
    path, done = written(ending)
    read = import_file(path)
    points = np.vstack([view_of(curve).flattened(1e-6).points for curve in read.document.curves])
    line = dense(document)
    assert to_line(points[::5], line) <= done.deviation + read.deviation + 1e-5
    assert to_line(line[::20], points) <= done.deviation + read.deviation + 1e-5


def test_a_path_for_robots_is_the_curve_within_its_deviation(document, written):
    path, done = written(".pathweaver.csv")
    again = view_of(import_file(path).document.curves[0]).curve
    count = again.domain[1]
    t = np.union1d(np.linspace(0.0, count, 3001), np.arange(0.5, min(count, 2000)))
    away = np.hypot(*(again.evaluate(t) - truth_of(document, 1.0 + 2.5 * t / count)).T)
    # Where the deviation is rounding alone it is called exact.
    assert away.max() <= done.deviation + 1e-12


def test_rows_of_samples_are_the_curve_and_its_derivatives(document, written):
    path, done = written(".csv", format_options={"samples": 200})
    titles, *rows = (line.split(",") for line in path.read_text().splitlines())
    # Where the curve stands still it has no curvature: the cell is empty.
    values = {title: np.array([float(row[k] or "nan") for row in rows]) for k, title in enumerate(titles)}
    assert np.column_stack([values["x"], values["y"]]) == pytest.approx(
        truth_of(document, values["t"]), abs=1e-12
    )
    inner = values["t"][1:-1]
    h = 1e-4
    velocity = (truth_of(document, inner + h) - truth_of(document, inner - h)) / (2 * h)
    assert np.column_stack([values["vx"], values["vy"]])[1:-1] == pytest.approx(velocity, rel=1e-4, abs=2e-3)
    points = np.column_stack([values["x"], values["y"]])
    assert to_line(dense(document)[::5], points) <= done.deviation + 1e-5
    assert values["length"][-1] == pytest.approx(
        np.hypot(*np.diff(dense(document), axis=0).T).sum(), rel=1e-5
    )


def test_rows_become_a_curve_of_the_requested_family(tmp_path):
    path = tmp_path / "rows.csv"
    path.write_text("t,x,y\n0,0,0\n1,1,2\n2.5,2.5,1\n4,4,3\n")
    for name in OWN:
        (curve,) = import_file(path, ImportOptions(family=FAMILIES.named(name))).document.curves
        assert curve.family.name == name
        view = view_of(curve)
        assert view.curve.evaluate(1.7) == pytest.approx(
            (TRUE_BASIS[name](np.array([1.7]), view.parameters) @ view.points)[0]
        )


def test_a_picture_and_a_film_show_a_curve_of_another_family(document, written, tmp_path):
    path, _ = written(".png", width=300)
    with Image.open(path) as picture:
        ink = np.asarray(picture.convert("L")) < 250
    # A line a pixel wide or more, as long as the curve is, in a picture a little wider than it.
    line = dense(document)
    length = np.hypot(*np.diff(line, axis=0).T).sum()
    assert ink.sum() > 0.8 * length * 300 / (1.15 * np.ptp(line[:, 0]))
    film = tmp_path / "run.gif"
    write_film(document, film, Film(width=120, fps=4, seconds=1.0))
    with Image.open(film) as frames:
        assert frames.n_frames >= 4


def test_facts_match_the_curve(document):
    (facts,) = facts_of(document)
    line = dense(document, 20001)
    assert facts.degree == view_of(document.curves[0]).curve.degree
    assert facts.degree is None or not is_own(document)
    assert facts.domain == (1.0, 3.5)
    length = np.hypot(*np.diff(line, axis=0).T).sum()
    assert facts.length.value == pytest.approx(length, abs=facts.length.error + 1e-6)
    assert facts.box == pytest.approx((*line.min(axis=0), *line.max(axis=0)), abs=1e-6)
    assert facts.closed is False


@pytest.mark.parametrize("kind", [ParametrizationKind.UNIFORM, ParametrizationKind.MANUAL])
def test_curves_with_other_parameter_rules_are_written(kind, tmp_path):
    for name in OWN:
        document = Document((curve_of(name, kind),))
        path = tmp_path / "curve.py"
        done = export(document, path, Options(tolerance=TOLERANCE))
        namespace = {}
        exec(compile(path.read_text(), str(path), "exec"), namespace)
        (function,) = (value for key, value in namespace.items() if key.startswith("a_"))
        start, end = view_of(document.curves[0]).curve.domain
        t = np.linspace(start, end, 1001)
        assert np.linalg.norm(function(t) - truth_of(document, t), axis=1).max() <= done.deviation
