"""Selected points, selected curves, the point under the pointer; each names something that exists."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from contextlib import contextmanager
from itertools import repeat
from operator import is_
from typing import TYPE_CHECKING

from ..document.layers import layer_of
from ..document.model import Curve, Document
from ..document.point_group import NO_POINTS, PointGroup, some_points
from ..document.selection import (
    Choice,
    are_left,
    existing_points,
    followed_curves,
    followed_group,
    returned_curves,
    returned_points,
    with_points,
)
from ..document.several_curves import is_blank
from ..document.shapes import whole_shapes
from ..document.steps import reshaped
from .highlight import Highlight
from .next_style import Marked, NextStyle

if TYPE_CHECKING:
    from .session import Session


class Selection:
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
    next_style
        The style of what is drawn next, where nothing is chosen.
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
        self.next_style = NextStyle()
        # The layer that was chosen since a curve was; None where that of the active curve is meant.
        self._layer: str | None = None

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
        several = self.curves if len(self.curves) > 1 else frozenset[int]()
        return several if self.is_editing else self._chosen

    @property
    def marked(self) -> frozenset[int]:
        """The curves that are seen to be selected: the edited one or several, those chosen, or none."""
        return self.curves if self.is_editing else self._chosen

    @property
    def means_curve(self) -> bool:
        """Whether there is a curve to act on: edited or chosen, or that of a document that is blank."""
        return bool(self.marked) or is_blank(self._session.document)

    def highlight(self, *, whole_curves: bool = False) -> Highlight:
        """Return the selected points, or else the chosen curves, or the edited one with all of its shape.

        `whole_curves` passes over the points, as where the list of curves has the focus.
        """
        if self.group.parts and not whole_curves:
            return Highlight(self.group.curves, self.group)
        # One curve of a shape can be chosen alone, in the list.
        return Highlight(self.whole if self.is_editing else self._chosen)

    @property
    def whole(self) -> frozenset[int]:
        """The selected curves, with all others of their shapes."""
        return whole_shapes(self._session.document, self.curves)

    def set_points(self, indices: Collection[int]) -> None:
        """Select points of the active curve alone, those that exist; it is edited with any."""
        self.set_group(some_points([(self._session.active_index, frozenset(map(int, indices)))]))

    def set_group(self, group: PointGroup) -> None:
        """Select points of the curves that are edited, those that exist.

        The active curve is edited with any, and one of those with some: the one so far, or the nearest to it.
        """
        active = self._session.active_index
        if not self.is_editing and existing_points(group, self._session.document.curves, {active}).parts:
            self.activate(active)
        existing = self._existing(group)
        if existing.parts and not existing.of(active):
            self._turn_to(min(existing.curves, key=lambda curve: abs(curve - active)))
        self._put(existing)

    def select_all_points(self) -> None:
        """Select all points of the curves that are edited."""
        curves = self._session.document.curves
        self.set_group(some_points((at, frozenset(range(len(curves[at].points)))) for at in self.edited))

    def show_group(self, group: PointGroup) -> None:
        """Show points as selected while a gesture goes on, perhaps none of the active curve.

        `set_group` or `restore` ends it.
        """
        self._put(self._existing(group))

    def _keep_group(self, group: PointGroup) -> None:
        """Select what exists of some points: nothing, where that is nothing of the active curve."""
        existing = self._existing(group)
        self._put(existing if existing.of(self._session.active_index) else NO_POINTS)

    def _existing(self, group: PointGroup) -> PointGroup:
        curves = self._session.document.curves
        return existing_points(group, curves, self.edited) if group.parts else NO_POINTS

    def _put(self, group: PointGroup) -> None:
        if group != self.group:
            self.group = group
            self._session.box.set_turns(False)
            self._session.history.end_run()
            self._session.selection_changed.emit(self.points)

    def set_hovered(self, index: int) -> None:
        """Take note of the point under the pointer; -1 for none."""
        before, count = self.hovered, len(self._session.active_curve.points)
        self.hovered = index if 0 <= index < count else -1
        if self.hovered != before:
            self._session.hovered_changed.emit(self.hovered)

    @property
    def layer(self) -> str:
        """The layer that what is new comes into, empty for none: that of what was chosen last, or itself."""
        document, layer = self._session.document, self._layer
        if layer is not None and (not layer or layer in document.layers):
            return layer
        return layer_of(document, self._session.active_index)

    def set_layer(self, layer: str | None) -> None:
        """Have what is new come into a layer, until a curve is chosen; None for that of the active curve."""
        before, self._layer = self.layer, layer
        if self.layer != before:
            self._session.layer_changed.emit()

    # Curves

    def activate(self, index: int) -> None:
        """Edit a curve, and select it alone; of another one nothing is selected yet."""
        self._take((index,), index, is_editing=True)

    def edit_chosen(self) -> None:
        """Edit what is chosen: several shapes together, or the active curve with its shape."""
        active = self._session.active_index
        others = self._chosen - whole_shapes(self._session.document, (active,))
        self._take((*self._chosen, active) if others else (active,), active, is_editing=True)

    def leave_points(self) -> None:
        """Choose the curves that are edited as wholes; nothing, where a tool took one up unasked."""
        if self.is_editing and any(self._session.document.curves[at].points for at in self.curves):
            self.choose(() if self.next_style.marked is Marked.LENT else self.curves)

    def go_to(self, index: int) -> None:
        """Make another of the curves that are edited the active one; the same points are selected."""
        group = self.group
        self._turn_to(index)
        self._put(group)

    def _turn_to(self, index: int) -> None:
        others = self.curves if len(self.curves) > 1 else ()
        self._take((*others, index), index, is_editing=True)

    def choose(self, indices: Collection[int]) -> None:
        """Choose curves as wholes, those that exist, or none at all; no curve is edited any more.

        Curves of one shape are chosen together. The active one is one of them, as `set_curves` has it.
        """
        document = self._session.document
        places = [index for index in indices if 0 <= index < len(document.curves)]
        self._take(whole_shapes(document, places), is_editing=False)

    def take_up(self) -> None:
        """Edit the active curve, for a tool that needs one; where nobody chose it, its style says nothing."""
        was_chosen = bool(self.marked) and self.next_style.marked
        self.activate(self._session.active_index)
        self.next_style.marked = was_chosen or Marked.LENT

    def begin_opened(self) -> None:
        """Begin with a document that was opened: nobody chose its curves.

        None hidden or locked is edited, nor any on a page, where one chooses first.
        """
        document, self.next_style.marked = self._session.document, Marked.OPENED
        is_drawing = document.page is not None and not is_blank(document)
        is_safe = not (self._session.active_curve.is_free and with_points(document.curves, self.curves))
        if is_drawing or is_safe:
            self.choose(())
            self.next_style.marked = Marked.OPENED

    def show_choice(self, indices: Collection[int]) -> None:
        """Show curves as chosen while a gesture goes on; `choose` or `restore` ends it."""
        self._chosen = frozenset(indices)
        self._session.selected_curves_changed.emit(self.curves)

    def settle(self) -> None:
        """Take what a gesture showed as selected, and which was dropped, for what is: as far as it may be."""
        if not self.is_editing and self._chosen and self._chosen != self.curves:
            self._take(self._chosen, is_editing=False)
        self._keep_group(self.group)

    def set_curves(self, indices: Collection[int], active: int | None = None) -> None:
        """Select curves to work on together, those that exist.

        The active curve is one of them: `active`, or the one so far, or the selected one nearest to it. With
        several no points are selected, so that tools act on the curves.
        """
        wanted = self._session.active_index if active is None else active
        self._take(indices or (wanted,), active, is_editing=self.is_editing)

    def _take(self, indices: Collection[int], active: int | None = None, *, is_editing: bool) -> None:
        session = self._session
        if session.is_previewing:
            # The gesture may edit a curve that goes with its preview.
            session.interrupt()
        self._note_style(session.document)
        before, places, layer = self.choice, range(len(session.document.curves)), self.layer
        wanted = active if active is not None and active in places else session.active_index
        existing = frozenset(index for index in indices if index in places)
        if is_editing and (points := with_points(session.document.curves, existing)) != existing:
            existing, is_editing = points or existing, bool(points)
        if wanted not in existing:
            wanted = min(existing, key=lambda index: abs(index - wanted), default=wanted)
        self.curves = frozenset({*existing, wanted})
        self.is_editing, self._chosen = is_editing, frozenset() if is_editing else frozenset(existing)
        self.next_style.marked = Marked.ASKED
        if wanted != session.active_index:
            session.interrupted.emit()
            session.cancel()
            self.enter(wanted)
            self._session.scrub.keep()
            session.active_changed.emit(wanted)
        # No point stays selected of a curve that is not edited any more.
        self._keep_group(NO_POINTS if self.chosen or not is_editing else self.group)
        self.last = max(existing - before.curves, default=self.last if self.last in existing else wanted)
        if (self.curves, self.chosen, self.is_editing) != (before.curves, before.chosen, before.is_editing):
            self._session.box.set_turns(False)
            session.selected_curves_changed.emit(self.curves)
        # Whoever chooses nothing goes on where he was.
        self._layer = None if existing else layer
        if self.layer != layer:
            session.layer_changed.emit()

    @property
    def choice(self) -> Choice:
        """All that is selected now."""
        active = self._session.active_index
        return Choice(active, self.group, self.curves, self.chosen, self.is_editing, self._layer)

    def restore(self, choice: Choice) -> None:
        """Select what was selected before; the active curve is the one of then already."""
        self._take(choice.curves if choice.is_editing else choice.chosen, is_editing=choice.is_editing)
        self.set_group(choice.points)
        self.set_layer(choice.layer)

    def reset(self) -> None:
        """Edit the active curve, with nothing of it selected, and tell nobody yet."""
        self.group, self.curves = NO_POINTS, frozenset({self._session.active_index})
        self.is_editing, self._chosen, self.last = True, frozenset(), self._session.active_index

    def enter(self, index: int) -> None:
        """Make curve `index` the active one; what belonged to the other is put away."""
        self.set_points([])
        self.set_hovered(-1)
        self._session.active_index = index

    def begin(self, index: int) -> None:
        """Edit curve `index`, which a gesture begins, and nothing else; tell nobody yet."""
        self._note_style(self._session.document)
        self.enter(index)
        self.is_editing, self._chosen, self.curves = True, frozenset(), frozenset({index})
        # It is not in the document yet.
        self.next_style.marked = Marked.LENT

    # From document to document

    @contextmanager
    def following(self, before: Document) -> Iterator[None]:
        """Go along from a document to the one that is shown now, around what tells of it.

        Nobody who is told of the document finds something named that it does not have. Whoever draws it has
        to hear of the points first.
        """
        session, curves = self._session, self._session.document.curves
        if session.active_index in self.curves and reshaped(before, session.document) is not None:
            # As under most drags: all that is selected, or pointed at, is where it was.
            yield
            session.scrub.keep()
            return
        session.active_index = min(session.active_index, len(curves) - 1)
        points = followed_group(self.group, session.active_index, before.curves, curves)
        has_moved = self._follow_curves(before)
        self._keep_group(self.group)
        self.set_hovered(self.hovered)
        yield
        self._keep_group(points)
        session.scrub.keep()
        if has_moved:
            session.selected_curves_changed.emit(self.curves)

    def _follow_curves(self, begun: Document) -> bool:
        """Select the same curves where they are now; return whether that is another selection.

        Where what was edited is gone, and no curve has come in its place, none is edited and none chosen: the
        next key is not about a curve that nobody has asked for.
        """
        self._note_style(begun)
        before, session, old = begun.curves, self._session, (self.curves, self._chosen, self.is_editing)
        after, active = session.document.curves, session.active_index
        several = self._chosen if not self.is_editing else self.curves if len(self.curves) > 1 else ()
        kept = followed_curves(several, before, after)
        if self.is_editing and are_left(self.curves, active, before, after):
            self.is_editing, kept = False, frozenset()
        elif active not in kept and kept and not self.is_editing and len(after) == len(before):
            # Undo and redo of a drag that has chosen something leave that chosen, whatever was before it.
            active = session.active_index = min(kept, key=lambda place: abs(place - active))
        elif active not in kept:
            # A curve that was added is what is worked on now; where one has gone nobody has chosen another.
            kept = frozenset({active} if self.is_editing or len(after) > len(before) else ())
        self.last = max(followed_curves({self.last}, before, after), default=active)
        self.curves = kept or frozenset({active})
        self.is_editing &= with_points(after, self.curves) == self.curves
        self._chosen = frozenset() if self.is_editing else kept
        if not any(map(is_, before, repeat(after[active]))):
            # It was drawn, or worked on.
            self.next_style.marked = Marked.ASKED
        return (self.curves, self._chosen, self.is_editing) != old

    def _note_style(self, document: Document) -> None:
        self.next_style.note(document, self.marked, self._session.active_index)

    def select_returned(self, before: Sequence[Curve]) -> None:
        """Select the points, or the curves, that undo or redo has brought back."""
        curves = self._session.committed.curves
        returned = returned_curves(before, curves)
        if len(returned) > 1 or (returned and not self.is_editing):
            self.set_curves(returned)
        elif self.is_editing and not self.group.parts and len(before) == len(curves):
            self._keep_group(returned_points(self.edited, before, curves))
