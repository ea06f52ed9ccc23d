"""Rulers and guides: shown, locked, added, typed, cleared."""

from __future__ import annotations

from PySide6.QtCore import QPoint, QPointF, Qt

from ...actions.declaration import action, also, switch
from ...actions.needs import Need
from ...actions.sections import VIEW_DRAWING, VIEW_GUIDES, VIEW_GUIDES_MORE
from ...actions.situation import Situation
from ...actions.strips import CANVAS_MENU, GUIDE_MENU
from ...document.guide_edits import (
    add_guide,
    clear_guides,
    lock_guide,
    move_guide,
    place_words,
    remove_guide,
)
from ...document.model import Axis, Document, Guide
from ...document.readings import Readings, readings_of
from ...state.window_state import WindowState
from ...workbench.context import WindowContext
from .. import guides
from .made_commands import MadeGuideCommands

_SOME_GUIDE = Need("a guide", lambda now: bool(now.session.document.guides))
_FREE_GUIDE = Need("a guide that is not locked", lambda now: _is_locked(now) is False)
_BESIDE = 6
"""Pixels between the field and the guide, or the ruler."""


class GuideCommands:
    """Keeps the canvas in step with the guides of the document, and changes them."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session
        self._canvas = context.central.canvas
        self._guides = self._canvas.drawing.guides
        self._made: guides.field.GuideField | None = None
        # The guide whose place is typed; None for a new one.
        self._typed: int | None = None
        self._show_state(None, context.store.state)
        context.store.changed.connect(self._show_state)
        self._guides.pointed_at = lambda place: context.store.change(guide=place)
        self._canvas.guide_drawn.connect(lambda: context.store.change(guides_shown=True))
        self._canvas.guide_opened.connect(self._open)

    def show_document(self) -> None:
        """Show the guides of the document."""
        drawn = self._session.document.guides
        self._guides.render(drawn, self._unit, self._readings)
        if not drawn:
            self._guides.point_at(-1)

    @property
    def _unit(self) -> str:
        return self._session.document.unit

    @property
    def _readings(self) -> Readings:
        return readings_of(self._session.document)

    def _show_state(self, _before: WindowState | None, state: WindowState) -> None:
        if state.shows_rulers != self._canvas.rulers.are_shown:
            self._canvas.show_rulers(state.shows_rulers)
            self._context.central.message_bar.place()
        self._guides.set_visible(state.guides_shown)
        self._guides.locked = state.guides_locked
        self._canvas.change_tool_settings(guides_stay=state.guides_locked or not state.guides_shown)

    # The field

    @property
    def field(self) -> guides.field.GuideField:
        """The field on the canvas; made when somebody first types into it."""
        if self._made is None:
            self._made = guides.field.GuideField(self._canvas.viewport())
            self._made.entered.connect(self._take)
            self._made.closed.connect(lambda: self._canvas.setFocus(Qt.FocusReason.OtherFocusReason))
            self._session.interrupted.connect(self._made.close_field)
        return self._made

    def _open(self, which: int | Axis) -> None:
        """Ask for the place of a guide in the document, or of a new one of an axis."""
        self._canvas.cancel_gesture()
        middle = self._canvas.to_plane(self._canvas.camera.centre().toPoint())
        if isinstance(which, Axis):
            self._typed = None
            self.field.open_for(None, which, self._unit, self._readings, self._corner_of_new, middle)
        else:
            guide, self._typed = self._session.document.guides[which], which
            self.field.open_for(
                guide, guide.axis, self._unit, self._readings, lambda _axis: self._corner_of(guide), middle
            )

    def _corner_of(self, guide: Guide) -> QPoint:
        """Return where the field stands for a guide: beside it, at the ruler."""
        # At an angle where it comes in; its field goes no farther than the canvas.
        corner = guide.beside(self._canvas.to_plane(self._canvas.camera.origin.toPoint()))
        origin, pixel = self._canvas.camera.origin, self._canvas.to_pixel(*corner)
        if guide.axis is Axis.X:
            return QPoint(pixel.x() + _BESIDE, int(origin.y()) + _BESIDE)
        return QPoint(int(origin.x()) + _BESIDE, pixel.y() + _BESIDE)

    def _corner_of_new(self, axis: Axis) -> QPoint:
        """Return where the field stands for a new guide: at the ruler along which its place is measured."""
        origin, centre = self._canvas.camera.origin, self._canvas.camera.centre()
        at = QPointF(centre.x(), origin.y()) if axis is Axis.X else QPointF(origin.x(), centre.y())
        return (at + QPointF(_BESIDE, _BESIDE)).toPoint()

    def _take(self, guide: Guide) -> None:
        place = self._typed
        if place is None:
            self._context.store.change(guides_shown=True)
            name = f"Guide at {place_words(guide, self._readings)}"
            drawn = guide.axis, guide.position, guide.lean, guide.across
            self._session.change(name, lambda document: add_guide(document, *drawn))
        else:
            name = f"Move guide to {place_words(guide, self._readings)}"
            self._session.change(name, lambda document: move_guide(document, place, guide))

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
        """Show rulers above the canvas and at its left, or plain axes."""

    @action("addGuide", "Add Guide…", VIEW_GUIDES, "Shift+G", "add-guide", keywords="guideline help line")
    @also(CANVAS_MENU(33))
    def _add(self) -> None:
        """Type where a new guide lies and at which angle: “x = 20”, “y = 1 in”; or drag it from a ruler."""
        self._open(Axis.X)

    @action("typeGuide", "Type Place…", VIEW_GUIDES, full_name="Type Place of Guide…", needs=_FREE_GUIDE)
    @also(GUIDE_MENU(10))
    def _type(self) -> None:
        """Type where the guide lies that was pointed at last, and at which angle."""
        self._open(self._last())

    @action(
        "removeGuide",
        "Remove Guide",
        VIEW_GUIDES,
        "",
        "delete",
        needs=_FREE_GUIDE,
        keywords="delete guideline",
    )
    @also(GUIDE_MENU(11))
    def _remove(self) -> None:
        """Remove the guide that was pointed at last."""
        place = self._last()
        where = place_words(self._session.document.guides[place], self._readings)
        self._session.change(f"Remove guide at {where}", lambda document: remove_guide(document, place))

    @action(
        "lockGuide",
        "Lock Guide",
        VIEW_GUIDES,
        "",
        "lock",
        needs=_SOME_GUIDE,
        title=lambda now: "Unlock Guide" if _is_locked(now) else "Lock Guide",
        keywords="unlock guideline fix protect",
    )
    @also(GUIDE_MENU(12))
    def _lock_one(self) -> None:
        """Keep the guide that was pointed at last where it is, whatever is pressed; or let it go again."""
        place = self._last()
        guide = self._session.document.guides[place]
        text = f"{'Unlock' if guide.locked else 'Lock'} guide at {place_words(guide, self._readings)}"
        self._session.change(text, lambda document: lock_guide(document, place, locked=not guide.locked))

    def _last(self) -> int:
        return _pointed_at(self._session.document, self._context.store.state)

    @switch(
        "guides_shown",
        "toggleGuides",
        "Show Guides",
        VIEW_GUIDES_MORE,
        "Shift+\\, |",
        "guides",
        keywords="hide guidelines",
    )
    def _toggle(self) -> None:
        """Show or hide the guides; nothing snaps to hidden ones."""

    @switch(
        "guides_locked",
        "lockGuides",
        "Lock Guides",
        VIEW_GUIDES_MORE,
        "",
        "lock",
    )
    @also(GUIDE_MENU(20))
    def _lock(self) -> None:
        """Keep all guides where they are: a press goes to what lies behind them."""

    @action("clearGuides", "Clear Guides", VIEW_GUIDES_MORE, needs=_SOME_GUIDE, keywords="remove all guides")
    @also(GUIDE_MENU(21))
    def _clear(self) -> None:
        """Remove all guides but those that are locked."""
        self._session.change("Clear guides", clear_guides)


def _pointed_at(document: Document, state: WindowState) -> int:
    """Return the place of the guide that was pointed at last, else of the last one that was added."""
    count = len(document.guides)
    return state.guide if 0 <= state.guide < count else count - 1


def _is_locked(now: Situation) -> bool | None:
    """Whether the guide that was pointed at last is locked; None without guides."""
    guides = now.session.document.guides
    return guides[_pointed_at(now.session.document, now.state)].locked if guides else None


COMMAND_SETS = (GuideCommands, MadeGuideCommands)
