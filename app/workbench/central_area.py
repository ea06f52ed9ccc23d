"""Middle of the window: the canvas, and below it the panes that features declare."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeVar

import msgspec
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QSplitter, QToolButton, QVBoxLayout, QWidget

from ..actions.declaration import marked
from ..canvas.canvas import Canvas
from ..plotting.camera import CameraOverT
from ..plotting.tool_plot import ToolPlot
from ..session import Session
from ..tools.canvas.select import SELECT
from ..tools.toolbox import Toolbox
from ..view_model.basis import BasisView
from .message_bar import MessageBar

_DECLARED = "central_pane"


class CentralPane(QWidget):
    """Pane below the canvas.

    Attributes
    ----------
    plot
        The plot of the pane; None until it is created.
    """

    plot: ToolPlot | None = None

    @property
    def stop(self) -> QWidget:
        """Widget that gets the focus by F6."""
        return self

    def fit(self, *, whole: bool) -> None:
        """Show the usual range of values, or all of them."""


_Builder = TypeVar("_Builder", bound=Callable[..., CentralPane])


class Pane(msgspec.Struct, frozen=True):
    """Declaration of a pane below the canvas; the decorated method builds it in the parent that it gets.

    Attributes
    ----------
    name
        Its object name.
    stretch, height
        Stretch factor when the window grows, and height in a new window (0: its size hint).
    """

    name: str
    stretch: int = 0
    height: int = 0

    def __call__(self, build: _Builder) -> _Builder:
        """Declare the decorated method as the one that builds the pane."""
        setattr(build, _DECLARED, self)
        return build


_STRETCH, _HEIGHT = 9, 600
"""Of the canvas, in a new window."""

_CANVAS_SHARE, _LEAST_PANE = 0.4, 130
"""Share of the height that the canvas keeps, and pixels that a pane keeps, when another pane grows."""


class CentralArea:
    """Plots of a window, with the message bar over the canvas.

    Attributes
    ----------
    canvas
        The drawing.
    panes
        The panes below the canvas, from the top down.
    t_camera
        The camera of the shared t axis, set by the pane that owns it.
    basis
        The functions drawn over that axis, None without a curve.
    message_bar
        The line on the canvas.
    splitter, under_canvas
        The splitter of canvas and panes; the layout for bars below the canvas.
    """

    t_camera: CameraOverT
    basis: BasisView | None = None

    def __init__(self, session: Session, parent: QWidget) -> None:
        # Each with its final parent from the start: a widget that is moved is styled again with its content.
        self.splitter = QSplitter(Qt.Orientation.Vertical, parent)
        self.splitter.setObjectName("drawingSplitter")
        pane = QWidget(self.splitter)
        self.canvas = Canvas(Toolbox(session, SELECT), pane)
        self.message_bar = MessageBar(self.canvas.viewport())
        self.message_bar.clear_top = lambda: self.canvas.rulers.thickness
        bar, rulers = self.message_bar, self.canvas.rulers
        self.canvas.framing.covered_top = lambda: max(bar.covered - rulers.thickness, 0.0)
        self.under_canvas = QVBoxLayout(pane)
        self.under_canvas.setContentsMargins(0, 0, 0, 0)
        self.under_canvas.setSpacing(0)
        self.under_canvas.addWidget(self.canvas, 1)
        self.panes: tuple[CentralPane, ...] = ()
        self._fits_whole = False
        # The heights at scale 1, while the scale is another one.
        self._scale, self._usual_heights = 1.0, list[int]()
        self.splitter.setStretchFactor(0, _STRETCH)
        self.splitter.setChildrenCollapsible(False)
        # Else the background of the window shows beside the thin line of a handle.
        self.splitter.setAutoFillBackground(True)

    def fill(self, command_sets: Mapping[type, object]) -> None:
        """Build the panes that the command sets declare, in order."""
        heights = [_HEIGHT]
        for kind, commands in command_sets.items():
            for build, declared in marked(kind, _DECLARED):
                pane = build(commands, self.splitter)
                pane.setObjectName(declared.name)
                self.panes += (pane,)
                self.splitter.setStretchFactor(len(self.panes), declared.stretch)
                heights += [declared.height] if declared.height else []
        self.splitter.setSizes(heights)
        # Else the window uses the minimum size of the canvas alone.
        self.splitter.updateGeometry()
        self._order_tabs()

    def _order_tabs(self) -> None:
        """Let Tab visit the panes after the canvas, although they are built after toolbar and docks."""
        last: QWidget = self.message_bar.findChildren(QToolButton)[-1]
        for pane in self.panes:
            for widget in pane.findChildren(QWidget):
                if widget.focusPolicy() & Qt.FocusPolicy.TabFocus:
                    QWidget.setTabOrder(last, widget)
                    last = widget

    def __getitem__(self, name: str) -> CentralPane:
        return next(pane for pane in self.panes if pane.objectName() == name)

    @property
    def plots(self) -> list[ToolPlot]:
        """The canvas and the plots below it that are built."""
        return [self.canvas, *(pane.plot for pane in self.panes if pane.plot is not None)]

    @property
    def stops(self) -> list[QWidget]:
        """Widgets that get the focus by F6, from the top down."""
        return [self.canvas, *(pane.stop for pane in self.panes)]

    def cancel_gesture(self) -> bool:
        """Cancel the gesture in flight; return whether there was one."""
        return any(plot.cancel_gesture() for plot in self.plots)

    def set_scale(self, scale: float) -> None:
        """Enlarge points, lines and numbers, for a projector, and the panes up to half of the height.

        At scale 1 the panes have the heights that they had before.
        """
        for plot in self.plots:
            plot.set_scale(scale)
        heights = self.splitter.sizes()
        usual = self._usual_heights or heights
        self._usual_heights = usual if scale != 1.0 else []
        # A pane that was opened since then has no usual height.
        pairs = zip(usual, heights, strict=True)
        _canvas, *wanted = (max(scale, 1.0) * (then or now / self._scale) for then, now in pairs)
        share = min(sum(heights) / 2 / (sum(wanted) or 1.0), 1.0) if scale > 1.0 else 1.0
        panes = [round(share * height) for height in wanted]
        self._scale = scale
        self.splitter.setSizes([sum(heights) - sum(panes), *panes])

    def fit(self) -> None:
        """Fit all curves, and the usual ranges of the panes."""
        self.canvas.framing.fit()
        self.fit_panes(whole=False)

    def fit_panes(self, *, whole: bool) -> None:
        """Fit the panes to their usual ranges, or to all values."""
        self._fits_whole = whole
        for pane in self.panes:
            pane.fit(whole=whole)

    def fit_again(self) -> None:
        """Fit everything as before, after the window was resized."""
        self.canvas.framing.fit()
        self.fit_panes(whole=self._fits_whole)

    def make_room(self, pane: CentralPane, height: int) -> None:
        """Give a pane at least this height, at the expense of the canvas first, then of the other panes."""
        heights, index = self.splitter.sizes(), self.splitter.indexOf(pane)
        missing, least = height - heights[index], int(_CANVAS_SHARE * sum(heights))
        if missing <= 0:
            return
        for other in range(len(heights)):
            if other != index:
                given = max(min(missing, heights[other] - (_LEAST_PANE if other else least)), 0)
                heights[other] -= given
                heights[index] += given
                missing -= given
        self.splitter.setSizes(heights)
