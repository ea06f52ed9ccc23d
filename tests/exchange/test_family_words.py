"""Families in the cells of a table of points: with what is set of them, and back."""

import pytest
from msgspec.structs import replace

from app.document.model import Document, make_curve
from app.exchange.files import export, import_file
from app.exchange.options import Options
from app.exchange.table.columns import family_cell, read_family_cell
from app.families import FAMILIES, HERMITE, NO_SETTINGS, FamilySettingValues
from app.view_model.curve.curve_view import view_of
from tests.own_families import EVERY
from tests.rows import each_row

POINTS = [(0.0, 0.0), (1.0, 2.0), (2.5, 1.0), (4.0, 3.0), (5.0, 0.5)]

pytestmark = pytest.mark.usefixtures("own_families")


def other_value(setting):
    if setting.choices:
        values = [value for value, _ in setting.choices]
    elif setting.is_whole:
        values = range(setting.limits[0], setting.limits[1] + 1)
    else:
        values = [sum(setting.limits) / 3 + 1 / 7]  # with digits to the last one
    return next(value for value in values if value != setting.default)


@each_row("name", [*EVERY, "tests_swaying"])
def test_every_setting_survives_a_table_of_points(name, tmp_path):
    family = FAMILIES.named(name)
    settings = FamilySettingValues((setting.name, other_value(setting)) for setting in family.settings.all)
    curve = replace(make_curve(POINTS, family=family), settings=settings)
    assert read_family_cell(family_cell(curve)) == (family, False, settings)
    path = tmp_path / "curve.points.csv"
    export(Document((curve,)), path, Options())
    (again,) = import_file(path).document.curves
    assert (again.family, again.settings) == (family, settings)
    assert (view_of(again).curve.evaluate(0.3) == view_of(curve).curve.evaluate(0.3)).all()


def test_a_family_cell_contains_family_closing_and_settings():
    family = FAMILIES.named("tests_swaying")
    curve = replace(make_curve(POINTS, family=family), settings=FamilySettingValues({"amount": 5}))
    assert family_cell(curve) == "tests_swaying amount=5"
    assert family_cell(replace(make_curve(POINTS, family=HERMITE), closed=True)) == "closed hermite"
    assert read_family_cell(" Closed  Hermite ") == (HERMITE, True, NO_SETTINGS)
    assert not read_family_cell("tests_swaying amount=2").settings


@each_row(
    ("text", "words"),
    [
        ("tests_swaying amount=10", "tests_swaying with amount= and a whole number from 0 to 9"),
        ("tests_swaying amount=x", "a whole number from 0 to 9"),
        ("tests_swaying first_side=up", "one of left, right"),
        ("tests_swaying speed=1", "tests_swaying amount=2, tests_swaying first_side=left"),
        ("hermite amount=1", "hermite alone, which has no settings"),
        ("", "one of lagrange, hermite"),
        ("closed", "one of lagrange, hermite"),
    ],
)
def test_unknown_family_words_are_refused(text, words):
    with pytest.raises(ValueError, match=words):
        read_family_cell(text)
