"""The QObject that owns the open document, and the signals by which it reports changes."""

from __future__ import annotations

import logging
from collections.abc import Callable, Collection, Hashable, Sequence
from pathlib import Path

from msgspec.structs import replace
from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QUndoStack

from ..document.fields import NO_SCROLL, Scroll
from ..document.groups import tidy_shapes
from ..document.limits import AlreadySoError, EditError
from ..document.model import Curve, Document, Vector
from ..document.plain_numbers import with_plain_numbers
from ..document.point_group import NO_POINTS, newly_set
from ..document.selection import SelectionState
from ..document.several_curves import is_blank
from ..document.style import PLAIN_STYLE
from ..document.words import capitalized
from ..families import Family
from ..storage.examples import first_sketch
from ..storage.open_file import LoadedDocument
from ..view_model.curve.curve_view import CurveView
from .change import Change, Message, MessageKind, raiser_of, why_locked, why_unsavable
from .files import Files
from .history import DocumentOrigin, History, HistoryState
from .selection import BoxState, ScrubLine, Selection
from .views import Views

_log = logging.getLogger("curvebench.session")


class Batch:
    """A batch of signals that belong together: true while it is entered.

    A step changes document, selection and history, and each has its signal. A listener that renders all three
    would render several times, intermediate states among them; with `then` it waits for the end of the batch.
    """

    def __init__(self) -> None:
        self._depth = 0
        self._waiting: dict[Callable[[], object], None] = {}

    def __bool__(self) -> bool:
        return self._depth > 0

    def __enter__(self) -> None:
        self._depth += 1

    def __exit__(self, *_raised: object) -> None:
        self._depth -= 1
        while self._waiting and not self:
            show = next(iter(self._waiting))
            # First: what it shows may change something once more.
            del self._waiting[show]
            show()

    def then(self, show: Callable[[], object]) -> None:
        """Call `show` once at the end of the batch; right now outside a batch."""
        if self:
            self._waiting[show] = None
        else:
            show()


class SessionSignals(QObject):
    """Signals of a session, and messages to the person.

    Signals
    -------
    document_changed
        The document shown is another one: a preview, a change, undo, redo, open or new.
    settled
        The document shown, so far a preview, is the current one.
    active_changed
        Another curve is edited.
    selection_changed
        Another set of points is selected.
    selected_curves_changed
        Another set of curves is selected, to be worked on together.
    hovered_changed
        The pointer is over another point (its index, or -1), on the canvas or in the basis panel.
    scrub_changed
        The scrub line was moved to another t, or hidden (None).
    pivot_changed
        Another pivot was set, or it has moved along with the points it was set for.
    grips_changed
        The grips of the box around what is selected do something else.
    file_changed
        The path or the modified mark is another one.
    opened
        Another document was opened or begun, or undo or redo has gone back to another one.
    left
        A document without a file was left with this work in it; undo or redo goes back to it.
    saved
        The document was written to its file.
    history_changed
        There is another step to undo or redo.
    ranges_returned
        Undo or redo of a step that has changed the view: the ranges of x and y to show, and those that it
        has left visible.
    gesture_ended
        No gesture is in flight any more: it has become a step, or another change, undo, another active curve
        or another document has dropped it. Emitted also where none was in flight; messages about the
        document before are out of date.
    message
        A `Message` for the person.

    Attributes
    ----------
    batch
        Entered while several signals report one change.
    """

    document_changed = Signal(object)
    settled = Signal()
    active_changed = Signal(int)
    selection_changed = Signal(object)
    selected_curves_changed = Signal(object)
    hovered_changed = Signal(int)
    scrub_changed = Signal(object)
    pivot_changed = Signal()
    grips_changed = Signal()
    file_changed = Signal()
    opened = Signal()
    left = Signal(object)
    saved = Signal()
    history_changed = Signal()
    ranges_returned = Signal(object, object)
    gesture_ended = Signal()
    message = Signal(object)

    def __init__(self) -> None:
        super().__init__()
        self.batch = Batch()

    def say(self, text: str, *, is_hint: bool = False) -> None:
        """Show a sentence in the status line; a hint about the next press goes with the tool in use."""
        self.message.emit(Message(MessageKind.INFORMATION, text, is_hint=is_hint))

    def refuse(self, text: str) -> None:
        """Say that something was not done, and why: marked, so that it is not taken for a hint."""
        self.message.emit(Message(MessageKind.REFUSAL, text))

    def offer(self, text: str, *actions: str) -> None:
        """Show a sentence above the canvas, and beside it a button for each action of these names.

        Without a sentence, the one that was there goes: the action has done it.
        """
        self.message.emit(Message(MessageKind.OFFER, text, actions))


class Session(SessionSignals):
    """Owner of the open document: `change` changes it at once; a gesture previews a change, then commits it.

    Every change is one named step of the history::

        session.change("Move point 2", lambda document: move_points(document, 0, [2], (0.5, 0.0)))

    It returns a `Change`, which is false and has a sentence where the edit is refused; the document is then
    the same as before. `document_changed` reports each document that is displayed, previews included.

    Attributes
    ----------
    history
        The steps that can be undone.
    files
        The file behind the document, and where the document began.
    active_index
        The curve that is edited.
    selected
        Selected points and curves, the point under the pointer.
    box
        The pivot and the grips of the box around the selection.
    scrub
        The scrub line.
    newly_set
        Points whose estimates the last step has set to keep the shape, besides its own points.
    """

    def __init__(self) -> None:
        super().__init__()
        self.history = History(self, self._restore_step)
        self.undo_stack.cleanChanged.connect(self.file_changed)
        self.undo_stack.indexChanged.connect(self._report_index)
        self.files = Files(self)
        self.active_index = 0
        self.selected = Selection(self)
        self.box = BoxState(self.pivot_changed.emit, self.grips_changed.emit)
        self.scrub = ScrubLine(lambda: self.active_view, self.scrub_changed.emit)
        self.newly_set = NO_POINTS
        self._views = Views()
        self._committed = self._document = with_plain_numbers(first_sketch())
        # The selection before the gesture in flight; None while nothing is previewed.
        self._selection_before: SelectionState | None = None
        # The document that a gesture gave to be shown; `_document` is what came of it.
        self._asked: Document | None = None
        # What a gesture selects together with its preview.
        self._selects: SelectionState | None = None

    def __del__(self) -> None:
        self.history.drop()

    def _report_index(self, _index: int) -> None:
        self._follow_history()
        if self.newly_set.parts:
            self.newly_set = NO_POINTS
            self.offer("")
        self.history_changed.emit()

    def _follow_history(self) -> None:
        """Adopt the state of the history, where undo or redo has failed on its way to it.

        The history goes on whatever a step raises; what a step does besides may be what failed.
        """
        state = self.history.state
        if state is None or state.document is self._committed or state.document == self._committed:
            return
        self.history.end_run()
        self._selection_before = self._asked = self._selects = None
        self._committed = self._document = state.document
        self._views.take()
        self.active_index = min(state.active, len(state.document.curves) - 1)
        self.selected.reset()
        if state.origin is not self.files.origin:
            self._turn_to(state.origin)
        self.gesture_ended.emit()
        self.document_changed.emit(state.document)
        self.selection_changed.emit(self.selection)
        self.selected.set_hovered(-1)
        self.scrub.keep()
        self.active_changed.emit(self.active_index)
        self.selected_curves_changed.emit(self.selected.curves)

    # What is shown

    @property
    def document(self) -> Document:
        """The current document; during a gesture, its preview."""
        return self._document

    @property
    def committed(self) -> Document:
        """The history's last state, whatever a gesture in flight shows."""
        return self._committed

    @property
    def state(self) -> HistoryState:
        """The state that the next step of the history starts from."""
        selection = self.selected.state if self._selection_before is None else self._selection_before
        return HistoryState(self._committed, selection.active, self.files.origin, selection)

    @property
    def is_previewing(self) -> bool:
        """Whether a gesture in flight shows something else than the history's last state."""
        return self._document is not self._committed

    @property
    def active_curve(self) -> Curve:
        """The curve that is edited."""
        return self._document.curves[self.active_index]

    @property
    def views(self) -> list[CurveView]:
        """The views of all curves."""
        return self._views.of(self._document.curves)

    def expect(self, views: Sequence[CurveView]) -> None:
        """Accept views of curves that the next change adds, computed beforehand."""
        self._views.expect(views)

    @property
    def active_view(self) -> CurveView:
        """The view of the active curve."""
        return self.views[self.active_index]

    @property
    def template_curve(self) -> Curve:
        """The curve that gives a new one its family, rules and style: the active one, but for a style set.

        Nobody means to draw what has no paint, unless it was set so.
        """
        curve, style = self.active_curve, self.selected.next_style
        if style is None and curve.points and not (curve.style.has_fill or curve.style.has_stroke):
            style = PLAIN_STYLE
        return curve if style is None else replace(curve, style=style)

    @property
    def target_view(self) -> CurveView | None:
        """The view of the active curve; None while no curve is edited and none selected.

        A blank document has nothing to choose from: its curve is the one that is about to be drawn.
        """
        is_target = self.selected.marked or is_blank(self._document)
        return self.active_view if is_target else None

    @property
    def undo_stack(self) -> QUndoStack:
        """The steps of the history in Qt."""
        return self.history.stack

    @property
    def selection(self) -> frozenset[int]:
        """Indices of the selected points of the active curve."""
        return self.selected.points

    # Changes

    def change(
        self,
        text: str,
        edit: Callable[[Document], Document],
        *,
        active: int | None = None,
        run: Hashable = None,
        scroll: Scroll = NO_SCROLL,
    ) -> Change:
        """Make the document that `edit` returns the current one, as the step `text` of the history.

        A gesture in flight is dropped first. Where `edit` raises `EditError` the status line says why.

        Parameters
        ----------
        active
            The curve to edit from then on, where that changes.
        run
            Changes of one run within a second, with nothing between them, are one step: arrow keys.
        scroll
            The parts of the plane that undo and redo return to.
        """
        with self.batch:
            self.interrupt()
            try:
                document = edit(self._committed)
            except EditError as reason:
                is_so = isinstance(reason, AlreadySoError)
                return self._refused(str(reason), raiser_of(reason), is_so=is_so)
            return self._make_step(document, text, active, run, scroll)

    def preview(
        self, document: Document, *, active: int | None = None, selects: SelectionState | None = None
    ) -> bool:
        """Show `document` during a gesture; `commit` or `cancel` ends it. Return whether it is shown.

        `selects` is the selection meanwhile and after the commit, from the first preview on that has it; its
        active curve may be one that the gesture begins.
        """
        asked, document = document, self._normalised(document)
        if document is self._document:
            return True
        if reason := why_locked(self._committed, document):
            self.refuse(reason)
            return False
        if self._selection_before is None:
            self._selection_before = self.selected.state
            self._views.leave()
        is_first = selects is not None and self._selects is None
        if selects is not None and selects.is_editing:
            active = selects.active
        if active is not None and active != self.active_index:
            self.selected.begin_curve(active)
        self._asked = asked
        self._show(document)
        if selects is not None and is_first:
            self._selects = selects
            self.selected.show(selects)
        return True

    def commit(
        self, document: Document, text: str, *, active: int | None = None, scroll: Scroll = NO_SCROLL
    ) -> Change:
        """End the gesture in flight with `document`, as the step `text` of the history; see `change`.

        Undo and redo of it return to the parts of the plane that were visible before and after a `scroll`.
        """
        with self.batch:
            return self._make_step(document, text, active, None, scroll)

    def _normalised(self, document: Document) -> Document:
        """Return the document with plain numbers, and shapes that are whole."""
        return tidy_shapes(with_plain_numbers(document, self._document), self._document)

    def _make_step(
        self, document: Document, text: str, active: int | None, run: Hashable, scroll: Scroll = NO_SCROLL
    ) -> Change:
        """Make `document` the current one, unless a locked curve changes, or no file could hold it."""
        is_previewed = document is self._asked or document is self._document
        document = self._document if is_previewed else self._normalised(document)
        if document == self._committed:
            self.cancel()
            return Change(is_done=False)
        if not is_previewed and (reason := why_locked(self._committed, document)):
            return self._refused(reason, "the lock of a curve")
        if reason := why_unsavable(self._committed, document):
            return self._refused(reason, "the file format")
        before, selects = self.state, self._selects
        self._selection_before = self._asked = self._selects = None
        if active is None:
            active = self.active_index if selects is None else selects.active
        after = HistoryState(document, active, self.files.origin, scroll=scroll[::-1])
        self.history.push(replace(before, scroll=scroll), after, text, run)
        if selects is not None and not selects.is_editing:
            self.selected.select_whole(selects.whole_curves)
        _log.debug("a step of the history, now %d", self.undo_stack.count())
        return Change(is_done=True)

    def cancel(self) -> None:
        """Drop the preview, and restore the selection before it."""
        before, self._selection_before = self._selection_before, None
        self._asked = self._selects = None
        if before is None:
            return
        with self.batch:
            if before.active != self.active_index:
                self.selected.make_active(before.active)
            if self.is_previewing:
                self._show(self._committed)
            self.selected.restore(before)

    def interrupt(self) -> bool:
        """Drop the gesture in flight, wherever it is, with its preview; return whether one was shown."""
        was_previewing = self.is_previewing
        with self.batch:
            self.gesture_ended.emit()
            self.cancel()
            self.selected.keep_previewed()
        return was_previewing

    def report(self, done: str, before: Sequence[Curve], exempt: Collection[Vector] = ()) -> None:
        """Report the last step, if `done` says anything, and offer to reset points set to keep the shape.

        `before` are the curves before it, `exempt` the positions of its own points.
        """
        self.newly_set = group = newly_set(before, self.document.curves, exempt)
        if group.parts:
            verb = "was" if group.count == 1 else "were"
            self.offer(f"{capitalized(group.names)} {verb} set to keep the shape.", "resetKept")
        if done:
            self.say(done)

    def _refused(self, reason: str, by: str, *, is_so: bool = False) -> Change:
        """Say why nothing changes; log the function that refused."""
        _log.info("a change was refused by %s", by)
        self._views.expect(())
        (self.say if is_so else self.refuse)(reason)
        self.cancel()
        return Change(is_done=False, refusal=reason)

    # From state to state

    def _restore_step(self, state: HistoryState) -> None:
        is_previewed = self.is_previewing and state.document is self._document
        if self.history.is_pushing and is_previewed and state.active == self.active_index:
            # It is drawn already.
            self.history.end_run()
            self.gesture_ended.emit()
            self._committed = state.document
            self.settled.emit()
            return
        before, is_other = self._committed, state.origin is not self.files.origin
        if is_other and self.files.is_modified and self.files.path is None:
            self.left.emit(before)
        with self.batch:
            if is_other:
                self._turn_to(state.origin)
            self._restore(state)
            if is_other:
                self.selected.begin_opened()
            elif not self.history.is_pushing:
                self.selected.select_returned(before, state.selection)
        # The view moves once it shows the document: a move asks what is below the pointer.
        if not is_other and not self.history.is_pushing and state.scroll != NO_SCROLL:
            self.ranges_returned.emit(*state.scroll)
        if is_other and not self.history.is_pushing:
            self.file_changed.emit()
            self.opened.emit()

    def _turn_to(self, origin: DocumentOrigin) -> None:
        """Close the document before this one, with its file, selection and scrub line."""
        self.files.origin = origin
        if self.files.path is not None:
            # Its file holds the other document: nothing of this one may go there unasked.
            self.files.close()
            self.undo_stack.resetClean()
        self.selected.clear()
        self.scrub.set(None)
        self.box.set_pivot(None)
        # Curves of another document have no last good shape here.
        self._views.take()

    def _restore(self, state: HistoryState, views: Sequence[CurveView] | None = None) -> None:
        self.history.end_run()
        if not self.is_previewing:
            self._views.leave()
        self._selection_before = self._asked = self._selects = None
        self.gesture_ended.emit()
        if state.active != self.active_index:
            self.selected.make_active(state.active)
        self._committed = state.document
        if views is not None:
            # Late: those who heard of the gesture's end may have asked for views of the document before.
            self._views.take(views)
        self._show(state.document)

    def _show(self, document: Document) -> None:
        before, self._document = self._document, document
        with self.selected.following(before):
            self.document_changed.emit(document)

    def renew(self, families: Collection[Family]) -> None:
        """Show curves of these families anew: the families have changed, not the document."""
        self.interrupt()
        self._views.renew(families)
        self.document_changed.emit(self._document)

    # Files

    def new(self) -> None:
        """Start an empty document."""
        self.files.new()

    def open(
        self, path: str | Path, reading: LoadedDocument | None = None, views: Sequence[CurveView] = ()
    ) -> None:
        """Open the document at `path`; see `Files.open`."""
        self.files.open(path, reading, views)

    def save(self, path: str | Path | None = None, *, overwrite: bool = False) -> None:
        """Write the document to `path`, or to the file it came from; see `Files.save`."""
        self.files.save(path, overwrite=overwrite)

    def begin(self, state: HistoryState, path: Path | None, views: Sequence[CurveView] = ()) -> None:
        """Go on with another document, whose history begins here; its views may be given."""
        with self.batch:
            self._turn_to(state.origin)
            self.files.path = path
            self._restore(state, views)
            self.selected.begin_opened()
            self.undo_stack.clear()
            self.undo_stack.setClean()
            self.file_changed.emit()
        self.opened.emit()
