"""Zoom: by steps, to a size, to what is drawn or selected, and back."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import Qt

from ...actions.declaration import action, also
from ...actions.menus import CANVAS_MENU, TOOLBAR, VIEW_ZOOM, VIEW_ZOOM_STEPS, ZOOM_MENU
from ...actions.needs import CURVE_WITH_POINTS
from ...plotting.scrolling import ZOOM_STEP
from ...view_model.curve.curve_view import CurveView
from ...workbench.context import WindowContext
from .past_views import PastViews
from .zoom_field import ZoomField, pixels_at_full_size, words_about_full_size


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
        self._unit_shown = self._unit
        self._show_zoom()

    # The zoom in per cent

    @property
    def _unit(self) -> str:
        return self._context.session.document.unit

    @property
    def _full_size(self) -> float:
        """Pixels of a length of 1 at 100 %."""
        return pixels_at_full_size(self._unit, self._canvas.logicalDpiX())

    def render(self, view: CurveView) -> None:
        """Show the zoom again where the document has another unit."""
        if self._unit != self._unit_shown:
            self._show_zoom()

    def _show_zoom(self) -> None:
        self._unit_shown = self._unit
        share = self._canvas.pixel_map.sx / self._full_size
        self.field.show_zoom(share, words_about_full_size(self._unit, self._canvas.logicalDpiX()))

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
            self._context.session.refuse("The drawing cannot be shown at that size.")

    # Actions

    @action("fitView", "Fit", VIEW_ZOOM, "F", "fit", full_name="Fit View")
    @also(TOOLBAR(60), CANVAS_MENU(30), ZOOM_MENU(20))
    def _fit(self) -> None:
        """Show all visible curves; without points the reference image."""
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
        """Show the selected points, or else the selected curves, as large as there is room for."""
        self._past.begin_move()
        session, framing = self._context.session, self._canvas.framing
        if parts := session.selected.group.parts:
            found = [session.views[curve].points[sorted(indices)] for curve, indices in parts]
            framing.fit_points(np.concatenate(found))
        else:
            framing.fit_views([session.views[place] for place in sorted(session.selected.curves)])

    @action("zoomIn", "Zoom In", VIEW_ZOOM_STEPS, "Ctrl+=, Ctrl++, +, =", "zoom-in")
    def _zoom_in(self) -> None:
        """Zoom in on the canvas, about the pointer if that is over it."""
        self._zoom(ZOOM_STEP)

    @action("zoomOut", "Zoom Out", VIEW_ZOOM_STEPS, "Ctrl+-, -", "zoom-out")
    def _zoom_out(self) -> None:
        """Zoom out on the canvas, about the pointer if that is over it."""
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
        """Show the curves at true size."""
        self._zoom_to(1.0)

    @action(
        "previousView", "Previous View", VIEW_ZOOM_STEPS, "`", "previous-view", keywords="zoom back undo view"
    )
    @also(ZOOM_MENU(30))
    def _go_back(self) -> None:
        """Show again what was seen before the last zoom or pan."""
        if not self._past.go_back():
            self._context.session.refuse("Nothing else was seen before.")
