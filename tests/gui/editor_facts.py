"""Facts that many tests ask of an editor: names, the last step, places on curves and how far these went."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import QObject, QPoint, Qt
from PySide6.QtGui import QAction, QColor, QImage
from PySide6.QtTest import QTest

from tests.waiting import until


def names(editor):
    """The names of all curves, as one word."""
    return "".join(curve.name for curve in editor.session.document.curves)


def whole_curve_names(editor):
    """Return the names of the curves that are selected as a whole, as one word."""
    curves = editor.session.document.curves
    return "".join(curves[place].name for place in sorted(editor.session.selected.whole_curves))


def undo_text(editor):
    return editor.session.undo_stack.undoText()


def on_curve(editor, row, t=0.45):
    x, y = editor.session.views[row].curve.evaluate(t)
    return float(x), float(y)


def moved_by(editor, before, row):
    """How far a curve has been moved since `before`; it must have been moved as a whole."""
    new, old = (
        np.array([point.position for point in document.curves[row].points])
        for document in (editor.session.document, before)
    )
    ways = new - old
    assert np.ptp(ways, axis=0) == pytest.approx((0, 0), abs=1e-12)
    return tuple(ways[0].tolist())


def at(editor, x, y):
    """A place so many pixels right of and above the lower left part of the canvas."""
    return editor.window.canvas.to_plane(QPoint(80 + x, 300 - y))


def retype(field, text):
    field.setFocus()
    field.selectAll()
    QTest.keyClicks(field, text)
    QTest.keyClick(field, Qt.Key.Key_Return)


def transform(editor, key, amount):
    """Move, scale or rotate by G, S or R and a typed amount."""
    editor.key(getattr(Qt.Key, f"Key_{key}"))
    editor.type_amount(amount)
    editor.key(Qt.Key.Key_Return)


def picture(path, width=60, height=80, colour="#ff0000"):
    """A picture of one colour, in a file."""
    image = QImage(width, height, QImage.Format.Format_RGB32)
    image.fill(QColor(colour))
    assert image.save(str(path))
    return path


# Looked up once, see fingerprint.py; the last three make up why an action is not possible.
_enabled, _checked, _text, _tip = QAction.isEnabled, QAction.isChecked, QAction.text, QAction.toolTip
_property, _WHY_NOT = QObject.property, ("isRedundant", "reason", "needs")


def action_states(actions):
    """Return what each action shows, by its name; of those whose menu has told more, nothing."""
    return {
        name: (
            *(_enabled(action), _checked(action), _text(action), _tip(action)),
            *[_property(action, key) or None for key in _WHY_NOT],
        )
        for name, action in actions._actions.items()
        if name not in actions._opened
    }


def assert_actions_as_rendered_anew(editor):
    """Raise unless the actions are as they are when all facts are asked again."""
    actions = editor.window.actions_by_name
    before = action_states(actions)
    actions._index()
    actions.render()
    after = action_states(actions)
    different = {name: (shown, after[name]) for name, shown in before.items() if shown != after[name]}
    assert not different, different


def until_settled(editor, condition):
    """Wait for what is computed beside the window, which begins at once instead of when a hand has rested."""

    def is_there():
        editor.wait_for_rest()
        return condition()

    until(is_there)


def stop_beside(lifecycle):
    """Stop a program whose windows stay open: they are watched and kept by it no more."""
    lifecycle.stop()
    while lifecycle._autosaves:
        _window, autosave = lifecycle._autosaves.popitem()
        autosave.finish()
