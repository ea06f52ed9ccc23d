"""Documents of older versions in the window: what their opening has set to keep the shape is said once."""

from __future__ import annotations

import json

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import QMimeData, Qt
from PySide6.QtWidgets import QApplication

from app.document.model import Document, make_curve
from app.document.point_edits import explicit_points
from app.families import HERMITE
from app.storage.format import encode
from app.view_model.curve.curve_view import view_of
from app.workbench.clipboard import CURVES

HILLS = ((0, 0), (1, 2), (2.5, 1), (4, 3), (5, 0.5), (6.5, 2), (8, 0))


def hills():
    curve = make_curve(HILLS, name="Hills", family=HERMITE)
    set_there = replace(curve.points[3], velocity=(2.0, -9.0))
    return replace(curve, points=(*curve.points[:3], set_there, *curve.points[4:]))


def of_version_3():
    values = json.loads(encode(Document((hills(),)))) | {"version": 3}
    return json.dumps(values).encode()


def older_samples():
    """The curve of version 3: its estimates are those of the same points with nothing set."""
    free = view_of(make_curve(HILLS, family=HERMITE))
    set_there = [
        replace(point, velocity=hills().points[3].velocity if index == 3 else free.velocity_of(index))
        for index, point in enumerate(free.source.points)
    ]
    return view_of(replace(free.source, points=tuple(set_there))).samples


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "hills.curve.json"
    path.write_bytes(of_version_3())
    return path


def test_an_older_document_keeps_its_shape_and_says_once_what_was_set(editor, path):
    editor.window.open_file(path)
    assert editor.session.active_view.samples == pytest.approx(older_samples(), abs=1e-12)
    assert explicit_points(editor.curve, range(7)) == {2, 3, 4}
    assert editor.file_bar.text == (
        "“hills.curve.json” was made with an older version: 2 points were set to keep the shape. "
        "Saving keeps a backup of the old file."
    )
    assert not editor.session.files.is_modified
    assert path.read_bytes() == of_version_3()
    editor.drag_point(0, to=(0.0, 0.5))
    # It covered the curve through edits and undo.
    assert editor.file_bar.text == ""
    editor.trigger("undo")
    assert editor.file_bar.text == ""
    editor.trigger("redo")
    editor.trigger("saveDocument")
    assert editor.file_bar.text == ""
    assert path.with_name("hills.curve.json.v3.bak").read_bytes() == of_version_3()
    editor.window.open_file(path)
    assert editor.file_bar.text == ""
    assert explicit_points(editor.curve, range(7)) == {2, 3, 4}


def test_curves_copied_by_an_older_version_keep_their_shape(editor):
    data = QMimeData()
    data.setData(CURVES, of_version_3())
    QApplication.clipboard().setMimeData(data)
    editor.key(Qt.Key.Key_V, Qt.KeyboardModifier.ControlModifier)
    moved = editor.session.active_view.samples - np.array(editor.session.active_view.points[0])
    assert moved == pytest.approx(older_samples(), abs=1e-12)
    assert editor.message == (
        "The clipboard content was made with an older version: 2 points were set to keep the shape."
    )


def test_an_older_document_of_estimates_alone_says_nothing_of_points(editor, path):
    values = json.loads(encode(Document((make_curve(HILLS, family=HERMITE),)))) | {"version": 3}
    path.write_bytes(json.dumps(values).encode())
    editor.window.open_file(path)
    assert editor.file_bar.text == ""
    assert editor.status == (
        "hills.curve.json was saved by an older version. The first save keeps a backup of it."
    )
