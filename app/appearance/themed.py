"""Widgets that take the colours of the theme, and those of the next one when it changes."""

from __future__ import annotations

from PySide6.QtCore import QEvent
from PySide6.QtWidgets import QApplication

from ..qt.overrides import SafeOverrides, guard
from .theme import LIGHT, Theme, theme_of


class FollowsTheme(SafeOverrides):
    """Mixin for widgets, named before Qt's class: `set_theme` is called whenever there is another theme.

    It begins with `follow_theme`, called when the widget is built.

    Attributes
    ----------
    theme
        The theme that it shows.
    """

    theme: Theme = LIGHT
    _is_following = False

    def follow_theme(self) -> None:
        """Show the theme of the moment, and from now on every other one."""
        # Not the widget's own palette: that is behind until the widget has been polished.
        theme = theme_of(QApplication.palette())
        if self._is_following and theme is self.theme:
            return  # a palette is told more than once; a style sheet of one's own is a change of it, too
        self._is_following, self.theme = True, theme
        self.set_theme(theme)

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        raise NotImplementedError

    @guard
    def changeEvent(self, event: QEvent) -> None:
        """Show another theme; called by Qt."""
        super().changeEvent(event)  # type: ignore[misc]  # that of the widget's class
        if self._is_following and event.type() == QEvent.Type.PaletteChange:
            self.follow_theme()
