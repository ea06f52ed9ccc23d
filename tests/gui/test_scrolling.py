"""Wheels and trackpads on canvas, basis panel and plots: what zooms, what pans."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QInputDevice, QNativeGestureEvent, QPointingDevice, QWheelEvent
from PySide6.QtWidgets import QApplication

from app.features.laboratory.cost import LogPlot
from app.plotting.plot_widget import PlotWidget

Phase, Keys = Qt.ScrollPhase, Qt.KeyboardModifier


def trackpad():
    """A new one for each event: one that was kept for all was once gone before it was used."""
    kinds = QInputDevice.DeviceType.TouchPad, QPointingDevice.PointerType.Finger
    abilities = QInputDevice.Capability.Position | QInputDevice.Capability.Scroll
    return QPointingDevice("trackpad", 7, *kinds, abilities, 2, 1)


def scroll(
    plot, at, *, angle=(0, 0), pixels=(0, 0), phase=Phase.NoScrollPhase, keys=Keys.NoModifier, pad=False
):
    place = QPointF(at)
    given = [
        place,
        plot.viewport().mapToGlobal(place),
        QPoint(*pixels),
        QPoint(*angle),
        Qt.MouseButton.NoButton,
        keys,
        phase,
        False,
        Qt.MouseEventSource.MouseEventNotSynthesized,
    ]
    device = trackpad()
    event = QWheelEvent(*given, device) if pad else QWheelEvent(*given)
    QApplication.sendEvent(plot.viewport(), event)


def pinch(plot, at, value, kind=Qt.NativeGestureType.ZoomNativeGesture):
    place = QPointF(at)
    device = trackpad()
    event = QNativeGestureEvent(
        kind, device, 2, place, place, plot.viewport().mapToGlobal(place), value, QPointF(), 0
    )
    QApplication.sendEvent(plot.viewport(), event)


def moved(before, after):
    """By how many pixels the drawing moved, and how much larger it became."""
    x, y = after.point(*before.plane(0.0, 0.0))
    return (x, y), after.sx / before.sx


class View:
    """What becomes of the part of the plane that a plot shows."""

    def __init__(self, editor, plot):
        self._editor, self.plot = editor, plot
        self.middle = QPoint(plot.viewport().width() // 2, plot.viewport().height() // 2)

    def after(self, send, *args, **keys):
        before = self.plot.pixel_map
        send(self.plot, self.middle, *args, **keys)
        self._editor.settle()
        return moved(before, self.plot.pixel_map)


@pytest.fixture
def canvas(editor):
    return View(editor, editor.window.canvas)


@pytest.fixture
def basis(editor):
    return View(editor, editor.window.basis_panel)


def test_a_wheel_mouse_zooms_as_ever(canvas):
    _, factor = canvas.after(scroll, angle=(0, 240))
    assert factor == pytest.approx(1.44)
    # libinput's wheels with fine steps have pixels under X11, and are wheels all the same.
    _, factor = canvas.after(scroll, angle=(0, -120), pixels=(0, -120))
    assert factor == pytest.approx(1 / 1.2)
    _, factor = canvas.after(scroll, angle=(0, 120), keys=Keys.ControlModifier)
    assert factor == pytest.approx(1.2)


@pytest.mark.parametrize("pad", [False, True])
def test_two_fingers_pan(canvas, pad):
    # Told by the device where the system knows no phases. It zoomed by 1.2 ** (1/4).
    phase = Phase.NoScrollPhase if pad else Phase.ScrollUpdate
    by, factor = canvas.after(scroll, angle=(-16, 30), pixels=(-20, 35), phase=phase, pad=pad)
    assert factor == pytest.approx(1.0)
    assert by == pytest.approx((-20, 35))
    by, _ = canvas.after(scroll, angle=(0, -30), phase=phase, pad=pad)
    assert by == pytest.approx((0, -15))  # 60 pixels a notch where no pixels are told


def test_shift_and_a_tilted_wheel_move_sideways(canvas):
    for angle in ((0, -120), (-120, 0)):
        by, factor = canvas.after(scroll, angle=angle, keys=Keys.ShiftModifier)
        assert factor == pytest.approx(1.0)
        assert by == pytest.approx((-60, 0))
    by, factor = canvas.after(scroll, angle=(120, 0))
    assert (by, factor) == (pytest.approx((60, 0)), pytest.approx(1.0))


def test_momentum_continues_a_pan_when_ctrl_is_pressed_later(canvas):
    canvas.after(scroll, pixels=(0, 5), angle=(0, 5), phase=Phase.ScrollBegin)
    canvas.after(scroll, phase=Phase.ScrollEnd)
    by, factor = canvas.after(
        scroll, pixels=(0, 8), angle=(0, 8), phase=Phase.ScrollMomentum, keys=Keys.ControlModifier
    )
    assert (by, factor) == (pytest.approx((0, 8)), pytest.approx(1.0))
    _, factor = canvas.after(
        scroll, pixels=(0, 8), angle=(0, 120), phase=Phase.ScrollBegin, keys=Keys.ControlModifier
    )
    assert factor == pytest.approx(1.2)


def test_a_pinch_zooms_about_the_position_between_the_fingers(canvas):
    at = canvas.plot.to_plane(canvas.middle)
    _, factor = canvas.after(pinch, 0.25)
    assert factor == pytest.approx(1.25)
    assert canvas.plot.to_plane(canvas.middle) == pytest.approx(at)
    _, factor = canvas.after(pinch, -0.2)
    assert factor == pytest.approx(0.8)
    # Fingers that turn, and a value that would turn the picture inside out.
    assert canvas.after(pinch, 30.0, Qt.NativeGestureType.RotateNativeGesture)[1] == pytest.approx(1.0)
    assert canvas.after(pinch, -1.5)[1] == pytest.approx(1.0)


def test_the_basis_panel_scrolls_along_t_only(basis):
    low, high = basis.plot.pixel_map.box[1::2]
    by, factor = basis.after(scroll, pixels=(25, 40), angle=(25, 40), phase=Phase.ScrollUpdate)
    assert (by[0], factor) == (pytest.approx(25), pytest.approx(1.0))
    assert basis.after(pinch, 0.5)[1] == pytest.approx(1.5)
    assert basis.plot.pixel_map.box[1::2] == pytest.approx((low, high))


def test_every_plot_scrolls_alike():
    def heirs(kind):
        return {kind} | {each for heir in kind.__subclasses__() for each in heirs(heir)}

    own = {kind for kind in heirs(PlotWidget) if "wheelEvent" in vars(kind)}
    # The one that stands in a panel which scrolls leaves the wheel to that.
    assert own == {PlotWidget, LogPlot}
