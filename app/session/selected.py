"""What is selected: points, curves, the point under the pointer; each names something that exists."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..document.groups import expand_to_shapes
from ..document.point_group import NO_POINTS
from ..document.selection import SelectionState
from ..document.style import Style
from .highlight import ClipboardSelection

if TYPE_CHECKING:
    from .session import Session


class Selected:
    """Selection and the like, neither saved nor undone.

    One curve is edited, and with it those of its shape and those chosen beside it: their points are shown
    and selected, some of the active one if any. Or none is, and curves are chosen as wholes; the active one
    is then the last that was edited or chosen.

    Whatever is asked for, it names what exists in the document shown. The session's signals tell of it.

    Attributes
    ----------
    group
        The selected points, of all curves that are edited.
    curves
        Indices of the curves that are worked on together; the active one is one of them.
    last
        The curve that was chosen last, of several at once the foremost.
    is_editing
        Whether the active curve is edited.
    hovered
        The point under the pointer, or -1.
    is_lent
        Whether a tool took up the active curve while nothing was selected: nobody chose it.
    next_style
        The style that was set, or used last, while nothing was selected, or before the chosen curves were
        brought here: that of what is drawn next. None where that looks like the active curve.
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        self.group = NO_POINTS
        self.curves = frozenset({0})
        self.is_editing = True
        self.last = 0
        # While no curve is edited, those that are chosen: all of `curves`, or none at all.
        self._chosen: frozenset[int] = frozenset()
        self.hovered = -1
        self.is_lent = False
        self.next_style: Style | None = None

    @property
    def points(self) -> frozenset[int]:
        """Indices of the selected points of the active curve."""
        return self.group.of(self._session.active_index)

    @property
    def edited(self) -> frozenset[int]:
        """The curves whose points can be selected: the active one, its shape, and those chosen with it."""
        return self.whole if self.is_editing else frozenset()

    @property
    def chosen(self) -> frozenset[int]:
        """The curves that are acted on as wholes: those chosen, or several beside the one that is edited."""
        if not self.is_editing:
            return self._chosen
        return self.curves if len(self.curves) > 1 else frozenset()

    @property
    def meant(self) -> frozenset[int]:
        """The curves that an act on whole curves is for: chosen, of selected points, or the edited shape."""
        active = self._session.active_index
        return self.chosen or self.group.curves or expand_to_shapes(self._session.document, (active,))

    @property
    def marked(self) -> frozenset[int]:
        """The curves that are seen to be selected: the edited one or several, those chosen, or none."""
        return self.curves if self.is_editing else self._chosen

    def highlight(self, *, whole_curves: bool = False) -> ClipboardSelection:
        """Return the selected points, or else the chosen curves, or the edited one with all of its shape.

        `whole_curves` passes over the points, as where the list of curves has the focus.
        """
        if self.group.parts and not whole_curves:
            return ClipboardSelection(self.group.curves, self.group)
        # One curve of a shape can be chosen alone, in the list.
        return ClipboardSelection(self.whole if self.is_editing else self._chosen)

    @property
    def whole(self) -> frozenset[int]:
        """The selected curves, with all others of their shapes."""
        return expand_to_shapes(self._session.document, self.curves)

    @property
    def choice(self) -> SelectionState:
        """All that is selected now."""
        active = self._session.active_index
        return SelectionState(active, self.group, self.curves, self.chosen, self.is_editing)
