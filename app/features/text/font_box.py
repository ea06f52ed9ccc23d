"""The fonts with outlines, to choose one of."""

from __future__ import annotations

import re

from PySide6.QtCore import QEvent, QObject, QSignalBlocker, QStringListModel, Signal
from PySide6.QtGui import QFont, QGuiApplication
from PySide6.QtWidgets import QFontComboBox

from ...qt.overrides import Guarded
from ...widgets.controls import named

_MAKER = re.compile(r"\s*\[[^\[\]]*\]$")


def plain_family(family: str) -> str:
    """Return the name of a family without that of its maker, which Qt adds where there are several."""
    return _MAKER.sub("", family)


class FontBox(Guarded, QFontComboBox):
    """Fonts with outlines: of the list, while it is open, the one pointed at counts.

    Signals
    -------
    pointed_at
        Another one is to be seen; none any more where that is empty.
    picked
        One is chosen.
    """

    pointed_at = Signal(str)
    picked = Signal(str)

    def __init__(self, family: str) -> None:
        super().__init__()
        tip = "Font of the text; point at one in the list to see the text in it"
        named(self, "textFont", "Font", tip)
        # Those made of pixels have none.
        self.setFontFilters(QFontComboBox.FontFilter.ScalableFonts)
        self._pointed_at = ""
        self.take(family)
        QGuiApplication.instance().fontDatabaseChanged.connect(self._name_each_once)  # type: ignore[union-attr]
        self.textHighlighted.connect(self._point_at)
        self.activated.connect(self._pick)
        # Not told of in other ways: Escape puts the list away.
        self.view().installEventFilter(self)

    @property
    def family(self) -> str:
        """Family of the font that counts."""
        return self._pointed_at or plain_family(self.currentFont().family())

    def take(self, family: str) -> None:
        """Have another one count."""
        # Else it would tell that one is pointed at, which it passes on its way there.
        with QSignalBlocker(self):
            self.setCurrentFont(QFont(plain_family(family)))
        self._name_each_once()
        self._pointed_at = ""
        if (line := self.lineEdit()) is not None:
            # Of a long name the beginning is seen.
            line.home(False)

    def _name_each_once(self) -> None:
        """List a family that several makers have once, by its plain name."""
        fonts, shown = self.model(), self.currentText()
        assert isinstance(fonts, QStringListModel)
        names = fonts.stringList()
        plain = list(dict.fromkeys(map(plain_family, names)))
        if plain != names:
            with QSignalBlocker(self):
                fonts.setStringList(plain)
                self.setCurrentIndex(self.findText(plain_family(shown)))

    def _point_at(self, family: str) -> None:
        family = plain_family(family)
        if family != self._pointed_at:
            self._pointed_at = family
            self.pointed_at.emit(family)

    def _pick(self) -> None:
        self._point_at("")
        self.picked.emit(plain_family(self.currentFont().family()))

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Hide:
            self._point_at("")
        return super().eventFilter(watched, event)
