"""Rulers, guides and snapping: switches, guides typed and cleared, targets of snapping."""

from __future__ import annotations

from msgspec.structs import replace
from PySide6.QtCore import QPoint, QPointF, Qt

from ...actions.declaration import Action, action, action_for_each, also, switch
from ...actions.menus import (
    CANVAS_MENU,
    SNAP_MENU,
    TOOLBAR,
    VIEW_DRAWING,
    VIEW_GUIDES,
    VIEW_SNAP,
    VIEW_SNAP_TO,
)
from ...actions.needs import Need
from ...document.model import Axis, Guide
from ...document.plane_edits import add_guide, clear_guides, guide_label, move_guide
from ...state.window_state import WindowState
from ...tools.snapping import SnapKind
from ...workbench.context import WindowContext
from .. import snapping

_SOME_GUIDE = Need("", lambda state: state.has_guides, "There are no guides.")
_BESIDE = 6
"""Pixels between the field and the guide, or the ruler."""


class GuideCommands:
    """Rulers and guides: shown on the canvas, typed and cleared."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session
        self._canvas = context.central.canvas
        self._guides = self._canvas.drawing.guides
        self._field: snapping.guide_field.GuideField | None = None
        # The index of the guide that is typed; None for a new one.
        self._typed: int | None = None
        self._show_state(None, context.store.state)
        context.store.changed.connect(self._show_state)
        self._canvas.guide_drawn.connect(lambda: context.store.change(guides_visible=True))
        self._canvas.guide_opened.connect(self._open)

    def show_document(self) -> None:
        """Show the guides of the document."""
        self._guides.render(self._session.document.guides, self._unit)

    @property
    def _unit(self) -> str:
        return self._session.document.unit

    def _show_state(self, _before: WindowState | None, state: WindowState) -> None:
        if state.shows_rulers != self._canvas.rulers.are_visible:
            self._canvas.show_rulers(state.shows_rulers)
            self._context.central.message_bar.place()
        self._guides.set_visible(state.guides_visible)

    # The field

    @property
    def field(self) -> snapping.guide_field.GuideField:
        """The field on the canvas; created when first used."""
        if self._field is None:
            self._field = snapping.guide_field.GuideField(self._canvas.viewport())
            self._field.entered.connect(self._take)
            self._field.closed.connect(lambda: self._canvas.setFocus(Qt.FocusReason.OtherFocusReason))
            self._session.gesture_ended.connect(self._field.close_field)
        return self._field

    def _open(self, which: int | Axis) -> None:
        """Ask for the position of a guide of the document, or of a new one across an axis."""
        self._canvas.cancel_gesture()
        if isinstance(which, Axis):
            self._typed = None
            self.field.open_for(which, None, self._unit, lambda: self._corner_of_new(which))
        else:
            guide, self._typed = self._session.document.guides[which], which
            self.field.open_for(guide.axis, guide.position, self._unit, lambda: self._corner_of(guide))

    def _corner_of(self, guide: Guide) -> QPoint:
        """Return the corner of the field for a guide: beside the guide, at the ruler."""
        origin = self._canvas.camera.origin.toPoint()
        pixel = self._canvas.to_pixel(*guide.nearest_position(self._canvas.to_plane(origin)))
        at = QPoint(pixel.x(), origin.y()) if guide.axis is Axis.X else QPoint(origin.x(), pixel.y())
        return at + QPoint(_BESIDE, _BESIDE)

    def _corner_of_new(self, axis: Axis) -> QPoint:
        """Return the corner of the field for a new guide: at the ruler that measures its position."""
        origin, centre = self._canvas.camera.origin, self._canvas.camera.centre()
        at = QPointF(centre.x(), origin.y()) if axis is Axis.X else QPointF(origin.x(), centre.y())
        return (at + QPointF(_BESIDE, _BESIDE)).toPoint()

    def _take(self, guide: Guide) -> None:
        index, where = self._typed, guide_label(guide)
        if index is None:
            self._context.store.change(guides_visible=True)
            self._session.change(
                f"Guide at {where}", lambda document: add_guide(document, guide.axis, guide.position)
            )
        else:
            self._session.change(
                f"Move guide to {where}", lambda document: move_guide(document, index, guide.position)
            )

    # Actions

    @switch(
        "rulers",
        "toggleRulers",
        "Rulers",
        VIEW_DRAWING,
        "Ctrl+Shift+R",
        "rulers",
        full_name="Show Rulers",
    )
    def _toggle_rulers(self) -> None:
        """Show rulers above and to the left of the canvas, or plain axes."""

    @switch(
        "guides_visible",
        "toggleGuides",
        "Show Guides",
        VIEW_GUIDES,
        "Shift+\\, |",
        "guides",
        keywords="hide guidelines",
    )
    def _toggle(self) -> None:
        """Show or hide the guides. Drag guides out of the rulers; hidden guides are not snapped to."""

    @action("clearGuides", "Clear Guides", VIEW_GUIDES, needs=_SOME_GUIDE, keywords="remove all guides")
    def _clear(self) -> None:
        """Remove all guides."""
        self._session.change("Clear guides", clear_guides)


class SnapCommands:
    """Snapping: switched on and off, as a whole and for each target."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._show_state(None, context.store.state)
        context.store.changed.connect(self._show_state)

    def _show_state(self, before: WindowState | None, state: WindowState) -> None:
        # Snapping to invisible targets would be confusing.
        visible = {SnapKind.GRID: state.grid, SnapKind.GUIDES: state.guides_visible}
        hidden = {kind for kind, is_visible in visible.items() if not is_visible}
        effective = replace(state.snapping, kinds=state.snapping.kinds - hidden)
        canvas = self._context.central.canvas
        canvas.tools.snapping.settings = effective
        canvas.show_marks()
        if before is not None and before.snapping != state.snapping:
            # Update the drag in flight with the new targets.
            canvas.move_again()

    @action(
        "toggleSnap",
        "Snap",
        VIEW_SNAP,
        "%",
        "magnet",
        checked=lambda state: state.window.snapping.on,
        choices=SNAP_MENU,
    )
    @also(TOOLBAR(62), CANVAS_MENU(32))
    def _toggle(self) -> None:
        """Turn snapping to grid, guides, points and curves on or off, also during a drag."""
        store = self._context.store
        # Another window may have changed the preferences.
        store.read_preferences()
        on = not store.state.snapping.on
        store.change(snap_on=on)
        self._context.session.say(
            "Snapping is on. Press % to turn it off." if on else "Snapping is off. Press % to turn it on."
        )

    @action_for_each(
        tuple(SnapKind),
        lambda kind: Action(
            f"snapTo{kind.value.capitalize()}",
            kind.label,
            VIEW_SNAP_TO,
            tip=f"Turn snapping to {kind.label.lower()} on or off",
            full_name=f"Snap To: {kind.label}",
            checked=lambda state: kind in state.window.snapping.kinds,
            keywords="magnet",
        ),
    )
    @also(SNAP_MENU(10))
    def _toggle_kind(self, kind: SnapKind) -> None:
        store = self._context.store
        store.read_preferences()
        kinds = store.state.snapping.kinds ^ {kind}
        store.change(snap_kinds=kinds)
        is_on, what = kind in kinds, kind.label.lower()
        does = f"Snapping to {what} is {'on' if is_on else 'off'}."
        self._context.session.say(does if store.state.snapping.on else f"{does} Press % to turn snapping on.")


COMMAND_SETS = (GuideCommands, SnapCommands)
