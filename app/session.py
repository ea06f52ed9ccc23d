"""The one mutable owner: the current document, its history, the selection and the file behind it."""

from __future__ import annotations

import time
from collections.abc import Callable, Collection, Hashable, Sequence
from pathlib import Path

import msgspec
from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QUndoStack

from app.document.choice import followed_curves, followed_nodes, returned_curves, returned_nodes
from app.document.curve_edits import refuse_locked
from app.document.edits import EditError
from app.document.model import Curve, Document, empty_document
from app.document.plain import plain
from app.examples import first_sketch, template_title
from app.resources import is_resource
from app.storage import files
from app.storage.format import FormatError, validate_changes
from app.storage.open_file import FileChange, OpenFile, Reading
from app.undo_step import Beginning, State, UndoStep, state_at_index
from app.view_model.curve_view import CurveView, view_of

_RUN_SECONDS = 1.0
"""Changes of the same run that follow each other as quickly as this are one step."""


class _Home(msgspec.Struct, frozen=True):
    """What was edited, selected and chosen before a preview began another curve."""

    active: int
    selection: frozenset[int]
    chosen: frozenset[int]


class Change(msgspec.Struct, frozen=True):
    """What became of a change of the document; true where it is a step of the history now.

    Attributes
    ----------
    is_done
        Whether the document is another one.
    refusal
        Why it is not, as the status line has it; empty where the change was none.
    """

    is_done: bool
    refusal: str = ""

    def __bool__(self) -> bool:
        return self.is_done


class Session(QObject):
    """What is open, and everything that may change it.

    Signals
    -------
    document_changed
        The document shown is another one: a preview, a commit, undo, redo, open or new.
    active_changed
        Another curve is edited.
    selection_changed
        Another set of nodes is selected.
    chosen_changed
        Another set of curves is chosen, to be worked on together.
    hovered_changed
        The pointer is over another node (its index, or -1), on the canvas or in the basis panel.
    scrub_changed
        The scrub line was moved to another t, or put away (None).
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
    interrupted
        The document or the curve that is edited is being replaced (a step, undo, open): a gesture in flight
        is void, and what has been said about the old one is out of date.
    said
        A sentence for the status line.
    refused
        A sentence for the status line: something was not done, and why.
    offered
        A sentence that stays until the next step, and the name of an action that goes with it.

    Attributes
    ----------
    beginning
        Where the document began; the same for all states of it.
    path, file
        Where the document is kept; None as long as it has no file.
    selection, hovered, chosen_curves, scrub
        The nodes selected; the node under the pointer, or -1; the curves that are worked on together, by
        their places, of which the one that is edited is one; the t of the scrub line, or None. Whatever is
        asked for and whatever happens to the document, they name what exists in the document shown.
    clock
        Tells the seconds between the changes of a run; tests give their own.
    """

    document_changed = Signal(object)
    active_changed = Signal(int)
    selection_changed = Signal(object)
    chosen_changed = Signal(object)
    hovered_changed = Signal(int)
    scrub_changed = Signal(object)
    file_changed = Signal()
    opened = Signal()
    left = Signal(object)
    saved = Signal()
    history_changed = Signal()
    interrupted = Signal()
    said = Signal(str)
    refused = Signal(str)
    offered = Signal(str, str)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.undo_stack = QUndoStack(self)
        self.undo_stack.cleanChanged.connect(self._report_clean)
        self.undo_stack.indexChanged.connect(self._report_index)
        self.path: Path | None = None
        self.beginning = Beginning()
        self.file: OpenFile | None = None
        self.active_index = 0
        self.selection: frozenset[int] = frozenset()
        self.chosen_curves = frozenset({0})
        self.hovered = -1
        self.scrub: float | None = None
        # Where the person put the scrub line; it stands there as far as the curve goes.
        self._scrub_asked: float | None = None
        self.offered_at: float | None = None
        self.clock: Callable[[], float] = time.monotonic
        # The run that the last step belongs to, and when that was.
        self._run: tuple[Hashable, float] | None = None
        self._committed = plain(first_sketch())
        self._shown = self._committed
        self._home: _Home | None = None
        # A step is being made, not undone or redone.
        self._is_pushing = False
        self._views: list[CurveView] = []
        self._views_of: tuple[Curve, ...] = ()

    def _report_clean(self, _clean: bool) -> None:
        self.file_changed.emit()

    def _report_index(self, _index: int) -> None:
        self.offered_at = None
        self._follow_history()
        self.history_changed.emit()

    def _follow_history(self) -> None:
        """Turn to what the history says is there, where undo or redo has failed on its way to it.

        The history goes on whatever a step raises: whoever undoes next would land somewhere else. What a step
        does besides may be what failed; here it is made anew.
        """
        state = state_at_index(self.undo_stack)
        if state is None or state.document is self._committed or state.document == self._committed:
            return
        self._run = self._home = None
        self._committed = self._shown = state.document
        self._views, self._views_of = [], ()
        self.active_index = min(state.active, len(state.document.curves) - 1)
        self.selection, self.chosen_curves = frozenset(), frozenset({self.active_index})
        if state.beginning is not self.beginning:
            self._turn_to(state.beginning)
        self.interrupted.emit()
        self.document_changed.emit(state.document)
        self.selection_changed.emit(self.selection)
        self.set_hovered(-1)
        self.set_scrub(self._scrub_asked)
        self.active_changed.emit(self.active_index)
        self.chosen_changed.emit(self.chosen_curves)

    # What is shown

    @property
    def document(self) -> Document:
        """The current document; during a gesture, its preview."""
        return self._shown

    @property
    def active_curve(self) -> Curve:
        """The curve that is edited."""
        return self._shown.curves[self.active_index]

    @property
    def views(self) -> list[CurveView]:
        """The view-models of all curves; made anew only for curves that are other values than before."""
        curves = self._shown.curves
        if self._views_of is not curves:
            known = {id(view.source): view for view in self._views}
            # A curve that was changed takes its last good shape from its place in the list.
            same_places = len(curves) == len(self._views)
            self._views = [
                known.get(id(curve)) or view_of(curve, self._views[place] if same_places else None)
                for place, curve in enumerate(curves)
            ]
            self._views_of = curves
        return self._views

    @property
    def active_view(self) -> CurveView:
        """The view-model of the active curve."""
        return self.views[self.active_index]

    def activate(self, index: int) -> None:
        """Edit another curve, and choose it alone; nothing of it is selected yet."""
        self.choose_curves((index,), index)

    def choose_curves(self, indices: Collection[int], active: int | None = None) -> None:
        """Choose curves to work on together, those that exist.

        The curve that is edited is one of them: `active`, or the one edited so far, or the chosen one nearest
        to it. With several no points are selected, so that tools act on the curves.
        """
        if self.is_previewing:
            # The gesture may edit a curve that goes with its preview.
            self.interrupt()
        count = len(self._shown.curves)
        indices = {index for index in indices if 0 <= index < count}
        wanted = active if active is not None and 0 <= active < count else self.active_index
        if wanted not in indices:
            wanted = min(indices, key=lambda index: abs(index - wanted), default=wanted)
        before, self.chosen_curves = self.chosen_curves, frozenset({*indices, wanted})
        if wanted != self.active_index:
            self.interrupted.emit()
            self.cancel()
            self.offered_at = None
            self._enter(wanted)
            self.set_scrub(self._scrub_asked)
            self.active_changed.emit(wanted)
        if len(self.chosen_curves) > 1:
            self.select([])
        if self.chosen_curves != before:
            self.chosen_changed.emit(self.chosen_curves)

    def _follow_choice(self, before: Document) -> bool:
        """Keep the chosen curves valid after `before`; return whether they are other places now."""
        old = self.chosen_curves
        kept = followed_curves(old, before.curves, self._shown.curves) if len(old) > 1 else frozenset[int]()
        self.chosen_curves = kept if self.active_index in kept else frozenset({self.active_index})
        return self.chosen_curves != old

    def _enter(self, index: int) -> None:
        """Make curve `index` the active one; what belonged to the other is put away."""
        self.select([])
        self.set_hovered(-1)
        self.active_index = index

    @property
    def selected(self) -> int | None:
        """The selected node if exactly one is selected."""
        return next(iter(self.selection)) if len(self.selection) == 1 else None

    @property
    def is_previewing(self) -> bool:
        """Whether a gesture in flight shows something else than the history's last state."""
        return self._shown is not self._committed

    @property
    def committed(self) -> Document:
        """The history's last state, whatever a gesture in flight shows."""
        return self._committed

    @property
    def has_changes(self) -> bool:
        """Whether something was changed here since the document was opened or saved."""
        return not self.undo_stack.isClean()

    @property
    def is_modified(self) -> bool:
        """Whether what is here is not in the file: changed here, or changed, damaged or deleted there."""
        return self.has_changes or (self.file is not None and self.file.has_lost_document)

    # Changes

    def change(
        self,
        text: str,
        edit: Callable[[Document], Document],
        *,
        active: int | None = None,
        run: Hashable = None,
    ) -> Change:
        """Make what `edit` returns for the document the current one, as the step `text` of the history.

        A gesture in flight is dropped first, so `edit` gets the history's last state. Where it raises
        `EditError` nothing changes and the status line says why.

        Parameters
        ----------
        active
            The curve to edit from then on, where that changes.
        run
            Changes of the same run that follow each other within a second, with nothing between them, are one
            step: arrow keys.
        """
        self.interrupt()
        try:
            document = edit(self._committed)
        except EditError as reason:
            return self._refused(str(reason))
        return self.commit(document, text, active=active, run=run)

    def preview(self, document: Document, *, active: int | None = None) -> bool:
        """Show `document` during a gesture; `commit` or `cancel` ends it. Return whether it is shown.

        `active` is the curve to edit meanwhile, where the gesture begins another one.
        """
        document = plain(document, self._shown)
        if document is self._shown:
            return True
        if reason := self._why_locked(document):
            self.refuse(reason)
            return False
        if active is not None and self._home is None:
            self._home = _Home(self.active_index, self.selection, self.chosen_curves)
            self._enter(active)
        self._show(document)
        return True

    def interrupt(self) -> bool:
        """Drop the gesture in flight, wherever it is, with its preview; return whether one was shown."""
        was_previewing = self.is_previewing
        self.interrupted.emit()
        self.cancel()
        return was_previewing

    def _why_locked(self, document: Document) -> str:
        """Return which locked curve is another one in `document`, as a sentence; empty where none is."""
        try:
            refuse_locked(self._committed, document)
        except EditError as reason:
            return str(reason)
        return ""

    def _why_not_kept(self, document: Document) -> str:
        """Return why no file may hold `document`, which no edit should make; empty where one may."""
        try:
            validate_changes(self._committed, document)
        except FormatError as reason:
            return f"This cannot be kept: {reason}."
        return ""

    def commit(
        self, document: Document, text: str, *, active: int | None = None, run: Hashable = None
    ) -> Change:
        """End the gesture in flight with `document`, as the step `text` of the history; see `change`.

        A document in which a locked curve is another one, or that no file could hold, is refused.
        """
        document = plain(document, self._shown)
        if document == self._committed:
            self.cancel()
            return Change(is_done=False)
        if reason := self._why_locked(document) or self._why_not_kept(document):
            return self._refused(reason)
        after = self.active_index if active is None else active
        home, self._home = self._home, None
        before = self._state(self._committed, self.active_index if home is None else home.active)
        joins, steps = self._goes_on(run), self.undo_stack.index()
        self._push(UndoStep(self._restore_step, before, self._state(document, after), text, joins=joins))
        # Where the change has taken its run back, the last step is another one.
        is_there = self.undo_stack.index() >= steps
        self._run = (run, self.clock()) if run is not None and is_there else None
        return Change(is_done=True)

    def _refused(self, reason: str) -> Change:
        """Say why nothing changes."""
        self.refuse(reason)
        self.cancel()
        return Change(is_done=False, refusal=reason)

    def _state(self, document: Document, active: int) -> State:
        return State(document, active, self.beginning)

    def _push(self, step: UndoStep) -> None:
        self._is_pushing = True
        self.undo_stack.push(step)
        self._is_pushing = False

    def _goes_on(self, run: Hashable) -> bool:
        """Whether a change of this run follows the last one closely enough to be the same step."""
        return self._run is not None and self._run[0] == run and self.clock() - self._run[1] <= _RUN_SECONDS

    def cancel(self) -> None:
        """Drop the preview; nothing is left of it."""
        if self._shown is self._committed:
            return
        home, self._home = self._home, None
        if home is not None:
            self._enter(home.active)
        self._show(self._committed)
        if home is not None:
            self.choose_curves(home.chosen)
            self.select(home.selection)

    def _restore_step(self, state: State) -> None:
        before, is_other = self._committed, state.beginning is not self.beginning
        if is_other:
            if self.is_modified and self.path is None:
                self.left.emit(before)
            self._turn_to(state.beginning)
        self._restore(state)
        if self._is_pushing:
            return
        if is_other:
            self.file_changed.emit()
            self.opened.emit()
        else:
            self._choose_returned(before)

    def _turn_to(self, beginning: Beginning) -> None:
        """Put away what belonged to the document before this one."""
        self.beginning = beginning
        if self.path is not None:
            # Its file holds the other document: nothing of this one may go there unasked.
            self._take_file(None)
            self.path = None
            self.undo_stack.resetClean()
        self.select([])
        self.choose_curves((self.active_index,))
        self.set_scrub(None)
        # Another document's curves are nobody's last good shape.
        self._views, self._views_of = [], ()

    def _choose_returned(self, before: Document) -> None:
        """Select the points, or choose the curves, that undo or redo has brought back."""
        curves = self._committed.curves
        if len(chosen := returned_curves(before.curves, curves)) > 1:
            self.choose_curves(chosen)
        elif not self.selection and len(before.curves) == len(curves):
            old = before.curves[self.active_index].nodes
            self.select(returned_nodes(old, self.active_curve.nodes))

    def _restore(self, state: State, views: Sequence[CurveView] = ()) -> None:
        self._run = self._home = None
        self.interrupted.emit()
        if state.active != self.active_index:
            self._enter(state.active)
        self._committed = state.document
        if views:
            # Those that are of the document's curves are taken as they are.
            self._views, self._views_of = list(views), ()
        self._show(state.document)

    def _show(self, document: Document) -> None:
        before, self._shown = self._shown, document
        self.active_index = min(self.active_index, len(document.curves) - 1)
        has_moved = self._follow_choice(before)
        selection = self._followed_selection(before)
        # Nobody who is told of the document finds something named that it does not have.
        self.select(self.selection)
        self.set_hovered(self.hovered)
        self.document_changed.emit(document)
        # Whoever draws it has had to hear of the nodes first.
        self.select(selection)
        self.set_scrub(self._scrub_asked)
        if has_moved:
            self.chosen_changed.emit(self.chosen_curves)

    def _followed_selection(self, before: Document) -> frozenset[int]:
        """Return where the nodes are now that were selected in `before`."""
        if not self.selection or self.active_index >= len(before.curves):
            return frozenset()
        return followed_nodes(self.selection, before.curves[self.active_index].nodes, self.active_curve.nodes)

    # What is neither saved nor undone

    def select(self, indices: Collection[int]) -> None:
        """Select the nodes at `indices` of the active curve, those that exist."""
        count = len(self.active_curve.nodes)
        chosen = frozenset(int(index) for index in indices if 0 <= index < count)
        if chosen != self.selection:
            self._run = None
            self.selection = chosen
            self.selection_changed.emit(chosen)

    def set_hovered(self, index: int) -> None:
        """Say which node the pointer is over; -1 for none."""
        if not 0 <= index < len(self.active_curve.nodes):
            index = -1
        if index != self.hovered:
            self.hovered = index
            self.hovered_changed.emit(index)

    def set_scrub(self, t: float | None) -> None:
        """Move the scrub line to `t`, or put it away (None).

        It stays on the curve that is edited: at the end nearer to `t` where that lies outside, away while
        there is no curve, and at `t` again when there is one that goes as far.
        """
        self._scrub_asked = t
        if t is not None:
            curve = self.active_view.curve
            t = None if curve is None else float(min(max(t, curve.domain[0]), curve.domain[1]))
        if t != self.scrub:
            self.scrub = t
            self.scrub_changed.emit(t)

    def say(self, text: str) -> None:
        """Show a sentence in the status line."""
        self.said.emit(text)

    def refuse(self, text: str) -> None:
        """Say that something was not done, and why: marked, so that it is not taken for a hint."""
        self.refused.emit(text)

    def offer(self, text: str, action: str, at: float | None = None) -> None:
        """Show a sentence above the canvas, and beside it a button for the action of this name.

        `at` is the parameter that the action is about; the next step of the history makes it void, and so
        does another curve to edit.
        """
        self.offered_at = at
        self.offered.emit(text, action)

    # Files

    def new(self) -> None:
        """Start an empty document."""
        self._replace(plain(empty_document()), None)

    def open(self, path: str | Path, reading: Reading | None = None, views: Sequence[CurveView] = ()) -> None:
        """Open the document at `path`; when it cannot be read, raise and leave the open one as it was.

        Where the file was read already, `reading` is what it held, and `views` may be those of its curves.
        What ships with the program opens as a copy: it is everybody's, and a lock has no place beside it.
        """
        path = Path(path)
        if is_resource(path):
            self.open_copy(path)
            return
        opened = OpenFile.open(path, self.file, reading)
        self._replace(opened.document, path, opened.file, views=views)

    def open_copy(self, path: str | Path, text: str = "Open") -> None:
        """Open the document at `path` as a new one without a file of its own (lessons, examples).

        Work in a document without a file is not lost for it: opening is then one step of the history, called
        `text`, and undo goes back.
        """
        path = Path(path)
        document = plain(files.load(path))
        title = template_title(path, document)
        self.cancel()
        if self.path is not None or not (self.undo_stack.count() or self.is_modified):
            self._replace(document, None, beginning=Beginning(path, title))
            return
        before = self._state(self._committed, self.active_index)
        after = State(document, 0, Beginning(path, title, self.beginning))
        self._push(UndoStep(self._restore_step, before, after, text))
        # What is in front now is as it came; the work that was left is told of by `left`.
        self.undo_stack.setClean()
        self.file_changed.emit()
        self.opened.emit()

    def go_back(self) -> None:
        """Undo to what was there before the document that is open was opened as a step of the history."""
        here = self.beginning
        while self.beginning is here and here.before is not None and self.undo_stack.canUndo():
            self.undo_stack.undo()

    def reload(self) -> None:
        """Take over what the file holds now, as a step of the history; raises as `open` does."""
        if self.file is None:
            return
        document = plain(self.file.read_again())
        self.cancel()
        if document != self._committed:
            before = self._state(self._committed, self.active_index)
            stays = self.active_index < len(document.curves)
            after = self._state(document, self.active_index if stays else 0)
            self.undo_stack.push(UndoStep(self._restore, before, after, "Reload"))
        self.undo_stack.setClean()
        self.file_changed.emit()

    def look_at_file(self) -> None:
        """Take note of what the file holds at this moment; before the document goes, for one."""
        if self.file is not None:
            self.note_file_change(self.file.check())

    def give_up_changes(self) -> None:
        """Let the document go as it is, unsaved: nobody is asked about it."""
        self.undo_stack.setClean()
        if self.file is not None:
            self.file.accept()
            self.file_changed.emit()

    def note_file_change(self, change: FileChange) -> None:
        """Take note of what the file holds."""
        if self.file is not None and change is not self.file.change:
            self.file.change = change
            self.file_changed.emit()

    @property
    def template(self) -> str:
        """What the document was begun from, in words; empty where it was opened as a file, or begun empty."""
        return self.beginning.title

    @property
    def is_read_only(self) -> bool:
        """Whether somebody else has the file open, so that only Save As keeps changes."""
        return self.file is not None and self.file.owner is not None

    def save(self, path: str | Path | None = None, *, overwrite: bool = False) -> None:
        """Write the document to `path`, or to the file it came from.

        A file that was changed since it was seen last is replaced only if `overwrite` says so; see
        `OpenFile.saved` for what is refused besides.
        """
        target = Path(path) if path is not None else self.path
        if target is None:
            raise EditError("The document has no file yet; choose one with Save As.")
        self.cancel()
        file = OpenFile.saved(target, self._committed, self.file, overwrite=overwrite)
        self._take_file(file)
        self.path = target
        self.undo_stack.setClean()
        self.saved.emit()
        self.file_changed.emit()

    def _take_file(self, file: OpenFile | None) -> None:
        if self.file is not None and self.file is not file:
            self.file.close()
        self.file = file

    def restore(self, document: Document, path: Path | None) -> None:
        """Go on with unsaved work: `document`, with changes that are not in the file at `path`."""
        self._replace(plain(document), path)
        self.undo_stack.resetClean()

    def _replace(
        self,
        document: Document,
        path: Path | None,
        file: OpenFile | None = None,
        beginning: Beginning | None = None,
        views: Sequence[CurveView] = (),
    ) -> None:
        if file is None and path is not None:
            file = OpenFile.adopt(path, self.file)
        self._take_file(file)
        self.path = None
        self._turn_to(beginning or Beginning())
        self.path = path
        self._restore(self._state(document, 0), views)
        self.undo_stack.clear()
        self.undo_stack.setClean()
        self.file_changed.emit()
        self.opened.emit()
