"""Situation by which actions are enabled, checked and named."""

from __future__ import annotations

from ..document.model import Document
from ..document.paper import object_word
from ..document.point_group import PointGroup
from ..document.several_curves import is_blank
from ..document.shape_edits import objects
from ..session import Session
from ..state.window_state import WindowState, WindowStore
from ..view_model.curve.curve_view import CurveView
from .clipboard_watch import ClipboardWatch


class Situation:
    """The document, the selection and the window's state as they are now.

    Attributes
    ----------
    session
        The document, its history and the selection.
    """

    def __init__(self, session: Session, store: WindowStore, clipboard: ClipboardWatch) -> None:
        self.session, self._store, self._clipboard = session, store, clipboard
        self._known: tuple[Document, frozenset[int], int] | None = None

    @property
    def state(self) -> WindowState:
        """The window's state."""
        return self._store.state

    @property
    def thing(self) -> str:
        """What people call whatever is drawn, as it stands in titles: "Curve", on a page "Object"."""
        return object_word(self.session.document).title()

    @property
    def things(self) -> str:
        """The same of several."""
        return object_word(self.session.document, many=True).title()

    @property
    def view(self) -> CurveView:
        """The active curve."""
        return self.session.active_view

    @property
    def selection(self) -> frozenset[int]:
        """The selected points of the active curve; there are some where any are selected."""
        return self.session.selection

    @property
    def group(self) -> PointGroup:
        """The selected points, of all curves that are edited."""
        return self.session.selected.group

    @property
    def selected(self) -> frozenset[int]:
        """The selected curves."""
        return self.session.selected.curves

    @property
    def has_highlight(self) -> bool:
        """Whether there is something to copy or to delete."""
        return bool(self.session.selected.highlight().curves) and not self.is_blank

    @property
    def is_blank(self) -> bool:
        """Whether nothing has been drawn yet."""
        return is_blank(self.session.document)

    @property
    def chosen(self) -> frozenset[int]:
        """The curves that are acted on as wholes: those chosen, or several beside the one that is edited."""
        return self.session.selected.chosen

    @property
    def object_count(self) -> int:
        """The number of things that are chosen: a whole group is one, and a whole shape."""
        document, chosen, known = self.session.document, self.chosen, self._known
        if len(chosen) < 2:
            return len(chosen)
        if known is None or known[0] is not document or known[1] != chosen:
            known = self._known = document, chosen, len(objects(document, chosen))
        return known[2]

    @property
    def has_copied_derivatives(self) -> bool:
        """Whether there are derivatives on the clipboard; another program may have to be asked for that."""
        return self._clipboard.holds_derivatives

    @property
    def has_derivatives(self) -> bool:
        """Whether the active curve's family has velocities."""
        return self.session.active_curve.family.derivatives > 0
