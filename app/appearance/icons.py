"""Icons in the colours of a theme, drawn when they are needed, in the needed size."""

from __future__ import annotations

import os
from functools import cache, cached_property
from pathlib import Path
from typing import Final

from PySide6.QtCore import QByteArray, QPoint, QRect, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QIcon, QIconEngine, QImage, QPainter, QPixmap
from PySide6.QtSvg import QSvgRenderer

from ..qt.overrides import SafeOverrides
from ..storage.resources import resource
from .theme import Theme, mix

_PIXELS: Final = (16, 20, 24, 32, 40, 48, 64, 80)
"""16, 20, 24, 32 and 40 px at device pixel ratios 1 and 2."""


@cache
def icon(name: str, theme: Theme) -> QIcon:
    """
    Return an icon of ``resources/icons`` in the colours of a theme.

    Ink as a rule, muted when disabled, the accent when checked.

    Parameters
    ----------
    name : str
        File name without ``.svg``.
    theme : Theme
        Theme in which it is shown.

    Returns
    -------
    QIcon
        Drawn at every size in use, never scaled. The same object for the same arguments.

    Raises
    ------
    FileNotFoundError
        If there is no such icon.
    """
    return QIcon(_IconEngine(_files().get(name) or str(resource("icons", f"{name}.svg")), theme))


@cache
def _files() -> dict[str, str]:
    """Return the files of all icons by their names: one listing is faster than hundreds of lookups."""
    return {path.name.removesuffix(".svg"): path.path for path in os.scandir(resource("icons"))}


class _IconEngine(SafeOverrides, QIconEngine):
    """Draws an icon when a size of it is first requested: most never are."""

    def __init__(self, path: str, theme: Theme) -> None:
        super().__init__()
        self._path, self._theme = path, theme
        self._pixmaps: dict[tuple[int, QIcon.Mode, QIcon.State], QPixmap] = {}

    @cached_property
    def _drawing(self) -> str:
        return Path(self._path).read_text(encoding="utf-8").replace("currentColor", self._theme.ink.name())

    def pixmap(self, size: QSize, mode: QIcon.Mode, state: QIcon.State) -> QPixmap:
        """Return the icon at a size in pixels of the device."""
        key = (min(size.width(), size.height()), mode, state)
        if key not in self._pixmaps:
            self._pixmaps[key] = QPixmap.fromImage(self._image(*key))
        return self._pixmaps[key]

    def _image(self, pixels: int, mode: QIcon.Mode, state: QIcon.State) -> QImage:
        shape = _render(self._drawing, max(pixels, 1))
        if mode is QIcon.Mode.Disabled:
            return _tinted(shape, mix(self._theme.muted, self._theme.surface, 0.5))
        return _tinted(shape, self._theme.accent) if state is QIcon.State.On else shape

    def paint(self, painter: QPainter, rect: QRect, mode: QIcon.Mode, state: QIcon.State) -> None:
        """Draw the icon in the middle of `rect`."""
        device = painter.device()
        ratio = device.devicePixelRatioF() if device is not None else 1.0
        side = min(rect.width(), rect.height())
        pixmap = QPixmap(self.pixmap(QSize(1, 1) * round(side * ratio), mode, state))
        pixmap.setDevicePixelRatio(ratio)
        corner = rect.center() - QPoint(side, side) / 2
        painter.drawPixmap(QRect(corner, QSize(side, side)), pixmap)

    def availableSizes(  # noqa: N802
        self, mode: QIcon.Mode = QIcon.Mode.Normal, state: QIcon.State = QIcon.State.Off
    ) -> list[QSize]:
        """Return the sizes in use; any other is drawn as well."""
        return [QSize(pixels, pixels) for pixels in _PIXELS]

    def actualSize(self, size: QSize, mode: QIcon.Mode, state: QIcon.State) -> QSize:  # noqa: N802
        """Return the square that fits."""
        side = min(size.width(), size.height())
        return QSize(side, side)

    def clone(self) -> QIconEngine:
        """Return another engine for the same drawing."""
        return _IconEngine(self._path, self._theme)


@cache
def app_icon() -> QIcon:
    """Return the icon of the program, in its own colours, for windows and the task bar."""
    result = QIcon()
    drawing = resource("icons", "app.svg").read_text(encoding="utf-8")
    for pixels in (*_PIXELS, 128, 256):
        result.addPixmap(QPixmap.fromImage(_render(drawing, pixels)))
    return result


def _render(drawing: str, pixels: int) -> QImage:
    image = QImage(pixels, pixels, QImage.Format.Format_ARGB32_Premultiplied)
    image.fill(Qt.GlobalColor.transparent)
    painter = QPainter(image)
    if pixels % 32 == 16:
        # The 1.5/24 wide lines are 1, 3 or 5 px here: centred on whole numbers they would blur.
        painter.translate(0.5, 0.5)
    QSvgRenderer(QByteArray(drawing.encode())).render(painter, QRectF(0, 0, pixels, pixels))
    painter.end()
    return image


def _tinted(image: QImage, colour: QColor) -> QImage:
    """Return the image with every pixel in one colour, its opacity kept."""
    result = QImage(image)
    painter = QPainter(result)
    painter.setCompositionMode(QPainter.CompositionMode.CompositionMode_SourceIn)
    painter.fillRect(result.rect(), colour)
    painter.end()
    return result
