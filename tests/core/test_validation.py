"""Input that describes no curve: every message says what, where and what was needed."""

import math
import re
import subprocess
import sys
from decimal import Decimal
from fractions import Fraction
from types import ModuleType

import numpy as np
import pytest

from curvecore import (
    CurveError,
    HermiteCurve,
    LagrangeCurve,
    QuinticHermiteCurve,
    cubic_path,
    flatten,
    parameter_sensitivity,
)
from tests.rows import each_row

POINTS = [[0.0, 0.0], [1.0, 2.0], [3.0, 1.0]]
T = [0.0, 0.5, 1.0]


def lagrange(points=POINTS, parameters=T):
    return LagrangeCurve(points, parameters)


@each_row(
    ("arguments", "message", "indices"),
    [
        (
            {"points": [[0.0, math.nan], [1.0, 1.0], [2.0, 0.0]]},
            "points[0, 1] is nan; every value must be finite",
            (0,),
        ),
        ({"points": [[0.0, 0.0], [1.0, 1.0], [math.inf, 0.0]]}, "points[2, 0] is inf", (2,)),
        ({"points": [0.0, 1.0, 2.0]}, "points must have the shape (n, dim), not (3,)", ()),
        ({"points": np.zeros((3, 0))}, "points must have the shape (n, dim), not (3, 0)", ()),
        ({"points": [[0.0, 0.0]]}, "points must have at least 2 rows, not 1", ()),
        ({"points": [[0.0, 0.0], [1.0]]}, "points must be a regular array of real numbers", ()),
        ({"points": [["a", "b"], ["c", "d"]]}, "points must be a regular array of real numbers", ()),
        ({"points": [["1", "2"], ["3", "4"]]}, "points must be a regular array of real numbers", ()),
        ({"points": [[1j, 0], [0, 1], [1, 1]]}, "points must be a regular array of real numbers", ()),
        ({"points": [[None, 0], [0, 1], [1, 1]]}, "points[0, 0] is nan", (0,)),
        ({"points": [[10**400, 0], [0, 1], [1, 1]]}, "points must be a regular array of real numbers", ()),
        ({"parameters": [0.0, 1.0]}, "parameters must have the shape (3,), one per point, not (2,)", ()),
        ({"parameters": 0.0}, "parameters must have the shape (3,), one per point, not ()", ()),
        ({"parameters": [0.0, math.nan, 1.0]}, "parameters[1] is nan", (1,)),
        (
            {"parameters": [0.0, 0.5, 0.5]},
            "parameters must be strictly increasing, but parameters[2] = 0.5 "
            "does not exceed parameters[1] = 0.5",
            (1, 2),
        ),
        ({"parameters": [0.0, 2.0, 1.0]}, "parameters must be strictly increasing", (1, 2)),
        ({"parameters": [-1.7e308, 0.0, 1.7e308]}, "parameters must span an interval of finite length", ()),
    ],
)
def test_bad_data(arguments, message, indices):
    with pytest.raises(CurveError, match=re.escape(message)) as caught:
        lagrange(**arguments)
    assert caught.value.indices == indices
    assert isinstance(caught.value, ValueError)


def test_derivatives_need_the_shape_of_the_points():
    with pytest.raises(
        CurveError, match=re.escape("velocities must have the shape of the points, (3, 2), not (2, 2)")
    ):
        HermiteCurve(POINTS, POINTS[:2], T)
    with pytest.raises(CurveError, match=re.escape("accelerations must have the shape of the points")):
        QuinticHermiteCurve(POINTS, POINTS, [[1.0], [2.0], [3.0]], T)
    with pytest.raises(CurveError, match=re.escape("accelerations[1, 0] is -inf")):
        QuinticHermiteCurve(POINTS, POINTS, [[0, 0], [-math.inf, 0], [0, 0]], T)
    with pytest.raises(CurveError, match=re.escape("jets must have the shape (3, 2, dim), not (3, 1, 2)")):
        HermiteCurve(POINTS, POINTS, T).with_jets(np.zeros((3, 1, 2)))
    with pytest.raises(CurveError, match="jets"):
        lagrange().with_jets(np.full((3, 1, 2), math.nan))


@each_row("curve", [lagrange(), HermiteCurve(POINTS, POINTS, T)])
@each_row(
    ("t", "order", "message"),
    [
        (math.nan, 0, "t is nan; every value must be finite"),
        ([0.0, math.inf], 0, "t[1] is inf"),
        ([[0.0, math.inf]], 0, "t[0, 1] is inf"),
        (0.5, -1, "order must be at least 0, not -1"),
        (0.5, 1.5, "order must be an integer, not 1.5"),
    ],
)
def test_bad_evaluation(curve, t, order, message):
    for method in (curve.evaluate, curve.basis):
        with pytest.raises(CurveError, match=re.escape(message)):
            method(t, order)


def test_t_of_results_with_an_axis_for_t_is_a_number_or_a_row():
    for ask in (parameter_sensitivity, HermiteCurve.local_basis):
        with pytest.raises(
            CurveError, match=re.escape("t must be a number or have the shape (m,), not (1, 1)")
        ):
            ask(HermiteCurve(POINTS, POINTS, T), [[0.0]])


def test_bad_tolerances_and_boxes():
    for value, message in ((0.0, "tolerance must be greater than 0"), (math.nan, "tolerance is nan")):
        with pytest.raises(CurveError, match=message):
            flatten(lagrange(), value)
        with pytest.raises(CurveError, match=message):
            cubic_path(lagrange(), value)
    with pytest.raises(CurveError, match="box must be"):
        flatten(lagrange(), 0.1, (0.0, 1.0))
    with pytest.raises(CurveError, match="xmin <= xmax"):
        flatten(lagrange(), 0.1, (1.0, 0.0, 0.0, 1.0))
    with pytest.raises(
        CurveError, match=re.escape("curve must be plane (dim 2) to be flattened, not of dim 3")
    ):
        flatten(lagrange(np.eye(3)), 0.1)


def test_other_numbers_are_numbers():
    curve = LagrangeCurve([[Fraction(1, 3), Decimal("0.5")], [1, True]], (0, np.float32(1.0)))
    assert curve.points.tolist() == [[1 / 3, 0.5], [1.0, 1.0]]


def test_importing_the_core_loads_only_numpy():
    program = (
        "import sys, numpy; before = set(sys.modules); import curvecore; "
        "print(*{m.partition('.')[0] for m in set(sys.modules) - before} - set(sys.stdlib_module_names))"
    )
    loaded = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert set(loaded.stdout.split()) <= {"curvecore", "numpy"}


def test_a_number_is_accepted_while_another_thread_imports_masked_arrays(monkeypatch):
    """The module was there, but not yet its classes: AttributeError in the middle of a drag."""
    monkeypatch.setitem(sys.modules, "numpy.ma", ModuleType("numpy.ma"))
    curve = LagrangeCurve([(0, 0), (1, 2)], [0, 1])
    assert curve.evaluate(0.5).tolist() == [0.5, 1.0]
