"""Code out: executed here, it gives the curves."""

import ast
import re

import numpy as np
import pytest
from PySide6.QtQml import QJSEngine

from app.document.model import (
    Document,
    Parametrization,
    ParametrizationKind,
    make_curve,
)
from app.exchange.errors import ExchangeError
from app.exchange.exported_curves import curves_of, deviation_text, samples_of
from app.exchange.formats.code import (
    gdscript_code,
    identifiers_of,
    javascript_code,
    python_code,
    scipy_code,
)
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
    for name, source in zip(identifiers_of(source.name for source in sources.curves), sources, strict=True):
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
    names = identifiers_of(curve.name for curve in curves_of(gallery).curves)
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


# JavaScript and GDScript


@pytest.fixture(scope="module")
def engine(qapp):
    """Qt's interpreter of JavaScript."""
    return QJSEngine()


def javascript_functions(engine, path, text):
    path.write_text(text, encoding="utf-8")
    module = engine.importModule(str(path))
    assert not module.isError(), module.toString()

    def function_of(name):
        def call(t):
            point = module.property(name).call([float(t)])
            assert not point.isError(), point.toString()
            return [point.property(axis).toNumber() for axis in (0, 1)]

        return call

    return function_of


def gdscript_functions(text):
    """The functions of a script, its statements translated to Python; vectors have single precision."""
    changes = (
        (r"^static func (\w+)\((\w+)(?:: \w+)?(?:, (\w+): \w+)?\) -> Vector2:", r"def \1(\2, \3):"),
        (r"def (\w+)\((\w+), \):", r"def \1(\2):"),
        (r"\bvar (\w+)(?:: \w+ =| :=)", r"\1 ="),
        (r"^const ", ""),
        (r"curve\.(pieces|ends)", r'curve["\1"]'),
        (r'([\w"\[\]]+)\.size\(\)', r"len(\1)"),
        (r"for (\w+) in (.+):", r"for \1 in range(\2):"),
    )
    for pattern, replacement in changes:
        text = re.sub(pattern, replacement, text, flags=re.MULTILINE)
    namespace = {"Vector2": lambda x, y: np.float32([x, y]).astype(float)}
    exec(compile(text, "exported.gd", "exec"), namespace)
    return namespace.__getitem__


def functions_of(language, engine, folder, document):
    """What the code says of its deviation, and its functions by name, with y up."""
    if language == "javascript":
        written = javascript_code(document)
        return written, javascript_functions(engine, folder / f"{id(document)}.mjs", written.text)
    written = gdscript_code(document)
    get = gdscript_functions(written.text)
    return written, lambda name: lambda t: get(name)(t) * [1, -1]


@pytest.mark.parametrize("language", ["javascript", "gdscript"])
def test_templates_give_the_curve_within_the_stated_deviation(kind, engine, tmp_path, language):
    written, function_of = functions_of(language, engine, tmp_path, kind)
    assert f"{deviation_text(written.deviation, written.is_bound)}, in the unit" in written.text
    sources = curves_of(kind)
    for name, source in zip(identifiers_of(each.name for each in sources.curves), sources, strict=True):
        t = np.concatenate([samples_of(piece) for piece in source.core.pieces])[::5]
        points = np.array([function_of(name)(value) for value in t.tolist()])
        # Rounding of control points, which reach beyond the points.
        room = 64 * 2.0**-53 * np.abs(source.core.jets).max() * len(source.core.points)
        assert np.hypot(*(points - source.core.evaluate(t)).T).max() <= written.deviation + room


def test_a_name_that_is_a_word_of_a_language_is_changed(engine, tmp_path):
    names = ["function", "var", "func", "class", "evaluate", "Größe 1"]
    points = [(0.0, 0.0), (1.0, 2.0)]
    document = Document(tuple(make_curve(points, name=name) for name in names))
    identifiers = identifiers_of(names)
    assert identifiers[:5] == [f"curve_{name}" for name in names[:5]]
    for language in ("javascript", "gdscript"):
        _, function_of = functions_of(language, engine, tmp_path, document)
        for name in identifiers:
            np.testing.assert_allclose(function_of(name)(1.0), points[1])
