"""Title of a dock, with buttons that make it a window of its own, and put it away."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDockWidget, QWidget

from ..appearance.icons import icon
from ..appearance.theme import Theme
from ..appearance.themed import FollowsTheme
from ..qt.labels import Label
from ..widgets.boxes import row_of
from ..widgets.tool_buttons import ICON, tool_button

_FLOAT, _DOCK = "Float: a window of its own", "Dock: back into the window"


class DockTitle(FollowsTheme, QWidget):
    """The words and the buttons; dragged anywhere else, the dock comes along.

    Attributes
    ----------
    float_button, close_button
        The buttons; the first is down while the dock floats.
    """

    def __init__(self, dock: QDockWidget) -> None:
        super().__init__(dock)
        self._dock = dock
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        name, title = dock.objectName(), dock.windowTitle()
        self.float_button = tool_button(f"{name}Float", f"Float {title}", _FLOAT, icon_size=ICON, flat=True)
        self.close_button = tool_button(
            f"{name}Close", f"Close {title}", "Close; View › Panels brings it back", icon_size=ICON, flat=True
        )
        self.float_button.setCheckable(True)
        self.float_button.clicked.connect(lambda: dock.setFloating(not dock.isFloating()))
        self.close_button.clicked.connect(dock.close)
        dock.topLevelChanged.connect(self._show_place)
        # Text is the last to give way where there is little room. It is 80 wide then: its layout says so,
        # for Qt asks hundreds of times whenever docks are laid out.
        self._words = words = Label(title)
        words.setMinimumWidth(9)
        dock.windowTitleChanged.connect(self._show_title)
        buttons = self.float_button, self.close_button
        row_of((words, 1), *buttons, margins=(10, 1, 3, 1), spacing=2, parent=self)
        self.follow_theme()
        self._show_place(dock.isFloating())

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        self.close_button.setIcon(icon("close", theme))
        self._show_icon()

    def _show_title(self, title: str) -> None:
        self._words.setText(title)
        for button in (self.float_button, self.close_button):
            button.setAccessibleName(f"{button.accessibleName().partition(' ')[0]} {title}")

    def _show_place(self, floats: bool) -> None:
        button, (verb, tip) = self.float_button, ("Dock", _DOCK) if floats else ("Float", _FLOAT)
        button.setChecked(floats)
        button.setToolTip(tip)
        button.setAccessibleName(f"{verb} {button.accessibleName().partition(' ')[2]}")
        self._show_icon()

    def _show_icon(self) -> None:
        self.float_button.setIcon(icon("dock" if self._dock.isFloating() else "float", self.theme))
