"""Zoom: its actions, its field in the status line, and the views to go back to."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
from PySide6.QtCore import QObject, QPoint, Qt, QTimer, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu, QSizePolicy, QWidget

from ...actions.declaration import action, also
from ...actions.menus import CANVAS_MENU, TOOLBAR, VIEW_ZOOM, VIEW_ZOOM_STEPS, ZOOM_MENU
from ...actions.needs import CURVE_WITH_POINTS
from ...document.expression import ExpressionError
from ...document.lengths import MILLIMETRES, known_unit
from ...document.words import number
from ...plotting.camera import Camera
from ...plotting.scrolling import ZOOM_STEP
from ...tasks.task import DelayedCall
from ...view_model.curve.curve_view import CurveView
from ...widgets.boxes import row_of
from ...widgets.controls import named, tool_button
from ...widgets.fields import NumberEdit, read_number
from ...workbench.context import WindowContext


class ZoomCommands:
    """Changes of which part of the plane is seen."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._canvas = context.central.canvas
        self._past = PastViews(self._canvas.camera, self._canvas)
        context.session.opened.connect(self._past.forget)
        self.field = ZoomField(context.status_line)
        self.field.zoom_entered.connect(self._take_zoom)
        self.field.refused.connect(context.session.refuse)
        self.field.offer([*context.actions.in_bar(ZOOM_MENU).values()])
        context.status_line.addPermanentWidget(self.field)
        self._canvas.camera.changed.connect(self._show_zoom)
        self._rendered_unit = self._unit
        self._show_zoom()

    # The zoom in per cent

    @property
    def _unit(self) -> str:
        return self._context.session.document.unit

    @property
    def _full_size(self) -> float:
        """Pixels of a length of 1 at 100 %."""
        return pixels_at_full_size(self._unit, self._canvas.logicalDpiX())

    def render_panel(self, view: CurveView) -> None:
        """Show the zoom again where the document has another unit."""
        if self._unit != self._rendered_unit:
            self._show_zoom()

    def _show_zoom(self) -> None:
        self._rendered_unit = self._unit
        share = self._canvas.pixel_map.sx / self._full_size
        self.field.show_zoom(share, full_size_text(self._unit, self._canvas.logicalDpiX()))

    def _take_zoom(self, share: float) -> None:
        self._canvas.setFocus(Qt.FocusReason.OtherFocusReason)
        self._zoom_to(share)

    def _zoom_to(self, share: float) -> None:
        self._zoom(share * self._full_size / self._canvas.pixel_map.sx)

    def _zoom(self, factor: float) -> None:
        self._past.begin_move()
        camera = self._canvas.camera
        before = camera.pixel_map.sx
        camera.zoom(factor, self._canvas.zoom_centre)
        if factor != 1 and camera.pixel_map.sx == before:
            self._context.session.refuse("The drawing cannot be displayed at that zoom.")

    # Actions

    @action("fitView", "Fit", VIEW_ZOOM, "F", "fit", full_name="Fit View")
    @also(TOOLBAR(60), CANVAS_MENU(30), ZOOM_MENU(20))
    def _fit(self) -> None:
        """Show all visible curves, or the reference image where there are no points."""
        self._past.begin_move()
        self._context.central.fit()

    @action(
        "fitSelection",
        "Fit Selection",
        VIEW_ZOOM_STEPS,
        "Shift+F, Ctrl+3",
        "fit-selection",
        needs=CURVE_WITH_POINTS,
        keywords="zoom to selection",
    )
    @also(ZOOM_MENU(21))
    def _fit_selection(self) -> None:
        """Zoom to the selected points, or else to the selected curves."""
        self._past.begin_move()
        session, framing = self._context.session, self._canvas.framing
        if parts := session.selected.group.parts:
            points = [session.views[curve].points[sorted(indices)] for curve, indices in parts]
            framing.fit_points(np.concatenate(points))
        else:
            framing.fit_views([session.views[curve] for curve in sorted(session.selected.curves)])

    @action("zoomIn", "Zoom In", VIEW_ZOOM_STEPS, "Ctrl+=, Ctrl++, +, =", "zoom-in")
    def _zoom_in(self) -> None:
        """Zoom in, about the pointer if it is over the canvas."""
        self._zoom(ZOOM_STEP)

    @action("zoomOut", "Zoom Out", VIEW_ZOOM_STEPS, "Ctrl+-, -", "zoom-out")
    def _zoom_out(self) -> None:
        """Zoom out, about the pointer if it is over the canvas."""
        self._zoom(1 / ZOOM_STEP)

    @action(
        "zoom100",
        "100 %",
        VIEW_ZOOM_STEPS,
        "Ctrl+0, Ctrl+1",
        "actual-size",
        full_name="Zoom to 100 %",
        keywords="actual true size 1:1",
    )
    @also(ZOOM_MENU(10))
    def _use_full_size(self) -> None:
        """Show the curves at actual size."""
        self._zoom_to(1.0)

    @action(
        "previousView", "Previous View", VIEW_ZOOM_STEPS, "`", "previous-view", keywords="zoom back undo view"
    )
    @also(ZOOM_MENU(30))
    def _go_back(self) -> None:
        """Return to the view before the last zoom or pan."""
        if not self._past.go_back():
            self._context.session.refuse("There is no previous view.")


PIXELS_WITHOUT_UNIT = 100.0
"""Pixels of a length of 1 at 100 %, where nobody has said how long that is."""

_MILLIMETRES_PER_INCH = 25.4
_PLAIN = (0.01, 1e6)
"""Per cents that are written without a power of ten."""


def pixels_at_full_size(unit: str, dots_per_inch: float) -> float:
    """Return the pixels of a length of 1 at 100 %: its actual size, where the unit is known."""
    known = known_unit(unit)
    if not known:
        return PIXELS_WITHOUT_UNIT
    return MILLIMETRES[known] / _MILLIMETRES_PER_INCH * dots_per_inch


def full_size_text(unit: str, dots_per_inch: float) -> str:
    """Return the sentence about the size of 100 %."""
    pixels = number(pixels_at_full_size(unit, dots_per_inch), 3)
    if known := known_unit(unit):
        return f"100 % is actual size on this screen: 1 {known} is {pixels} pixels."
    return f"Without a unit of length, 100 % draws a length of 1 as {pixels} pixels."


def per_cent_text(share: float) -> str:
    """Return a zoom with three digits: 1.0 as "100 %"."""
    value = 100 * share
    if not _PLAIN[0] <= value < _PLAIN[1]:
        return f"{number(value, 3)} %"
    return f"{number(float(f'{value:.3g}'), 7)} %"


def read_zoom(text: str) -> float:
    """Return the share that was typed: of "250 %", "250" and "500/2" 2.5.

    Raises
    ------
    ExpressionError
        With a message for the user, for an invalid zoom.
    """
    value = read_number(text.replace("%", " "))
    if value <= 0:
        raise ExpressionError("Type a zoom greater than 0, such as 250 %.")
    return value / 100


_SOON_MS = 33
"""Milliseconds after which a zoom is written: a wheel is quicker than an eye."""

_PADDING = 4
_WIDEST = "88888888 %"


class ZoomField(QWidget):
    """Shows the zoom, and takes another one.

    Signals
    -------
    zoom_entered
        Another zoom was typed, 1.0 for 100 %.
    refused
        Reason why the input is no zoom.
    """

    zoom_entered = Signal(float)
    refused = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("zoomReadout")
        self._share, self._about = 1.0, ""
        self.edit = NumberEdit("zoomField", "Zoom", "Zoom", read_zoom)
        self.edit.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.edit.setFrame(False)
        self.edit.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Preferred)
        self.edit.entered.connect(self._enter)
        self.edit.refused.connect(self.refused)
        self._choices = tool_button("zoomChoices", "Choose a zoom", "Choose a zoom", flat=True)
        self._choices.setArrowType(Qt.ArrowType.UpArrow)
        self._choices.clicked.connect(self._open_menu)
        self._menu = named(QMenu(self._choices), "zoomMenu")
        # No taller than the text beside it, or the status line would grow.
        for part in (self.edit, self._choices):
            part.setMaximumHeight(self.fontMetrics().height() + _PADDING)
        row_of(self.edit, self._choices, margins=0, spacing=0, parent=self)
        self._soon = DelayedCall(self, _SOON_MS, self._write)

    def offer(self, groups: Sequence[Sequence[QAction]]) -> None:
        """Set the actions of the menu, in groups."""
        for index, group in enumerate(groups):
            if index:
                self._menu.addSeparator()
            self._menu.addActions(list(group))

    def _open_menu(self) -> None:
        # Opened by hand: for a menu of the button the style would draw a second arrow.
        self._menu.popup(self.mapToGlobal(QPoint(0, -self._menu.sizeHint().height())))

    def show_zoom(self, share: float, about: str) -> None:
        """Show a zoom, and its tip about 100 %."""
        if share != self._share or about != self._about:
            self._share, self._about = share, about
            self._soon.start_if_idle()

    def _write(self) -> None:
        self._soon.stop()
        edit, text = self.edit, per_cent_text(self._share)
        edit.show_text(text)
        edit.setToolTip(f"Zoom: type a value such as 250 %. {self._about}")
        width = max(edit.fontMetrics().horizontalAdvance(line) for line in (text, _WIDEST)) + 14
        if width != edit.width():
            edit.setFixedWidth(width)

    def _enter(self, share: float) -> None:
        self.zoom_entered.emit(share)
        # Also without a change, to write the typed text in the usual form.
        self._write()


_REST_MS: Final = 300
"""Milliseconds without a move of the view after which the next one is another."""

_MOST: Final = 100

Box = tuple[float, float, float, float]


class PastViews(QObject):
    """Previous views of a camera; consecutive notches of the wheel are one move."""

    def __init__(self, camera: Camera, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._camera = camera
        self._before: list[Box] = []
        self._last_box, self._size = camera.pixel_map.box, self._size_now()
        # Whether a previous view is being restored, which is no move.
        self._is_going = False
        self._moving = QTimer(self, singleShot=True, interval=_REST_MS)
        camera.changed.connect(self._note)

    def _size_now(self) -> tuple[float, float]:
        pixel_map = self._camera.pixel_map
        return pixel_map.width, pixel_map.height

    def _note(self) -> None:
        """Remember the view before this move, unless only the window was resized."""
        box, size = self._camera.pixel_map.box, self._size_now()
        if size == self._size and box != self._last_box and not self._is_going:
            if not self._moving.isActive():
                self._before = [*self._before[-_MOST:], self._last_box]
            self._moving.start()
        self._last_box, self._size = box, size

    def begin_move(self) -> None:
        """Treat the next change as a separate move."""
        self._moving.stop()

    def forget(self) -> None:
        """Forget the views, after another document was opened."""
        self.begin_move()
        self._before.clear()

    def go_back(self) -> bool:
        """Go back to the previous view; return whether there is one."""
        self._moving.stop()
        if not self._before:
            return False
        x_min, y_min, x_max, y_max = self._before.pop()
        self._is_going = True
        self._camera.show_box((x_min, x_max), (y_min, y_max))
        self._is_going = False
        return True
