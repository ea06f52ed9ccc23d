"""A step changes document, selection and history: actions and panels are rendered once."""

import pytest
from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QAbstractButton, QApplication, QLineEdit, QWidget

from app.actions.qactions import Actions
from app.document import point_edits
from app.document.model import Document, make_curve
from app.families import HERMITE
from app.window.connect import Commands
from tests.effort import noted_calls

SQUARE = make_curve([(0, 0), (1, 0), (1, 1), (0, 1)], family=HERMITE)
LINE = make_curve([(3, 0), (4, 1)], family=HERMITE)


@pytest.fixture
def render_calls(editor, monkeypatch):
    """Return the times that actions and panels were rendered, from now on."""
    editor.session.commit(Document((SQUARE, LINE)), "Begin", active=0)
    editor.select([1, 2])
    return noted_calls(monkeypatch, Actions, "render"), noted_calls(monkeypatch, Commands, "render_panels")


def delete_points(session):
    session.change("Delete points", lambda document: point_edits.delete_points(document, 0, {1, 2}))


def delete_curve(session):
    session.change("Delete curve", lambda document: Document(document.curves[1:]))


def drop_a_drag(session):
    session.preview(point_edits.move_points(session.document, 0, [1], (0.5, 0.0)))
    session.cancel()


def begin_another(session):
    session.files.replace(Document((LINE,)), None)


@pytest.mark.parametrize("do", [delete_points, delete_curve, drop_a_drag, begin_another])
def test_a_batch_of_changes_updates_actions_and_panels_once(editor, render_calls, do):
    do(editor.session)
    actions, panels = render_calls
    assert len(actions) == 1
    assert [view.source for _commands, view in panels] == [editor.session.active_curve]


def test_a_change_of_document_and_selection_updates_the_views_once(editor, render_calls):
    """Of thousands of curves all was drawn, listed and enabled twice, for 170 ms."""
    session = editor.session
    session.commit(Document((SQUARE, LINE, SQUARE)), "Begin", active=0)
    session.selected.select_whole((0, 2))
    for each in render_calls:
        each.clear()
    editor.trigger("groupCurves")
    assert [curve.groups for curve in session.document.curves] == [(), ("Group 1",), ("Group 1",)]
    assert session.selected.whole_curves == {1, 2}
    assert [len(each) for each in render_calls] == [1, 1]


def test_the_parts_of_the_window_show_the_state_after_the_batch(editor, render_calls):
    delete_points(editor.session)
    names = editor.window.actions_by_name
    assert names["undo"].isEnabled()
    assert "Delete points" in names["undo"].text()
    editor.session.undo_stack.undo()
    assert names["redo"].isEnabled()
    assert len(render_calls[0]) <= 3, "undo is told of by the session and by the history"


def test_an_action_updates_actions_and_panels_once(editor, render_calls):
    editor.window.actions_by_name["deleteSelection"].trigger()
    actions, panels = render_calls
    assert len(editor.session.active_curve.points) == 2
    assert (len(actions), len(panels)) == (1, 1)


def test_a_switch_without_effect_shows_the_option_that_is_on(editor, render_calls):
    switch = editor.window.actions_by_name["tangentEstimated"]
    assert switch.isChecked()
    document = editor.session.document
    switch.trigger()
    assert editor.session.document is document
    assert switch.isChecked()
    assert not render_calls[0]


class Written(QObject):
    """Notes the events of widgets that were given a tooltip, or were enabled or disabled.

    Attributes
    ----------
    same_tips
        The names of those that were given the tooltip that they had; none of buttons, whose actions give it.
    enabled
        The names of those that were enabled or disabled.
    """

    def __init__(self, window):
        super().__init__(window)
        self._tips = {widget: widget.toolTip() for widget in window.findChildren(QWidget)}
        self.same_tips, self.enabled = [], []

    def eventFilter(self, watched, event):
        if event.type() == QEvent.Type.ToolTipChange and not isinstance(watched, QAbstractButton):
            if self._tips.get(watched) == watched.toolTip():
                self.same_tips.append(watched.objectName() or type(watched).__name__)
            self._tips[watched] = watched.toolTip()
        elif event.type() == QEvent.Type.EnabledChange:
            self.enabled.append(watched.objectName())
        return False


def test_only_changed_texts_are_written(editor):
    """Every movement gave the fields, labels and bars the tooltips that they had."""
    flat = make_curve([(0, 0), (1, 0), (2, 1)], family=HERMITE)
    editor.session.commit(Document((flat,)), "Begin", active=0)
    editor.show_dock("transformDock")
    editor.select([0, 1])
    assert not editor.window.findChild(QLineEdit, "transformHeight").isEnabled()
    written = Written(editor.window)
    QApplication.instance().installEventFilter(written)
    try:
        for step in (0.1, 0.2, 0.3):
            editor.session.change(
                "Move points",
                lambda document, step=step: point_edits.move_points(document, 0, [0, 1], (step, 0.0)),
            )
            editor.settle()
    finally:
        QApplication.instance().removeEventFilter(written)
        written.deleteLater()
    assert written.same_tips == []
    assert "transformHeight" not in written.enabled
