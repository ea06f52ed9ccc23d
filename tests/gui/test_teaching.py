"""The badge that teaches, with real events."""

from __future__ import annotations

import numpy as np
from msgspec.structs import replace
from PySide6.QtCore import QEvent, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QFrame, QLabel, QPushButton

from app.document.model import Document, Parametrization, ParametrizationKind, Point, make_curve
from app.features.teaching.commands import TeachingBadge

LEFT = Qt.MouseButton.LeftButton


def wave(count):
    points = [(0.5 * i, float(np.sin(2.0 * i))) for i in range(count)]
    return replace(make_curve(points), parametrization=Parametrization(kind=ParametrizationKind.UNIFORM))


def badge(editor):
    return editor.window.findChild(TeachingBadge, "teachingBadge")


def show(editor, curve):
    editor.session.commit(Document((curve,)), "Begin")
    editor.fit()


def open_popup(editor):
    QTest.mouseClick(badge(editor), LEFT)
    popup = editor.window.findChild(QFrame, "teachingPopup")
    assert popup.isVisible()
    return popup


def follow(editor, name):
    QTest.mouseClick(editor.window.findChild(QPushButton, name), LEFT)
    editor.settle()


def test_the_badge_appears_when_the_lebesgue_constant_passes_100(editor):
    assert not badge(editor).isVisible()
    # Λ of n + 1 equally spaced points: 51.2 for 13, 89.3 for 14, 155 to 192 further on (Λ grows by nearly 2).
    show(editor, wave(12))
    assert not badge(editor).isVisible()
    show(editor, wave(21))
    assert badge(editor).isVisible()
    # Published for 21 equally spaced points: 10986.5.
    assert badge(editor).text() == "⚠ Λ 10\N{NARROW NO-BREAK SPACE}987"
    assert "4 digits of accuracy are lost" in badge(editor).sentence
    assert not editor.window.findChild(QLabel, "lebesgueConstant").isVisible()
    editor.choose_parametrization(ParametrizationKind.CHEBYSHEV)
    assert not badge(editor).isVisible()
    assert editor.window.findChild(QLabel, "lebesgueConstant").isVisible()


def test_the_badge_moves_nothing(editor):
    show(editor, wave(12))
    size = editor.window.canvas.size()
    show(editor, wave(21))
    assert badge(editor).isVisible()
    assert editor.window.canvas.size() == size


def test_a_dismissed_badge_returns_only_for_a_new_reason(editor):
    show(editor, wave(21))
    open_popup(editor)
    follow(editor, "putBadgeAway")
    assert not badge(editor).isVisible()
    editor.drag_point(3, to=(1.6, 1.0))
    assert not badge(editor).isVisible()
    # Mended, and broken again.
    editor.choose_parametrization(ParametrizationKind.CHEBYSHEV)
    editor.trigger("undo")
    assert badge(editor).isVisible()


def test_the_badge_does_not_change_during_a_drag(editor):
    curve = wave(4)
    points = tuple(replace(point, t=float(t)) for point, t in zip(curve.points, (0, 1, 2, 3), strict=True))
    show(
        editor,
        replace(curve, points=points, parametrization=Parametrization(kind=ParametrizationKind.MANUAL)),
    )
    panel = editor.window.basis_panel
    start, end = panel.rail_pixel(1.0), panel.rail_pixel(2.0)
    editor.send(panel, QEvent.Type.MouseMove, start, held=False)
    editor.send(panel, QEvent.Type.MouseButtonPress, start)
    for _ in range(3):
        editor.send(panel, QEvent.Type.MouseMove, end)
    editor.wait_for_rest()
    assert np.diff(editor.parameters).min() < 0.01
    assert not badge(editor).isVisible()
    editor.send(panel, QEvent.Type.MouseButtonRelease, end, held=False)
    editor.settle()
    assert badge(editor).isVisible()


def test_parameters_that_nearly_coincide_are_named(editor):
    points = tuple(
        Point(float(x), float(y), t)
        for (x, y), t in zip([(0, 0), (1, 2), (2, 0), (3, 1)], (0, 1, 1.0005, 3), strict=True)
    )
    manual = Parametrization(kind=ParametrizationKind.MANUAL)
    show(editor, replace(make_curve(()), points=points, parametrization=manual))
    assert badge(editor).text() == "⚠ t almost equal"
    assert "points 1 and 2 are only" in badge(editor).sentence


def test_the_links_of_the_badge_lead_to_the_laboratory_and_to_a_cure(editor):
    show(editor, wave(21))
    open_popup(editor)
    follow(editor, "openLaboratory")
    assert editor.action("toggleLaboratory").isChecked()
    assert editor.window.findChild(QFrame, "teachingPopup").isHidden()
    open_popup(editor)
    follow(editor, "openExplanation")
    assert editor.session.scrub.t is not None
    assert editor.window.findChild(QFrame, "wigglePanel").isVisible()


def test_escape_closes_the_popup(editor):
    show(editor, wave(21))
    popup = open_popup(editor)
    QTest.keyClick(popup, Qt.Key.Key_Escape)
    assert popup.isHidden()
    assert badge(editor).isVisible()
