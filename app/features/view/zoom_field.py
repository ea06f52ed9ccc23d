"""The zoom in the status line: a field to type it into, and a button with a menu of what is usual."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QPoint, Qt, QTimer, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu, QSizePolicy, QWidget

from ...document.expression import ExpressionError
from ...document.lengths import MILLIMETRES, known_unit
from ...document.words import number
from ...widgets.boxes import row_of
from ...widgets.controls import named, tool_button
from ...widgets.fields import NumberEdit, read_number

PIXELS_WITHOUT_UNIT = 100.0
"""Pixels of a length of 1 at 100 %, where nobody has said how long that is."""

_MILLIMETRES_PER_INCH = 25.4
_PLAIN = (0.01, 1e6)
"""Per cents that are written without a power of ten."""


def pixels_at_full_size(unit: str, dots_per_inch: float) -> float:
    """Return how many pixels a length of 1 takes at 100 %: as many as on paper, if its unit is one."""
    known = known_unit(unit)
    if not known:
        return PIXELS_WITHOUT_UNIT
    return MILLIMETRES[known] / _MILLIMETRES_PER_INCH * dots_per_inch


def words_about_full_size(unit: str, dots_per_inch: float) -> str:
    """Return what 100 % means here, as a sentence."""
    pixels = number(pixels_at_full_size(unit, dots_per_inch), 3)
    if known := known_unit(unit):
        return f"100 % is true size on this screen: 1 {known} is {pixels} pixels."
    return f"Without a unit of length 100 % shows a length of 1 as {pixels} pixels."


def per_cent_text(share: float) -> str:
    """Return a zoom with three digits: 1.0 as "100 %"."""
    value = 100 * share
    if not _PLAIN[0] <= value < _PLAIN[1]:
        return f"{number(value, 3)} %"
    return f"{number(float(f'{value:.3g}'), 7)} %"


def read_zoom(text: str) -> float:
    """Return the share that was typed: of "250 %", "250" and "500/2" 2.5.

    Raises
    ------
    ExpressionError
        With the sentence for the person, where it is none.
    """
    value = read_number(text.replace("%", " "))
    if value <= 0:
        raise ExpressionError("A zoom is greater than 0, such as 250 %.")
    return value / 100


_SOON_MS = 33
"""Milliseconds after which a zoom is written: a wheel is quicker than an eye."""

_PADDING = 4
_WIDEST = "88888888 %"


class ZoomField(QWidget):
    """Shows the zoom, and takes another one.

    Signals
    -------
    zoom_entered
        Another zoom was typed, 1.0 for 100 %.
    refused
        Why what was typed is no zoom.
    """

    zoom_entered = Signal(float)
    refused = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("zoomReadout")
        self._share, self._about = 1.0, ""
        self.edit = NumberEdit("zoomField", "Zoom", "Zoom", read_zoom)
        self.edit.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.edit.setFrame(False)
        self.edit.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Preferred)
        self.edit.entered.connect(self._enter)
        self.edit.refused.connect(self.refused)
        self._choices = tool_button("zoomChoices", "Choose a zoom", "Choose a zoom", flat=True)
        self._choices.setArrowType(Qt.ArrowType.UpArrow)
        self._choices.clicked.connect(self._open_menu)
        self._menu = named(QMenu(self._choices), "zoomMenu")
        # No taller than the words beside it: the status line would grow.
        for part in (self.edit, self._choices):
            part.setMaximumHeight(self.fontMetrics().height() + _PADDING)
        row_of(self.edit, self._choices, margins=0, spacing=0, parent=self)
        self._soon = QTimer(self, singleShot=True, interval=_SOON_MS)
        self._soon.timeout.connect(self._write)

    def offer(self, groups: Sequence[Sequence[QAction]]) -> None:
        """Offer actions in the menu, in groups."""
        for place, group in enumerate(groups):
            if place:
                self._menu.addSeparator()
            self._menu.addActions(list(group))

    def _open_menu(self) -> None:
        # By hand: a menu of the button's own has the style draw a second arrow.
        self._menu.popup(self.mapToGlobal(QPoint(0, -self._menu.sizeHint().height())))

    def show_zoom(self, share: float, about: str) -> None:
        """Show a zoom soon, and in the tip what 100 % means."""
        if share != self._share or about != self._about:
            self._share, self._about = share, about
            if not self._soon.isActive():
                self._soon.start()

    def _write(self) -> None:
        self._soon.stop()
        edit, text = self.edit, per_cent_text(self._share)
        edit.show_text(text)
        edit.setToolTip(f"Zoom: type one, such as 250 %. {self._about}")
        width = max(edit.fontMetrics().horizontalAdvance(each) for each in (text, _WIDEST)) + 14
        if width != edit.width():
            edit.setFixedWidth(width)

    def _enter(self, share: float) -> None:
        self.zoom_entered.emit(share)
        # Also where nothing has changed: what was typed is written as the others are.
        self._write()
