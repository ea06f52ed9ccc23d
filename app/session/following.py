"""The selection from document to document."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from ..document.differences import reshaped_curves
from ..document.model import Document
from ..document.point_group import NO_POINTS
from ..document.selection import (
    SelectionState,
    followed_curves,
    followed_selection,
    returned_curves,
    returned_points,
)

if TYPE_CHECKING:
    from .selection import Selection
    from .session import Session


class Following:
    """What becomes of the selection as its session goes to another document, or to another state of one."""

    def __init__(self, session: Session) -> None:
        self._session = session

    # To another document

    def leave(self) -> None:
        """Put away what is selected of a document that goes."""
        selected = self._session.selected
        selected.set_points([])
        selected.take_up()
        selected.next_style = None

    def begin_opened(self) -> None:
        """Begin with a document that was opened: nobody chose its curves.

        None hidden or locked is edited.
        """
        selected = self._session.selected
        selected.is_lent = False
        if not self._session.active_curve.is_selectable:
            selected.choose(())

    def reset(self) -> None:
        """Edit the active curve, with nothing of it selected, and tell nobody yet."""
        selected, active = self._session.selected, self._session.active_index
        selected.hold((active,))
        selected.group, selected.last = NO_POINTS, active

    # Around a gesture

    def begin(self, index: int) -> None:
        """Edit curve `index`, which a gesture begins, and nothing else; tell nobody yet."""
        selected = self._session.selected
        selected.enter(index)
        selected.hold((index,))
        # It is not in the document yet.
        selected.is_lent = True

    def settle(self) -> None:
        """Take what a gesture showed as selected, and which was dropped, for what is: as far as it may be."""
        selected = self._session.selected
        if not selected.is_editing and selected.chosen and selected.chosen != selected.curves:
            selected.set_curves(selected.chosen)
        selected.keep_group(selected.group)

    # To another state

    @contextmanager
    def going_on(self, before: Document) -> Iterator[None]:
        """Go along from a document to the one that is shown now, around what tells of it.

        Nobody who is told of the document finds something named that it does not have. Whoever draws it has
        to hear of the points first.
        """
        session, selected, curves = self._session, self._session.selected, self._session.document.curves
        if session.active_index in selected.curves and reshaped_curves(before, session.document) is not None:
            # As under most drags: all that is selected, or pointed at, is where it was.
            yield
            session.scrub.keep()
            return
        marked = [each for place, each in enumerate(before.curves) if place in selected.marked]
        session.active_index = min(session.active_index, len(curves) - 1)
        old = selected.choice
        new = followed_selection(old, before.curves, curves)
        session.active_index = new.active
        selected.last = max(followed_curves({selected.last}, before.curves, curves), default=new.active)
        selected.hold(new.curves, new.chosen, is_editing=new.is_editing)
        if marked and not selected.marked:
            # They were deleted: what is drawn next looks like the foremost of them, unless they were brought.
            selected.next_style = selected.next_style or marked[-1].style
        elif all(each is not curves[new.active] for each in before.curves):
            # It was begun, or worked on.
            selected.is_lent, selected.next_style = False, None
        selected.keep_group(selected.group)
        selected.set_hovered(selected.hovered)
        yield
        selected.keep_group(new.points)
        session.scrub.keep()
        if (new.curves, new.chosen, new.is_editing) != (old.curves, old.chosen, old.is_editing):
            session.selected_curves_changed.emit(selected.curves)

    def select_returned(self, document: Document, then: SelectionState | None) -> None:
        """Select points, or curves, that undo or redo has brought back; edit or choose what was `then`.

        That is so, too, where what was edited or chosen since goes with the step, as copies do.
        """
        selected, now, before = self._session.selected, self._session.committed, document.curves
        curves = now.curves
        returned = returned_curves(before, curves)
        is_left = len(before) > len(curves)
        if then is not None and _comes_back(then, returned, selected, is_left=is_left):
            selected.restore(then)
        elif len(returned) > 1 or (returned and not selected.is_editing):
            selected.set_curves(returned)
        elif selected.is_editing and not selected.group.parts and len(before) == len(curves):
            selected.keep_group(returned_points(selected.edited, before, curves))


def _comes_back(then: SelectionState, returned: Collection[int], now: Selection, *, is_left: bool) -> bool:
    """Whether what was selected before a step is selected again, for undo has brought back some of it.

    Likewise where nothing is selected any more, for what the step has made is gone: then points of what was
    edited, or what was chosen as a whole.
    """
    has_gone = is_left and not now.marked
    if then.is_editing:
        has_gone = has_gone and bool(then.points.parts)
        return not now.is_editing and (has_gone or not then.curves.isdisjoint(returned))
    return not then.chosen.isdisjoint(returned) or (has_gone and bool(then.chosen))
