"""Recovery bar over the canvas: unsaved work from the last run, with a picture, a name, and buttons.

`RecoveryBar` shows `UnsavedWork` records; `unsaved_work_of` makes them from snapshots, `thumbnail` paints
them.
"""

from __future__ import annotations

import os
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

import msgspec
import numpy as np
from msgspec.structs import replace
from PySide6.QtCore import QDateTime, QLocale, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QColor, QImage, QKeyEvent, QPainter, QPen, QPixmap
from PySide6.QtWidgets import QHBoxLayout, QPushButton, QScrollArea, QWidget

from ...appearance.icons import icon
from ...appearance.theme import Theme
from ...document.groups import shape_count_label
from ...document.model import Curve, Document
from ...document.style import Style
from ...document.words import count_of
from ...exchange.drawing.drawing import Drawing, drawing_of
from ...exchange.drawing.painting import Painting
from ...exchange.drawing.styles import PictureStyle
from ...exchange.errors import ExchangeError
from ...qt.labels import MUTED, WARNING, Label, tip_of
from ...storage.files import printable_path
from ...storage.recovery import Snapshot, SnapshotOrigin
from ...tasks.progress import silent
from ...widgets.boxes import column_of, row_of
from ...widgets.controls import push_button, tool_button
from ...widgets.elided_label import ElidedLabel
from ...widgets.frames import OverlayFrame, scroll_vertically
from ...workbench.document_files import NEW_NAME

_USUAL, _SIDE, _BELOW = 640, 40, 44
_AROUND_ROWS = 24
_PICTURE = (57, 36)
_MOST_COVERED = 1 / 4
"""Largest share of the canvas that the bar covers; more scrolls."""

_AROUND_TEXT = 26


class RecoveryBar(OverlayFrame):
    """Bar over the lower part of the canvas; editing continues behind it.

    Signals
    -------
    restore_asked, discard_asked, later_asked
        The person has decided about the unsaved work with this index.
    closed
        All remaining decisions are postponed.
    """

    restore_asked = Signal(int)
    discard_asked = Signal(int)
    later_asked = Signal(int)
    closed = Signal()

    def __init__(self, parent: QWidget) -> None:
        super().__init__("recoveryBar", parent)
        self.setAccessibleName("Unsaved work")
        self._unsaved: tuple[UnsavedWork, ...] = ()
        self._pictures: list[Label] = []
        self._title = ElidedLabel("recoveryTitle")
        self._note: Label | None = None
        tip = "Decide later: the next start asks again"
        self._close = tool_button("closeRecovery", "Decide later", tip, flat=True)
        self._close.clicked.connect(self.closed)
        self._rows = scroll_vertically(QScrollArea(), "recoveryRows")
        head = row_of((self._title, 1), (self._close, Qt.AlignmentFlag.AlignTop))
        column_of(head, self._rows, margins=(14, 4, 8, 8), spacing=2, parent=self)
        self.follow_theme()

    def render(self, unsaved: Sequence[UnsavedWork], note: str = "") -> None:  # type: ignore[override]
        """Show unsaved work and a note above it; hide the bar if there is neither.

        Every panel has a method of this name; QWidget's own `render` is not used.
        """
        self._unsaved = tuple(unsaved)
        number = "A document" if len(unsaved) == 1 else count_of(len(unsaved), "document")
        self._title.setText(f"{number} with unsaved work from the last session:")
        self._title.setVisible(bool(unsaved))
        scroll = self._rows.verticalScrollBar().value()
        focused = next((i for i, button in enumerate(self._row_buttons) if button.hasFocus()), None)
        self._build_rows(note)
        self.setVisible(bool(unsaved or note))
        if unsaved or note:
            self.place()
            self.raise_()
            self._rows.verticalScrollBar().setValue(scroll)
        if focused is not None and unsaved:
            # The same button of the row that is now there, or of the last one.
            self._row_buttons[min(focused, 3 * len(unsaved) - 3 + focused % 3)].setFocus()

    @property
    def text(self) -> str:
        """The title and the note; empty while the bar is hidden."""
        texts = [label.text() for label in (self._title, self._note) if label and not label.isHidden()]
        return "" if self.isHidden() else "\n".join(texts)

    @property
    def _row_buttons(self) -> list[QPushButton]:
        """The buttons of the rows, three in each."""
        return self._rows.findChildren(QPushButton)

    def _build_rows(self, note: str) -> None:
        content = QWidget()
        self._pictures.clear()
        self._note = Label(note, name="recoveryNote", wordWrap=True, role=WARNING) if note else None
        notes = [self._note] if self._note is not None else []
        rows = [self._row(index, work) for index, work in enumerate(self._unsaved)]
        column_of(*notes, *rows, 1, margins=(0, 0, 6, 0), spacing=4, parent=content)
        self._paint_pictures()
        self._rows.setWidget(content)
        content.setAutoFillBackground(False)
        self._rows.viewport().setAutoFillBackground(False)

    def _row(self, index: int, work: UnsavedWork) -> QHBoxLayout:
        picture = Label(name=f"recoveryPicture{index}", label=f"Picture of {work.name}")
        self._pictures.append(picture)
        picture.setFixedSize(*_PICTURE)
        name, details = ElidedLabel(), ElidedLabel("recoveryTold", role=MUTED)
        name.setText(work.name)
        font = name.font()
        font.setBold(True)
        name.setFont(font)
        details.setText(work.details)
        name.setToolTip(tip_of(work.tip or work.name))
        words = column_of(1, name, details, 1, spacing=0)
        return row_of(picture, (words, 1), *self._buttons(index, work.name), spacing=10)

    def _buttons(self, index: int, name: str) -> Iterator[QPushButton]:
        for key, text, tip, asked in (
            ("restoreWork", "Restore", f"Open the unsaved work on {name}", self.restore_asked),
            ("discardWork", "Discard", f"Discard the unsaved work on {name}", self.discard_asked),
            ("laterWork", "Later", f"Keep the unsaved work on {name} for the next start", self.later_asked),
        ):
            button = push_button(f"{key}{index}", text, tip_of(tip), tip)
            button.setFixedWidth(button.fontMetrics().horizontalAdvance(text) + _AROUND_TEXT)
            button.clicked.connect(lambda _checked=False, asked=asked: asked.emit(index))
            yield button

    def place(self) -> None:
        """Move to the bottom, centred; at most a quarter of the canvas is covered, and rows scroll."""
        below, content = self.below, self._rows.widget()
        if content is None:
            return
        wanted = content.sizeHint().width() + self._rows.verticalScrollBar().sizeHint().width() + _AROUND_ROWS
        width = min(below.width() - 2 * _SIDE, max(_USUAL, wanted))
        rows = max(content.heightForWidth(width), content.sizeHint().height())
        self._rows.setFixedHeight(rows)
        most = int(_MOST_COVERED * below.width() * below.height() / max(width, 1))
        height = max(self.heightForWidth(width), self.minimumSizeHint().height())
        least = max(_PICTURE[1], 2 * self.fontMetrics().height())
        scrolled = max(min(height - most, rows - least), 0)
        self._rows.setFixedHeight(rows - scrolled)
        top = max(below.height() - height + scrolled - _BELOW, 0)
        self.setGeometry((below.width() - width) // 2, top, width, height - scrolled)

    def take_focus(self) -> None:
        """Focus the first button."""
        button = self.findChild(QPushButton, "restoreWork0") or self._close
        button.setFocus(Qt.FocusReason.ShortcutFocusReason)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape:
            self.closed.emit()
            return
        super().keyPressEvent(event)

    def set_theme(self, theme: Theme) -> None:
        self._close.setIcon(icon("close", theme))
        self.set_sheet("#recoveryTitle { font-weight: bold }")
        self._paint_pictures()

    def _paint_pictures(self) -> None:
        ratio = self.devicePixelRatioF()
        for picture, work in zip(self._pictures, self._unsaved, strict=True):
            image = thumbnail(work.document, *_PICTURE, self.theme, ratio)
            picture.setPixmap(QPixmap.fromImage(image))


# Unsaved work in words

_MINUTE, _HOUR, _DAY = 60.0, 3600.0, 86400.0


class UnsavedWork(msgspec.Struct, frozen=True):
    """Unsaved work in a row of the bar.

    Attributes
    ----------
    name
        Name of the document.
    details
        Age of the snapshot, and the state of the file.
    tip
        Path of the file; empty for a document that was never saved.
    document
        The document, for the picture.
    """

    name: str
    details: str
    tip: str
    document: Document


def unsaved_work_of(snapshots: Sequence[Snapshot]) -> list[UnsavedWork]:
    """Return the unsaved work in snapshots; entries of one name are distinguished."""
    rows = [_unsaved_work(snapshot) for snapshot in snapshots]
    tips = {name: {row.tip for row in rows if row.name == name} for name in {row.name for row in rows}}
    # Files of one name in several folders …
    rows = [
        replace(row, name=os.path.join(*Path(row.tip).parts[-2:]))  # noqa: PTH118 - as it is written
        if row.tip and len(tips[row.name]) > 1
        else row
        for row in rows
    ]
    # … and several windows of one file.
    total, counts = Counter((row.name, row.tip) for row in rows), Counter[tuple[str, str]]()
    for index, (row, snapshot) in enumerate(zip(rows, snapshots, strict=True)):
        key = (row.name, row.tip)
        counts[key] += 1
        if total[key] > 1:
            name = f"{row.name} ({counts[key]} of {total[key]})"
            rows[index] = replace(row, name=name, details=f"{_contents(snapshot)} · {row.details}")
    return rows


def _contents(snapshot: Snapshot) -> str:
    """Return the time of a snapshot to the second, and its size."""
    curves = snapshot.document.curves
    points = count_of(sum(len(curve.points) for curve in curves), "point")
    moment = time.strftime("%H:%M:%S", time.localtime(snapshot.written))
    return f"{moment} · {shape_count_label(curves)}, {points}"


def _unsaved_work(snapshot: Snapshot) -> UnsavedWork:
    document, origin, file = snapshot.document, snapshot.origin, snapshot.origin.path
    words = [age_in_words(time.time() - snapshot.written)]
    if file is None:
        words.append("never saved")
    elif not file.exists():
        words.append("file missing")
    elif not origin.is_unchanged:
        words.append("file changed since")
    first = document.curves[0].name
    untitled = origin.title or ("Untitled sketch" if first == NEW_NAME else first)
    name = printable_path(file.name) if file is not None else untitled
    return UnsavedWork(name, " · ".join(words), printable_path(file) if file is not None else "", document)


def damaged_note(damaged: tuple[Path, ...]) -> str:
    """Return the note about damaged snapshots."""
    if not damaged:
        return ""
    if len(damaged) == 1:
        return f"⚠ A damaged backup cannot be read. It was renamed to {printable_path(damaged[0].name)}."
    folder = printable_path(damaged[0].parent)
    return f"⚠ {len(damaged)} damaged backups cannot be read. They were kept in {folder}."


def restored_message(origin: SnapshotOrigin, *, is_unchanged: bool) -> str:
    """Return the message about restored work, which depends on its file."""
    if origin.path is None:
        return "Restored. The document has no file yet."
    name = printable_path(origin.path.name)
    if is_unchanged:
        return f"Restored. Save to write the changes to {name}."
    if not origin.path.exists():
        return f"{name} no longer exists. Your work was restored as a new document."
    return f"{name} has changed since then. Your work was restored as a new document."


def age_in_words(seconds: float) -> str:
    """Return an age in words, "3 minutes ago"; the date if it is more than a month."""
    if seconds < 45:  # or negative, if the clock was set back
        return "a moment ago"
    if seconds > 30 * _DAY:
        then = QDateTime.fromSecsSinceEpoch(round(time.time() - seconds))
        return "on " + QLocale().toString(then.date(), QLocale.FormatType.ShortFormat)
    for unit, name, one in (
        (_DAY, "day", "a day"),
        (_HOUR, "hour", "an hour"),
        (_MINUTE, "minute", "a minute"),
    ):
        if seconds >= 0.75 * unit:
            number = max(round(seconds / unit), 1)
            return f"{one} ago" if number == 1 else f"{number} {name}s ago"
    return "a moment ago"


# Thumbnail

_LINE_WIDTH, _POINT_RADIUS = 1.5, 2.0

_LEAST = 0.3
"""Least width of a line in pixels: a finer line to scale would be invisible."""

_MARGIN = 3.0

_MOST_NODES = 200
"""Largest number of points whose curves are drawn; larger documents are drawn as polylines of some points."""


def thumbnail(document: Document, width: int, height: int, theme: Theme, ratio: float = 1.0) -> QImage:
    """Return a picture of a document with `width` × `height` logical pixels.

    If nothing can be drawn, it is empty paper.
    """
    image = QImage(round(width * ratio), round(height * ratio), QImage.Format.Format_ARGB32_Premultiplied)
    image.setDevicePixelRatio(ratio)
    image.fill(theme.paper)
    painter = QPainter(image)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    try:
        if sum(len(curve.points) for curve in document.curves) <= _MOST_NODES:
            _paint_curves(painter, drawing_of(document), theme, (width, height))
        else:
            _paint_points(painter, document, QRectF(0, 0, width, height), theme)
    except ExchangeError:
        pass  # a document with a single point, for instance
    finally:
        painter.end()
    return image


def _paint_curves(painter: QPainter, drawing: Drawing, theme: Theme, size: tuple[int, int]) -> None:
    """Paint the curves of a drawing as on the canvas, and their points."""
    drawing = drawing.fitted(*size)
    visible = (replace(outline, style=_with_line(outline.style)) for outline in drawing.outlines)
    ink = PictureStyle(theme.curve.name(), theme.paper.name(), theme.name)
    Painting(replace(drawing, outlines=tuple(visible)), painter, ink).paint(points=False, report=silent)
    painter.setPen(Qt.PenStyle.NoPen)
    for outline in drawing.outlines:
        painter.setBrush(QColor(ink.visible_colour(outline.colour)))
        for x, y in outline.points.tolist():
            painter.drawEllipse(QPointF(x, drawing.frame.height - y), _POINT_RADIUS, _POINT_RADIUS)


def _with_line(style: Style) -> Style:
    """Return a style whose line, if there is one, is visible in the picture."""
    width = _LINE_WIDTH if style.width is None else style.width
    return replace(style, width=max(width, _LEAST) if width else 0.0)


def _paint_points(painter: QPainter, document: Document, frame: QRectF, theme: Theme) -> None:
    curves = [curve for curve in document.curves if curve.visible and curve.points]
    if not curves:
        return
    positions = np.array([point.position for curve in curves for point in curve.points])
    low = positions.min(axis=0)
    size = np.maximum(positions.max(axis=0) - low, np.finfo(float).tiny)
    room = frame.adjusted(_MARGIN, _MARGIN, -_MARGIN, -_MARGIN)
    scale = min(room.width() / size[0], room.height() / size[1])
    corner = np.array([room.center().x(), room.center().y()]) - scale * size / 2
    for curve in curves:
        flat = (_thinned(curve, len(positions)) - low) * scale
        flat[:, 1] = scale * size[1] - flat[:, 1]
        style = curve.style
        width = _LINE_WIDTH if style.width is None else max(style.width * scale, _LEAST)
        painter.setPen(QPen(QColor(style.colour) if style.colour else theme.curve, width))
        painter.drawPolyline([QPointF(x, y) for x, y in (flat + corner).tolist()])


def _thinned(curve: Curve, total: int) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    step = max(1, total // _MOST_NODES)
    points = [*curve.points[::step], curve.points[-1]]
    return np.array([point.position for point in points])
