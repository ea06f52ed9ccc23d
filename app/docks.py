"""The docks at the sides of the window: what stands in them, and in which order."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TypeVar

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDockWidget, QMainWindow, QWidget

from app.actions.qactions import Actions
from app.panels.curve_list import CurveList
from app.panels.curve_settings import CurveSettings
from app.panels.fitting import Scrolled
from app.panels.history import HistoryPanel
from app.panels.image_panel import ImagePanel
from app.panels.late_dock import IN_DOCK, LateDock
from app.panels.point_table import PointTable
from app.session import Session

_LEFT, _RIGHT = Qt.DockWidgetArea.LeftDockWidgetArea, Qt.DockWidgetArea.RightDockWidgetArea

_CURVE_LIST_BUTTONS = (
    "newCurve", "duplicateCurve", "deleteCurve", "joinCurve", "splitCurve", "reverseCurve", "closeCurve",
)  # fmt: skip
"""The actions that stand as buttons under the list of curves."""

_LATE = {
    "jointsDock": "Joints",
    "analysisDock": "Analysis",
    "laboratoryDock": "Lab",
    "wiggleDock": "Wiggle",
    "hodographDock": "Hodograph",
}
"""Built when they are first shown: nobody waits for them at the start."""

_ASKED_FOR = ("laboratoryDock", "wiggleDock", "hodographDock")
"""Too many tabs are none: these come when they are asked for."""


_Dock = TypeVar("_Dock", bound=QDockWidget)
_Panel = TypeVar("_Panel", bound=QWidget)


class Docks:
    """Builds and places the docks of a window.

    Parameters
    ----------
    build
        Returns the content of a late dock, by its name.

    Attributes
    ----------
    side
        The docks at the right, in the order of their tabs.
    image, lessons
        The dock of the picture to trace; the one at the left.
    """

    def __init__(
        self, window: QMainWindow, session: Session, actions: Actions, build: Callable[[str], QWidget]
    ) -> None:
        self._window, self._build = window, build
        points, self.table_panel = self._add("pointsDock", "Points", PointTable)
        form = partial(CurveSettings, session.active_view)
        curve, self.curve_settings = self._add("curveDock", "Curve", form)
        curves, self.curve_list = self._add("curvesDock", "Curves", CurveList)
        self.curve_list.add_buttons([actions[name] for name in _CURVE_LIST_BUTTONS])
        steps = partial(HistoryPanel, session.undo_stack)
        history, self.history = self._add("historyDock", "History", steps)
        self.image, self.image_panel = self._add("imageDock", "Image", ImagePanel)
        late = [self._add_late(name, title) for name, title in _LATE.items()]
        self.lessons = self._add_late("lessonsDock", "Lessons", _LEFT)
        self._stack(points, [curves, history])
        self._stack(curve, [*late, self.image])
        for dock in (*late, self.lessons):
            if dock.objectName() in (*_ASKED_FOR, "lessonsDock"):
                dock.hide()
        self.side = (points, curves, history, curve, *late, self.image)
        window.resizeDocks([points], [360], Qt.Orientation.Horizontal)
        window.resizeDocks([points, curve], [480, 300], Qt.Orientation.Vertical)

    def _add(self, name: str, title: str, panel: Callable[[QWidget], _Panel]) -> tuple[QDockWidget, _Panel]:
        dock = QDockWidget(title, self._window)
        area = Scrolled(panel, IN_DOCK, dock)
        dock.setWidget(area)
        return self._place(dock, name, _RIGHT), area.content

    def _add_late(self, name: str, title: str, area: Qt.DockWidgetArea = _RIGHT) -> LateDock:
        return self._place(LateDock(title, lambda: self._build(name), self._window), name, area)

    def _place(self, dock: _Dock, name: str, area: Qt.DockWidgetArea) -> _Dock:
        dock.setObjectName(name)
        dock.setAllowedAreas(_LEFT | _RIGHT)
        self._window.addDockWidget(area, dock)
        return dock

    def _stack(self, front: QDockWidget, others: Sequence[QDockWidget]) -> None:
        """Make tabs of docks, the first in front."""
        for other in others:
            self._window.tabifyDockWidget(front, other)
        front.raise_()
