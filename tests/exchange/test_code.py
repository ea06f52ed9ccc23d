"""Code out: executed here, it gives the curves."""

import ast

import numpy as np
import pytest

from app.document.model import (
    Document,
    Parametrization,
    ParametrizationKind,
    make_curve,
)
from app.exchange.errors import ExchangeError
from app.exchange.exported_curves import curves_of, samples_of
from app.exchange.formats.code import identifiers_of, python_code, scipy_code
from app.view_model.curve.curve_view import view_of
from tests.rows import each_row


def executed(text):
    namespace = {}
    exec(compile(text, "exported.py", "exec"), namespace)
    return namespace


def distance(document, text, step=1):
    """The largest distance of the exported functions from the curves, against the sum of |B_ir(t) d_ir|.

    That sum times the unit roundoff is what rounding the points alone can change; it is about the size of
    the curve, and far more on a Lagrange curve of high degree with even parameters. Of all samples every
    `step`-th is asked for.
    """
    namespace = executed(text)
    sources = curves_of(document)
    worst = 0.0
    for name, source in zip(identifiers_of(sources), sources, strict=True):
        function = namespace[name]
        t = np.concatenate([samples_of(piece) for piece in source.core.pieces])[::step]
        points = function(t)
        assert points.shape == (len(t), 2)
        terms = np.einsum("mir,ird->md", np.abs(source.core.basis(t)), np.abs(source.core.jets))
        worst = max(worst, (np.abs(points - source.core.evaluate(t)) / terms.max()).max())
    return worst


def test_the_python_code_gives_the_curve_to_1e_12(kind):
    written = python_code(kind)
    curve = view_of(kind.curves[0]).curve
    if curve.degree is None:
        # No polynomial: cubics within the tolerance, and the file says how far they are.
        assert distance(kind, written.text) * np.abs(curve.points).max() <= written.deviation < 1e-4
        return
    assert distance(kind, written.text) < 1e-14
    if curve.degree < 20:
        assert written.deviation < 1e-12


def test_the_python_code_of_the_examples(example):
    assert distance(example, python_code(example).text) < 1e-12


def test_the_python_code_takes_scalars_and_any_shape(sketch):
    function = executed(python_code(sketch).text)["curve_1"]
    assert function(0.25).shape == (2,)
    assert function(np.zeros((2, 3))).shape == (2, 3, 2)


# Of 560 the product of all differences is no number that can be told from 0.
@pytest.mark.parametrize("count", [100, 560])
def test_many_chebyshev_points(count):
    rule = Parametrization(ParametrizationKind.CHEBYSHEV)
    points = np.column_stack([np.linspace(0, 1, count), np.sin(np.linspace(0, 20, count))])
    curve = make_curve(points.tolist())
    document = Document((type(curve)(curve.name, curve.family, rule, curve.points),))
    # Two or three samples between two points.
    assert distance(document, python_code(document).text, step=count // 60) < 1e-12


def test_the_scipy_code_is_within_its_stated_deviation(kind):
    written = scipy_code(kind)
    size = np.abs(view_of(kind.curves[0]).curve.points).max()
    assert distance(kind, written.text) <= 8 * written.deviation / size + 1e-14
    curve = view_of(kind.curves[0]).curve
    if curve.degree is not None and not curve.is_one_polynomial:
        assert written.deviation < 1e-13 * size


def test_the_scipy_code_states_its_loss_of_digits_on_uniform_parameters():
    rule = Parametrization(ParametrizationKind.UNIFORM)
    curve = make_curve(np.random.default_rng(1).normal(size=(25, 2)).tolist())
    document = Document((type(curve)(curve.name, curve.family, rule, curve.points),))
    written = scipy_code(document)
    assert written.deviation > 1e-12
    assert distance(document, written.text) > 1e-13


def test_several_curves_get_distinct_identifiers(gallery):
    names = identifiers_of(curves_of(gallery))
    assert names[-2:] == ["ring", "ring_2"]
    assert len(set(names)) == len(names)
    for write in (python_code, scipy_code):
        written = write(gallery)
        ast.parse(written.text)
        assert "# Curvebench " in written.text
        assert "“begun”: A curve needs at least two points." in written.text
        assert written.remarks


@each_row("name", ["", "class", "2 fast", "évaluate", "np", "x\n__import__('os')", "‖"])
def test_hostile_names_stay_in_comments(name):
    document = Document((make_curve([(0, 0), (1, 1)], name=name),))
    for write in (python_code, scipy_code):
        tree = ast.parse(write(document).text)
        called = {
            node.func.id for node in ast.walk(tree) if isinstance(node, ast.Call) and hasattr(node.func, "id")
        }
        assert called <= {"evaluate", "lagrange", "hermite", "len", "enumerate", "range"}


def test_nothing_to_write_is_refused(nothing):
    for write in (python_code, scipy_code):
        with pytest.raises(ExchangeError, match="There is nothing to export"):
            write(nothing)
