"""Context menus of the canvas: the actions that fit what lies under the right button or the Menu key."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from msgspec.structs import replace
from PySide6.QtCore import QPoint
from PySide6.QtWidgets import QMenu

from ..actions.declaration import place_actions
from ..actions.menus import CANVAS_MENU, CHOSEN_MENU, CURVE_MENU, POINT_MENU
from ..document.shape_edits import pressed
from ..tools.pointer import Hit, Part
from ..workbench.context import WindowContext, bar_menu


class ContextMenus:
    """Menus of a point, of a curve, of what is chosen and of the canvas."""

    def __init__(
        self,
        context: WindowContext,
        command_sets: Mapping[type, object],
        attempt: Callable[[Callable[[], object]], None],
    ) -> None:
        self._context, self._attempt = context, attempt
        self._at_place = [pair for kind, each in command_sets.items() for pair in place_actions(kind, each)]
        context.central.canvas.menu_requested.connect(self._open_on_canvas)

    def _open_on_canvas(self, hit: Hit | None, place: QPoint) -> None:
        session = self._context.session
        if hit is not None and hit.curve >= 0:
            hit = self._as_own(hit)
        if hit is not None and hit.part is Part.OTHER_CURVE:
            # One of those that are selected leaves them selected: the menu is about all.
            selected = session.selected.marked
            if session.selected.is_editing or hit.index in selected:
                session.selected.set_curves(selected if hit.index in selected else (hit.index,), hit.index)
            else:
                session.selected.choose(pressed(session.document, hit.index, session.selected.choice))
            self._open_on_edited(place)
        elif hit is not None and hit.part is Part.CURVE:
            self._curve_menu(hit.t).popup(place)
        elif hit is not None and hit.part is not Part.GUIDE:
            if hit.index not in session.selection:
                session.selected.set_points([hit.index])
            bar_menu(self._context, POINT_MENU).popup(place)
        else:
            bar_menu(self._context, CANVAS_MENU).popup(place)

    def _as_own(self, hit: Hit) -> Hit:
        """Make the curve of a point or handle the active one; one that was chosen whole is meant whole."""
        selected = self._context.session.selected
        if hit.curve in selected.chosen and hit.index not in selected.group.of(hit.curve):
            return replace(hit, part=Part.OTHER_CURVE, index=hit.curve)
        selected.go_to(hit.curve)
        return hit.as_own

    def _open_on_edited(self, place: QPoint) -> None:
        """Open the menu for a place on the curve that the right button has made the one edited."""
        hit = self._context.central.canvas.hit_at(place)
        is_alone = len(self._context.session.selected.curves) == 1
        if hit is not None and hit.part is not Part.OTHER_CURVE and (is_alone or hit.part is Part.CURVE):
            self._open_on_canvas(hit, place)
        else:
            self._open_on_curves(place)

    def _open_on_curves(self, place: QPoint) -> None:
        """Open the menu of what is chosen as a whole; of a curve that is edited, its own."""
        is_whole = bool(self._context.session.selected.chosen)
        bar_menu(self._context, CHOSEN_MENU if is_whole else CURVE_MENU, is_short=is_whole).popup(place)

    def _curve_menu(self, t: float) -> QMenu:
        """Return the menu for a place on the active curve."""
        menu = bar_menu(self._context, CURVE_MENU)
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
