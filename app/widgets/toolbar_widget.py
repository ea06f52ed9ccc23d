"""Widget of a toolbar that has room only in a wide window."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget


class ToolbarWidget(QWidget):
    """Part of the toolbar that is no button."""

    yields_late = False
    """Whether it keeps its words as long as the buttons beside it keep their icons and words."""

    def set_compact(self, compact: bool) -> None:
        """Take less room in a narrow window."""
