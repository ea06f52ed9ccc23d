"""Shortcut sheet over the drawing: keys and mouse, first what applies now, then the rest."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
from PySide6.QtCore import QEvent, QMargins, QObject, Qt
from PySide6.QtGui import QAction, QHideEvent, QKeyEvent, QKeySequence, QMouseEvent, QShowEvent
from PySide6.QtWidgets import QApplication, QFrame, QGridLayout, QLineEdit, QScrollArea, QSizePolicy, QWidget

from ...appearance.icons import icon
from ...appearance.theme import Theme
from ...document.words import count_of
from ...qt.labels import Label, html_of
from ...tools.canvas.select import SELECT
from ...tools.tool import TOOLS, GestureRow, ToolRecord
from ...widgets.boxes import column_of, row_of
from ...widgets.controls import ICON, named, tool_button
from ...widgets.frames import OverlayFrame

Rows = Sequence[tuple[str, str]]
_WIDEST, _MARGIN, _KEYS_WIDTH = 560, 24, 190
_MARGINS = QMargins(_MARGIN, _MARGIN, _MARGIN, _MARGIN)


class Moment(msgspec.Struct, frozen=True):
    """Situation by which the sheet tells what applies now.

    Attributes
    ----------
    tool
        The tool in use.
    selected
        How many points are selected.
    has_derivatives
        Whether the family has velocities.
    chosen
        The words for what is chosen as a whole, "Leaf" or "2 curves"; empty for nothing.
    """

    tool: ToolRecord
    selected: int
    has_derivatives: bool
    chosen: str = ""

    @property
    def has_curves(self) -> bool:
        """Whether curves are chosen and the transforms act on them: no point is selected."""
        return bool(self.chosen) and not self.selected

    @property
    def title(self) -> str:
        """Heading for the situation."""
        if self.tool is SELECT and self.has_curves:
            return f"Now: {self.chosen} chosen"
        if self.tool is SELECT and self.selected:
            return f"Now: {count_of(self.selected, 'point')} selected"
        return f"Now: {self.tool.doing}"

    def missing(self, gesture: GestureRow) -> str:
        """Return what must be otherwise for a gesture of any tool to apply; empty where it does."""
        is_there = (gesture.selected and bool(self.selected)) or (gesture.curves and self.has_curves)
        if not is_there and gesture.curves:
            curves = "curves chosen and no point selected"
            return f"with points selected, or {curves}" if gesture.selected else f"with {curves}"
        if not is_there and gesture.selected:
            return "with points selected"
        return "on a Hermite curve" if gesture.needs_derivatives and not self.has_derivatives else ""

    def rows(self) -> tuple[Rows, Rows]:
        """Return the gestures that apply, and the others, each with what must be otherwise."""
        own = [*self.tool.gestures, *_WITH_ANY_TOOL]
        if self.tool is not SELECT:
            own.append(GestureRow("Escape", "back to selecting"))
        now = [(each.keys, each.what) for each in own if not self.missing(each)]
        rest = {each: missing for each in own if (missing := self.missing(each))}
        for tool in TOOLS:
            for each in tool.gestures:
                if each not in own:
                    rest.setdefault(each, f"when {tool.doing}")
        return now, [(each.keys, f"{each.what}, {missing}") for each, missing in rest.items()]


_WITH_ANY_TOOL = (
    GestureRow("Hold Ctrl or Shift", "while something is dragged: one axis; of angles: steps of 15°"),
    GestureRow("%", "snap, or not, also in mid-drag"),
    GestureRow("Escape, right button", "during a drag: take it back"),
    GestureRow(
        "Moving, scaling, rotating",
        "G, S, R: what is selected, else all points. X or Y locks an axis, digits type the amount "
        "(1/3, 2mm), Tab (or ;) goes from x to y, Enter ends",
    ),
    GestureRow(
        "Arrow keys",
        "move by a round number or a step of the grid; in the t-rail its ticks; Shift: ten, Ctrl: a tenth",
        selected=True,
        curves=True,
    ),
    GestureRow("Drag a tick of the t-rail", "change t; the parameters become manual"),
    GestureRow("Hold E, dragging a tick", "all ticks on the side you move to go along"),
    GestureRow("Shift+click ticks", "select several; dragging one moves all"),
    GestureRow("Double-click a tick", "type its t; right-click for more"),
    GestureRow("Drag in the basis panel", "scrub: every point shows its weight at t; Escape puts it away"),
    GestureRow("Click a basis function", "select its point"),
    GestureRow("Drag, moving the image", "move it, or scale it by a corner; arrow keys nudge it"),
    GestureRow("Ctrl+click, Shift+click, Ctrl+A", "in the list of curves: choose several"),
    GestureRow("F2, Del", "in the list of curves: rename, delete"),
    GestureRow("Right button, Menu key", "what can be done there"),
    GestureRow("Drop a file", "open a document, or trace a picture"),
    GestureRow("Wheel, pinch, Ctrl+two fingers", "zoom at the pointer"),
    GestureRow("Middle button, Space+drag, two fingers", "pan; Shift+wheel: sideways"),
)


class ShortcutSheet(OverlayFrame):
    """Lies over the drawing; Escape, F1 or a click beside it puts it away. What is typed is looked for in it.

    It is a part of the window and no window of its own: it needs no place on the desktop, and Escape reaches
    it wherever the focus is. All other keys are its own while it has the focus, and act on nothing behind it.

    Parameters
    ----------
    toggle
        The action that shows it, whose keys put it away.
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
        self._search.textEdited.connect(self._show_found)
        self.setFocusProxy(self._search)
        self._focus_before: QWidget | None = None
        words = "Put the sheet away"
        self._close = tool_button("closeShortcuts", words, f"{words} (Esc)", icon_size=ICON, flat=True)
        self._close.clicked.connect(self.dismiss)
        self._area = QScrollArea()
        self._area.setObjectName("shortcutArea")
        self._area.setWidgetResizable(True)
        self._area.setFrameShape(QFrame.Shape.NoFrame)
        self._area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        heading = Label("<b>Keys and mouse</b>", is_html=True)
        top = row_of(heading, (self._search, 1), self._close, margins=(16, 8, 8, 4), spacing=16)
        column_of(top, self._area, margins=(1, 1, 1, 8), spacing=0, parent=self)
        self.follow_theme()
        self.hide()

    def open(self, moment: Moment, menus: Sequence[tuple[str, Rows]]) -> None:
        """Show what applies at `moment`, then the other gestures, then the keys of each menu."""
        now, rest = moment.rows()
        self._sections = [(moment.title, now), ("Otherwise", rest), *menus]
        self._search.clear()
        self._show_found("")
        self._focus_before = QApplication.focusWidget()
        self.show()
        self.raise_()
        self.setFocus()

    def _show_found(self, text: str) -> None:
        """Show the rows in which all words of a text are."""
        words = text.casefold().split()
        found = [
            (title, [row for row in rows if all(word in " ".join(row).casefold() for word in words)])
            for title, rows in self._sections
        ]
        nothing = [("Nothing is called that; the command palette finds by other words, too.", (("", ""),))]
        self._area.setWidget(_grid(found if any(rows for _, rows in found) else nothing))
        self.place()

    def dismiss(self) -> None:
        """Hide, and give the focus back."""
        had_focus = self.hasFocus() or self.isAncestorOf(QApplication.focusWidget() or self.below)
        self.hide()
        if had_focus and self._focus_before is not None:
            self._focus_before.setFocus()
        self._focus_before = None

    def place(self) -> None:
        """Lie in the middle of the drawing, as high as the rows need and there is room."""
        corner = self._over.mapTo(self.below, self._over.rect().topLeft())
        room = self._over.size().shrunkBy(_MARGINS)
        width = min(room.width(), _WIDEST)
        content = self._area.widget()
        # A vertical scroll bar takes its width from the rows.
        rows = content.heightForWidth(width - 24) if content is not None else 0
        top = max(each.sizeHint().height() for each in (self._close, self._search))
        # Nothing found has no height for a width: the field and the button keep their own.
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
        _application().installEventFilter(self)
        super().showEvent(event)

    def hideEvent(self, event: QHideEvent) -> None:
        # Whatever hides it: every event of the program would come by.
        _application().removeEventFilter(self)
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
            case QEvent.Type.KeyPress if _is_escape(event) and watched.isWidgetType():
                self.dismiss()
                return True
            case QEvent.Type.MouseButtonPress if isinstance(watched, QWidget) and self._is_beside(event):
                self.dismiss()
        return False

    def _is_beside(self, event: QEvent) -> bool:
        assert isinstance(event, QMouseEvent)
        return not self.rect().contains(self.mapFromGlobal(event.globalPosition().toPoint()))


def _is_escape(event: QEvent) -> bool:
    return isinstance(event, QKeyEvent) and event.key() == Qt.Key.Key_Escape


def _grid(sections: Sequence[tuple[str, Rows]]) -> QWidget:
    """Return all sections in one grid, so that their columns stand below each other."""
    content = QWidget()
    content.setObjectName("shortcutRows")
    grid = QGridLayout(content)
    grid.setContentsMargins(16, 0, 16, 8)
    grid.setHorizontalSpacing(16)
    grid.setVerticalSpacing(4)
    grid.setColumnMinimumWidth(0, _KEYS_WIDTH)
    grid.setColumnStretch(1, 1)
    line = 0
    for title, rows in sections:
        if not rows:
            continue
        heading = Label(f"<b>{html_of(title)}</b>", is_html=True)
        heading.setContentsMargins(0, 10 if line else 0, 0, 2)
        grid.addWidget(heading, line, 0, 1, 2)
        for offset, (keys, what) in enumerate(rows, start=1):
            grid.addWidget(_cell(keys, "shortcutKeys"), line + offset, 0)
            grid.addWidget(_cell(what, "shortcutText"), line + offset, 1)
        line += len(rows) + 1
    grid.setRowStretch(line, 1)
    return content


def _cell(text: str, name: str) -> Label:
    label = Label(text, name=name, wordWrap=True)
    label.setAlignment(Qt.AlignmentFlag.AlignTop)
    label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Minimum)
    return label


def _application() -> QApplication:
    application = QApplication.instance()
    assert isinstance(application, QApplication)
    return application
