"""Watch over a file and its folder."""

from __future__ import annotations

import os
from pathlib import Path

from PySide6.QtCore import QFileSystemWatcher, QObject, QTimer, Signal
from PySide6.QtGui import QWindow
from PySide6.QtWidgets import QWidget

from ..qt.overrides import application
from ..tasks.task import DelayedCall

_SETTLE_MS = 100
"""Delay after the first notification in milliseconds: writing a file causes several."""


class DiskWatch(QObject):
    """Watcher of one file and its folder.

    The folder too, because a file that is replaced by another one of its name is watched no longer, and
    because locks come and go there. Some file systems of a network tell nothing: a check is due also whenever
    the window comes to the front, and `check_every` asks for one regularly.

    Parameters
    ----------
    parent
        The parent: a window, or an object that has to notice itself that a window comes to the front.

    Signals
    -------
    triggered
        Something may have changed; the file is to be checked.
    """

    triggered = Signal()

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._path: Path | None = None
        self._watcher: QFileSystemWatcher | None = None
        self._soon = DelayedCall(self, _SETTLE_MS, self._trigger)
        self._regularly = QTimer(self)
        self._regularly.timeout.connect(self.triggered)

    def watch(self, path: Path | None) -> None:
        """Watch the file at `path` instead of the previous one; None watches nothing."""
        if path is not None and self._path is None:
            application().focusWindowChanged.connect(self._look_up)
        elif path is None and self._path is not None:
            application().focusWindowChanged.disconnect(self._look_up)
        self._path = path
        if self._watcher is not None:
            for known in (*self._watcher.files(), *self._watcher.directories()):
                self._watcher.removePath(known)
        self._soon.stop()
        self._add()

    def check_every(self, milliseconds: int) -> None:
        """Trigger also at this interval; 0 for notifications only."""
        if milliseconds == 0:
            self._regularly.stop()
        elif not self._regularly.isActive():
            self._regularly.start(milliseconds)

    def _add(self) -> None:
        """Watch the file and its folder, where they exist."""
        if self._path is None:
            return
        watcher = self._watcher or self._make_watcher()
        known = {*watcher.files(), *watcher.directories()}
        # The target of a link as well: the folder of the link does not change with it.
        real = Path(os.path.realpath(self._path))
        for path in {self._path.absolute().parent, real.parent, real}:
            if str(path) not in known and path.exists():
                watcher.addPath(str(path))

    def _make_watcher(self) -> QFileSystemWatcher:
        self._watcher = QFileSystemWatcher(self)
        self._watcher.fileChanged.connect(self._soon.start_if_idle)
        self._watcher.directoryChanged.connect(self._soon.start_if_idle)
        return self._watcher

    def _trigger(self) -> None:
        self._add()
        self.triggered.emit()

    def _look_up(self, window: QWindow | None) -> None:
        """Trigger when the window comes to the front."""
        parent = self.parent()
        if window is not None and isinstance(parent, QWidget) and window is parent.windowHandle():
            self._soon.start_if_idle()
