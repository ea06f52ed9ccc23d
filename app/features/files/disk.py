"""The document's file while it is open: changed or deleted by another program, or open elsewhere.

`DiskCommands` follows the file and its lock, and offers actions in a bar over the canvas; the notices of that
bar are written at the end of this module.
"""

from __future__ import annotations

import time
from enum import Enum, auto
from pathlib import Path

import msgspec
from PySide6.QtCore import QObject, QTimer

from ...actions.declaration import action
from ...actions.menus import FILE_DISK
from ...actions.needs import Need
from ...document.model import Document
from ...state.window_state import FileState
from ...storage.files import ChangedOnDiskError, Stamp, StorageError
from ...storage.format_error import FormatError
from ...storage.lock import Owner
from ...storage.migration import LeftOut
from ...storage.open_file import FileChange, LockedError, OpenFile
from ...view_model.curve.curve_view import view_of
from ...workbench.context import WindowContext
from ...workbench.disk_watch import DiskWatch
from ...workbench.message_bar import NoticeBar

_RECHECK_MS = 100
_MOST_CHECKS = 5
"""Number of checks, each after twice as long, before a file counts as gone or broken: other programs may be
just writing it."""

_OWNER_MS = 2000
"""Milliseconds between checks whether the owner of the document is still there; a crash gives no sign."""

_CHANGED_OUTSIDE = "a file that was changed outside this window"


class DiskCommands(QObject):
    """Keeps the line about the file in step with the disk, and does what it offers."""

    def __init__(self, context: WindowContext) -> None:
        super().__init__(context.window)
        self._context, self._session = context, context.session
        self._bar: NoticeBar | None = None
        self._watch = DiskWatch(context.window)
        self._watch.triggered.connect(self._check_file)
        self._recheck = QTimer(self, singleShot=True)
        self._recheck.timeout.connect(self._check_file)
        self._file: OpenFile | None = None
        self._path: Path | None = None
        self._stamp: Stamp | None = None
        self._standing = Ownership.OURS
        self._dismissed: set[Notice] = set()
        self._reset()
        context.files.refused = self._show_refusal
        self._session.file_changed.connect(self._follow)
        self._session.opened.connect(self._tell_of_file)
        self._follow()
        # A document that was opened before there was a window.
        self._tell_of_file()

    def _reset(self) -> None:
        """Begin anew, with what was just opened, saved or reloaded."""
        self._recheck.stop()
        self.checks = 0
        self._change = FileChange.SAME
        self._other: Document | None = None
        self._refusal: Notice | None = None
        self._hide_ghost()

    # Keeping in step

    def _follow(self) -> None:
        """Take note of another file, or of the same one saved."""
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
        if file is not None and file.change is not self._change:
            self._settle(file, file.change)  # somebody has looked before the watch did
        self._show()

    def _tell_of_file(self) -> None:
        """Say what one should know about a file that was just opened."""
        file = self._session.files.file
        if file is None:
            return
        if file.is_older and not file.left_out:
            self._context.status_line.say(
                f"{file.path.name} is of an older version; the first save keeps the old file beside it."
            )
        elif file.lock_problem and file.owner is None:
            self._context.status_line.say(
                f"Others cannot see that {file.path.name} is open here: no lock in its folder "
                f"({file.lock_problem})."
            )

    def _check_file(self) -> None:
        """Look at the file and at its lock."""
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
            self._settle(file, change)
        self._show()

    def _settle(self, file: OpenFile, change: FileChange) -> None:
        """Take note of what has become of the file."""
        is_news = change is not self._change or self._other is not file.other_document
        self._change, self._other = change, file.other_document
        if is_news:
            self._dismissed.clear()
            if change is not FileChange.CHANGED:
                self._hide_ghost()
            elif self._context.store.state.compares_with_file:
                self._show_ghost()
        if change in (FileChange.GONE, FileChange.SAME) and self._is_refused_for_other_content:
            self._refusal = None  # what it warns of is there no longer
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

    # What is shown

    def _show(self) -> None:
        """Show what matters most now."""
        self._watch.check_every(_OWNER_MS if self._session.files.is_read_only else 0)
        self._context.store.change(
            file=FileState(
                change=self._change if self._file is not None else None,
                is_read_only=self._session.files.is_read_only,
                may_overwrite=self._may_overwrite,
                is_asked=self._standing is Ownership.ASKED,
            )
        )
        notice = next((each for each in self._notices() if each not in self._dismissed), None)
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
        """Return what there is to say, the most urgent first."""
        file = self._file
        found: list[Notice | None] = [self._refusal]
        if file is not None:
            name, owner = file.path.name, file.owner
            lock = lock_notice(name, self._standing, owner)
            content = content_notice(
                name, self._change, modified=self._session.files.has_changes, owner=owner
            )
            is_urgent = self._standing in (Ownership.ASKED, Ownership.FREED, Ownership.TAKEN_AWAY)
            found += [lock, content] if is_urgent else [content, lock]
            found.append(left_out_notice(name, file.left_out))
        return [each for each in found if each is not None]

    def _show_notice(self, notice: Notice) -> None:
        if self._bar is None:
            central = self._context.central
            self._bar = NoticeBar("file", central.canvas, central.message_bar)
            self._bar.clear_top = central.message_bar.clear_top
            self._bar.closed.connect(self._dismiss)
        self._shown = notice
        self._bar.show_notice(
            notice.text, [self._context.actions[name] for name in notice.actions], warns=notice.warns
        )

    def _dismiss(self) -> None:
        """Dismiss the sentence; if there is another one behind it, show that."""
        if self._shown is self._refusal:
            self._refusal = None
        elif self._standing is Ownership.ASKED:
            self._standing = Ownership.OPENED_ELSEWHERE
        else:
            self._dismissed.add(self._shown)
        self._show()

    def _show_refusal(self, path: Path, sentence: str, problem: StorageError) -> None:
        """Say why the document was not saved, and offer a way."""
        own = self._file is not None and self._file.is_at(path)
        self._refusal = refusal_notice(path.name, sentence, problem, own=own)
        if own:
            self._check_file()
        self._show()

    # What can be done

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
        """Take over what the file holds now; Undo brings back what was here."""
        if self._file is None:
            return
        name = self._file.path.name
        try:
            self._session.files.reload()
        except (FormatError, StorageError) as problem:
            self._refusal = Notice(f"{name} was not reloaded: {problem}", ("saveDocumentAs",))
            self._show()
            return
        self._session.say(f"Reloaded {name}; Undo brings back what was here.")

    @action(
        "keepMine",
        "Keep Mine",
        FILE_DISK,
        full_name="Keep Mine, not the File",
        needs=Need(
            _CHANGED_OUTSIDE,
            lambda state: state.window.file.change in (FileChange.CHANGED, FileChange.UNREADABLE),
        ),
    )
    def _keep_mine(self) -> None:
        """Go on with what is here; the next save replaces the changed file."""
        if self._file is not None:
            self._file.accept()
            # What is here is in no file.
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
        """Show what the file holds now, dashed behind the drawing."""
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
            views, f"{self._path.name} on the disk"
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
        """Replace the changed file by what is here."""
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
        """Make a document yours that is open elsewhere."""
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
        """Take the document over although somebody may be editing it."""
        if self._file is None:
            return
        self._file.take_over()
        self._standing, self._refusal = Ownership.OURS, None
        self._session.file_changed.emit()
        self._session.say(f"{self._file.path.name} can be saved from here now.")
        self._check_file()


# Notices: a sentence about the file, and the actions offered with it


class Notice(msgspec.Struct, frozen=True):
    """A sentence, the names of the actions that are offered with it, and whether it is a warning."""

    text: str
    actions: tuple[str, ...]
    warns: bool = True


class Ownership(Enum):
    """Relation of this window to the one that owns the document."""

    OURS = auto()
    OPENED_ELSEWHERE = auto()
    ASKED = auto()
    """The person wants to take it over, and has been told that somebody may be editing it."""
    TAKEN_AWAY = auto()
    FREED = auto()


def content_notice(name: str, change: FileChange, *, modified: bool, owner: Owner | None) -> Notice | None:
    """Return what there is to say when the file `name` holds something else than was seen last."""
    if change is FileChange.CHANGED:
        here = ", and here too" if modified else ""
        text = f"“{name}” was changed on the disk by another program{here}."
        if owner is not None:
            here = "; you have changes of your own here" if modified else ""
            text = f"{_who(owner)} saved changes to “{name}”{_where(owner)}{here}."
        return Notice(text, ("reloadFile", "keepMine", "compareWithFile"))
    if change is FileChange.UNREADABLE:
        text = f"“{name}” was changed by another program and holds no document now. Yours is still here."
        return Notice(text, ("keepMine", "saveDocumentAs"))
    if change is FileChange.GONE:
        text = f"“{name}” is gone from its folder: deleted, moved or renamed. Saving writes it anew."
        return Notice(text, ("saveDocument", "saveDocumentAs"))
    return None


def lock_notice(name: str, standing: Ownership, owner: Owner | None) -> Notice | None:
    """Return what there is to say about who owns the document `name`."""
    if standing is Ownership.OURS or owner is None:
        return None
    who, have = _who(owner), _have(owner)
    if standing is Ownership.FREED:
        text = f"“{name}” is free again; nobody else has it open now."
        return Notice(text, ("takeOver",), warns=False)
    if standing is Ownership.ASKED:
        text = f"{who} may still be editing “{name}”. If both save, one will have to choose between the two."
        return Notice(text, ("editAnyway", "saveDocumentAs"))
    if standing is Ownership.TAKEN_AWAY:
        text = f"{who} {have} taken “{name}” over{_where(owner)}. Your changes can go to another file."
        return Notice(text, ("saveDocumentAs", "takeOver"))
    old = f" Perhaps {_who(owner, first=False)} forgot it." if owner.may_have_forgotten else ""
    text = f"{who} {have} this open{_where(owner)}, since {_moment(owner.since)}; opened read-only.{old}"
    return Notice(text, ("takeOver", "saveDocumentAs"), warns=False)


def left_out_notice(name: str, left_out: LeftOut) -> Notice | None:
    """Return what there is to say when the file `name` of an older version holds more than the document."""
    if not left_out:
        return None
    them = "it" if left_out.is_one else "them"
    text = f"{left_out.sentence(name)} Save writes the file without {them}, and keeps the old one beside it."
    return Notice(text, ("saveDocumentAs",))


def refusal_notice(name: str, sentence: str, problem: StorageError, *, own: bool) -> Notice:
    """Return what to say when the document was not saved to the file `name`, its own one or another."""
    if isinstance(problem, ChangedOnDiskError):
        text = f"“{name}” was changed by another program; it was not saved."
        return Notice(text, ("overwriteFile", "saveDocumentAs", "reloadFile", "compareWithFile"))
    if isinstance(problem, LockedError):
        owner = problem.owner
        text = f"{_who(owner)} {_have(owner)} “{name}” open{_where(owner)}; it was not saved."
        return Notice(text, ("saveDocumentAs", "takeOver") if own else ("saveDocumentAs",))
    return Notice(sentence, ("saveDocumentAs",))


def _who(owner: Owner, *, first: bool = True) -> str:
    if owner.is_same_person:
        return "You" if first else "you"
    return owner.user or ("Somebody" if first else "somebody")


def _have(owner: Owner) -> str:
    return "have" if owner.is_same_person else "has"


def _where(owner: Owner) -> str:
    if owner.is_this_process:
        return " in another window"
    if owner.is_same_person:
        return " in another Curvebench"
    return f" on {owner.host}" if owner.host else ""


def _moment(seconds: float) -> str:
    """Return a time of day, with the date where it is not today."""
    try:
        then, now = time.localtime(seconds), time.localtime()
    except (OverflowError, OSError, ValueError):  # whatever somebody wrote into the lock file
        return "some time"
    same_day = then[:3] == now[:3]
    return time.strftime("%H:%M" if same_day else "%Y-%m-%d %H:%M", then)
