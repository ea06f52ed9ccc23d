"""The shapes that an action means."""

from __future__ import annotations

from typing import Final

import numpy as np
from PySide6.QtCore import QPoint

from ...actions.needs import Need
from ...canvas.canvas import Canvas
from ...document.selection import with_points
from ...document.shapes import is_of_several, whole_shapes
from ...session import Session

AN_OBJECT: Final = Need("a curve", lambda now: bool(meant(now.session)) and not now.is_blank)

A_SHAPE: Final = Need(
    "a shape",
    lambda now: bool(with_points(now.session.document.curves, meant(now.session))) and not now.is_blank,
)

SEVERAL_SHAPES: Final = Need(
    "two chosen shapes or more", lambda now: is_of_several(now.session.document, meant(now.session))
)

_BESIDE = 6
"""Pixels between a field and the shapes."""


def meant(session: Session) -> frozenset[int]:
    """Return the chosen curves, or the one that is edited, with all others of their shapes."""
    return whole_shapes(session.document, session.selected.marked)


def beside_meant(session: Session, canvas: Canvas) -> QPoint:
    """Return where a field stands on the canvas: beside those curves."""
    views = [session.views[place] for place in sorted(meant(session))]
    boxes = [view.drawn_box for view in views if view.has_curve]
    if not boxes:
        return QPoint(_BESIDE, _BESIDE)
    right, top = np.max([box[1] for box in boxes], axis=0)
    return canvas.to_pixel(float(right), float(top)) + QPoint(_BESIDE, 0)
