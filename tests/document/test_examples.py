"""The examples that come with the program: what they are, and that the files are what the script makes."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

from app.families import HERMITE
from app.storage.files import load
from app.storage.format import encode
from app.view_model.curve.curve_view import view_of
from tests.rows import each_row

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "resources" / "examples"


def _generator():
    path = ROOT / "tests" / "data" / "make_examples.py"
    spec = importlib.util.spec_from_file_location("make_examples", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


GENERATOR = _generator()
EXAMPLES = GENERATOR.examples()


def core(stem):
    (curve,) = load(FOLDER / f"{stem}.curve.json").curves
    view = view_of(curve)
    assert not view.problem
    return view.curve


def test_the_folder_contains_only_the_examples():
    assert {path.name for path in FOLDER.iterdir()} == {f"{stem}.curve.json" for stem in EXAMPLES}


@each_row("stem", EXAMPLES)
def test_each_example_equals_the_output_of_the_script(stem):
    assert (FOLDER / f"{stem}.curve.json").read_bytes() == encode(EXAMPLES[stem])


@each_row("stem", EXAMPLES)
def test_consecutive_points_differ(stem):
    assert np.hypot(*np.diff(core(stem).points, axis=0).T).min() > 1e-3


def test_the_script_writes_to_the_given_folder(tmp_path, monkeypatch):
    monkeypatch.setattr(GENERATOR, "FOLDER", tmp_path / "examples")
    GENERATOR.main()
    assert load(tmp_path / "examples" / "letter_s.curve.json") == EXAMPLES["letter_s"]


@pytest.mark.parametrize("stem", ["runge_uniform", "runge_chebyshev"])
def test_runge_is_a_graph_over_t(stem):
    curve = core(stem)
    t = np.linspace(-1, 1, 301)
    # The abscissae are rounded to 12 decimals; the Lebesgue constant of 11 uniform points is 30.
    np.testing.assert_allclose(curve.evaluate(t)[:, 0], t, rtol=0, atol=30 * 1e-12)


def test_runge_swings_at_uniform_points_and_not_at_chebyshev_points():
    t = np.linspace(-1, 1, 2001)
    error = {
        stem: np.abs(core(stem).evaluate(t)[:, 1] - GENERATOR.runge(t)).max()
        for stem in ("runge_uniform", "runge_chebyshev")
    }
    # The classical values, e.g. Epperson, Amer. Math. Monthly 94 (1987) 329-341: 1.92 at uniform points.
    assert error["runge_uniform"] == pytest.approx(1.915, abs=0.01)
    assert error["runge_chebyshev"] < 0.14


def test_the_robot_rests_at_both_ends():
    curve = core("robot_move")
    assert curve.domain == (0.0, 2.5)
    for order in (1, 2):
        np.testing.assert_allclose(curve.evaluate([0.0, 2.5], order), 0.0, atol=1e-12)
    speed = np.hypot(*curve.evaluate(np.linspace(0.3, 2.2, 200), 1).T)
    assert speed.min() > 0.2


def test_the_airfoil_has_the_published_thickness_and_camber():
    points = core("airfoil_naca").points
    assert len(points) == 41
    np.testing.assert_array_equal(points[0], points[-1])
    upper, lower = points[:21][::-1], points[20:]
    x = np.linspace(0.05, 0.95, 400)
    top, bottom = np.interp(x, *upper.T), np.interp(x, *lower.T)
    # The 12 and the 2 of NACA 2412, in hundredths of the chord; chords of the polyline cost a little.
    assert (top - bottom).max() == pytest.approx(0.12, abs=0.001)
    assert ((top + bottom) / 2).max() == pytest.approx(0.02, abs=0.001)


def test_the_letter_has_the_turns_of_an_s():
    curve = core("letter_s")
    assert load(FOLDER / "letter_s.curve.json").curves[0].family is HERMITE
    t = np.linspace(*curve.domain, 400)[5:-5]
    (dx, dy), (ax, ay) = curve.evaluate(t, 1).T, curve.evaluate(t, 2).T
    bends = np.sign(dx * ay - dy * ax)
    assert np.count_nonzero(np.diff(bends)) == 1, "one bow to the left, one to the right"
