"""Formulas and code of families that say what their pieces interpolate: exact where that can be written.

Each is the natural cubic spline of the tests' own families. What they say of themselves is right, right in a
form that no writer knows, or wrong.
"""

import json

import numpy as np
import pytest

from app.document.model import Document
from app.exchange.files import export
from app.exchange.options import Options
from app.families import FAMILIES, Family
from app.view_model.curve.curve_view import view_of
from curvecore import Interpolant
from tests.view_model.test_any_family import SIZE, curve_of

pytestmark = pytest.mark.usefixtures("own_families")

EXACT = 1e-13 * SIZE
"""More than the roundings of a few products of numbers of the size of the points."""


def velocities(curve):
    return curve.basis(curve.parameters, 1)[:, :, 0] @ curve.points


def ends(curve):
    """Points and velocities at both ends of each cubic: what it is."""
    jets, t = np.stack([curve.points, velocities(curve)], axis=1), curve.parameters
    return [Interpolant(t[k : k + 2], jets[k : k + 2]) for k in range(len(t) - 1)]


def four_points(curve):
    """Four points of each cubic: the same, in a form of which no writer has heard."""
    t = curve.parameters
    places = [np.linspace(t[k], t[k + 1], 4) for k in range(len(t) - 1)]
    return [Interpolant(each, curve.evaluate(each)[:, None]) for each in places]


def three_velocities(curve):
    """Hermite data at three nodes, of which two would do."""
    jets, t = np.stack([curve.points, velocities(curve)], axis=1), curve.parameters
    middle = 0.5 * (t[:-1] + t[1:])
    inner = np.stack([curve.evaluate(middle), curve.evaluate(middle, 1)], axis=1)
    return [
        Interpolant(np.array([t[k], middle[k], t[k + 1]]), np.stack([jets[k], inner[k], jets[k + 1]]))
        for k in range(len(t) - 1)
    ]


def own_points(curve):
    """Its points, as a polynomial through them has it: wrong."""
    return [Interpolant(curve.parameters, curve.jets)]


def no_velocities(curve):
    """Points and no velocities at the ends: wrong."""
    return [each._replace(jets=each.jets * [[1.0], [0.0]]) for each in ends(curve)]


def velocities_that_jump(curve):
    """Two velocities at one joint: wrong, and no curve of a family with derivatives."""
    first, *others = ends(curve)
    return [first._replace(jets=first.jets * [[1.0], [2.0]]), *others]


RIGHT = [ends]
OTHERWISE = [four_points, three_velocities, own_points, no_velocities, velocities_that_jump]


@pytest.fixture
def document_of():
    """Make a document with a curve of a family that says this of its pieces."""
    spline = type(view_of(curve_of("tests_natural_spline")).curve)
    added = []

    def document_of(interpolants):
        body = {"__slots__": (), "name": "tests_told_spline", "interpolants": interpolants}
        added.append(Family.of(type("ToldSpline", (spline,), body)))
        FAMILIES.add(added[-1])
        return Document((curve_of("tests_told_spline"),))

    yield document_of
    for family in added:
        FAMILIES.remove(family)


def distance_of_code(document, path):
    """How far the exported function is from the curve, and what the export said."""
    done = export(document, path, Options())
    namespace = {}
    exec(compile(path.read_text(), str(path), "exec"), namespace)
    (function,) = (value for name, value in namespace.items() if name.startswith("a_tests"))
    curve = view_of(document.curves[0]).curve
    t = np.linspace(*curve.domain, 4001)
    return np.linalg.norm(function(t) - curve.evaluate(t), axis=1).max(), done.deviation


@pytest.mark.parametrize("ending", [".py", ".scipy.py"])
@pytest.mark.parametrize("interpolants", RIGHT)
def test_representable_curves_are_written_exactly(document_of, interpolants, ending, tmp_path):
    if ending == ".scipy.py":
        pytest.importorskip("scipy")
    away, said = distance_of_code(document_of(interpolants), tmp_path / f"curve{ending}")
    assert away <= EXACT
    assert said <= EXACT


@pytest.mark.parametrize("ending", [".py", ".scipy.py"])
@pytest.mark.parametrize("interpolants", OTHERWISE)
def test_other_families_are_written_as_cubics_within_a_deviation(document_of, interpolants, ending, tmp_path):
    """`own_points` was written as one polynomial, 1.6 away in a curve of the size 6."""
    if ending == ".scipy.py":
        pytest.importorskip("scipy")
    away, said = distance_of_code(document_of(interpolants), tmp_path / f"curve{ending}")
    # Measured at other parameters than these; cubics follow cubics to a hundred-thousandth of the size.
    assert away <= 1.05 * said + EXACT
    assert said <= 1e-5 * SIZE


@pytest.mark.parametrize("interpolants", [*RIGHT, *OTHERWISE])
def test_coefficients_match_the_curve(document_of, interpolants, tmp_path):
    document, path = document_of(interpolants), tmp_path / "curve.coefficients.json"
    done = export(document, path, Options())
    (written,) = json.loads(path.read_text())["curves"]
    curve, worst = view_of(document.curves[0]).curve, 0.0
    for piece in written["segments"]:
        s = np.linspace(0.0, 1.0, 50)
        at = piece["start"] + s * (piece["end"] - piece["start"])
        found = np.column_stack([np.polynomial.polynomial.polyval(s, piece[axis]) for axis in "xy"])
        worst = max(worst, np.linalg.norm(found - curve.evaluate(at), axis=1).max())
    assert worst <= 1.05 * done.deviation + EXACT
    assert done.deviation <= 1e-5 * SIZE
    if interpolants in RIGHT:
        assert len(written["segments"]) == len(curve.points) - 1
        assert done.deviation <= EXACT
