"""What the right button and the Menu key open: the actions that fit what lies there."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QMenu

from app.actions.declaration import place_actions
from app.tools.pointer import Hit, Part
from app.workbench.context import WindowContext

_SEPARATOR = ""
_POINT = (
    "tangentSmooth", "tangentCorner", "tangentEstimated", "straightSegment", "pullVelocity", _SEPARATOR,
    "splitCurve", _SEPARATOR,
    "cutPoints", "copyPoints", "copyDerivatives", "pasteDerivatives", _SEPARATOR,
    "deleteSelection",
)  # fmt: skip
_CURVE = (
    "closeCurve", "reverseCurve", "joinCurve", "duplicateCurve", "freezeParameters", _SEPARATOR,
    "curveColour", "curveVisible", "curveLocked", _SEPARATOR,
    "deleteCurve",
)  # fmt: skip
_CANVAS = (
    "addTool", "selectAll", "selectAllCurves", _SEPARATOR,
    "pastePoints", "pasteAsCurve", "newCurve", _SEPARATOR,
    "fitView", "toggleGrid", "toggleSnap", "toggleScrub",
)  # fmt: skip
_LIST = (
    "renameCurve", "curveColour", "curveVisible", "curveLocked", _SEPARATOR,
    "raiseCurve", "lowerCurve", "selectAllCurves", "onlyThisCurve", _SEPARATOR,
    "newCurve", "duplicateCurve", "joinCurve", "reverseCurve", "closeCurve", _SEPARATOR,
    "deleteCurve",
)  # fmt: skip


class ContextMenus:
    """Fills menus from the registry of actions, for a point, a curve, the canvas and the list of curves."""

    def __init__(
        self,
        context: WindowContext,
        command_sets: Mapping[type, object],
        attempt: Callable[[Callable[[], object]], None],
    ) -> None:
        self._context, self._attempt = context, attempt
        self._at_place = [pair for kind, each in command_sets.items() for pair in place_actions(kind, each)]
        context.central.canvas.menu_requested.connect(self._open_on_canvas)

    def open_on_list(self, place: QPoint) -> None:
        """Open the menu of the list of curves."""
        self._popup(self._menu(_LIST), place)

    def _open_on_canvas(self, hit: Hit | None, place: QPoint) -> None:
        session = self._context.session
        if hit is not None and hit.part is Part.OTHER_CURVE:
            # One of those that are selected leaves them selected: the menu is about all.
            selected = session.selected.curves
            session.selected.set_curves(selected if hit.index in selected else (hit.index,), hit.index)
            self._open_on_edited(place)
        elif hit is not None and hit.part is Part.CURVE:
            self._popup(self._curve_menu(hit.t), place)
        elif hit is not None:
            if hit.index not in session.selection:
                session.selected.set_points([hit.index])
            self._popup(self._menu(_POINT), place)
        else:
            self._popup(self._menu(_CANVAS), place)

    def _open_on_edited(self, place: QPoint) -> None:
        """Open the menu for a place on the curve that the right button has made the one edited."""
        hit = self._context.central.canvas.hit_at(place)
        is_alone = len(self._context.session.selected.curves) == 1
        if hit is not None and hit.part is not Part.OTHER_CURVE and (is_alone or hit.part is Part.CURVE):
            self._open_on_canvas(hit, place)
        else:
            self._popup(self._menu(_CURVE), place)

    def _curve_menu(self, t: float) -> QMenu:
        """Return the menu for a place on the active curve."""
        menu = self._menu(_CURVE)
        top = menu.actions()[0]
        for entry, act in self._at_place:
            known = self._context.actions[entry.like]
            here = menu.addAction(known.icon(), entry.text)
            here.setObjectName(entry.name)
            here.setStatusTip(known.statusTip())
            here.setToolTip(known.toolTip())
            here.setEnabled(known.isEnabled())
            here.triggered.connect(lambda _checked=False, act=act: self._attempt(lambda: act(t)))
            menu.insertAction(top, here)
        menu.insertSeparator(top)
        return menu

    def _menu(self, names: tuple[str, ...]) -> QMenu:
        menu = QMenu(self._context.window)
        menu.setObjectName("contextMenu")
        menu.setToolTipsVisible(True)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        for name in names:
            if name == _SEPARATOR:
                menu.addSeparator()
            else:
                menu.addAction(self._context.actions[name])
        return menu

    @staticmethod
    def _popup(menu: QMenu, place: QPoint) -> None:
        menu.popup(place)
