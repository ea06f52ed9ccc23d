"""Selected curves aligned and spaced evenly, by their extents; whole shapes as one."""

from __future__ import annotations

import numpy as np
import pytest
from extents import CLOSE, sampled_bounds
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QToolButton

from app.document.model import Document, make_curve
from app.families import HERMITE
from tests.gui.editor_facts import undo_text

WAVE = ((0.0, 0.0), (1.0, 1.5), (2.5, -0.5), (3.0, 1.0))


@pytest.fixture
def four(editor):
    """Four waves of several sizes, the second is edited; all are chosen."""
    placed = ((0, 0, 1), (4, 1, 1.5), (2.5, 5, 0.7), (9, -2, 2))
    curves = tuple(
        make_curve([(x0 + size * x, y0 + size * y) for x, y in WAVE], name=name, family=HERMITE)
        for name, (x0, y0, size) in zip("ABCD", placed, strict=True)
    )
    editor.session.commit(Document(curves), "Begin", active=1)
    editor.session.selected.set_curves(range(4))
    editor.fit()
    return editor


def boxes(editor, count=4):
    """Lower left and upper right corners of all curves, (n, 2, 2)."""
    return np.array([sampled_bounds(editor, place) for place in range(count)])


def edge_of(boxes, action):
    axis = 0 if action in ("alignLeft", "alignCentre", "alignRight") else 1
    low, high = boxes[..., 0, axis], boxes[..., 1, axis]
    return {"alignLeft": low, "alignBottom": low, "alignRight": high, "alignTop": high}.get(
        action, (low + high) / 2
    )


ACTIONS = ("alignLeft", "alignCentre", "alignRight", "alignTop", "alignMiddle", "alignBottom")


def whole(boxes):
    return np.array([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])


def test_curves_are_aligned_to_each_reference_by_their_extents(four):
    for to in ("EachOther", "First", "Largest", "Drawing"):
        four.trigger(f"alignTo{to}")
        before = boxes(four)
        box = {
            "EachOther": whole(before[:3]),
            "First": before[1],
            "Largest": before[1],
            "Drawing": whole(before),
        }
        for action in ACTIONS:
            case = to, action
            four.session.selected.set_curves({0, 1, 2}, 1)
            four.trigger(action)
            after = boxes(four)
            target = float(edge_of(box[to], action))
            assert edge_of(after[:3], action) == pytest.approx(3 * [target], abs=2 * CLOSE), case
            # Nothing has changed its size or moved along the other axis, and nothing else has moved at all.
            assert after[:, 1] - after[:, 0] == pytest.approx(before[:, 1] - before[:, 0], abs=CLOSE), case
            other = 1 if action in ACTIONS[:3] else 0
            assert after[:, :, other] == pytest.approx(before[:, :, other], abs=CLOSE), case
            assert after[3] == pytest.approx(before[3], abs=CLOSE), case
            assert undo_text(four) == f"Align 3 curves {action.removeprefix('align').lower()}", case
            assert four.session.selected.curves == {0, 1, 2}, case
            four.trigger("undo")
            assert boxes(four) == pytest.approx(before), case
    four.trigger("alignToEachOther")


def test_the_largest_curve_may_be_another_than_the_edited_curve(four):
    before = boxes(four)
    four.trigger("alignToLargest")
    four.trigger("alignTop")
    assert boxes(four)[:, 1, 1] == pytest.approx(4 * [before[3, 1, 1]], abs=CLOSE)
    four.trigger("alignToEachOther")


def test_one_curve_is_aligned_to_the_drawing(four):
    four.session.selected.select_whole({1})
    assert not four.action("alignCentre").isEnabled()
    four.trigger("alignToDrawing")
    before = whole(boxes(four))
    four.trigger("alignCentre")
    assert boxes(four)[1, :, 0].mean() == pytest.approx(before[:, 0].mean(), abs=CLOSE)
    four.trigger("alignToEachOther")


@pytest.mark.parametrize(("action", "axis"), [("distributeHorizontally", 0), ("distributeVertically", 1)])
def test_centres_are_spaced_evenly(four, action, axis):
    before = boxes(four)
    four.trigger(action)
    middles = np.sort(boxes(four)[:, :, axis].mean(axis=1))
    assert np.diff(middles) == pytest.approx(3 * [np.ptp(before[:, :, axis].mean(axis=1)) / 3], abs=2 * CLOSE)
    assert undo_text(four) == f"Distribute 4 curves {action.removeprefix('distribute').lower()}"


@pytest.mark.parametrize(
    ("action", "axis"), [("distributeGapsHorizontally", 0), ("distributeGapsVertically", 1)]
)
def test_gaps_become_the_same(four, action, axis):
    before = boxes(four)[:, :, axis]
    four.trigger(action)
    after = boxes(four)[:, :, axis]
    order = np.argsort(after.mean(axis=1))
    gaps = after[order][1:, 0] - after[order][:-1, 1]
    assert gaps == pytest.approx(3 * [gaps[0]], abs=3 * CLOSE)
    outer = np.argsort(before.mean(axis=1))[[0, -1]]
    assert after[outer] == pytest.approx(before[outer], abs=CLOSE), "the outer two stay"
    assert undo_text(four) == f"Distribute gaps of 4 curves {action.removeprefix('distributeGaps').lower()}"


def test_a_shape_is_aligned_as_one(four):
    four.session.change(
        "Shape",
        lambda document: replace(
            document,
            curves=tuple(
                replace(curve, shape="Pair") if curve.name in "AB" else curve for curve in document.curves
            ),
        ),
    )
    four.session.selected.select_whole({0, 2})
    before = boxes(four)
    four.trigger("alignBottom")
    after = boxes(four)
    assert after[0] - before[0] == pytest.approx(after[1] - before[1], abs=2 * CLOSE)
    low = whole(before[:3])[0][1]
    assert [after[:2, 0, 1].min(), after[2, 0, 1]] == pytest.approx([low, low], abs=2 * CLOSE)


def with_groups(editor, letters):
    editor.session.change(
        "Group",
        lambda document: replace(
            document,
            curves=tuple(
                replace(curve, groups=("Crown",)) if curve.name in letters else curve
                for curve in document.curves
            ),
        ),
    )


def test_a_group_is_aligned_as_one(four):
    with_groups(four, "ABC")
    four.session.selected.select_whole(range(4))
    before = boxes(four)
    four.trigger("alignTop")
    after = boxes(four)
    assert after[:3] - before[:3] == pytest.approx(np.array(3 * [after[0] - before[0]]), abs=2 * CLOSE)
    assert whole(after[:3])[1][1] == pytest.approx(after[3, 1, 1], abs=2 * CLOSE)


def test_a_group_that_is_alone_is_aligned_as_one(four):
    """To all curves; to each other, and spaced, it is one thing, and nothing is offered."""
    with_groups(four, "ABC")
    four.session.selected.select_whole([])
    four.click(tuple(four.session.views[0].curve.evaluate(0.4).tolist()))
    assert four.session.selected.whole_curves == {0, 1, 2}
    for action in ("alignCentre", "distributeHorizontally", "distributeGapsVertically"):
        assert not four.action(action).isEnabled()
    assert "(a group counts as one)" in four.action("alignCentre").toolTip()
    four.trigger("alignToDrawing")
    before = boxes(four)
    four.trigger("openTransform")
    QTest.mouseClick(four.window.findChild(QToolButton, "alignCentreButton"), Qt.MouseButton.LeftButton)
    after = boxes(four)
    assert whole(after[:3])[:, 0].mean() == pytest.approx(whole(before)[:, 0].mean(), abs=2 * CLOSE)
    assert after[:3] - before[:3] == pytest.approx(np.array(3 * [after[0] - before[0]]), abs=2 * CLOSE)
    assert after[3] == pytest.approx(before[3])
    four.trigger("alignToEachOther")


def test_unlocked_curves_are_aligned_to_a_locked_curve(four):
    four.session.selected.set_curves({0})
    four.trigger("curveLocked")
    four.session.selected.set_curves(range(4), 1)
    document = four.session.document
    four.trigger("alignRight")
    after = four.session.document
    assert (after.curves[0], after == document) == (document.curves[0], False)
    assert four.status == "1 locked curve stays."


def test_selected_points_are_aligned_before_selected_curves(four):
    four.session.selected.set_curves({1})
    four.select([0, 1])
    others = boxes(four)[[0, 2, 3]]
    four.trigger("alignTop")
    heights = [point.y for point in four.curve.points]
    assert heights[0] == heights[1] == 1 + 1.5 * 1.5
    assert boxes(four)[[0, 2, 3]] == pytest.approx(others)


def test_alignment_of_too_few_curves_is_refused_with_the_number_needed(four):
    four.session.selected.set_curves({0, 1})
    assert four.action("alignLeft").isEnabled()
    assert not four.action("distributeHorizontally").isEnabled()
    assert "three selected points or curves" in four.action("distributeHorizontally").toolTip()
    assert not four.action("distributeGapsVertically").isEnabled()


def test_curves_without_points_are_not_aligned(four):
    session = four.session
    for to in ("EachOther", "First", "Largest", "Drawing"):
        session.commit(Document((replace(session.document.curves[0], points=()),) * 2), "Empty", active=0)
        session.selected.set_curves({0, 1})
        four.action(f"alignTo{to}").trigger()
        four.action("alignLeft").trigger()
        assert four.window.status_line.text == "The selection has no points to align.", to
        four.window.status_line.clear_message()


def test_the_buttons_of_the_panel_align(four):
    four.trigger("openTransform")
    QTest.mouseClick(four.window.findChild(QToolButton, "alignBottomButton"), Qt.MouseButton.LeftButton)
    low = boxes(four)[:, 0, 1]
    assert low == pytest.approx(4 * [low[0]], abs=CLOSE)


def test_alignment_refers_to_the_last_clicked_or_the_smallest_curve(four):
    """Also where it lies between the others in the list, and after the list was turned round."""
    four.session.selected.select_whole({0})
    for place in (3, 1):
        on = tuple(four.session.views[place].curve.evaluate(0.4).tolist())
        four.click(on, keys=Qt.KeyboardModifier.ShiftModifier)
    four.trigger("alignToLast")
    before = boxes(four)
    four.trigger("alignBottom")
    assert boxes(four)[[0, 1, 3], 0, 1] == pytest.approx(3 * [before[1, 0, 1]], abs=2 * CLOSE)
    four.trigger("undo")
    four.session.change("Turn", lambda document: replace(document, curves=document.curves[::-1]))
    assert four.session.selected.last == 2
    four.session.selected.select_whole({1, 2, 3})
    before = boxes(four)
    four.trigger("alignToSmallest")
    four.trigger("alignTop")
    assert boxes(four)[1:, 1, 1] == pytest.approx(3 * [before[1, 1, 1]], abs=2 * CLOSE)
    four.trigger("alignToEachOther")


def test_without_an_edited_curve_alignment_refers_to_the_first_selected_curve(four):
    four.session.selected.select_whole({2})
    four.click(
        tuple(four.session.views[3].curve.evaluate(0.4).tolist()), keys=Qt.KeyboardModifier.ShiftModifier
    )
    assert four.session.selected.whole_curves == {2, 3}
    before = boxes(four)
    four.trigger("alignToFirst")
    four.trigger("alignBottom")
    assert boxes(four)[[2, 3], 0, 1] == pytest.approx(2 * [before[2, 0, 1]], abs=CLOSE)
    four.trigger("alignToEachOther")
