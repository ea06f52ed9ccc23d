"""A document with a family that this program does not have: it opens, and is saved unchanged."""

from __future__ import annotations

import copy
import json
import pickle

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QToolButton

from app.cli import main
from app.document.model import Document, make_curve
from app.families import FAMILIES, HERMITE, LAGRANGE, Family
from app.storage.format import decode, encode
from app.storage.resources import resource

NAME = "my_gaussian"
MISSING = "The family “my_gaussian” is not available"
POINTS = ((0.0, 0.0), (1.0, 2.0), (3.0, 1.0), (4.0, 3.0))


@pytest.fixture
def path(tmp_path):
    """A document with such a curve and, second, a curve of a family that is here."""
    document = Document(
        (make_curve(POINTS, family=Family(NAME, None)), make_curve(POINTS[::-1], name="Other"))
    )
    path = tmp_path / "theirs.curve.json"
    path.write_bytes(encode(document))
    return path


@pytest.fixture
def opened(editor, path):
    editor.session.open(path)
    return editor


def test_a_file_with_a_missing_family_is_read_and_written_unchanged(path):
    data = path.read_bytes()
    assert json.loads(data)["curves"][0]["family"] == NAME
    document = decode(data)
    family = document.curves[0].family
    assert family.is_missing
    assert family == FAMILIES.named(NAME) == pickle.loads(pickle.dumps(family)) == copy.deepcopy(family)
    assert encode(document) == data


def test_a_file_with_a_missing_family_opens_and_the_message_names_the_family(opened):
    assert MISSING in opened.message
    assert opened.session.active_view.curve is None
    assert not any(opened.action(family.action_name).isChecked() for family in FAMILIES)
    # Nothing is wrong with the parameters.
    assert not opened.window.message_bar.findChild(QToolButton, "offeredAction").isVisible()
    rows = opened.window.findChild(object, "curveList").model()
    said = [rows.index(row, 0).data(Qt.ItemDataRole.AccessibleTextRole) for row in range(rows.rowCount())]
    assert any("my_gaussian (not installed), 4 points" in text for text in said)


def test_points_of_a_missing_family_can_be_dragged_typed_and_undone(opened, path):
    before = path.read_bytes()
    opened.drag_point(1, (1.5, 2.5))
    assert opened.point(1) == pytest.approx((1.5, 2.5), abs=2 * opened.pixel)
    table = opened.window.point_table.model()
    assert not any(column.is_derivative for column in table.columns)
    assert table.setData(table.index(2, 1), 3.25)
    assert opened.point(2) == (3.25, 1.0)
    assert opened.curve.family.name == NAME
    opened.trigger("undo")
    opened.trigger("undo")
    opened.session.save()
    assert path.read_bytes() == before


def test_a_point_that_moved_is_all_that_is_saved_otherwise(opened, path):
    before = json.loads(path.read_bytes())
    opened.drag_point(0, (-1.0, -1.0))
    opened.session.save()
    after = json.loads(path.read_bytes())
    moved = after["curves"][0]["points"][0]
    assert (moved["x"], moved["y"]) == opened.point(0)
    after["curves"][0]["points"][0] = before["curves"][0]["points"][0]
    assert after == before


NEED_THE_CURVE = ["splitCurve", "joinCurve", "reverseCurve", "closeCurve", "insertPoint"]


def test_edits_that_need_the_curve_of_a_missing_family_are_refused(opened):
    for action in NEED_THE_CURVE:
        opened.select([1])
        opened.session.scrub.set(0.3)
        before = opened.session.document
        if opened.action(action).isEnabled():
            opened.trigger(action)
            assert NAME in opened.status or "my_gaussian curve" in opened.status, action
        assert opened.session.document is before, action


def test_switching_from_a_missing_family_makes_a_curve_of_the_same_points(opened):
    opened.choose_family(LAGRANGE)
    assert opened.session.active_view.is_current
    assert MISSING not in opened.message
    opened.trigger("undo")
    assert opened.curve.family.name == NAME
    assert not opened.session.active_view.is_current
    opened.choose_family("hermite")
    assert opened.curve.family is HERMITE


def test_the_command_line_reports_a_missing_family_and_writes_the_rest(path, tmp_path, capsys):
    assert main(["info", str(path)]) == 0
    assert MISSING in capsys.readouterr().out
    assert main(["info", "--json", str(path)]) == 0
    assert json.loads(capsys.readouterr().out)["curves"][0]["family"] == NAME
    assert main(["render", str(path), "-o", str(tmp_path / "a.svg")]) == 0
    assert MISSING in capsys.readouterr().err
    assert (tmp_path / "a.svg").read_text().count("<path") == 1


def test_a_missing_family_is_not_drawn_as_the_document_before(editor, tmp_path):
    example = resource("examples", "letter_s.curve.json")
    path = tmp_path / "missing.curve.json"
    path.write_text(example.read_text("utf-8").replace('"hermite"', '"nowhere"'), "utf-8")
    editor.session.open(example)
    editor.settle()
    editor.session.open(path)
    editor.settle()
    assert editor.curve.family.is_missing
    assert editor.session.active_view.curve is None
