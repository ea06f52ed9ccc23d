"""Texts and pictures of other programs, in front of the curves or behind them, from a sheet that is kept."""

from __future__ import annotations

from collections.abc import Sequence
from time import perf_counter

from PySide6.QtCore import QPointF, QRectF, QTimer
from PySide6.QtGui import QColor, QPainter, QTransform

from ..appearance.colours import curve_colour
from ..appearance.theme import Theme
from ..document.kept import KeptPicture, KeptText
from ..document.model import Vector
from ..plotting.layers import Layer
from ..plotting.pictures import Sheets, transparent
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget
from ..qt.kept import Inks, box_of, paint_kept

_SLOW = 0.008
"""Seconds above which the picture is not made anew for every step of a pan or a zoom."""

_REST_MS = 80

_LIGHT = 128
"""Lightness of paper that takes colours as they are."""


class KeptLayer(Layer):
    """Layer of what is shown, and moved as it is.

    While the view rests painting it is copying one picture, and while it moves the old picture is moved along
    where a new one takes long.
    """

    def __init__(self, plot: PlotWidget, *, z: float, behind: bool) -> None:
        super().__init__(plot, z=z)
        self._behind = behind
        self._texts: tuple[KeptText, ...] = ()
        self._pictures: tuple[KeptPicture, ...] = ()
        self._kept: Sheets | None = None
        self._seconds = 0.0
        self._is_resting = False
        self._rest = QTimer(plot, singleShot=True, interval=_REST_MS)
        self._rest.timeout.connect(self._make_anew)
        self.set_visible(False)

    def render(self, texts: Sequence[KeptText], pictures: Sequence[KeptPicture]) -> None:
        """Draw these from the next paint on."""
        own_texts = tuple(each for each in texts if each.behind is self._behind)
        own_pictures = tuple(each for each in pictures if each.behind is self._behind)
        if (own_texts, own_pictures) != (self._texts, self._pictures):
            self._texts, self._pictures, self._kept = own_texts, own_pictures, None
            self.set_visible(bool(own_texts or own_pictures))
            self.update()

    @property
    def box(self) -> QRectF:
        """The box in the plane that all of it takes, y upwards; an empty one without any."""
        found = QRectF()
        shown: tuple[KeptText | KeptPicture, ...] = (*self._texts, *self._pictures)
        for box in map(box_of, shown):
            found = found.united(box)
        return found

    def all_at(self, place: Vector) -> list[KeptText | KeptPicture]:
        """Return what lies at a place of the plane, the topmost first."""
        at = QPointF(*place)
        topmost: tuple[KeptText | KeptPicture, ...] = (*reversed(self._texts), *reversed(self._pictures))
        return [each for each in topmost if box_of(each).contains(at)]

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Draw the picture; it is made anew when another part of the plane is visible."""
        key, kept = (self.theme, painter.device().devicePixelRatioF()), self._kept
        if kept is None or kept.key != key:
            kept = self._made(shown, *key)
        elif kept.shown != shown:
            if self._seconds > _SLOW and not self._is_resting:
                self._rest.start()
                painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, True)
            else:
                kept = self._made(shown, *key)
        kept.draw(painter, shown, kept.sheets[0])

    def _made(self, shown: PixelMap, theme: Theme, ratio: float) -> Sheets:
        began = perf_counter()
        sheet = transparent(shown.width, shown.height, ratio)
        with QPainter(sheet) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            way = QTransform(shown.sx, 0, 0, -shown.sy, *shown.point(0.0, 0.0))
            paint_kept(painter, self._texts, self._pictures, way, self._inks(theme))
        self._kept = Sheets((sheet,), shown, (theme, ratio))
        self._seconds, self._is_resting = perf_counter() - began, False
        return self._kept

    def _inks(self, theme: Theme) -> Inks:
        """Return the colours: on dark paper what is written for light paper is seen, too."""
        is_light = theme.is_as_printed or theme.paper.lightness() >= _LIGHT
        return Inks(QColor if is_light else lambda code: curve_colour(code, theme), theme.muted)

    def _make_anew(self) -> None:
        self._is_resting = True
        self.update()
