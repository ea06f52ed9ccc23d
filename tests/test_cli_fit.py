"""Fewer points on the command line: convert --fit and --fit-tolerance."""

import io
import os
import subprocess
import sys

import numpy as np
import pytest

from app.cli import main
from app.storage.files import load
from app.view_model.curve.curve_view import view_of

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
    dx, dy = ROWS.T[:, :, None] - places.T[:, None]
    return np.sqrt((dx * dx + dy * dy).min(axis=1))


@pytest.mark.parametrize("family", ["hermite", "lagrange", "quintic_hermite"])
def test_fit_prints_the_number_of_points_and_the_deviation(table, tmp_path, capsys, family):
    out = tmp_path / "few.curve.json"
    assert main(["convert", str(table), str(out), "--fit", "9", "--family", family]) == 0
    (curve,) = load(out).curves
    assert (curve.family.name, len(curve.points)) == (family, 9)
    said = capsys.readouterr().err.splitlines()
    line = next(each for each in said if "“rows”: 9 points; largest deviation " in each)
    told = float(line.partition("deviation ")[2].partition(",")[0].replace("e−", "e-"))
    # Told in three digits; the samples are 0.001 from any place of the curve.
    assert gaps(curve).max() <= 1.01 * told + 1e-3


def test_fit_tolerance_bounds_the_gap_to_the_curve(table, tmp_path, capsys):
    out = tmp_path / "few.curve.json"
    assert main(["convert", str(table), str(out), "--fit-tolerance", "0.01"]) == 0
    (curve,) = load(out).curves
    assert curve.family.name == "hermite"
    assert len(curve.points) <= 6
    assert gaps(curve).max() <= 0.01 + 1e-3
    assert "largest deviation from the true curves" in capsys.readouterr().out


def test_fitted_documents_keep_their_families_and_on_request_their_times(tmp_path, capsys):
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
        (["--keep-times"], "--keep-times needs"),
    ],
)
def test_impossible_fits_are_refused(table, tmp_path, capsys, words, said):
    assert main(["convert", str(table), str(tmp_path / "out.svg"), *words]) == 1
    assert said in capsys.readouterr().err
    assert not (tmp_path / "out.svg").exists()


class Terminal(io.StringIO):
    """A terminal on which somebody presses Ctrl+C when so many words have been said."""

    def __init__(self, patience=10**9):
        super().__init__()
        self.patience = patience

    def isatty(self):
        return True

    def flush(self):
        if self.getvalue().count("Fitting: ") > self.patience:
            self.patience = 10**9
            raise KeyboardInterrupt


@pytest.fixture
def noisy(tmp_path):
    path = tmp_path / "noisy.csv"
    rows = ROWS + 0.01 * np.random.default_rng(4).normal(size=ROWS.shape)
    np.savetxt(path, rows, delimiter=",", header="x,y", comments="")
    return path


def test_a_terminal_shows_the_progress_of_a_fit(noisy, tmp_path, monkeypatch):
    monkeypatch.setattr("app.cli.output.PATIENCE", -1.0)
    monkeypatch.setattr(sys, "stderr", terminal := Terminal())
    out = tmp_path / "few.curve.json"
    assert main(["convert", str(noisy), str(out), "--fit-tolerance", "0.035", "--family", "b_spline"]) == 0
    words = [each for each in terminal.getvalue().split("\r") if each.startswith("Fitting: ")]
    shares = [int(each.removeprefix("Fitting: ").partition("%")[0]) for each in words]
    assert shares == sorted(shares)
    assert len(set(shares)) >= 3
    # The line is gone before the result is told.
    rest = terminal.getvalue().rpartition("%\033[K")[2]
    assert rest.startswith("\r\033[K")
    assert " points; largest deviation 0.03" in rest


def test_ctrl_c_ends_a_fit_and_leaves_no_file(noisy, tmp_path, monkeypatch):
    monkeypatch.setattr("app.cli.output.PATIENCE", -1.0)
    monkeypatch.setattr(sys, "stderr", terminal := Terminal(patience=5))
    words = ["--fit-tolerance", "0.035", "--family", "b_spline"]
    assert main(["convert", str(noisy), str(tmp_path / "few.curve.json"), *words]) == 130
    assert terminal.getvalue().endswith("\r\033[K")
    assert [path.name for path in tmp_path.iterdir()] == ["noisy.csv"]


def test_data_with_large_scatter_give_a_sensible_number_of_points(noisy, tmp_path, capsys):
    out = tmp_path / "few.curve.json"
    assert main(["convert", str(noisy), str(out), "--fit-tolerance", "0.02"]) == 1
    said = capsys.readouterr().err
    assert "largest deviation stays at 0.0" in said
    assert not out.exists()
    count = said.rpartition("--fit ")[2].rstrip(".\n")
    assert 2 <= int(count) <= 10
    assert main(["convert", str(noisy), str(out), "--fit", count]) == 0
    assert len(load(out).curves[0].points) == int(count)


def test_the_program_computes_in_one_thread_beside_the_window():
    """A second one, which waits in a loop, held the window up for seconds."""
    program = "import os; from app.__main__ import main; main(); print(os.environ['OPENBLAS_NUM_THREADS'])"
    free = {name: value for name, value in os.environ.items() if name != "OPENBLAS_NUM_THREADS"}
    for given, expected in (({}, "1"), ({"OPENBLAS_NUM_THREADS": "2"}, "2")):
        command = [sys.executable, "-c", f"import sys; sys.argv[1:] = ['lesson']; {program}"]
        done = subprocess.run(command, env={**free, **given}, capture_output=True, text=True, check=True)
        assert done.stdout.splitlines()[-1] == expected
