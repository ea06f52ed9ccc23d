"""The families that have no button of their own in the toolbar: a button with a menu of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu, QSizePolicy, QToolButton

from ...actions.keymap import plain
from ...appearance.icons import icon
from ...appearance.theme import FollowsTheme, Theme
from ...widgets.boxes import row_of
from ...widgets.controls import ToolbarWidget, named

_WORD, _TIP = "Families", "Further families of curves"
_ICON, _ARROW, _BESIDES = 20, 22, 36
"""Pixels along the sides of the icon, and of what stands beside it alone, and beside icon and word."""


class FamilyButton(FollowsTheme, ToolbarWidget):
    """Chooses one of the further families, and shows the one in use.

    Parameters
    ----------
    is_on
        Tells by its name whether what an action switches is on.
    """

    yields_late = True

    def __init__(self, is_on: Callable[[str], bool]) -> None:
        super().__init__()
        self._is_on = is_on
        self._words: dict[QAction, str] = {}
        self._is_compact = False
        self._shown: tuple[object, ...] = ()
        self.button = named(QToolButton(), "familiesButton", _TIP)
        self.button.setCheckable(True)
        self.button.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.button.setIconSize(QSize(_ICON, _ICON))
        self._menu = self._make_menu()
        self.button.setMenu(self._menu)
        row_of(self.button, margins=(0, 0, 0, 0), parent=self)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Preferred)
        self.follow_theme()

    def offer(self, further: Sequence[tuple[QAction, str]]) -> None:
        """Offer the actions of these families, each with a short word for the button, and no others.

        One that is gone has left the menu by itself.
        """
        for action, _word in further:
            if action not in self._words:
                self._menu.addAction(action)
                action.changed.connect(self.show_in_use)
        self._words = dict(further)
        self.button.setVisible(bool(further))
        self.show_in_use()

    def _make_menu(self) -> QMenu:
        menu = QMenu(self.button)
        menu.setObjectName("familiesMenu")
        menu.setToolTipsVisible(True)
        return menu

    def set_theme(self, theme: Theme) -> None:
        self.show_in_use()

    def set_compact(self, compact: bool) -> None:
        self._is_compact = compact
        self.show_in_use()

    def show_in_use(self) -> None:
        """Show the family in use, if it is one of these; the width stays."""
        action = next((each for each in self._words if self._is_on(each.objectName())), None)
        button, word = self.button, _WORD if action is None else self._words[action]
        button.setChecked(action is not None)
        seen = action or next(iter(self._words), None)
        picture = icon("spline", self.theme) if seen is None else seen.icon()
        text = "" if action is None else plain(action.text())
        # Every action of a family calls, for each of its changes.
        shown = picture.cacheKey(), text, self._words, self._is_compact, button.font()
        if shown == self._shown:
            return
        self._shown = shown
        button.setIcon(picture)
        button.setText(word)
        button.setToolTip(_TIP if action is None else f"{_TIP}; in use: {text}")
        style = Qt.ToolButtonStyle
        button.setToolButtonStyle(
            style.ToolButtonIconOnly if self._is_compact else style.ToolButtonTextBesideIcon
        )
        metrics = button.fontMetrics()
        widest = max(metrics.horizontalAdvance(each) for each in (_WORD, *self._words.values()))
        button.setFixedWidth(_ICON + (_ARROW if self._is_compact else _BESIDES + widest))
