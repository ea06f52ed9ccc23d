"""The files of families in use, of all windows together."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from PySide6.QtCore import QCoreApplication, QObject, Qt, QTimer, Signal
from PySide6.QtGui import QGuiApplication
from shiboken6 import isValid

from ...families import FAMILIES, Family
from ...tasks.single_task import SingleTask
from ...workbench.disk_watch import DiskWatch
from .. import own_families

_RECHECK_MS = 100
_MOST_CHECKS = 5
"""Number of looks, each after twice as long, before a file counts as gone: editors replace what they save."""


class FamilyFiles(QObject):
    """Runs files of families that the person named, and again whenever they are saved.

    A file is first run in a process of its own, with a limit of time; only one that works there is run in
    this one. A mistake leaves what the file said last.

    Signals
    -------
    brought
        A file was run: its path, and the families that are new, others than before, or offered no longer.
    told
        There is something else to say.

    Attributes
    ----------
    problems
        What is wrong with each file, as a sentence that names the line.
    running
        The file that has been running for a while; None while none is.
    offered
        What has just been written or brought, to be used: a template or a family; None where nothing has.
    """

    brought = Signal(object, object)
    told = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.problems: dict[Path, str] = {}
        self.running: Path | None = None
        self.offered: Path | Family | None = None
        self._seen: dict[Path, bytes | None] = {}
        self._watches: dict[Path, DiskWatch] = {}
        self._waiting: list[Path] = []
        self._trying: Path | None = None
        self._made_task: SingleTask | None = None
        if isinstance(application := QCoreApplication.instance(), QGuiApplication):
            application.applicationStateChanged.connect(self._look_when_active)
        for path in FAMILIES.files:
            self._follow(path)
            self._seen[path] = _content(path)

    def use(self, path: Path) -> None:
        """Run a file, have its families, and watch it from now on."""
        path = path.absolute()
        self._follow(path)
        self._seen[path] = _content(path)
        self._try(path)

    def stop(self) -> None:
        """Stop what is running; everything is as it was."""
        path = self._trying
        if path is not None and self._task.cancel():
            self._take_problem(path, f"“{path.name}” was stopped.")

    def forget_all(self) -> None:
        """Use no file any more."""
        self._waiting.clear()
        if self._made_task is not None:
            self._made_task.close()
        for watch in self._watches.values():
            watch.watch(None)
            watch.deleteLater()
        self._watches.clear()
        self._seen.clear()
        self.problems.clear()
        self.offered = None
        self.told.emit()

    # Noticing

    def _follow(self, path: Path) -> None:
        if path not in self._watches:
            watch = self._watches[path] = DiskWatch(self)
            watch.triggered.connect(partial(self._look, path))
            watch.watch(path)

    def _look_when_active(self, state: Qt.ApplicationState) -> None:
        if state is Qt.ApplicationState.ApplicationActive:
            for path in tuple(self._watches):
                self._look(path)

    def _look(self, path: Path, looked: int = 0) -> None:
        """Run a file that holds something else than when it was run last."""
        if path not in self._watches:
            return
        content = _content(path)
        if content is None and looked < _MOST_CHECKS:
            QTimer.singleShot(_RECHECK_MS << looked, self, partial(self._look, path, looked + 1))
        elif content != self._seen[path]:
            self._seen[path] = content
            if content is None:
                self._take_problem(
                    path, f"“{path.name}” is gone from its folder; its curves go on as they were."
                )
            else:
                self._try(path)

    # Running

    @property
    def _task(self) -> SingleTask:
        """The trials of files in flight; made with the first file."""
        if self._made_task is None:
            self._made_task = SingleTask(self)
            self._made_task.shown.connect(self._tell_running)
            self._made_task.ended.connect(self._go_on)
        return self._made_task

    def _try(self, path: Path) -> None:
        if self._trying == path:
            # It has been saved again meanwhile.
            self._task.cancel()
        if self._task.is_busy:
            if path not in self._waiting:
                self._waiting.append(path)
            return
        self._trying = path
        work = partial(own_families.trial.try_out, path)
        self._task.start(path.name, work, lambda _done: self._take(path), partial(self._fail, path))

    def _take(self, path: Path) -> None:
        """Run a file that works elsewhere here."""
        try:
            families = own_families.trial.use_file(FAMILIES, path)
        except own_families.trial.FamilyFileError as problem:
            self._fail(path, problem)
            return
        self.problems.pop(path, None)
        self.brought.emit(path, families)
        self.told.emit()

    def _fail(self, path: Path, problem: Exception) -> None:
        if not isinstance(problem, own_families.trial.FamilyFileError):
            raise problem
        self._take_problem(path, str(problem).replace(str(path), path.name))

    def _take_problem(self, path: Path, text: str) -> None:
        self.problems[path] = text
        self.told.emit()

    def _tell_running(self) -> None:
        self.running = self._trying
        self.told.emit()

    def _go_on(self) -> None:
        """Run what has been waiting; called when a trial has ended, before its result is taken."""
        was_told, self._trying, self.running = self.running is not None, None, None
        if was_told:
            self.told.emit()
        if self._waiting:
            QTimer.singleShot(0, self, partial(self._try, self._waiting.pop(0)))


def _content(path: Path) -> bytes | None:
    try:
        return path.read_bytes()
    except OSError:
        return None


_files: list[FamilyFiles] = []


def family_files() -> FamilyFiles:
    """Return those of this process, made with the first window; with the application they go."""
    if not _files or not isValid(_files[0]):
        _files[:] = [FamilyFiles(QCoreApplication.instance())]
    return _files[0]
