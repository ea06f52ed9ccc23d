"""Fewer points on the command line: convert --fit and --fit-tolerance."""

import numpy as np
import pytest

from app.cli import main
from app.storage.files import load
from app.view_model.curve_view import view_of

ROWS = np.stack([np.linspace(0.0, 6.0, 800), np.sin(np.linspace(0.0, 6.0, 800))], axis=1)


@pytest.fixture
def table(tmp_path):
    path = tmp_path / "rows.csv"
    np.savetxt(path, ROWS, delimiter=",", header="x,y", comments="")
    return path


def gaps(curve):
    """Return the distances of the rows from a curve, by samples 0.002 apart."""
    core = view_of(curve).curve
    places = core.evaluate(np.linspace(*core.domain, 4000))
    return np.linalg.norm(ROWS[:, None] - places[None], axis=2).min(axis=1)


@pytest.mark.parametrize("family", ["hermite", "lagrange", "quintic_hermite"])
def test_fit_gives_so_many_points_and_tells_the_deviation(table, tmp_path, capsys, family):
    out = tmp_path / "few.curve.json"
    assert main(["convert", str(table), str(out), "--fit", "9", "--family", family]) == 0
    (curve,) = load(out).curves
    assert (curve.family.name, len(curve.points)) == (family, 9)
    said = capsys.readouterr().err.splitlines()
    line = next(each for each in said if "“rows”: 9 points; largest deviation " in each)
    told = float(line.partition("deviation ")[2].partition(",")[0].replace("e−", "e-"))
    # Told in three digits; the samples are 0.001 from any place of the curve.
    assert gaps(curve).max() <= 1.01 * told + 1e-3


def test_fit_tolerance_is_kept(table, tmp_path, capsys):
    out = tmp_path / "few.curve.json"
    assert main(["convert", str(table), str(out), "--fit-tolerance", "0.01"]) == 0
    (curve,) = load(out).curves
    assert curve.family.name == "hermite"
    assert len(curve.points) <= 6
    assert gaps(curve).max() <= 0.01 + 1e-3
    assert "largest deviation from the true curves" in capsys.readouterr().out


def test_documents_keep_their_families_and_times_where_asked(tmp_path, capsys):
    source = "resources/examples/robot_move.curve.json"
    before = load(source).curves[0]
    out = tmp_path / "few.curve.json"
    assert main(["convert", source, str(out), "--fit-tolerance", "1e-3", "--keep-times"]) == 0
    after = load(out).curves[0]
    assert after.family is before.family
    old, new = view_of(before).curve, view_of(after).curve
    assert new.domain == old.domain
    t = np.linspace(*old.domain, 500)
    # It is tried at a thousand places of the curve, between which little happens.
    assert np.linalg.norm(new.evaluate(t) - old.evaluate(t), axis=1).max() <= 1.1e-3


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--fit", "5000"], "too few"),
        (["--fit-tolerance", "1e-9", "--family", "lagrange"], "no Lagrange curve within 1e-09 was found"),
        (["--keep-times"], "--keep-times goes with"),
    ],
)
def test_what_cannot_be_fitted_is_refused(table, tmp_path, capsys, words, said):
    assert main(["convert", str(table), str(tmp_path / "out.svg"), *words]) == 1
    assert said in capsys.readouterr().err
    assert not (tmp_path / "out.svg").exists()
