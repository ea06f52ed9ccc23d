"""What is drawn over the curve, switched with real events."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QCheckBox, QSlider

from app.view_model.analysis.figures import Style


def teeth(editor):
    return [figure for figure in editor.window.canvas.figures if figure.style is Style.COMB_TEETH]


def longest(editor):
    ends = teeth(editor)[0].points.reshape(-1, 2, 2)
    return np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).max()


def test_the_comb_follows_a_drag(editor):
    editor.trigger("overlayComb")
    before = teeth(editor)[0].points
    x, y = editor.point(1)
    editor.press((x, y))
    editor.move((x + 0.3, y + 0.3))
    assert not np.array_equal(teeth(editor)[0].points, before)
    editor.escape()
    assert np.array_equal(teeth(editor)[0].points, before)
    editor.trigger("overlayComb")
    assert not editor.window.canvas.figures


def test_the_analysis_dock_switches_and_scales_the_comb(editor, qtbot):
    editor.show_dock("analysisDock")
    switch = editor.window.findChild(QCheckBox, "overlayCombSwitch")
    qtbot.keyClick(switch, Qt.Key.Key_Space)
    assert editor.action("overlayComb").isChecked()
    before = longest(editor)
    qtbot.keyClick(editor.window.findChild(QSlider, "combScale"), Qt.Key.Key_Right)
    assert longest(editor) == pytest.approx(before * 10**0.05)
