"""The document's file while it is open: changed or deleted by another program, or open elsewhere.

`DiskCommands` follows the file and its lock, and offers actions in a bar over the canvas; the notices of that
bar are written at the end of this module.
"""

from __future__ import annotations

import time
from enum import Enum, auto
from pathlib import Path

import msgspec
from PySide6.QtCore import QObject

from ...actions.declaration import action
from ...actions.menus import FILE_DISK
from ...actions.needs import Need
from ...document.model import Document
from ...state.window_state import FileState
from ...storage.files import ChangedOnDiskError, Stamp, StorageError
from ...storage.format_error import FormatError
from ...storage.lock import Owner
from ...storage.migration import NOTHING, LeftOut
from ...storage.open_file import FileChange, LockedError, OpenFile
from ...tasks.task import DelayedCall
from ...view_model.curve.curve_view import view_of
from ...workbench.context import WindowContext
from ...workbench.disk_watch import DiskWatch
from ...workbench.message_bar import NoticeBar

_RECHECK_MS = 100
_MOST_CHECKS = 5
"""Number of checks, each after twice the time, before a file counts as deleted or damaged: another program
may be writing it."""

_OWNER_MS = 2000
"""Milliseconds between checks whether the owner of the lock still runs; a crash sends no event."""

_CHANGED_OUTSIDE = "a file that was changed outside this window"


class DiskCommands(QObject):
    """Actions on the file of the document, and the bar over the canvas that tells of its changes."""

    def __init__(self, context: WindowContext) -> None:
        super().__init__(context.window)
        self._context, self._session = context, context.session
        self._bar: NoticeBar | None = None
        self._watch = DiskWatch(context.window)
        self._watch.triggered.connect(self._check_file)
        self._recheck = DelayedCall(self, _RECHECK_MS, self._check_file)
        self._file: OpenFile | None = None
        self._path: Path | None = None
        self._stamp: Stamp | None = None
        self._standing = Ownership.OURS
        self._dismissed: set[Notice] = set()
        self._reset()
        context.files.refused = self._show_refusal
        self._session.file_changed.connect(self._follow)
        self._session.opened.connect(self._announce_file)
        self._follow()
        # The document may have been opened before the window existed.
        self._announce_file()

    def _reset(self) -> None:
        """Reset after the document was opened, saved or reloaded."""
        self._recheck.stop()
        self.checks = 0
        self._change = FileChange.SAME
        self._other: Document | None = None
        self._refusal: Notice | None = None
        self._hide_ghost()

    # Following the file

    def _follow(self) -> None:
        """Follow another file, or the same file after it was saved."""
        file = self._session.files.file
        stamp = file.stamp if file is not None else None
        if file is not self._file or stamp is not self._stamp:
            self._stamp = stamp
            self._reset()
        if file is not self._file:
            self._file = file
            self._dismissed.clear()
            is_other = file is not None and file.owner is not None
            self._standing = Ownership.OPENED_ELSEWHERE if is_other else Ownership.OURS
        if self._session.files.path != self._path:
            self._path = self._session.files.path
            self._watch.watch(self._path)
        if file is not None and self._session.files.has_changes and not file.left_out.words:
            file.left_out = NOTHING  # the person has read it, and goes on
        if file is not None and file.change is not self._change:
            self._note_change(file, file.change)  # another check was earlier than that of the watch
        self._show()

    def _announce_file(self) -> None:
        """Show a message about an older version or a missing lock of the opened file."""
        file = self._session.files.file
        if file is None:
            return
        if file.is_older and not file.left_out:
            self._context.status_line.say(
                f"{file.path.name} was saved by an older version. The first save keeps a backup of it."
            )
        elif file.lock_problem and file.owner is None:
            self._context.status_line.say(
                f"Others cannot see that {file.path.name} is open here: there is no lock file in its folder "
                f"({file.lock_problem})."
            )

    def _check_file(self) -> None:
        """Check the file and its lock."""
        file = self._file
        if file is None:
            return
        self._check_lock(file)
        change = file.check()
        unsettled = change in (FileChange.UNREADABLE, FileChange.GONE) and change is not self._change
        if unsettled and self.checks < _MOST_CHECKS:
            self._recheck.start(_RECHECK_MS << self.checks)
            self.checks += 1
            return
        self.checks = 0
        self._stamp = file.stamp
        if change is not self._change or change is FileChange.CHANGED:
            self._note_change(file, change)
        self._show()

    def _note_change(self, file: OpenFile, change: FileChange) -> None:
        """Record the change of the file by another program."""
        is_news = change is not self._change or self._other is not file.other_document
        self._change, self._other = change, file.other_document
        if is_news:
            self._dismissed.clear()
            if change is not FileChange.CHANGED:
                self._hide_ghost()
            elif self._context.store.state.compares_with_file:
                self._show_ghost()
        if change in (FileChange.GONE, FileChange.SAME) and self._is_refused_for_other_content:
            self._refusal = None  # its reason no longer exists
        self._session.files.note(change)

    def _check_lock(self, file: OpenFile) -> None:
        owner = file.check_lock()
        if owner is None:
            if file.owner is not None:
                self._standing = Ownership.FREED
            return
        if self._standing is Ownership.OURS:
            self._standing = Ownership.TAKEN_AWAY
            file.lose_to(owner)
            self._session.file_changed.emit()
        elif self._standing is Ownership.FREED:
            self._standing = Ownership.OPENED_ELSEWHERE
            file.lose_to(owner)

    # The bar

    def _show(self) -> None:
        """Show the most urgent notice, or hide the bar."""
        self._watch.check_every(_OWNER_MS if self._session.files.is_read_only else 0)
        self._context.store.change(
            file=FileState(
                change=self._change if self._file is not None else None,
                is_read_only=self._session.files.is_read_only,
                may_overwrite=self._may_overwrite,
                is_asked=self._standing is Ownership.ASKED,
            )
        )
        notice = next((entry for entry in self._notices() if entry not in self._dismissed), None)
        if notice is not None:
            self._show_notice(notice)
        elif self._bar is not None:
            self._bar.hide()

    @property
    def _is_refused_for_other_content(self) -> bool:
        return self._refusal is not None and "overwriteFile" in self._refusal.actions

    @property
    def _may_overwrite(self) -> bool:
        is_other = self._is_refused_for_other_content or self._change in (
            FileChange.CHANGED,
            FileChange.UNREADABLE,
        )
        return is_other and not self._session.files.is_read_only

    def _notices(self) -> list[Notice]:
        """Return the present notices, the most urgent first."""
        file = self._file
        notices: list[Notice | None] = [self._refusal]
        if file is not None:
            name, owner = file.path.name, file.owner
            lock = lock_notice(name, self._standing, owner)
            content = content_notice(
                name, self._change, modified=self._session.files.has_changes, owner=owner
            )
            is_urgent = self._standing in (Ownership.ASKED, Ownership.FREED, Ownership.TAKEN_AWAY)
            notices += [lock, content] if is_urgent else [content, lock]
            notices.append(left_out_notice(name, file.left_out))
        return [notice for notice in notices if notice is not None]

    def _show_notice(self, notice: Notice) -> None:
        if self._bar is None:
            central = self._context.central
            self._bar = NoticeBar("file", central.canvas, central.message_bar)
            self._bar.clear_top = central.message_bar.clear_top
            self._bar.closed.connect(self._dismiss)
        self._displayed = notice
        self._bar.show_notice(
            notice.text, [self._context.actions[name] for name in notice.actions], warns=notice.warns
        )

    def _dismiss(self) -> None:
        """Dismiss the displayed notice, and show the next one if there is any."""
        if self._displayed is self._refusal:
            self._refusal = None
        elif self._standing is Ownership.ASKED:
            self._standing = Ownership.OPENED_ELSEWHERE
        else:
            self._dismissed.add(self._displayed)
        self._show()

    def _show_refusal(self, path: Path, sentence: str, problem: StorageError) -> None:
        """Show why the document was not saved, and offer actions."""
        is_own_file = self._file is not None and self._file.is_at(path)
        self._refusal = refusal_notice(path.name, sentence, problem, is_own_file=is_own_file)
        if is_own_file:
            self._check_file()
        self._show()

    # Actions

    @action(
        "reloadFile",
        "Reload",
        FILE_DISK,
        icon="reset",
        full_name="Reload File",
        needs=Need(
            "a file that can be read",
            lambda state: state.window.file.change in (FileChange.SAME, FileChange.CHANGED),
        ),
    )
    def _reload(self) -> None:
        """Replace the document with the current content of the file; Undo restores it."""
        if self._file is None:
            return
        name = self._file.path.name
        try:
            self._session.files.reload()
        except (FormatError, StorageError) as problem:
            self._refusal = Notice(f"{name} was not reloaded: {problem}", ("saveDocumentAs",))
            self._show()
            return
        self._session.say(f"Reloaded {name}. Undo restores your document.")

    @action(
        "keepMine",
        "Keep Mine",
        FILE_DISK,
        full_name="Keep My Document, Not the File",
        needs=Need(
            _CHANGED_OUTSIDE,
            lambda state: state.window.file.change in (FileChange.CHANGED, FileChange.UNREADABLE),
        ),
    )
    def _keep_mine(self) -> None:
        """Keep the document in this window; the next save replaces the changed file."""
        if self._file is not None:
            self._file.accept()
            # The document in the window is in no file.
            self._session.undo_stack.resetClean()
            self._follow()

    @action(
        "compareWithFile",
        "Compare as Ghost",
        FILE_DISK,
        icon="eye",
        full_name="Compare with File as Ghost",
        needs=Need(_CHANGED_OUTSIDE, lambda state: state.window.file.change is FileChange.CHANGED),
        checked=lambda state: state.window.compares_with_file,
    )
    def _compare(self) -> None:
        """Show the current content of the file as a dashed ghost behind the curves."""
        if self._context.store.state.compares_with_file:
            self._hide_ghost()
        else:
            self._show_ghost()

    def _show_ghost(self) -> None:
        document = self._file.other_document if self._file is not None else None
        if document is None or self._path is None:
            self._hide_ghost()
            return
        self._context.store.change(compares_with_file=True)
        views = [view_of(curve) for curve in document.curves]
        self._context.central.canvas.drawing.annotations.show_file_version(
            views, f"{self._path.name} on disk"
        )

    def _hide_ghost(self) -> None:
        self._context.store.change(compares_with_file=False)
        self._context.central.canvas.drawing.annotations.show_file_version([], "")

    @action(
        "overwriteFile",
        "Overwrite",
        FILE_DISK,
        icon="save",
        full_name="Overwrite File",
        needs=Need("", lambda state: state.window.file.may_overwrite),
    )
    def _overwrite(self) -> None:
        """Replace the changed file with the document in this window."""
        self._context.files.overwrite()

    @action(
        "takeOver",
        "Take Over",
        FILE_DISK,
        icon="unlock",
        full_name="Take Over the Document",
        needs=Need("a document that is open read-only", lambda state: state.window.file.is_read_only),
    )
    def _take_over(self) -> None:
        """Take over a document that is open elsewhere, so that you can save it here."""
        file = self._file
        if file is None:
            return
        owner = file.check_lock()
        if owner is None or owner.may_have_forgotten:
            self._edit_anyway()
            return
        self._refusal = None
        self._standing = Ownership.ASKED
        self._show()

    @action(
        "editAnyway",
        "Edit Anyway",
        FILE_DISK,
        icon="unlock",
        full_name="Edit the Document Anyway",
        needs=Need("", lambda state: state.window.file.is_asked),
    )
    def _edit_anyway(self) -> None:
        """Take over the document even if it is being edited elsewhere."""
        if self._file is None:
            return
        self._file.take_over()
        self._standing, self._refusal = Ownership.OURS, None
        self._session.file_changed.emit()
        self._session.say(f"You can now save {self._file.path.name} in this window.")
        self._check_file()


# Notices: a sentence about the file, and the actions offered with it


class Notice(msgspec.Struct, frozen=True):
    """Notice in the bar: a text, the names of the offered actions, and whether it is a warning."""

    text: str
    actions: tuple[str, ...]
    warns: bool = True


class Ownership(Enum):
    """Ownership of the document: by this window or elsewhere."""

    OURS = auto()
    OPENED_ELSEWHERE = auto()
    ASKED = auto()
    """The person wants to take it over, and was warned that it may be edited elsewhere."""
    TAKEN_AWAY = auto()
    FREED = auto()


def content_notice(name: str, change: FileChange, *, modified: bool, owner: Owner | None) -> Notice | None:
    """Return the notice about a change of the file `name` by another program."""
    if change is FileChange.CHANGED:
        here = ", and you have unsaved changes here" if modified else ""
        text = f"Another program changed “{name}” on disk{here}."
        if owner is not None:
            text = f"{_who(owner)} saved changes to “{name}”{_where(owner)}{here}."
        return Notice(text, ("reloadFile", "keepMine", "compareWithFile"))
    if change is FileChange.UNREADABLE:
        text = f"Another program damaged “{name}”. Your document is still open here."
        return Notice(text, ("keepMine", "saveDocumentAs"))
    if change is FileChange.GONE:
        text = (
            f"“{name}” is no longer in its folder: it was deleted, moved or renamed. Save to write it again."
        )
        return Notice(text, ("saveDocument", "saveDocumentAs"))
    return None


def lock_notice(name: str, standing: Ownership, owner: Owner | None) -> Notice | None:
    """Return the notice about another owner of the document `name`."""
    if standing is Ownership.OURS or owner is None:
        return None
    who, have = _who(owner), _have(owner)
    if standing is Ownership.FREED:
        text = f"“{name}” is no longer open elsewhere. You can take it over."
        return Notice(text, ("takeOver",), warns=False)
    if standing is Ownership.ASKED:
        text = f"{who} may still be editing “{name}”. If you both save, one version replaces the other."
        return Notice(text, ("editAnyway", "saveDocumentAs"))
    if standing is Ownership.TAKEN_AWAY:
        text = f"{who} {have} taken over “{name}”{_where(owner)}. Save your changes under another name."
        return Notice(text, ("saveDocumentAs", "takeOver"))
    old = " It may have been left open by mistake." if owner.may_have_forgotten else ""
    since = f"{who} {have} had “{name}” open{_where(owner)} since {_moment(owner.since)}"
    text = f"{since}; it is read-only here.{old}"
    return Notice(text, ("takeOver", "saveDocumentAs"), warns=False)


def left_out_notice(name: str, left_out: LeftOut) -> Notice | None:
    """Return the notice about features of an older version that were left out."""
    if not left_out:
        return None
    them = "it" if left_out.is_one else "them"
    removes = f"removes {them} from the file, and " if left_out.words else ""
    text = f"{left_out.sentence(name)} Saving {removes}keeps a backup of the old file."
    return Notice(text, ("saveDocumentAs",), warns=bool(left_out.words))


def refusal_notice(name: str, sentence: str, problem: StorageError, *, is_own_file: bool) -> Notice:
    """Return the notice that the document was not saved to the file `name`, its own or another one."""
    if isinstance(problem, ChangedOnDiskError):
        text = f"“{name}” was not saved, because another program changed it."
        return Notice(text, ("overwriteFile", "saveDocumentAs", "reloadFile", "compareWithFile"))
    if isinstance(problem, LockedError):
        owner = problem.owner
        who = f"{_who(owner, first=False)} {_have(owner)}"
        text = f"“{name}” was not saved, because {who} it open{_where(owner)}."
        return Notice(text, ("saveDocumentAs", "takeOver") if is_own_file else ("saveDocumentAs",))
    return Notice(sentence, ("saveDocumentAs",))


def _who(owner: Owner, *, first: bool = True) -> str:
    if owner.is_same_person:
        return "You" if first else "you"
    return owner.user or ("Another user" if first else "another user")


def _have(owner: Owner) -> str:
    return "have" if owner.is_same_person else "has"


def _where(owner: Owner) -> str:
    if owner.is_this_process:
        return " in another window"
    if owner.is_same_person:
        return " in another process"
    return f" on {owner.host}" if owner.host else ""


def _moment(seconds: float) -> str:
    """Return the time of day, with the date unless it is today."""
    try:
        then, now = time.localtime(seconds), time.localtime()
    except (OverflowError, OSError, ValueError):  # the lock file may contain any number
        return "an unknown time"
    same_day = then[:3] == now[:3]
    return time.strftime("%H:%M" if same_day else "%Y-%m-%d %H:%M", then)
