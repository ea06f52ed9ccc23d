"""The docks at the sides of the window: what stands in them, and in which order."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import TypeVar

import msgspec
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDockWidget, QMainWindow, QWidget

from app.actions.declaration import marked
from app.actions.qactions import Actions
from app.features.curve_list.panel import CurveList
from app.features.curve_settings.panel import CurveSettings
from app.features.history.panel import HistoryPanel
from app.features.point_table.panel import PointTable
from app.features.reference_image.panel import ImagePanel
from app.panels.fitting import Scrolled
from app.panels.late_dock import IN_DOCK, LateDock
from app.session import Session

_LEFT, _RIGHT = Qt.DockWidgetArea.LeftDockWidgetArea, Qt.DockWidgetArea.RightDockWidgetArea

_CURVE_LIST_BUTTONS = (
    "newCurve", "duplicateCurve", "deleteCurve", "joinCurve", "splitCurve", "reverseCurve", "closeCurve",
)  # fmt: skip
"""The actions that stand as buttons under the list of curves."""

_DECLARED = "late_panel"
_Builder = TypeVar("_Builder", bound=Callable[..., QWidget])

_Dock = TypeVar("_Dock", bound=QDockWidget)
_Panel = TypeVar("_Panel", bound=QWidget)


class LatePanel(msgspec.Struct, frozen=True):
    """A panel that is built when its dock is first shown: nobody waits for it at the start.

    Attributes
    ----------
    name, title
        Object name of its dock, and what stands on the tab.
    on_demand
        Whether its dock stays away until it is asked for: too many tabs are none.
    at_left
        Whether it stands at the left.
    """

    name: str
    title: str
    on_demand: bool = False
    at_left: bool = False

    def __call__(self, build: _Builder) -> _Builder:
        """Declare the decorated method of a command set as what builds the panel."""
        setattr(build, _DECLARED, self)
        return build


def late_panels(commands: type) -> Iterator[tuple[LatePanel, Callable[..., QWidget]]]:
    """Yield the panels that a command set declares, and what builds them."""
    for build, panel in marked(commands, _DECLARED):
        yield panel, build


class Docks:
    """Builds and places the docks of a window.

    Parameters
    ----------
    panels
        What is built late, in the order of the tabs.
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
        self,
        window: QMainWindow,
        session: Session,
        actions: Actions,
        panels: Sequence[LatePanel],
        build: Callable[[str], QWidget],
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
        added = {panel: self._add_late(panel) for panel in panels}
        late = [dock for panel, dock in added.items() if not panel.at_left]
        self.lessons = next(dock for panel, dock in added.items() if panel.at_left)
        self._stack(points, [curves, history])
        self._stack(curve, [*late, self.image])
        for panel, dock in added.items():
            if panel.on_demand:
                dock.hide()
        self.side = (points, curves, history, curve, *late, self.image)
        window.resizeDocks([points], [360], Qt.Orientation.Horizontal)
        window.resizeDocks([points, curve], [480, 300], Qt.Orientation.Vertical)

    def __getitem__(self, name: str) -> QDockWidget:
        return next(each for each in (*self.side, self.lessons) if each.objectName() == name)

    def _add(self, name: str, title: str, panel: Callable[[QWidget], _Panel]) -> tuple[QDockWidget, _Panel]:
        dock = QDockWidget(title, self._window)
        area = Scrolled(panel, IN_DOCK, dock)
        dock.setWidget(area)
        return self._place(dock, name, _RIGHT), area.content

    def _add_late(self, panel: LatePanel) -> LateDock:
        dock = LateDock(panel.title, lambda: self._build(panel.name), self._window)
        return self._place(dock, panel.name, _LEFT if panel.at_left else _RIGHT)

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
