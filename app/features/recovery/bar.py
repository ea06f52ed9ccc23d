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
from PySide6.QtWidgets import QFrame, QHBoxLayout, QPushButton, QScrollArea, QWidget

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
from ...qt.labels import Label, tip_of
from ...storage.files import printable_path
from ...storage.recovery import Snapshot, SnapshotOrigin
from ...tasks.progress import silent
from ...widgets.boxes import column_of, row_of
from ...widgets.controls import push_button, tool_button
from ...widgets.elided_label import ElidedLabel
from ...widgets.frames import OverlayFrame
from ...workbench.document_files import NEW_NAME

_WIDEST, _SIDE, _BELOW = 640, 40, 44
_PICTURE = (88, 56)
_AROUND_TEXT = 26


class RecoveryBar(OverlayFrame):
    """Lies over the lower part of its parent and takes no room from it; work goes on behind it.

    Signals
    -------
    restore_asked, discard_asked, later_asked
        The person has decided about the offer with this index.
    closed
        Everything that is still there is to be decided later.
    """

    restore_asked = Signal(int)
    discard_asked = Signal(int)
    later_asked = Signal(int)
    closed = Signal()

    def __init__(self, parent: QWidget) -> None:
        super().__init__("recoveryBar", parent)
        self.setAccessibleName("Unsaved work")
        self._offers: tuple[UnsavedWork, ...] = ()
        self._pictures: list[Label] = []
        self._title = Label(name="recoveryTitle", wordWrap=True)
        self._note = Label(name="recoveryNote", wordWrap=True)
        tip = "Decide later; the next start asks again"
        self._close = tool_button("closeRecovery", "Decide later", tip, flat=True)
        self._close.clicked.connect(self.closed)
        self._rows = QScrollArea()
        self._rows.setObjectName("recoveryRows")
        self._rows.setFrameShape(QFrame.Shape.NoFrame)
        self._rows.setWidgetResizable(True)
        self._rows.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        words = column_of(self._title, self._note, margins=(0, 4, 0, 0))
        head = row_of((words, 1), (self._close, Qt.AlignmentFlag.AlignTop))
        column_of(head, self._rows, margins=(14, 6, 8, 12), spacing=8, parent=self)
        self.follow_theme()

    def render(self, offers: Sequence[UnsavedWork], note: str = "") -> None:  # type: ignore[override]
        """Show `offers`, and above them `note`; hide where there is neither.

        The name is that of every panel; QWidget's own `render`, which paints into a device, is not used.
        """
        self._offers = tuple(offers)
        number = "A document" if len(offers) == 1 else count_of(len(offers), "document")
        self._title.setText(f"{number} with unsaved work from last time:")
        self._title.setVisible(bool(offers))
        self._note.setText(note)
        self._note.setVisible(bool(note))
        self._build_rows()
        self.setVisible(bool(offers or note))
        if offers or note:
            self.place()
            self.raise_()

    @property
    def text(self) -> str:
        """The sentences at the top; empty while the panel is hidden."""
        shown = [label.text() for label in (self._title, self._note) if not label.isHidden()]
        return "" if self.isHidden() else "\n".join(shown)

    def _build_rows(self) -> None:
        content = QWidget()
        self._pictures.clear()
        rows = [self._row(index, offer) for index, offer in enumerate(self._offers)]
        column_of(*rows, 1, margins=(0, 0, 6, 0), spacing=8, parent=content)
        self._paint_pictures()
        self._rows.setWidget(content)
        content.setAutoFillBackground(False)
        self._rows.viewport().setAutoFillBackground(False)
        self._rows.setVisible(bool(self._offers))

    def _row(self, index: int, offer: UnsavedWork) -> QHBoxLayout:
        picture = Label(name=f"recoveryPicture{index}", label=f"Picture of {offer.name}")
        self._pictures.append(picture)
        picture.setFixedSize(*_PICTURE)
        name, details = ElidedLabel(), ElidedLabel()
        name.setText(offer.name)
        font = name.font()
        font.setBold(True)
        name.setFont(font)
        details.setText(offer.details)
        details.setObjectName("recoveryTold")
        name.setToolTip(tip_of(offer.tip or offer.name))
        words = column_of(1, name, details, 1, spacing=2)
        return row_of(picture, (words, 1), *self._buttons(index, offer.name), spacing=10)

    def _buttons(self, index: int, name: str) -> Iterator[QPushButton]:
        for key, text, tip, asked in (
            ("restoreWork", "Restore", f"Open the unsaved work on {name}", self.restore_asked),
            ("discardWork", "Discard", f"Delete the unsaved work on {name} for good", self.discard_asked),
            ("laterWork", "Later", f"Keep the unsaved work on {name} for the next start", self.later_asked),
        ):
            button = push_button(f"{key}{index}", text, tip_of(tip), tip)
            button.setFixedWidth(button.fontMetrics().horizontalAdvance(text) + _AROUND_TEXT)
            button.clicked.connect(lambda _checked=False, asked=asked: asked.emit(index))
            yield button

    def place(self) -> None:
        """Lie at the bottom, in the middle; half of the parent stays free, the rows scroll."""
        below = self.below
        width = min(below.width() - 2 * _SIDE, _WIDEST)
        content = self._rows.widget()
        wanted = content.sizeHint().height() if self._offers and content is not None else 0
        self._rows.setFixedHeight(min(wanted, max(below.height() // 2, _PICTURE[1])))
        height = max(self.heightForWidth(width), self.minimumSizeHint().height())
        top = max(below.height() - height - _BELOW, 0)
        self.setGeometry((below.width() - width) // 2, top, width, height)

    def take_focus(self) -> None:
        """Put the keyboard's focus on the first button."""
        button = self.findChild(QPushButton, "restoreWork0") or self._close
        button.setFocus(Qt.FocusReason.ShortcutFocusReason)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape:
            self.closed.emit()
            return
        super().keyPressEvent(event)

    def set_theme(self, theme: Theme) -> None:
        self._close.setIcon(icon("close", theme))
        self.set_sheet(
            "#recoveryTitle { font-weight: bold }"
            f"#recoveryNote {{ color: {theme.warning.name()} }}"
            f"#recoveryTold {{ color: {theme.muted.name()} }}"
        )
        self._paint_pictures()

    def _paint_pictures(self) -> None:
        ratio = self.devicePixelRatioF()
        for picture, offer in zip(self._pictures, self._offers, strict=True):
            image = thumbnail(offer.document, *_PICTURE, self.theme, ratio)
            picture.setPixmap(QPixmap.fromImage(image))


# Unsaved work in words

_MINUTE, _HOUR, _DAY = 60.0, 3600.0, 86400.0


class UnsavedWork(msgspec.Struct, frozen=True):
    """Unsaved work as the panel shows it.

    Attributes
    ----------
    name
        What the document is called.
    details
        When it was kept, and what there is to know.
    tip
        Where its file is; empty where it has none.
    document
        The work itself, for the picture.
    """

    name: str
    details: str
    tip: str
    document: Document


def unsaved_work_of(snapshots: Sequence[Snapshot]) -> list[UnsavedWork]:
    """Return how the snapshots are shown; those of one name are numbered."""
    offers = [_unsaved_work(each) for each in snapshots]
    places = {name: {each.tip for each in offers if each.name == name} for name in {o.name for o in offers}}
    # Files of one name in several folders …
    offers = [
        replace(each, name=os.path.join(*Path(each.tip).parts[-2:]))  # noqa: PTH118 - as it is written
        if each.tip and len(places[each.name]) > 1
        else each
        for each in offers
    ]
    # … and several windows of one file.
    total, seen = Counter((each.name, each.tip) for each in offers), Counter[tuple[str, str]]()
    for index, (offer, snapshot) in enumerate(zip(offers, snapshots, strict=True)):
        key = (offer.name, offer.tip)
        seen[key] += 1
        if total[key] > 1:
            name = f"{offer.name} ({seen[key]} of {total[key]})"
            offers[index] = replace(offer, name=name, details=f"{_contents(snapshot)} · {offer.details}")
    return offers


def _contents(snapshot: Snapshot) -> str:
    """Return when it was kept, to the second, and how much it holds."""
    curves = snapshot.document.curves
    points = count_of(sum(len(each.points) for each in curves), "point")
    moment = time.strftime("%H:%M:%S", time.localtime(snapshot.written))
    return f"{moment} · {shape_count_label(curves)}, {points}"


def _unsaved_work(snapshot: Snapshot) -> UnsavedWork:
    document, origin, file = snapshot.document, snapshot.origin, snapshot.origin.path
    words = [age_in_words(time.time() - snapshot.written)]
    if file is None:
        words.append("never saved")
    elif not file.exists():
        words.append("file gone")
    elif not origin.is_unchanged:
        words.append("file changed since")
    first = document.curves[0].name
    untitled = origin.title or ("Untitled sketch" if first == NEW_NAME else first)
    name = printable_path(file.name) if file is not None else untitled
    return UnsavedWork(name, " · ".join(words), printable_path(file) if file is not None else "", document)


def damaged_note(damaged: tuple[Path, ...]) -> str:
    """Return what to say of backups that cannot be read."""
    if not damaged:
        return ""
    if len(damaged) == 1:
        return f"⚠ A damaged backup cannot be read; it was set aside as {printable_path(damaged[0].name)}."
    folder = printable_path(damaged[0].parent)
    return f"⚠ {len(damaged)} damaged backups cannot be read; they were set aside in {folder}."


def restored_message(origin: SnapshotOrigin, *, is_unchanged: bool) -> str:
    """Return what to say of work that was restored, by the file it came from."""
    if origin.path is None:
        return "Restored; it has no file yet."
    name = printable_path(origin.path.name)
    if is_unchanged:
        return f"Restored; {name} does not hold these changes until you save."
    if not origin.path.exists():
        return f"{name} is gone; your work was restored as a new document."
    return f"{name} has changed since; your work was restored as a new document."


def age_in_words(seconds: float) -> str:
    """Return how long ago something was, as people say it; of more than a month the date."""
    if seconds < 45:  # also where the clock was set back
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
"""Pixels of a line, at least: a finer one is to scale, but nobody sees it."""

_MARGIN = 3.0

_MOST_NODES = 200
"""Of a larger document every so manieth point is joined by straight lines: its curves would take too long."""


def thumbnail(document: Document, width: int, height: int, theme: Theme, ratio: float = 1.0) -> QImage:
    """Return a picture of `width` × `height` pixels of a window with this device pixel ratio.

    Where nothing can be drawn it is empty paper.
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
        pass  # a single point, for instance
    finally:
        painter.end()
    return image


def _paint_curves(painter: QPainter, drawing: Drawing, theme: Theme, size: tuple[int, int]) -> None:
    """Paint a drawing with lines as on the canvas, and points."""
    drawing = drawing.fitted(*size)
    usual = (replace(each, style=_with_line(each.style)) for each in drawing.outlines)
    ink = PictureStyle(theme.curve.name(), theme.paper.name(), theme.name)
    Painting(replace(drawing, outlines=tuple(usual)), painter, ink).paint(points=False, report=silent)
    painter.setPen(Qt.PenStyle.NoPen)
    for outline in drawing.outlines:
        painter.setBrush(QColor(ink.visible_colour(outline.colour)))
        for x, y in outline.points.tolist():
            painter.drawEllipse(QPointF(x, drawing.frame.height - y), _POINT_RADIUS, _POINT_RADIUS)


def _with_line(style: Style) -> Style:
    """Return a style whose line, if there is one, can be seen as small as this."""
    width = _LINE_WIDTH if style.width is None else style.width
    return replace(style, width=max(width, _LEAST) if width else 0.0)


def _paint_points(painter: QPainter, document: Document, frame: QRectF, theme: Theme) -> None:
    curves = [curve for curve in document.curves if curve.visible and curve.points]
    if not curves:
        return
    places = np.array([point.position for curve in curves for point in curve.points])
    low = places.min(axis=0)
    size = np.maximum(places.max(axis=0) - low, np.finfo(float).tiny)
    room = frame.adjusted(_MARGIN, _MARGIN, -_MARGIN, -_MARGIN)
    scale = min(room.width() / size[0], room.height() / size[1])
    corner = np.array([room.center().x(), room.center().y()]) - scale * size / 2
    for curve in curves:
        flat = (_thinned(curve, len(places)) - low) * scale
        flat[:, 1] = scale * size[1] - flat[:, 1]
        style = curve.style
        width = _LINE_WIDTH if style.width is None else max(style.width * scale, _LEAST)
        painter.setPen(QPen(QColor(style.colour) if style.colour else theme.curve, width))
        painter.drawPolyline([QPointF(x, y) for x, y in (flat + corner).tolist()])


def _thinned(curve: Curve, total: int) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    step = max(1, total // _MOST_NODES)
    points = [*curve.points[::step], curve.points[-1]]
    return np.array([point.position for point in points])
