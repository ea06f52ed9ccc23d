"""Offers what was not saved when the program last ended, and brings it back."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from ...actions.declaration import action
from ...actions.menus import FILE_RECOVERY
from ...document.model import Document
from ...session import DocumentOrigin
from ...storage.recovery import Snapshot, SnapshotListing, list_snapshots
from ...workbench.context import WindowContext
from .. import recovery
from .autosave import Autosave, SetAside, document_origin, snapshot_folder

OpenBeside = Callable[[Document, Path | None, DocumentOrigin], Autosave]
"""Opens another window on a document with changes that are not in its file."""


class RecoveryCommands:
    """Unsaved work: restored, discarded or left for later."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._bar: recovery.bar.RecoveryBar | None = None
        self._found = SnapshotListing()
        self._autosave: Autosave | None = None
        self._open_beside: OpenBeside | None = None
        self._set_aside: SetAside | None = None

    def keep_with(self, autosave: Autosave, open_beside: OpenBeside) -> None:
        """Keep with `autosave` what is restored here; where there is other work, restore it elsewhere."""
        self._autosave, self._open_beside = autosave, open_beside
        self._set_aside = SetAside(self._context.session, snapshot_folder(), self._context.window)

    def close(self) -> None:
        """Keep for the next start what is not decided, and what only the history of this window holds."""
        self.leave()
        if self._set_aside is not None:
            self._set_aside.leave()

    @action("recoverWork", "Recover Unsaved Work", FILE_RECOVERY, icon="history")
    def _offer_again(self) -> None:
        """Offer what was not saved when the program last ended."""
        self.offer_unsaved_work()
        if not self._found.snapshots and not self._found.damaged:
            self._context.session.say("There is no unsaved work.")
        elif self._bar is not None:
            self._bar.take_focus()

    def offer_unsaved_work(self) -> None:
        """Offer what there is; say nothing where there is nothing."""
        self.leave()
        self._found = list_snapshots(snapshot_folder())
        if self._found.snapshots or self._found.damaged:
            self._render()

    def leave(self) -> None:
        """Keep what is not decided for the next start."""
        for snapshot in self._found.snapshots:
            snapshot.leave()
        self._found = SnapshotListing()
        if self._bar is not None:
            self._bar.hide()

    def _render(self) -> None:
        # Built only where there is something to show: almost no start has that.
        if self._bar is None:
            self._bar = recovery.bar.RecoveryBar(self._context.central.canvas)
            self._bar.restore_asked.connect(self._restore)
            self._bar.discard_asked.connect(self._discard)
            self._bar.later_asked.connect(self._later)
            self._bar.closed.connect(self.leave)
        bar = recovery.bar
        self._bar.render(bar.unsaved_work_of(self._found.snapshots), bar.damaged_note(self._found.damaged))

    def _take(self, index: int) -> Snapshot:
        snapshots = list(self._found.snapshots)
        snapshot = snapshots.pop(index)
        self._found = SnapshotListing(tuple(snapshots))
        self._render()
        return snapshot

    def _restore(self, index: int) -> None:
        session = self._context.session
        # Another window, rather than a question about the work in this one.
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
            snapshot.leave()  # rather offered twice than lost
        message = recovery.bar.restored_message(origin, is_unchanged=path is not None)
        if snapshot.left_out:
            message = f"{message} {snapshot.left_out.message_about('It')}"
        session.say(message)

    def _discard(self, index: int) -> None:
        self._take(index).discard()
        self._context.session.say("The unsaved work was deleted.")

    def _later(self, index: int) -> None:
        self._take(index).leave()
        self._context.session.say("It is kept; the next start asks again.")


COMMAND_SETS = (RecoveryCommands,)
