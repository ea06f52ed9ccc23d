"""Digits that choose the family of the curve that is edited."""

from __future__ import annotations

from PySide6.QtCore import Qt

from app.document import point_edits
from app.document.model import Document, make_curve
from app.families import HERMITE, LAGRANGE, QUINTIC_HERMITE

Key = Qt.Key
ARCH = ((0.0, 0.0), (10.0, 20.0), (35.0, 22.0), (40.0, 0.0))


def letter(editor, unit="mm"):
    """A curve with a handle of its own, edited, in a document of a unit."""
    document = Document((make_curve(ARCH, family=HERMITE, name="Letter"),), unit=unit)
    editor.session.commit(point_edits.set_velocity(document, 0, 1, (30.0, 10.0)), "Begin")
    editor.window.canvas.camera.show_box((-10, 50), (-10, 30))
    editor.settle()
    return editor


def test_a_digit_reshapes_at_once_as_the_toolbar_does(editor):
    letter(editor).key(Key.Key_3)
    assert editor.curve.family is QUINTIC_HERMITE
    letter(editor).trigger("familyLagrange")
    assert editor.curve.family is LAGRANGE
