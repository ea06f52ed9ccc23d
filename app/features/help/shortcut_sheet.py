"""Sheet of keys and gestures over the canvas: first those that apply now, then the others."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
from PySide6.QtCore import QEvent, QMargins, QObject, Qt
from PySide6.QtGui import QAction, QHideEvent, QKeyEvent, QKeySequence, QMouseEvent, QShowEvent
from PySide6.QtWidgets import QApplication, QLineEdit, QScrollArea, QSizePolicy, QWidget

from ...appearance.icons import icon
from ...appearance.theme import Theme
from ...document.words import count_of
from ...qt.labels import Label, html_of
from ...qt.overrides import application
from ...tools.canvas.select import SELECT
from ...tools.tool import TOOLS, GestureRow, ToolRecord
from ...widgets.boxes import column_of, grid_of, row_of
from ...widgets.controls import ICON, named, tool_button
from ...widgets.frames import OverlayFrame, scroll_vertically

Rows = Sequence[tuple[str, str]]
_WIDEST, _MARGIN, _KEYS_WIDTH = 560, 24, 190
_MARGINS = QMargins(_MARGIN, _MARGIN, _MARGIN, _MARGIN)


class SheetState(msgspec.Struct, frozen=True):
    """Facts that decide which gestures apply now.

    Attributes
    ----------
    tool
        The tool in use.
    point_count
        Number of selected points.
    has_derivatives
        Whether the family has velocities.
    curves
        Label of the selected whole curves, "Leaf" or "2 curves"; empty without any.
    """

    tool: ToolRecord
    point_count: int
    has_derivatives: bool
    curves: str = ""

    @property
    def has_curves(self) -> bool:
        """Whether whole curves are selected and no point, so that transformations act on the curves."""
        return bool(self.curves) and not self.point_count

    @property
    def title(self) -> str:
        """Heading of the gestures that apply now."""
        if self.tool is SELECT and self.has_curves:
            return f"Now: {self.curves} selected"
        if self.tool is SELECT and self.point_count:
            return f"Now: {count_of(self.point_count, 'point')} selected"
        return f"Now: {self.tool.doing}"

    def missing(self, gesture: GestureRow) -> str:
        """Return the condition that a gesture lacks; empty where it applies."""
        is_met = (gesture.selected and bool(self.point_count)) or (gesture.curves and self.has_curves)
        if not is_met and gesture.curves:
            curves = "whole curves selected"
            return f"with points or {curves}" if gesture.selected else f"with {curves}"
        if not is_met and gesture.selected:
            return "with points selected"
        return "on a Hermite curve" if gesture.needs_derivatives and not self.has_derivatives else ""

    def rows(self) -> tuple[Rows, Rows]:
        """Return the gestures that apply now, and the others, each with the condition that it lacks."""
        gestures = [*self.tool.gestures, *_WITH_ANY_TOOL]
        if self.tool is not SELECT:
            gestures.append(GestureRow("Escape", "return to Select"))
        now = [(gesture.keys, gesture.what) for gesture in gestures if not self.missing(gesture)]
        others = {gesture: missing for gesture in gestures if (missing := self.missing(gesture))}
        for tool in TOOLS:
            for gesture in tool.gestures:
                if gesture not in gestures:
                    others.setdefault(gesture, f"when {tool.doing}")
        return now, [(gesture.keys, f"{gesture.what}, {missing}") for gesture, missing in others.items()]


_WITH_ANY_TOOL = (
    GestureRow("Hold Ctrl or Shift", "during a drag: keep to one axis; for angles: steps of 15°"),
    GestureRow("%", "switch snapping on or off, also during a drag"),
    GestureRow("Escape, right button", "during a drag: cancel it"),
    GestureRow(
        "Moving, scaling, rotating",
        "G, S, R: the selection, or else all points. X or Y keeps to an axis, digits type the amount "
        "(1/3, 2mm), Tab (or ;) moves from x to y, Enter finishes",
    ),
    GestureRow(
        "Arrow keys",
        "move by a round number or a grid step (on the t-rail: ticks); Shift: tenfold, Ctrl: a tenth",
        selected=True,
        curves=True,
    ),
    GestureRow("Drag a tick of the t-rail", "change t; the parameters become manual"),
    GestureRow("Hold E, dragging a tick", "move all ticks in that direction as well"),
    GestureRow("Shift+click ticks", "select several ticks; dragging one moves all"),
    GestureRow("Double-click a tick", "type its t; right-click it for more"),
    GestureRow(
        "Drag in the basis panel", "move the scrub line: every point shows its weight at t; Escape hides it"
    ),
    GestureRow("Click a basis function", "select its point"),
    GestureRow("Drag, with Move Image", "move the image, or scale it by a corner; arrow keys move it"),
    GestureRow("Ctrl+click, Shift+click, Ctrl+A", "in the list of curves: select several"),
    GestureRow("F2, Del", "in the list of curves: rename, delete"),
    GestureRow("Right button, Menu key", "open a menu"),
    GestureRow("Drop a file", "open a document, import a file, or show a picture behind the curves"),
    GestureRow("Wheel, pinch, Ctrl+two fingers", "zoom at the pointer"),
    GestureRow("Middle button, Space+drag, two fingers", "pan; Shift+wheel: sideways"),
)


class ShortcutSheet(OverlayFrame):
    """Sheet over the canvas, with a search; Escape, F1 or a click beside it closes it.

    It is a frame in the window, not a window: Escape reaches it wherever the focus is. While it has the
    focus, it receives all other keys, and none acts on the window behind it.

    Parameters
    ----------
    toggle
        The action that shows the sheet; its keys close it.
    """

    def __init__(self, window: QWidget, over: QWidget, toggle: QAction) -> None:
        super().__init__("shortcutSheet", window)
        self.setAccessibleName("Keys and mouse")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self._over, self._toggle = over, toggle
        self._sections: Sequence[tuple[str, Rows]] = ()
        self._search = named(
            QLineEdit(), "shortcutSearch", "Find keys and gestures", "Type to find keys and gestures"
        )
        self._search.setPlaceholderText("Find")
        self._search.textEdited.connect(self._show_matches)
        self.setFocusProxy(self._search)
        self._focus_before: QWidget | None = None
        label = "Close the sheet"
        self._close = tool_button("closeShortcuts", label, f"{label} (Esc)", icon_size=ICON, flat=True)
        self._close.clicked.connect(self.dismiss)
        self._area = scroll_vertically(QScrollArea(), "shortcutArea")
        self._area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        heading = Label("<b>Keys and mouse</b>", is_html=True)
        top = row_of(heading, (self._search, 1), self._close, margins=(16, 8, 8, 4), spacing=16)
        column_of(top, self._area, margins=(1, 1, 1, 8), spacing=0, parent=self)
        self.follow_theme()
        self.hide()

    def open(self, state: SheetState, menus: Sequence[tuple[str, Rows]]) -> None:
        """Show the gestures that apply in `state`, then the others, then the keys of each menu."""
        now, others = state.rows()
        self._sections = [(state.title, now), ("Otherwise", others), *menus]
        self._search.clear()
        self._show_matches("")
        self._focus_before = QApplication.focusWidget()
        self.show()
        self.raise_()
        self.setFocus()

    def _show_matches(self, text: str) -> None:
        """Show the rows that contain all words of a text."""
        words = text.casefold().split()
        matches = [
            (title, [row for row in rows if all(word in " ".join(row).casefold() for word in words)])
            for title, rows in self._sections
        ]
        nothing = [("No match. The command palette also finds synonyms.", (("", ""),))]
        self._area.setWidget(_grid(matches if any(rows for _, rows in matches) else nothing))
        self.place()

    def dismiss(self) -> None:
        """Hide the sheet, and return the focus."""
        had_focus = self.hasFocus() or self.isAncestorOf(QApplication.focusWidget() or self.below)
        self.hide()
        if had_focus and self._focus_before is not None:
            self._focus_before.setFocus()
        self._focus_before = None

    def place(self) -> None:
        """Move to the middle of the canvas, as high as the rows need and there is room."""
        corner = self._over.mapTo(self.below, self._over.rect().topLeft())
        room = self._over.size().shrunkBy(_MARGINS)
        width = min(room.width(), _WIDEST)
        content = self._area.widget()
        # A vertical scroll bar takes its width from the rows.
        rows = content.heightForWidth(width - 24) if content is not None else 0
        top = max(widget.sizeHint().height() for widget in (self._close, self._search))
        # A sheet without matches has no height for a width: the field and the button keep theirs.
        height = min(room.height(), max(rows + top + 24, self.minimumSizeHint().height()))
        self.setGeometry(corner.x() + (self._over.width() - width) // 2, corner.y() + _MARGIN, width, height)

    def set_theme(self, theme: Theme) -> None:
        self._close.setIcon(icon("close", theme))
        self.set_sheet(
            "#shortcutArea, #shortcutRows { background: transparent }"
            f"#shortcutKeys {{ color: {theme.muted.name()} }}",
            line=0.2,
        )

    # Qt's events

    def showEvent(self, event: QShowEvent) -> None:
        application().installEventFilter(self)
        super().showEvent(event)

    def hideEvent(self, event: QHideEvent) -> None:
        # However it was hidden: else every event of the program would pass through the filter.
        application().removeEventFilter(self)
        super().hideEvent(event)

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent):
            if QKeySequence(event.keyCombination()) not in self._toggle.shortcuts():
                event.accept()
            return True
        return bool(super().event(event))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        scroll = self._area.verticalScrollBar()
        step, page = scroll.singleStep(), scroll.pageStep()
        keys = Qt.Key
        steps = {keys.Key_Down: step, keys.Key_Up: -step, keys.Key_PageDown: page, keys.Key_PageUp: -page}
        by = steps.get(keys(event.key()))
        if by is not None:
            scroll.setValue(scroll.value() + by)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        match event.type():
            case QEvent.Type.Resize if watched is self._over:
                self.place()
            case QEvent.Type.KeyPress if isinstance(event, QKeyEvent) and watched.isWidgetType():
                if event.key() == Qt.Key.Key_Escape:
                    self.dismiss()
                    return True
            case QEvent.Type.MouseButtonPress if isinstance(watched, QWidget) and self._is_beside(event):
                self.dismiss()
        return False

    def _is_beside(self, event: QEvent) -> bool:
        assert isinstance(event, QMouseEvent)
        return not self.rect().contains(self.mapFromGlobal(event.globalPosition().toPoint()))


def _grid(sections: Sequence[tuple[str, Rows]]) -> QWidget:
    """Return a widget with all sections in one grid, so that their columns are aligned."""
    content = QWidget()
    content.setObjectName("shortcutRows")
    grid = grid_of(16, 4, stretched=[1], margins=(16, 0, 16, 8), parent=content)
    grid.setColumnMinimumWidth(0, _KEYS_WIDTH)
    line = 0
    for title, rows in sections:
        if not rows:
            continue
        heading = Label(f"<b>{html_of(title)}</b>", is_html=True)
        heading.setContentsMargins(0, 10 if line else 0, 0, 2)
        grid.addWidget(heading, line, 0, 1, 2)
        for row, (keys, text) in enumerate(rows, start=line + 1):
            grid.addWidget(_cell(keys, "shortcutKeys"), row, 0)
            grid.addWidget(_cell(text, "shortcutText"), row, 1)
        line += len(rows) + 1
    grid.setRowStretch(line, 1)
    return content


def _cell(text: str, name: str) -> Label:
    label = Label(text, name=name, wordWrap=True)
    label.setAlignment(Qt.AlignmentFlag.AlignTop)
    label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Minimum)
    return label
