"""Layouts written as one expression: rows, columns and forms of widgets."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TypeVar

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QBoxLayout, QFormLayout, QGridLayout, QHBoxLayout, QLayout, QVBoxLayout, QWidget

from ..qt.labels import Label

Part = QWidget | QLayout | str | int | tuple[QWidget | QLayout, int | Qt.AlignmentFlag]
"""A widget, a layout, a text for a label, or a stretch; or a widget or layout with its stretch or side."""

Margins = int | tuple[int, int, int, int] | None
"""Left, top, right and bottom, or one number for all; None keeps those of the style."""

_Box = TypeVar("_Box", bound=QBoxLayout)


def remove_widgets(layout: QLayout, widgets: Iterable[QWidget]) -> None:
    """Remove widgets from a layout at once; they are deleted when control returns to the event loop."""
    for widget in widgets:
        layout.removeWidget(widget)
        widget.hide()
        widget.deleteLater()


def row_of(
    *parts: Part, margins: Margins = None, spacing: int | None = None, parent: QWidget | None = None
) -> QHBoxLayout:
    """Return a layout with these parts side by side; it is set on `parent`, if given."""
    return _filled(QHBoxLayout(), parts, margins, spacing, parent)


def column_of(
    *parts: Part, margins: Margins = None, spacing: int | None = None, parent: QWidget | None = None
) -> QVBoxLayout:
    """Return a layout with these parts below each other; it is set on `parent`, if given."""
    return _filled(QVBoxLayout(), parts, margins, spacing, parent)


def form_of(
    *rows: tuple[str, QWidget | QLayout],
    margins: Margins = None,
    across: int = 12,
    down: int = 8,
    parent: QWidget | None = None,
) -> QFormLayout:
    """Return a layout with a label at the left of each part."""
    layout = QFormLayout(parent)
    _set_margins(layout, margins)
    layout.setHorizontalSpacing(across)
    layout.setVerticalSpacing(down)
    for label, part in rows:
        layout.addRow(label, part)
    return layout


def grid_of(
    across: int = -1,
    down: int = -1,
    *,
    stretched: Iterable[int] = (),
    margins: Margins = None,
    parent: QWidget | None = None,
) -> QGridLayout:
    """Return an empty grid with `stretched` columns; spacings of -1 are those of the style."""
    layout = QGridLayout(parent)
    _set_margins(layout, margins)
    layout.setHorizontalSpacing(across)
    layout.setVerticalSpacing(down)
    for column in stretched:
        layout.setColumnStretch(column, 1)
    return layout


def in_columns(widgets: Sequence[QWidget], count: int, across: int = -1) -> QWidget:
    """Return a widget that holds others row by row, in `count` columns."""
    holder = QWidget()
    grid = grid_of(across, margins=0, parent=holder)
    for index, widget in enumerate(widgets):
        grid.addWidget(widget, index // count, index % count)
    return holder


def _filled(
    box: _Box, parts: Iterable[Part], margins: Margins, spacing: int | None, parent: QWidget | None
) -> _Box:
    if parent is not None:
        parent.setLayout(box)
    _set_margins(box, margins)
    if spacing is not None:
        box.setSpacing(spacing)
    for part in parts:
        if isinstance(part, int):
            box.addStretch(part)
        elif isinstance(part, tuple):
            _add(box, *part)
        else:
            _add(box, Label(part) if isinstance(part, str) else part, 0)
    return box


def _add(box: QBoxLayout, part: QWidget | QLayout, stretch_or_side: int | Qt.AlignmentFlag) -> None:
    if isinstance(part, QLayout):
        box.addLayout(part, stretch_or_side if isinstance(stretch_or_side, int) else 0)
    elif isinstance(stretch_or_side, Qt.AlignmentFlag):
        box.addWidget(part, 0, stretch_or_side)
    else:
        box.addWidget(part, stretch_or_side)


def _set_margins(layout: QLayout, margins: Margins) -> None:
    if isinstance(margins, int):
        layout.setContentsMargins(margins, margins, margins, margins)
    elif margins is not None:
        layout.setContentsMargins(*margins)
