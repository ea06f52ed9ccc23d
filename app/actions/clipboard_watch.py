"""Content of the clipboard, as far as actions depend on it."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QGuiApplication

DERIVATIVES = "application/x-curvebench-derivatives"
"""MIME type of a point's derivatives: a point of which the position does not count."""


class ClipboardWatch(QObject):
    """Knows whether there are derivatives on the clipboard.

    Another program may have to be asked for that: it is, when somebody wants to know, and once.

    Signals
    -------
    changed
        There is something else on the clipboard.
    """

    changed = Signal()

    def __init__(self, window: QObject) -> None:
        # A child of the window: the clipboard lives longer.
        super().__init__(window)
        self._known: bool | None = None
        QGuiApplication.clipboard().dataChanged.connect(self._forget)

    @property
    def holds_derivatives(self) -> bool:
        """Whether there are some now."""
        if self._known is None:
            data = QGuiApplication.clipboard().mimeData()
            self._known = data is not None and data.hasFormat(DERIVATIVES)
        return self._known

    def _forget(self) -> None:
        self._known = None
        self.changed.emit()
