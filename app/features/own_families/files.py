"""The files of families in use, of all windows together."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QCoreApplication, QObject, Qt, QTimer, Signal
from PySide6.QtGui import QGuiApplication
from shiboken6 import isValid

from ...families import FAMILIES, Family
from ...tasks.task import SingleTask
from ...workbench.disk_watch import DiskWatch
from .. import own_families

if TYPE_CHECKING:
    from ...families.family_file import Call

_RECHECK_MS = 100
_REPORTED_AFTER_MS = 1000
"""Milliseconds that a file may run before it is said that it does: starting a process takes half of them."""

_CALL_MS = 100
"""Milliseconds that a window waits for a function of a file."""

_MOST_CHECKS = 5
"""Number of looks, each after twice as long, before a file counts as gone: editors replace what they save."""


class FamilyFiles(QObject):
    """Family files that the person named: they run at once, and again whenever they are saved.

    A file is first run in a process of its own, with a limit of time; only one that works there is run in
    this one. A mistake leaves what the file said last. A function that takes too long for a window is tried
    there too; until it has ended there, curves of so many points are refused.

    Signals
    -------
    brought
        A file was run: its path, and the families that are new, others than before, or offered no longer.
    changed
        A file runs, has ended, or has a mistake: the notices are others.
    answered
        A function that took too long was tried elsewhere: curves of this family are to be drawn anew.

    Attributes
    ----------
    problems
        What is wrong with each file, as a sentence that names the line.
    running
        What has been running for a while, in words; empty while nothing is.
    offered
        What has just been written or brought, to be used: a template or a family; None where nothing has.
    """

    brought = Signal(object, object)
    changed = Signal()
    answered = Signal(object)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.problems: dict[Path, str] = {}
        self.running = ""
        self.offered: Path | Family | None = None
        self._contents: dict[Path, bytes | None] = {}
        self._watches: dict[Path, DiskWatch] = {}
        self._waiting: list[Path | Call] = []
        self._trying: Path | Call | None = None
        self._trial_task: SingleTask | None = None
        if isinstance(application := QCoreApplication.instance(), QGuiApplication):
            application.applicationStateChanged.connect(self._look_when_active)
        for path in FAMILIES.files:
            self._follow(path)
            self._contents[path] = _content(path)

    def use(self, path: Path) -> None:
        """Run a file, use its families, and watch it from now on."""
        path = path.absolute()
        self._follow(path)
        self._contents[path] = _content(path)
        self._begin(path)

    def stop(self) -> None:
        """Stop the trial in flight; nothing changes."""
        tried = self._trying
        if tried is not None and self._task.cancel():
            what = f"“{tried.name}”" if isinstance(tried, Path) else f"{tried.message} and"
            self._fail(tried, own_families.trial.FamilyFileError(f"{what} was stopped."))

    # Noticing

    def _follow(self, path: Path) -> None:
        if path not in self._watches:
            own_families.trial.PATIENCE.of_a_window(1e-3 * _CALL_MS, self._begin)
            watch = self._watches[path] = DiskWatch(self)
            watch.triggered.connect(partial(self._look, path))
            watch.watch(path)

    def _look_when_active(self, state: Qt.ApplicationState) -> None:
        if state is Qt.ApplicationState.ApplicationActive:
            for path in tuple(self._watches):
                self._look(path)

    def _look(self, path: Path, looked: int = 0) -> None:
        """Run a file if its content has changed."""
        if path not in self._watches:
            return
        content = _content(path)
        if content is None and looked < _MOST_CHECKS:
            QTimer.singleShot(_RECHECK_MS << looked, self, partial(self._look, path, looked + 1))
        elif content != self._contents[path]:
            self._contents[path] = content
            if content is None:
                self._add_problem(
                    path, f"“{path.name}” is no longer in its folder; its curves keep their last functions."
                )
            else:
                self._begin(path)

    # Running

    @property
    def _task(self) -> SingleTask:
        """The trials of files in flight; made with the first file."""
        if self._trial_task is None:
            self._trial_task = SingleTask(self, _REPORTED_AFTER_MS)
            self._trial_task.shown.connect(self._report_running)
            self._trial_task.ended.connect(self._go_on)
        return self._trial_task

    def _begin(self, tried: Path | Call) -> None:
        """Try a file, or a call of one, as soon as nothing else is tried; never at once, amid a drawing."""
        if self._trying == tried:
            # It has been saved again meanwhile.
            self._task.cancel()
        if tried not in self._waiting:
            self._waiting.append(tried)
            QTimer.singleShot(0, self, self._try_next)

    def _try_next(self) -> None:
        if not self._waiting or self._trying is not None:
            return
        tried = self._trying = self._waiting.pop(0)
        trial, fail = own_families.trial, partial(self._fail, tried)
        if isinstance(tried, Path):
            self._task.start(
                tried.name, partial(trial.try_out, tried), lambda _done: self._use_here(tried), fail
            )
        else:
            work = partial(trial.try_call, tried)
            self._task.start(tried.calls.path.name, work, partial(self._allow, tried), fail)

    def _use_here(self, path: Path) -> None:
        """Run a file that worked in another process in this one."""
        try:
            families = own_families.trial.use_file(FAMILIES, path)
        except own_families.trial.FamilyFileError as problem:
            self._fail(path, problem)
            return
        self.problems.pop(path, None)
        self.brought.emit(path, families)
        self.changed.emit()

    def _allow(self, call: Call, seconds: float) -> None:
        call.calls.allow(call.kind, seconds)
        self.answered.emit(FAMILIES.named(call.calls.name))

    def _fail(self, tried: Path | Call, problem: Exception) -> None:
        if not isinstance(problem, own_families.trial.FamilyFileError):
            raise problem
        path = _path_of(tried)
        text = str(problem).replace(str(path), path.name)
        if isinstance(tried, Path):
            self._add_problem(path, text)
        else:
            tried.calls.refuse(tried.kind, text)
            self.answered.emit(FAMILIES.named(tried.calls.name))

    def _add_problem(self, path: Path, text: str) -> None:
        self.problems[path] = text
        self.changed.emit()

    def _report_running(self) -> None:
        tried = self._trying
        assert tried is not None
        self.running = (
            f"“{tried.name}” has been running for a while…"
            if isinstance(tried, Path)
            else f"{tried.message}…"
        )
        self.changed.emit()

    def _go_on(self) -> None:
        """Start the next trial that waits; called when a trial has ended, before its result is used."""
        was_reported, self._trying, self.running = bool(self.running), None, ""
        if was_reported:
            self.changed.emit()
        QTimer.singleShot(0, self, self._try_next)


def _path_of(tried: Path | Call) -> Path:
    return tried if isinstance(tried, Path) else tried.calls.path


def _content(path: Path) -> bytes | None:
    try:
        return path.read_bytes()
    except OSError:
        return None


_files: list[FamilyFiles] = []


def family_files() -> FamilyFiles:
    """Return the family files of this process, made with the first window."""
    if not _files or not isValid(_files[0]):
        _files[:] = [FamilyFiles(QCoreApplication.instance())]
    return _files[0]
