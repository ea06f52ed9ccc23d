"""Families that a person wrote in a file: what one may say, and every mistake with its file and line."""

from __future__ import annotations

import errno
import json
import os
import re
import time
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from types import SimpleNamespace

import numpy as np
import pytest

from app.cli import main
from app.document.model import Document, make_curve
from app.families import FAMILIES, HERMITE, Family, family_file
from app.families.family import families_of_module
from app.families.family_file import (
    PATIENCE,
    FamilyFileError,
    FileCalls,
    families_in,
    families_of_files,
    forget_file,
    use_file,
)
from app.storage.format import encode
from curvecore import CurveError, cardinal_defect, families
from tests.effort import noted_calls
from tests.own_families import FILES

GAUSSIAN = '''"""Bells that are made cardinal.

The narrower, the calmer.
"""

import numpy as np

name = "my_gaussian"
title = "Gaussian"


def _bells(t, parameters):
    width = (parameters[-1] - parameters[0]) / len(parameters)
    return np.exp(-(((t[:, None] - parameters) / width) ** 2))


def basis(t, parameters):
    return _bells(t, parameters) @ np.linalg.inv(_bells(parameters, parameters))
'''
HATS = '''import numpy as np

name = "hats"
can_close = True


def breaks(parameters):
    return parameters


def basis(t, parameters, order):
    """Polylines."""
    hats = np.stack([np.interp(t, parameters, row) for row in np.eye(len(parameters))], axis=1)
    if order == 0:
        return hats
    segment = np.clip(np.searchsorted(parameters, t, side="right") - 1, 0, len(parameters) - 2)
    slopes = np.zeros((len(t), len(parameters)))
    h = np.diff(parameters)[segment]
    slopes[np.arange(len(t)), segment], slopes[np.arange(len(t)), segment + 1] = -1 / h, 1 / h
    return slopes if order == 1 else 0.0 * hats
'''
OWN_CLASS = '''import numpy as np
from curvecore import HermiteCurve


class Stiff(HermiteCurve):
    """Pieces with a stop at every point."""

    __slots__ = ()
    name = "stiff"
    title = "stiff"

    def __init__(self, points, velocities, parameters):
        super().__init__(points, np.zeros(np.shape(points)), parameters)
'''


@pytest.fixture
def write(tmp_path):
    def written(text, name="families.py"):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return written


def test_a_name_and_a_basis_are_enough_and_a_title_is_optional(write):
    (family,) = families_in(write(GAUSSIAN))
    assert (family.name, family.title, family.action_name) == ("my_gaussian", "Gaussian", "familyMyGaussian")
    assert family.tip == "Bells that are made cardinal"
    assert family.derivatives == 0
    assert family.interpolates
    assert not family.curve_class.can_close
    assert not family.curve_class.is_local
    points = np.array([[0.0, 0.0], [1.0, 2.0], [3.0, 1.0]])
    curve = family.make(points[:, None], [0.0, 0.4, 1.0])
    assert np.array_equal(curve.evaluate(curve.parameters), points)
    assert curve.degree is None


def test_breaks_derivatives_and_closing(write):
    (family,) = families_in(write(HATS))
    assert family.title == "hats"
    assert family.tip == "Polylines"
    assert family.curve_class.can_close
    curve = family.make(np.array([[[0.0, 0.0]], [[2.0, 4.0]], [[3.0, 0.0]]]), [0.0, 1.0, 2.0])
    assert curve.breaks.tolist() == [0.0, 1.0, 2.0]
    assert curve.evaluate(0.5, 1).tolist() == [2.0, 4.0]


BELLS = """from curvecore import FamilySetting
import numpy as np

name = "bells"
settings = [
    FamilySetting("width", "width of a bell", 3, limits=(1, 9)),
    FamilySetting("shape", "shape", "round", choices=(("round", "Round"), ("pointed", "Pointed"))),
]


def breaks(parameters, shape):
    return parameters if shape == "pointed" else parameters[[0, -1]]


def bells(t, parameters, width, shape):
    away = np.abs(t[:, None] - parameters) * len(parameters) / width
    return np.exp(-away**2) if shape == "round" else np.exp(-away)


def basis(t, parameters, shape, width):
    return bells(t, parameters, width, shape) @ np.linalg.inv(bells(parameters, parameters, width, shape))
"""


def test_settings_of_a_file_s_functions(write):
    (family,) = families_in(write(BELLS))
    assert [each.name for each in family.settings.all] == ["width", "shape"]
    points, parameters = np.array([[[0.0]], [[2.0]], [[1.0]], [[3.0]]]), np.arange(4.0)
    curves = [
        family.make(points, parameters, chosen)
        for chosen in ({}, {"width": 3}, {"width": 1}, {"shape": "pointed"})
    ]
    values = [float(curve.evaluate(0.5)[0]) for curve in curves]
    assert values[0] == values[1]
    assert len(set(values)) == 3
    assert curves[2].chosen == {"width": 1, "shape": "round"}
    assert curves[2].with_data(points, parameters).evaluate(0.5) == curves[2].evaluate(0.5)
    assert curves[2].functions_key == curves[2].with_jets(2.0 * points).functions_key
    assert curves[2].functions_key != curves[0].functions_key
    assert curves[3].breaks.tolist() == parameters.tolist()
    assert curves[0].breaks.tolist() == [0.0, 3.0]


def test_the_order_may_be_declared_anywhere(write):
    setting = 'settings = [curvecore.FamilySetting("slope", "slope", 1, limits=(1, 2))]'
    text = HATS.replace("order):", "slope, order):").replace("return slopes", "return slope * slopes")
    text = text.replace("can_close = True", f"import curvecore\n{setting}")
    (family,) = families_in(write(text))
    curve = family.make(np.array([[[0.0]], [[2.0]]]), [0.0, 1.0], {"slope": 2})
    assert curve.evaluate([0.5, 0.5], 1).tolist() == [[4.0], [4.0]]


@pytest.mark.parametrize(
    ("before", "after", "said"),
    [
        ("settings = [\n", "settings = [\n    4,\n", "settings must be a list of FamilySetting, not of 4"),
        (
            "3, limits",
            "30, limits",
            "the default of the setting “width” must be a whole number from 1 to 9, not 30",
        ),
        ('"width", "width', '"breadth", "width', "no function takes the setting “breadth”, as basis(t, par"),
    ],
)
def test_a_mistake_in_settings_is_reported(write, before, after, said):
    with pytest.raises(FamilyFileError, match=re.escape(said)):
        families_in(write(BELLS.replace(before, after)))


def test_a_class_of_the_core_s_kind(write):
    (family,) = families_in(write(OWN_CLASS))
    assert (family.name, family.derivatives, family.curve_class.can_close) == ("stiff", 1, True)


def test_a_curve_may_pass_beside_its_points(write):
    text = GAUSSIAN.replace('title = "Gaussian"', "interpolates = False").replace(
        "@ np.linalg.inv(_bells(parameters, parameters))", "/ len(parameters)"
    )
    (family,) = families_in(write(text))
    assert not family.interpolates
    curve = family.make(np.ones((3, 1, 2)), [0.0, 0.5, 1.0])
    assert curve.evaluate(0.5)[0] < 1.0


def test_a_family_with_functions_that_are_not_cardinal_is_drawn_beside_its_points(write):
    """Such a file was refused; what is wrong with it is measured instead."""
    text = GAUSSIAN.replace("parameters))\n", "parameters)) * 1.5\n")
    (family,) = families_in(write(text))
    assert not family.interpolates
    points = np.array([[[1.0, 0.0]], [[0.0, 2.0]], [[3.0, 1.0]]])
    curve = family.make(points, [0.0, 0.4, 1.0])
    assert curve.evaluate(0.4) == pytest.approx([0.0, 3.0])
    assert cardinal_defect(curve).value == pytest.approx(1.5)


MISTAKES = {
    "no file": (None, "cannot be read: {reason}."),
    "nothing": ("x = 1", "defines no family: it needs a name and a function basis(t, parameters)"),
    "no name": (GAUSSIAN.replace('name = "my_gaussian"', ""), "must define its name"),
    "a long name": (GAUSSIAN.replace('"my_gaussian"', '"Gaussian bells"'), "must define its name"),
    "a name that is taken": (
        GAUSSIAN.replace('"my_gaussian"', '"hermite"'),
        "a family named “hermite” already exists",
    ),
    "syntax": (GAUSSIAN.replace("def basis(t", "def basis(:t"), "line 17: invalid syntax"),
    "an import": (GAUSSIAN.replace("import numpy", "import nowhere, numpy"), "line 6: ModuleNotFoundError"),
    "no function": (HATS.replace("def basis", "basis = 3\ndef other"), "basis must be a function, not 3"),
    "a fact of the wrong kind": (HATS.replace("= True", "= 1"), "can_close must be bool, not 1"),
    "another shape": (
        GAUSSIAN.replace("_bells(t, parameters) @", "np.ones((1, 2)) @"),
        "must have the shape (m, n)",
    ),
    "an error within": (
        GAUSSIAN.replace("_bells(t, parameters) @", "(1 / 0) *"),
        "line 18: ZeroDivisionError",
    ),
    "no number": (
        GAUSSIAN.replace("return _bells(t,", "return np.nan * _bells(t,"),
        "line 17: the basis of my_gaussian is nan",
    ),
    "an end of the program": (
        GAUSSIAN.replace("import numpy", "import sys; sys.exit(0)\nimport numpy"),
        "line 6: SystemExit: 0",
    ),
    "an end within": (
        GAUSSIAN.replace("_bells(t, parameters) @", "exit('bye') @"),
        "line 18: SystemExit: bye",
    ),
    "what is no Exception": (
        GAUSSIAN.replace("import numpy", "raise BaseException('odd')\nimport numpy"),
        "line 6: BaseException: odd",
    ),
    "breaks that fall": (
        HATS.replace("return parameters", "return -parameters"),
        "must be finite and strictly",
    ),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_is_reported_with_file_and_line_and_adds_no_family(write, mistake, capsys):
    text, complaint = MISTAKES[mistake]
    complaint = complaint.replace("{reason}", os.strerror(errno.ENOENT))
    good = write(HATS, "good.py")
    bad = write(text, "bad.py") if text is not None else good.parent / "bad.py"
    before = list(FAMILIES)
    with pytest.raises(FamilyFileError) as caught, families_of_files(FAMILIES, [str(good), str(bad)]):
        raise AssertionError
    assert str(caught.value).startswith(f"“{bad}”")
    assert complaint in str(caught.value)
    assert list(FAMILIES) == before
    assert main(["--families", str(bad), "info", "nothing.curve.json"]) == 1
    error = capsys.readouterr().err
    assert complaint in error
    assert error.count("\n") == 1


@pytest.fixture
def stopped(monkeypatch):
    """The calls of a file's functions that were stopped for want of time: each made somebody wait."""
    return noted_calls(monkeypatch, FileCalls, "_refuse_overdue")


@pytest.fixture
def short_limits(monkeypatch):
    monkeypatch.setattr(family_file, "RUN_SECONDS", 0.2)
    monkeypatch.setattr(family_file, "CALL_SECONDS", 0.2)
    monkeypatch.setattr(PATIENCE, "seconds", 0.2)
    monkeypatch.setattr(PATIENCE, "overdue", None)


def test_an_endless_loop_is_stopped_and_its_line_reported(write, short_limits):
    path = write(GAUSSIAN.replace("import numpy", "while True: pass\nimport numpy"))
    with pytest.raises(FamilyFileError, match=r"line 6: it ran for longer than 0\.2 s and was stopped"):
        families_in(path)
    path = write(GAUSSIAN.replace("    return _bells(t", "    while True:\n        t\n    return _bells(t"))
    with pytest.raises(FamilyFileError, match=r"line 1[89]: it ran for longer than 0\.2 s and was stopped"):
        families_in(path)


def test_functions_that_hang_at_some_parameters_are_stopped_once(write, short_limits, stopped):
    """In a window they are asked for every frame."""
    hang = "    while len(parameters) == 5 and parameters[1] == 0.2:\n        pass\n    return _bells(t"
    (family,) = families_in(write(GAUSSIAN.replace("    return _bells(t", hang)))
    points = np.zeros((5, 1, 2))
    good = family.make(points, np.linspace(0.0, 1.0, 5))
    said = (
        r"“families.py”, line 1[89]: the family “Gaussian” ran for longer than 0\.2 s for 5 points and was st"
    )
    for _frame in range(50):
        with pytest.raises(CurveError, match=said):
            family.make(points, [0.0, 0.2, 0.5, 0.8, 1.0])
    # Nor are other parameters tried: each might hang, and take that long.
    with pytest.raises(CurveError, match=said):
        family.make(points, [0.0, 0.3, 0.5, 0.8, 1.0])
    assert len(stopped) == 1
    # What is shown stays, and so do curves of other numbers of points.
    assert np.isfinite(good.evaluate(0.3)).all()
    assert np.isfinite(family.make(points[:4], np.linspace(0.0, 1.0, 4)).evaluate(0.3)).all()


def test_a_loop_that_passes_over_mistakes_is_stopped_as_well(write, short_limits):
    """The alarm was a mistake like any other, and rang but once: the window stood still for good."""
    loop = """    while True:
        try:
            while True:
                t
        except Exception:
            pass
"""
    path = write(GAUSSIAN.replace("    return _bells(t", f"{loop}    return _bells(t"))
    with pytest.raises(
        FamilyFileError, match=r"line (19|2\d): it ran for longer than 0\.2 s and was stopped"
    ):
        families_in(path)


def test_a_call_that_waits_is_stopped(write, short_limits, monkeypatch):
    monkeypatch.setattr(family_file, "_longest_wait", lambda seconds: 1.5 * seconds)
    path = write(
        GAUSSIAN.replace("    return _bells(t", "    import time; time.sleep(60)\n    return _bells(t")
    )
    with pytest.raises(FamilyFileError, match=r"line 18: it ran for longer than 0\.2 s and was stopped"):
        families_in(path)


def test_time_of_other_processes_does_not_count(write, short_limits, monkeypatch):
    """Beside busy programs a file was stopped 1 s after its limit, however little it had worked."""
    slow = SimpleNamespace(monotonic=lambda: 10.0 * time.monotonic(), thread_time=time.thread_time)
    monkeypatch.setattr(family_file, "time", slow)
    monkeypatch.setattr(family_file, "_longest_wait", lambda _seconds: 1000.0)
    families_in(write(f"import time\ntime.sleep(0.3)\n{GAUSSIAN}"))


NEW = GAUSSIAN.replace("my_gaussian", "my_bells").replace('"Gaussian"', '"bells"')


@pytest.fixture
def registry():
    return type(FAMILIES)([HERMITE])


def test_a_changed_file_changes_its_family_in_open_documents(write, registry):
    path, point = write(GAUSSIAN), np.array([[[0.0, 0.0]], [[1.0, 2.0]], [[3.0, 1.0]]])
    known = registry.named("my_gaussian")
    assert known.is_missing
    use_file(registry, path)
    assert registry[-1] is known
    first = known.make(point, [0.0, 0.5, 1.0])
    write(GAUSSIAN.replace("return _bells(t,", "return 2.0 * _bells(t,").replace('"Gaussian"', '"Doubled"'))
    assert use_file(registry, path) == {known}
    assert (known.title, known.interpolates, len(registry)) == ("Doubled", False, 2)
    second = known.make(point, [0.0, 0.5, 1.0])
    assert known.makes(second)
    assert not known.makes(first)
    assert second.evaluate(0.3) == pytest.approx(2.0 * first.evaluate(0.3))


@pytest.mark.parametrize("text", ["x = (", "exit()", NEW.replace("my_bells", "hermite")])
def test_a_mistake_keeps_the_last_valid_family(write, registry, text):
    path = write(GAUSSIAN)
    use_file(registry, path)
    family = registry[-1]
    curve = family.make(np.zeros((2, 1, 2)), [0.0, 1.0])
    write(text)
    with pytest.raises(FamilyFileError):
        use_file(registry, path)
    assert list(registry) == [HERMITE, family]
    assert family.makes(curve)


def test_a_family_removed_from_its_file_is_not_offered_and_still_draws(write, registry):
    path = write(GAUSSIAN)
    use_file(registry, path)
    old = registry[-1]
    write(NEW)
    assert {each.name for each in use_file(registry, path)} == {"my_gaussian", "my_bells"}
    assert [each.name for each in registry] == ["hermite", "my_bells"]
    assert not old.is_missing
    write(GAUSSIAN)
    use_file(registry, path)
    assert registry[-1] is old
    forget_file(registry, path)
    assert list(registry) == [HERMITE]
    assert old.is_missing
    assert registry.files == {}


def test_a_family_name_of_another_file_is_refused(write, registry):
    use_file(registry, write(GAUSSIAN))
    with pytest.raises(FamilyFileError, match="a family named “my_gaussian” already exists"):
        use_file(registry, write(GAUSSIAN, "second.py"))
    twice = OWN_CLASS + OWN_CLASS.replace("class Stiff", "class Stiffer")
    with pytest.raises(FamilyFileError, match="a family named “stiff” already exists"):
        use_file(registry, write(twice, "second.py"))


def test_no_compiled_copy_is_left_beside_the_file(write):
    path = write(GAUSSIAN)
    families_in(path)
    assert [each.name for each in path.parent.iterdir()] == [path.name]


@pytest.fixture
def document(tmp_path):
    path = tmp_path / "bells.curve.json"
    curve = make_curve([(0, 0), (1, 2), (3, 1), (4, 3)], family=Family("my_gaussian", None))
    path.write_bytes(encode(Document((curve,))))
    return path


def test_info_states_that_the_degree_is_per_segment(tmp_path, capsys):
    """It said so only of families with derivatives."""
    curve = make_curve([(0, 0), (1, 2), (3, 1), (4, 3)], family=Family("tests_natural_spline", None))
    path = tmp_path / "spline.curve.json"
    path.write_bytes(encode(Document((curve,))))
    (file,) = (each for each in FILES if each.stem == "natural_spline")
    assert main(["info", "--families", str(file), str(path)]) == 0
    rows = {line[2:18].rstrip(): line[19:] for line in capsys.readouterr().out.splitlines()[1:]}
    assert rows["degree"] == "3 on every segment"


@pytest.mark.parametrize("place", ["before the verb", "behind it", "with ="])
def test_every_verb_accepts_a_family_file(write, document, tmp_path, capsys, place):
    path = write(GAUSSIAN)
    option = [f"--families={path}"] if place == "with =" else ["--families", str(path)]

    def run(verb, *words):
        return main([*option, verb, *words] if place == "before the verb" else [verb, *words, *option])

    assert run("info", "--json", str(document)) == 0
    facts = json.loads(capsys.readouterr().out)["curves"][0]
    assert (facts["family"], facts["degree"], facts["warnings"]) == ("my_gaussian", None, [])
    assert run("render", str(document), "-o", str(tmp_path / "a.svg")) == 0
    assert run("convert", str(document), str(tmp_path / "a.csv")) == 0
    assert (
        run("convert", "--family", "my_gaussian", str(tmp_path / "a.csv"), str(tmp_path / "b.curve.json"))
        == 0
    )
    assert json.loads((tmp_path / "b.curve.json").read_text())["curves"][0]["family"] == "my_gaussian"
    assert run("lesson") == 0
    assert "my_gaussian" not in [family.name for family in FAMILIES]


def test_help_names_the_option_and_a_missing_file_name_is_wrong_usage(capsys):
    for words in (["--help"], ["info", "--help"], ["convert", "--help"], ["render", "--help"]):
        with pytest.raises(SystemExit) as ended:
            main(words)
        assert ended.value.code == 0
        assert "--families FILE.py" in capsys.readouterr().out
    with pytest.raises(SystemExit) as ended:
        main(["info", "a.curve.json", "--families"])
    assert ended.value.code == 2
    assert "expected one argument" in capsys.readouterr().err


def test_an_installed_package_adds_a_family(tmp_path, monkeypatch):
    """As an entry point does: a package on the path whose metadata names the class."""
    (tmp_path / "stiff_curves.py").write_text(OWN_CLASS)
    info = tmp_path / "stiff_curves-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: stiff-curves\nVersion: 1.0\n")
    points = "[curvebench.families]\nstiff = stiff_curves:Stiff\nlost = stiff_curves:Lost\n"
    (info / "entry_points.txt").write_text(points)
    monkeypatch.syspath_prepend(tmp_path)
    families = type(FAMILIES)([HERMITE])
    assert [family.name for family in families] == ["hermite", "stiff"]
    assert len(families.problems) == 1
    assert "“lost”" in families.problems[0]


def test_the_file_of_the_readme_is_a_family(write):
    readme = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")
    (text,) = (
        block for block in re.findall(r"```python\n(.*?)```", readme, re.DOTALL) if "def basis" in block
    )
    (family,) = families_in(write(text))
    assert family.name == "gaussian"


def test_the_folder_of_the_core_lists_exactly_its_families():
    modules = [import_module(f"curvecore.families.{each.name}") for each in iter_modules(families.__path__)]
    found = {each.name for module in modules for each in families_of_module(module)}
    assert found == {family.name for family in FAMILIES} >= {"lagrange", "hermite", "quintic_hermite"}
