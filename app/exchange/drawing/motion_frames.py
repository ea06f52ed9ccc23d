"""The frames of a motion, painted one by one; with `image` the only part of the exchange that needs Qt."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from msgspec.structs import replace
from PySide6.QtCore import QLineF, QPointF, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPen

from curvecore.arrays import FloatArray

from ...document.model import Document
from ...view_model.motion import (
    ACTIVE,
    TRAIL,
    Dot,
    Role,
    arrow_segments,
    colour_of,
    dots_at,
    round_duration,
    scales_of,
)
from ...view_model.motion_settings import Repeat
from ...view_model.palette import ACCENT, PAPER, colour_on
from .drawing import Drawing, drawing_of
from .film import Film
from .outlines import Frame
from .painting import Painting

_NOMINAL = 640.0
"""Longer side of a picture in which dots and lines have their nominal sizes."""

_REACH = 0.5
"""Largest growth of the frame for the sake of arrows, against its longer side."""

_LOOKED_AT = 100
"""Frames in which the arrows are looked at to find the room they need."""


class FrameMaker:
    """Paints the frames of a film, from values alone: it may do so in any thread of a running application.

    Attributes
    ----------
    width, height
        Size in pixels, both even: many video formats need that.
    """

    def __init__(self, document: Document, film: Film) -> None:
        self._film = film
        self._courses = film.courses(document)
        self._scales = scales_of(list(self._courses.values()))
        self._times = _times(film, self._courses[ACTIVE].duration)
        drawing = drawing_of(film.drawn(document))
        self._frame = self._with_room_for_arrows(drawing.frame)
        self.width = film.width // 2 * 2
        self.height = max(2, round(self.width * self._frame.height / self._frame.width) // 2 * 2)
        self._background = self._paint_background(replace(drawing, frame=self._frame))

    def _with_room_for_arrows(self, frame: Frame) -> Frame:
        some = self._times[:: max(1, len(self._times) // _LOOKED_AT)]
        tips = [arrow.tip for dots in map(self._dots, some) for dot in dots for arrow in dot.arrows]
        low, high = np.array([frame.left, frame.bottom]), np.array([frame.left + frame.width, frame.top])
        if tips:
            reach, margin = _REACH * frame.side, 0.03 * frame.side
            low = np.maximum(np.minimum(low, np.min(tips, axis=0) - margin), low - reach)
            high = np.minimum(np.maximum(high, np.max(tips, axis=0) + margin), high + reach)
        return Frame(*low.tolist(), *(high - low).tolist())

    def _dots(self, seconds: float) -> list[Dot]:
        return dots_at(self._courses, seconds, self._film.repeat, self._scales)

    def _paint_background(self, drawing: Drawing) -> QImage:
        image = QImage(self.width, self.height, QImage.Format.Format_RGBX8888)
        image.fill(QColor(self._paper))
        with QPainter(image) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            fitted = drawing.fitted(self.width, self.height)
            Painting(fitted, painter, self._film.style).paint(points=self._film.points)
        return image

    def frames(self) -> Iterator[bytes]:
        """Yield the pixels of each frame, four bytes each (red, green, blue, nothing), row by row."""
        for seconds in self._times.tolist():
            image = QImage(self._background)
            with QPainter(image) as painter:
                painter.setRenderHint(QPainter.RenderHint.Antialiasing)
                for dot in self._dots(seconds):
                    self._paint_trail(painter, dot)
                    self._paint_dot(painter, dot)
            yield bytes(image.constBits())

    @property
    def _scale(self) -> float:
        return max(self.width, self.height) / _NOMINAL

    @property
    def _paper(self) -> str:
        style = self._film.style
        return style.paper or PAPER[style.theme]

    def _colour(self, role: Role) -> QColor:
        """Return the colour of a dot and its trail, the same as on a screen with this paper."""
        accent = ACCENT[self._film.style.theme]
        return QColor(colour_on(self._paper, role.colour) if role.colour else accent)

    def _pixels(self, points: FloatArray) -> FloatArray:
        frame = self._frame
        with np.errstate(all="ignore"):
            shares = (points - (frame.left, frame.bottom)) / (frame.width, frame.height)
            return np.clip(shares * (self.width, -self.height) + (0, self.height), -1e5, 1e5)

    def _paint_trail(self, painter: QPainter, dot: Dot) -> None:
        colour = self._colour(dot.role)
        painter.setPen(Qt.PenStyle.NoPen)
        radius = 3.2 * self._scale
        for age, (x, y) in enumerate(self._pixels(dot.trail).tolist()):
            colour.setAlphaF(0.65 * (1.0 - age / TRAIL))
            painter.setBrush(colour)
            painter.drawEllipse(QPointF(x, y), radius, radius)

    def _paint_dot(self, painter: QPainter, dot: Dot) -> None:
        (position,) = self._pixels(np.array([dot.position])).tolist()
        for arrow in dot.arrows:
            (tip,) = self._pixels(np.array([arrow.tip])).tolist()
            painter.setPen(QPen(QColor(colour_on(self._paper, colour_of(dot, arrow))), 2.0 * self._scale))
            for segment in arrow_segments(tuple(position), tuple(tip), 9.0 * self._scale).tolist():
                painter.drawLine(QLineF(*segment))
        if len(self._courses) > 1 and dot.role is ACTIVE:
            return
        painter.setPen(QPen(QColor(self._paper), 1.5 * self._scale))
        painter.setBrush(self._colour(dot.role))
        radius = dot.role.radius * self._scale
        painter.drawEllipse(QPointF(*position), radius, radius)


def _times(film: Film, duration: float) -> FloatArray:
    """Return when the frames are, in seconds of the motion; the last and the first are one step apart."""
    if film.repeat is Repeat.ONCE:
        return np.linspace(0.0, duration, film.frames)
    whole = round_duration(duration, film.repeat)
    # The second round, where the trail crosses the seam, so that the film loops without a jump.
    return np.asarray(whole + np.arange(film.frames) * (whole / film.frames))
