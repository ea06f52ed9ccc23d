"""The document's file while it is open: changed, gone, or open elsewhere, and what can be done then."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject, QTimer

from ...actions.declaration import action
from ...actions.menus import FILE_DISK
from ...actions.needs import Need
from ...document.model import Document
from ...state.window_state import FileState
from ...storage.files import Stamp, StorageError
from ...storage.format_error import FormatError
from ...storage.open_file import FileChange, OpenFile
from ...view_model.curve.curve_view import view_of
from ...workbench.context import WindowContext
from ...workbench.disk_watch import DiskWatch
from ...workbench.message_bar import NoticeBar
from .notices import Notice, Ownership, about_content, about_left_out, about_lock, about_refusal

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
            lock = about_lock(name, self._standing, owner)
            content = about_content(name, self._change, modified=self._session.files.has_changes, owner=owner)
            is_urgent = self._standing in (Ownership.ASKED, Ownership.FREED, Ownership.TAKEN_AWAY)
            found += [lock, content] if is_urgent else [content, lock]
            found.append(about_left_out(name, file.left_out))
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
        self._refusal = about_refusal(path.name, sentence, problem, own=own)
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


COMMAND_SETS = (DiskCommands,)
