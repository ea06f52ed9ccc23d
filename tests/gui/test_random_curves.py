"""Random commands on several curves: every document can be saved, and undo and redo are exact."""

from __future__ import annotations

import random

import pytest

from app.document.model import ParametrizationKind
from app.families import FAMILIES
from app.storage.format import decode, encode
from app.view_model.curve.curve_view import TOO_FEW

ACTIONS = (
    "newCurve", "duplicateCurve", "deleteCurve", "joinCurve", "splitCurve", "reverseCurve", "closeCurve",
    "curveVisible", "raiseCurve", "lowerCurve", "nextCurve", "previousCurve", "insertPoint",
    "tangentSmooth", "tangentSymmetric", "tangentCorner", "tangentEstimated", "freezeParameters",
    "resetVelocities",
    "cutPoints", "copyPoints", "pastePoints", "pasteAsCurve", "copyDerivatives", "pasteDerivatives",
    "deleteSelection", "selectAll", "selectAllCurves", "combineCurves", "breakApart", "deleteContour",
    "groupCurves", "ungroupCurves",
)  # fmt: skip


def step(editor, choose):
    """Do one thing at random, as a person might."""
    count = len(editor.curve.points)
    kind = choose.random()
    if kind < 0.2 and count:
        editor.select(choose.sample(range(count), choose.randint(1, min(3, count))))
    elif kind < 0.3:
        x_min, y_min, x_max, y_max = editor.window.canvas.pixel_map.box
        # Below the line of messages.
        editor.add_point(choose.uniform(x_min, x_max), choose.uniform(y_min, 0.8 * y_max + 0.2 * y_min))
    elif kind < 0.38:
        editor.choose_family(choose.choice(FAMILIES))
    elif kind < 0.44:
        editor.choose_parametrization(choose.choice(list(ParametrizationKind)))
    elif kind < 0.5 and editor.session.active_view.is_current:
        start, end = editor.session.active_view.curve.domain
        editor.session.scrub.set(start + choose.random() * (end - start))
    elif kind < 0.56 and editor.session.active_view.is_current:
        x, y = editor.session.active_view.curve.evaluate(
            editor.parameters[0] * 0.4 + editor.parameters[-1] * 0.6
        )
        editor.fit()
        editor.add_point(float(x), float(y))
    else:
        action = editor.action(choose.choice(ACTIONS))
        if action.isEnabled():
            editor.trigger(action.objectName())


@pytest.mark.parametrize("seed", range(4))
def test_undo_and_redo_are_exact(editor, seed, monkeypatch):
    choose, session = random.Random(seed), editor.session
    if seed:
        # Once with all panels; to draw them anew after every step takes longer than the steps.
        for dock in editor.window.context.docks.side:
            dock.close()
    editor.new()
    stack = session.undo_stack
    states = [(session.document, session.active_index)]
    for _ in range(70):
        # One choice in a box by keys may be several steps.
        seen = []
        connection = session.history_changed.connect(
            lambda seen=seen: seen.append((session.document, session.active_index))
        )
        with monkeypatch.context() as patch:
            # Painted when it is done, not after each event of it.
            patch.setattr(editor, "settle", lambda: None)
            step(editor, choose)
        editor.settle()
        assert session.document.curves[session.active_index] is session.active_curve
        # What cannot be drawn has a reason that the person may mend; nothing else may go wrong.
        assert session.active_view.is_current or session.active_view.problem
        if len(session.active_curve.points) < 2:
            assert session.active_view.problem == TOO_FEW
        session.history_changed.disconnect(connection)
        states += seen
        assert decode(encode(session.document)) == session.document
    for document, _ in reversed(states[:-1]):
        stack.undo()
        assert session.document is document
    for document, active in states[1:]:
        stack.redo()
        assert session.document is document
        # Whole curves that are chosen stay so; a curve that is edited is the one of then.
        assert session.active_index == active or session.active_index in session.selected.chosen
