"""Offers unsaved work of earlier runs, and restores it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from ...actions.declaration import action
from ...actions.menus import FILE_RECOVERY
from ...document.model import Document
from ...document.words import names_with_verb
from ...session import DocumentOrigin
from ...storage.recovery import Snapshot, SnapshotListing, list_snapshots
from ...workbench.context import WindowContext
from .. import recovery
from .autosave import Autosave, SetAside, document_origin, snapshot_folder

OpenBeside = Callable[[Document, Path | None, DocumentOrigin], Autosave]
"""Function that opens another window for a document with unsaved changes, and returns its autosave."""


class RecoveryCommands:
    """Action that offers unsaved work, to restore it, discard it or keep it for later."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        context.session.history_changed.connect(self._end_undo_of_discard)
        self._bar: recovery.bar.RecoveryBar | None = None
        self._listing = SnapshotListing()
        # Names and snapshots, deleted when the window is closed; until then "recoverWork" offers them again.
        self._discarded: list[tuple[str, Snapshot]] = []
        self._autosave: Autosave | None = None
        self._open_beside: OpenBeside | None = None
        self._set_aside: SetAside | None = None

    def keep_with(self, autosave: Autosave, open_beside: OpenBeside) -> None:
        """Set the autosave of this window, and the function that opens another window for restored work."""
        self._autosave, self._open_beside = autosave, open_beside
        self._set_aside = SetAside(self._context.session, snapshot_folder(), self._context.window)

    def _end_undo_of_discard(self) -> None:
        self._context.store.change(undoes_discard=False)

    def close(self) -> None:
        """Keep undecided snapshots, and documents that only the history holds, for the next start.

        Discarded snapshots are deleted.
        """
        self.leave()
        for _, snapshot in self._discarded:
            snapshot.discard()
        if self._set_aside is not None:
            self._set_aside.leave()

    @action("recoverWork", "Recover Unsaved Work", FILE_RECOVERY, icon="history")
    def _offer_again(self) -> None:
        """Show unsaved work from earlier sessions, and work discarded here until the window is closed."""
        self._context.session.offer("")
        self.offer_unsaved_work()
        if not self._listing.snapshots and not self._listing.damaged:
            self._context.session.say("There is no unsaved work.")
        elif self._bar is not None:
            self._bar.take_focus()

    def offer_unsaved_work(self) -> None:
        """Offer unsaved work, if there is any."""
        self.leave()
        for _, snapshot in self._discarded:
            snapshot.leave()
        self._discarded = []
        self._context.store.change(undoes_discard=False)
        self._listing = list_snapshots(snapshot_folder())
        if self._listing.snapshots or self._listing.damaged:
            self._render()

    def leave(self) -> None:
        """Keep undecided snapshots for the next start."""
        for snapshot in self._listing.snapshots:
            snapshot.leave()
        self._listing = SnapshotListing()
        if self._bar is not None:
            self._bar.hide()

    def _render(self) -> None:
        # Built when it is needed: almost no start has unsaved work.
        if self._bar is None:
            self._bar = recovery.bar.RecoveryBar(self._context.central.canvas)
            self._bar.restore_asked.connect(self._restore)
            self._bar.discard_asked.connect(self._discard)
            self._bar.later_asked.connect(self._later)
            self._bar.closed.connect(self.leave)
        bar = recovery.bar
        self._bar.render(
            bar.unsaved_work_of(self._listing.snapshots), bar.damaged_note(self._listing.damaged)
        )

    def _take(self, index: int) -> Snapshot:
        snapshots = list(self._listing.snapshots)
        snapshot = snapshots.pop(index)
        self._listing = SnapshotListing(tuple(snapshots))
        self._render()
        return snapshot

    def _restore(self, index: int) -> None:
        session = self._context.session
        # Open another window instead of asking about unsaved work in this one.
        open_beside = self._open_beside if session.files.is_modified else None
        if open_beside is None and not self._context.files.may_discard():
            return
        snapshot = self._take(index)
        origin, autosave = snapshot.origin, self._autosave
        path = origin.path if origin.is_unchanged else None
        session_origin = document_origin(origin, path)
        if open_beside is not None:
            autosave = open_beside(snapshot.document, path, session_origin)
        else:
            session.files.restore(snapshot.document, path, session_origin)
        if autosave is not None and autosave.write_now():
            snapshot.discard()
        else:
            snapshot.leave()  # better offered twice than lost
        message = recovery.bar.restored_message(origin, is_unchanged=path is not None)
        if snapshot.left_out:
            message = f"{message} {snapshot.left_out.message_about('It')}"
        self._offer_discarded()
        session.say(message)

    def _discard(self, index: int) -> None:
        name = recovery.bar.unsaved_work_of(self._listing.snapshots)[index].name
        self._discarded.append((name, self._take(index)))
        self._offer_discarded()
        self._context.store.change(undoes_discard=True)

    def _offer_discarded(self) -> None:
        """Name the discarded work, and offer it again, if there is any."""
        if self._discarded:
            names = names_with_verb([f"“{name}”" for name, _ in self._discarded])
            self._context.session.offer(f"{names} discarded.", "recoverWork")

    def _later(self, index: int) -> None:
        self._take(index).leave()
        self._context.session.say("The unsaved work was kept. The next start asks again.")


COMMAND_SETS = (RecoveryCommands,)
