"""The fonts with outlines, to choose one of."""

from __future__ import annotations

import re
from collections.abc import Iterable

from PySide6.QtCore import QEvent, QObject, QSignalBlocker, QStringListModel, Qt, Signal
from PySide6.QtGui import QFocusEvent, QFont, QGuiApplication
from PySide6.QtWidgets import QCompleter, QFontComboBox

from ...qt.keys import PASSING
from ...qt.overrides import Guarded
from ...widgets.controls import named

_MAKER = re.compile(r"\s*\[[^\[\]]*\]$")


def plain_family(family: str) -> str:
    """Return the name of a family without that of its maker, which Qt adds where there are several."""
    return _MAKER.sub("", family)


class FontBox(Guarded, QFontComboBox):
    """Fonts with outlines: of the list, while it is open, the one pointed at counts.

    Any part of a name may be typed: those that have it are listed, and Enter takes the first.

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
        tip = "Font of the text: point at one in the list to see the text in it, or type a part of a name"
        named(self, "textFont", "Font", tip)
        # Those made of pixels have none.
        self.setFontFilters(QFontComboBox.FontFilter.ScalableFonts)
        # Else what is typed is listed as a font.
        self.setInsertPolicy(QFontComboBox.InsertPolicy.NoInsert)
        self._pointed_at, self._family = "", ""
        self._first: tuple[str, ...] = ()
        self.take(family)
        QGuiApplication.instance().fontDatabaseChanged.connect(self._name_each_once)  # type: ignore[union-attr]
        self.textHighlighted.connect(self._point_at)
        self.activated.connect(self._pick)
        found = self.completer()
        assert found is not None
        found.setCompletionMode(QCompleter.CompletionMode.PopupCompletion)
        found.setFilterMode(Qt.MatchFlag.MatchContains)
        found.highlighted.connect(self._point_at)
        # Not told of in other ways: Escape puts the lists away.
        for each in (self.view(), found.popup()):
            assert each is not None
            each.installEventFilter(self)
        if (line := self.lineEdit()) is not None:
            line.returnPressed.connect(self._pick_first)

    @property
    def family(self) -> str:
        """Family of the font that counts."""
        return self._pointed_at or self._family

    def offer_first(self, families: Iterable[str]) -> None:
        """List some families before all others, as far as they are there."""
        self._first = tuple(dict.fromkeys(map(plain_family, families)))
        self._name_each_once()

    def take(self, family: str) -> None:
        """Have another one count."""
        self._family = plain_family(QFont(family).family())
        # Else it would tell that one is pointed at, which it passes on its way there.
        with QSignalBlocker(self):
            self.setCurrentFont(QFont(self._family))
        self._name_each_once()
        # Of a name that stands for another font Qt shows that one.
        if self._family and self.currentText() != self._family:
            with QSignalBlocker(self):
                self.setEditText(self._family)
        self._pointed_at = ""
        if (line := self.lineEdit()) is not None:
            # Of a long name the beginning is seen.
            line.home(False)

    def _name_each_once(self) -> None:
        """List a family that several makers have once, by its plain name."""
        fonts, shown = self.model(), self.currentText()
        assert isinstance(fonts, QStringListModel)
        names = fonts.stringList()
        known = dict.fromkeys(sorted(map(plain_family, names), key=str.casefold))
        plain = list(dict.fromkeys([*(each for each in self._first if each in known), *known]))
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
        if self.findText(self.currentText(), Qt.MatchFlag.MatchExactly) < 0:
            # Of what is typed Enter tells, too, whatever it is.
            self._pick_first()
            return
        self._family = plain_family(self.currentText())
        self.picked.emit(self._family)

    def _pick_first(self) -> None:
        """Take the first family with what is typed in its name; where there is none the name is as before."""
        typed = self.currentText()
        if typed == self._family or self.findText(typed, Qt.MatchFlag.MatchExactly) >= 0:
            return
        names = [self.itemText(at) for at in range(self.count())]
        holding = [at for at, name in enumerate(names) if typed.casefold() in name.casefold()]
        if not typed or not holding:
            self.setEditText(self._family)
            return
        begun = [at for at in holding if names[at].casefold().startswith(typed.casefold())]
        with QSignalBlocker(self):
            self.setCurrentIndex((begun or holding)[0])
        self.take(self.itemText(self.currentIndex()))
        self.picked.emit(self._family)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        if event.reason() not in PASSING and self.currentText() != self._family:
            self.setEditText(self._family)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Hide:
            self._point_at("")
        return super().eventFilter(watched, event)
