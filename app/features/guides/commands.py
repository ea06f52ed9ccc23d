"""Rulers and guides: shown, typed, cleared."""

from __future__ import annotations

from PySide6.QtCore import QPoint, QPointF, Qt

from ...actions.declaration import action, switch
from ...actions.menus import VIEW_DRAWING, VIEW_GUIDES
from ...actions.needs import Need
from ...document.model import Axis, Guide
from ...document.plane_edits import add_guide, clear_guides, move_guide, place_words
from ...state.window_state import WindowState
from ...workbench.context import WindowContext
from .. import guides

_SOME_GUIDE = Need("a guide", lambda state: state.has_guides)
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
        self._canvas.guide_drawn.connect(lambda: context.store.change(guides_shown=True))
        self._canvas.guide_opened.connect(self._open)

    def show_document(self) -> None:
        """Show the guides of the document."""
        self._guides.render(self._session.document.guides, self._unit)

    @property
    def _unit(self) -> str:
        return self._session.document.unit

    def _show_state(self, _before: WindowState | None, state: WindowState) -> None:
        if state.shows_rulers != self._canvas.rulers.are_shown:
            self._canvas.show_rulers(state.shows_rulers)
            self._context.central.message_bar.place()
        self._guides.set_visible(state.guides_shown)

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
        if isinstance(which, Axis):
            self._typed = None
            self.field.open_for(which, None, self._unit, lambda: self._corner_of_new(which))
        else:
            guide, self._typed = self._session.document.guides[which], which
            self.field.open_for(guide.axis, guide.position, self._unit, lambda: self._corner_of(guide))

    def _corner_of(self, guide: Guide) -> QPoint:
        """Return where the field stands for a guide: beside it, at the ruler."""
        origin = self._canvas.camera.origin.toPoint()
        pixel = self._canvas.to_pixel(*guide.beside(self._canvas.to_plane(origin)))
        at = QPoint(pixel.x(), origin.y()) if guide.axis is Axis.X else QPoint(origin.x(), pixel.y())
        return at + QPoint(_BESIDE, _BESIDE)

    def _corner_of_new(self, axis: Axis) -> QPoint:
        """Return where the field stands for a new guide: at the ruler along which its place is measured."""
        origin, centre = self._canvas.camera.origin, self._canvas.camera.centre()
        at = QPointF(centre.x(), origin.y()) if axis is Axis.X else QPointF(origin.x(), centre.y())
        return (at + QPointF(_BESIDE, _BESIDE)).toPoint()

    def _take(self, guide: Guide) -> None:
        place, where = self._typed, place_words(guide)
        if place is None:
            self._context.store.change(guides_shown=True)
            self._session.change(
                f"Guide at {where}", lambda document: add_guide(document, guide.axis, guide.position)
            )
        else:
            self._session.change(
                f"Move guide to {where}", lambda document: move_guide(document, place, guide.position)
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
        """Show rulers above the canvas and at its left, or plain axes."""

    @switch(
        "guides_shown",
        "toggleGuides",
        "Show Guides",
        VIEW_GUIDES,
        "Shift+\\, |",
        "guides",
        keywords="hide guidelines",
    )
    def _toggle(self) -> None:
        """Show or hide the guides, which are dragged out of the rulers; nothing snaps to hidden ones."""

    @action("clearGuides", "Clear Guides", VIEW_GUIDES, needs=_SOME_GUIDE, keywords="remove all guides")
    def _clear(self) -> None:
        """Remove all guides."""
        self._session.change("Clear guides", clear_guides)


COMMAND_SETS = (GuideCommands,)
