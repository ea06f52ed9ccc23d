"""SciPy's own tests of interpolators, as they stand in the installed SciPy, on curves behind SciPy's face.

Each test below is a function of ``scipy.interpolate.tests``, in which the names of SciPy's interpolators
stand for the adapters of ``scipy_faces``. Nothing of SciPy's is copied here; its tests are BSD-3-Clause,
copyright (c) 2001-2002 Enthought, Inc., 2003 SciPy Developers. Where SciPy is installed without its tests,
these are left out.

Tests of the same classes that do not apply, each with its reason, are in `NOT_APPLIED`; what SciPy adds to
these classes is run like the rest. Not looked at are classes of which there is no counterpart here: PPoly,
BPoly and NdPPoly themselves (curves go there and back by ``to_bpoly`` and ``from_bpoly``: test_calculus.py),
interp1d and interp2d (rules by name), BSpline (knots of all kinds and degrees; a BSplineCurve is clamped and
cubic), smoothing splines, radial basis functions, grids, AAA.
"""

import inspect
from importlib import import_module
from itertools import product
from types import SimpleNamespace

import numpy as np
import pytest
import scipy

from .scipy_faces import (
    AkimaFace,
    CubicHermiteFace,
    CubicSplineFace,
    Face,
    FloaterHormannFace,
    PchipFace,
    PolynomialFace,
    pchip_interpolate,
    polynomial_interpolate,
)

pytest.importorskip("scipy.interpolate.tests.test_polyint", reason="this SciPy comes without its tests")


def _module(name):
    """A module of SciPy's tests; an empty one where this SciPy has none of the name."""
    try:
        return import_module(f"scipy.interpolate.tests.{name}")
    except ModuleNotFoundError:
        return SimpleNamespace()


_POLYINT = _module("test_polyint")
_INTERPOLATE = _module("test_interpolate")
_RATIONAL = _module("test_bary_rational")
FACES = {
    "KroghInterpolator": PolynomialFace,
    "BarycentricInterpolator": PolynomialFace,
    "krogh_interpolate": polynomial_interpolate,
    "barycentric_interpolate": polynomial_interpolate,
    "CubicHermiteSpline": CubicHermiteFace,
    "CubicSpline": CubicSplineFace,
    "make_interp_spline": CubicSplineFace,
    "FloaterHormannInterpolator": FloaterHormannFace,
    "PchipInterpolator": PchipFace,
    "pchip": PchipFace,
    "pchip_interpolate": pchip_interpolate,
    "Akima1DInterpolator": AkimaFace,
}
FUNCTIONS = (
    "test_shapes",
    "test_derivs_shapes",
    "test_deriv_shapes",
    "test_complex",
    "test_CubicHermiteSpline_correctness",
    "test_CubicHermiteSpline_error_handling",
    "test_roots_extrapolate_gh_11185",
)
CLASSES = {
    "TestKrogh": _POLYINT,
    "TestBarycentric": _POLYINT,
    "TestPCHIP": _POLYINT,
    "TestCubicSpline": _POLYINT,
    "TestZeroSizeArrays": _POLYINT,
    "TestAkima1DInterpolator": _INTERPOLATE,
    "TestFloaterHormann": _RATIONAL,
}
_COMPLEX = "points are real"
_EXACT_ZERO = "asks for a 0 without any rounding; TestBarycentric asks the same with 1e-12, and is run"
_UNCHANGING = "curves never change: another one is made"
_POLES = "asks for poles, roots or residues in the complex plane"
NOT_APPLIED = {
    "test_complex": _COMPLEX,
    "test_roots_extrapolate_gh_11185": "asks for roots outside the domain, which `roots` does not look at",
    "TestKrogh.test_derivatives_complex": _COMPLEX
    + ", and derivatives of any number at a node another family",
    "TestKrogh.test_high_degree_warning": "asks for a warning of lost digits; none are lost",
    "TestKrogh.test_ndim_derivatives": _EXACT_ZERO,
    "TestKrogh.test_ndim_derivative": _EXACT_ZERO,
    "TestBarycentric.test_delayed": _UNCHANGING,
    "TestBarycentric.test_append": _UNCHANGING,
    "TestCubicSpline.test_dtypes": _COMPLEX,
    "TestCubicSpline.test_incorrect_inputs": "asks for refusals of conditions of its own",
    "TestAkima1DInterpolator.test_eval_mod": "asks for the modified rule of Akima",
    "TestAkima1DInterpolator.test_extend": _UNCHANGING,
    "TestAkima1DInterpolator.test_no_overflow": "asks for the modified rule, too; the other half is below",
    "TestFloaterHormann.test_iv": "asks for SciPy's words; those of the core are tried in test_validation.py",
    "TestFloaterHormann.test_uniform_grid": "asks for the weights, which a curve keeps to itself",
    "TestFloaterHormann.test_complex": _COMPLEX,
    "TestFloaterHormann.test_zeros": _POLES + ", one of them 1e-16 outside the domain",
    "TestFloaterHormann.test_no_poles": _POLES,
    "TestFloaterHormann.test_batch": _POLES,
}


def functions():
    """All test functions that are looked at, by their names."""
    for name in FUNCTIONS:
        if hasattr(_POLYINT, name):
            yield name, getattr(_POLYINT, name)
    for class_name, module in CLASSES.items():
        for name, function in vars(getattr(module, class_name, object)).items():
            if name.startswith("test"):
                yield f"{class_name}.{name}", function


def arguments(function):
    """The arguments with which pytest would call a function, a dictionary each."""
    rows = [{}]
    for mark in getattr(function, "pytestmark", []):
        if mark.name == "parametrize":
            names, values = mark.args[0].split(","), mark.args[1]
            found = [dict(zip(names, each if len(names) > 1 else (each,), strict=True)) for each in values]
            rows = [{**row, **each} for row, each in product(rows, found)]
    if "xp" in inspect.signature(function).parameters:
        rows = [{**row, "xp": np} for row in rows]
    return [{key: face_of(value) for key, value in row.items()} for row in rows]


def face_of(value):
    return FACES.get(getattr(value, "__name__", ""), value) if callable(value) else value


TESTS = dict(functions())
CASES = {
    f"{name}[{index}]" if index else name: (name, each)
    for name, function in TESTS.items()
    if name not in NOT_APPLIED
    for index, each in enumerate(arguments(function))
}


def same_at_both_ends(self, x, y, axis):
    """In place of SciPy's check: of conditions that differ at both ends, or give a value, there are none."""
    for ends in ("not-a-knot", "natural", "clamped"):
        self.check_correctness(CubicSplineFace(x, y, axis=axis, bc_type=ends), ends, ends)


@pytest.fixture
def faces(monkeypatch):
    for module in (_POLYINT, _INTERPOLATE, _RATIONAL):
        for name, face in FACES.items():
            if hasattr(module, name):
                monkeypatch.setattr(module, name, face)
    if hasattr(_POLYINT.TestCubicSpline, "check_all_bc"):
        monkeypatch.setattr(_POLYINT.TestCubicSpline, "check_all_bc", same_at_both_ends)


@pytest.mark.usefixtures("faces")
@pytest.mark.parametrize("case", CASES)
def test_scipy(case):
    name, given = CASES[case]
    class_name, dot, method = name.partition(".")
    if not dot:
        TESTS[name](**given)
        return
    it = getattr(CLASSES[class_name], class_name)()
    if hasattr(it, "setup_method"):
        it.setup_method()
    getattr(it, method)(**given)


def test_every_skipped_test_of_scipy_exists_and_has_a_reason():
    """A name that SciPy gave up would hide here; older SciPys lack some."""
    assert all(NOT_APPLIED.values())
    if tuple(map(int, scipy.__version__.split(".")[:2])) >= (1, 17):
        assert set(NOT_APPLIED) <= set(TESTS)


def test_a_large_jump_leaves_akima_finite():
    """The data of SciPy's test_no_overflow."""
    x = np.arange(1, 10)
    y = 1e6 * np.sqrt(np.finfo(float).max) * np.heaviside(x - 4, 0.5)
    assert np.isfinite(AkimaFace(x, y)(x)).all()


@pytest.mark.usefixtures("faces")
@pytest.mark.parametrize("name", ["TestKrogh.test_lagrange", "TestCubicSpline.test_three_points"])
def test_the_suite_of_scipy_tries_the_curves(name, monkeypatch):
    plain = Face.__call__
    monkeypatch.setattr(Face, "__call__", lambda self, *given, **more: plain(self, *given, **more) + 1.0)
    with pytest.raises(AssertionError):
        test_scipy(name)
