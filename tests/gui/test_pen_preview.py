"""What the pen shows before it is pressed: the curve with one point more, or the spot to insert at."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from pixels import is_colour
from PySide6.QtCore import QEvent, Qt
from PySide6.QtWidgets import QApplication

from app.appearance.theme import LIGHT
from app.document import rule_edits
from app.document.model import Document, ParametrizationKind, make_curve
from app.families import FAMILIES, HERMITE, LAGRANGE
from tests.gui.editor_facts import at

SHIFT = Qt.KeyboardModifier.ShiftModifier


@pytest.fixture
def hermite(editor):
    return drawn(editor, HERMITE)


def drawn(editor, family):
    """Draw a curve of three points, with the pen in hand."""
    editor.new()
    first = make_curve([at(editor, 0, 0), at(editor, 100, 60)], family=family)
    editor.session.commit(Document((replace(editor.curve, family=family, points=first.points),)), "Begin")
    editor.action("addTool").trigger()
    editor.click(at(editor, 200, 0))
    return editor


def ahead(editor):
    """The curve shown ahead, as a value."""
    view = editor.window.canvas.marks.preview_curve
    return view.source if view is not None else None


def ghost_pixels(editor):
    """How many pixels of the canvas have the colour of the line ahead."""
    editor.settle()
    image = editor.window.canvas.viewport().grab().toImage().copy(editor.window.canvas.camera.area)
    return int(is_colour(image, LIGHT.ghost)[:, ::2].sum())


@pytest.mark.parametrize("kind", [ParametrizationKind.CHORD_LENGTH, ParametrizationKind.MANUAL])
def test_the_preview_is_the_curve_that_a_click_makes(editor, kind):
    for family in FAMILIES:
        pen = drawn(editor, family)
        ruled = rule_edits.set_parametrization(pen.session.document, 0, kind, [0.0, 0.4, 1.0])
        pen.session.commit(ruled, "Begin")
        document, steps = pen.session.document, pen.session.undo_stack.count()
        assert ahead(pen) is None, family
        for x, y in ((300, 150), (310, 130)):
            pen.hover(at(pen, x, y))
            shown = ahead(pen)
            assert len(shown.points) == 4, family
        assert pen.session.document is document, family
        assert pen.session.undo_stack.count() == steps, family
        pen.click(at(pen, 310, 130))
        assert pen.curve == shown, family


def test_the_preview_is_painted_with_the_pen_alone(hermite):
    hermite.hover(at(hermite, 300, 170))
    shown = ghost_pixels(hermite)
    assert shown > 20
    hermite.escape()
    assert ahead(hermite) is None
    assert ghost_pixels(hermite) < shown / 4
    hermite.trigger("addTool")
    hermite.hover(at(hermite, 300, 170))
    assert ghost_pixels(hermite) == shown
    hermite.trigger("measureTool")
    hermite.hover(at(hermite, 300, 171))
    assert ahead(hermite) is None
    assert ghost_pixels(hermite) < shown / 4


def test_the_preview_is_removed_when_the_pointer_leaves(hermite):
    hermite.hover(at(hermite, 300, 170))
    assert ahead(hermite) is not None
    QApplication.sendEvent(hermite.window.canvas, QEvent(QEvent.Type.Leave))
    hermite.settle()
    assert ahead(hermite) is None


def test_the_preview_is_removed_by_a_press_and_not_restored_by_escape(hermite):
    document = hermite.session.document
    hermite.hover(at(hermite, 300, 170))
    hermite.press(at(hermite, 300, 170))
    assert ahead(hermite) is None
    hermite.move(at(hermite, 320, 180))
    assert ahead(hermite) is None
    hermite.escape()
    assert ahead(hermite) is None
    assert hermite.session.document is document
    hermite.release(at(hermite, 320, 180))
    assert len(ahead(hermite).points) == 4


def test_the_preview_snaps(hermite):
    spacing = hermite.window.canvas.tools.canvas.grid_spacing()
    near = (12 * spacing + 3 * hermite.pixel, 9 * spacing + 2 * hermite.pixel)
    hermite.trigger("toggleSnap")
    hermite.hover(near)
    assert ahead(hermite).points[3].position == pytest.approx((12 * spacing, 9 * spacing), rel=1e-12)
    hermite.trigger("toggleSnap")
    hermite.hover(near)
    assert ahead(hermite).points[3].position == pytest.approx(near, abs=hermite.pixel)


def test_none_where_a_press_begins_another_curve(hermite):
    hermite.hover(at(hermite, 300, 170))
    hermite.key(Qt.Key.Key_Return)
    assert ahead(hermite) is None
    hermite.hover(at(hermite, 310, 170))
    assert ahead(hermite) is None
    hermite.move(at(hermite, 310, 171), held=False, keys=SHIFT)
    assert len(ahead(hermite).points) == 4
    hermite.trigger("closeCurve")
    hermite.hover(at(hermite, 320, 170))
    assert ahead(hermite) is None


def test_on_the_curve_the_insertion_spot_replaces_the_preview(hermite):
    x, y = map(float, hermite.session.active_view.curve.evaluate(0.3))
    hermite.hover((x + hermite.pixel, y + 2 * hermite.pixel))
    spot = hermite.window.canvas.marks.spot
    assert ahead(hermite) is None
    hermite.click((x + hermite.pixel, y + 2 * hermite.pixel))
    assert hermite.point(1) == pytest.approx(spot, abs=0.5 * hermite.pixel)
    assert hermite.window.canvas.marks.spot is None
    hermite.escape()
    hermite.hover((x, y))
    assert hermite.window.canvas.marks.spot is None


def test_none_over_points_on_locked_curves_and_on_empty_ones(hermite):
    hermite.hover(hermite.point(1))
    assert ahead(hermite) is None
    hermite.trigger("curveLocked")
    hermite.hover(at(hermite, 300, 170))
    assert ahead(hermite) is None
    hermite.new()
    hermite.hover(at(hermite, 300, 170))
    assert ahead(hermite) is None


def test_the_preview_follows_undo_and_another_family(hermite):
    hermite.hover(at(hermite, 300, 170))
    hermite.trigger("undo")
    assert len(ahead(hermite).points) == 3
    hermite.choose_family(LAGRANGE)
    assert ahead(hermite).family is LAGRANGE


COUNTS = [
    (HERMITE, 200, True),
    (HERMITE, 201, False),
    (LAGRANGE, 24, True),
    (LAGRANGE, 25, False),
]


def test_a_slow_curve_has_no_preview(editor):
    for family, count, is_shown in COUNTS:
        angles = np.linspace(0, 6, count)
        points = [(float(x), float(y)) for x, y in zip(np.cos(angles), np.sin(angles), strict=True)]
        editor.session.commit(Document((make_curve(points, family=family),)), "Begin")
        editor.trigger("addTool")
        editor.hover((0.0, 0.1))
        assert (ahead(editor) is not None) is is_shown, (family, count)
