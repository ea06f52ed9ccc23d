"""The picture to trace: read from a file, drawn behind everything, dark on dark paper."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QImage, QImageReader, QPainter, QPen, QPixmap

from curvecore.arrays import FloatArray

from ..document.model import ReferenceImage, Vector
from ..plotting.layers import Layer
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget
from ..plotting.stamps import transparent
from ..storage.files import StorageError, read
from ..tools.pointer import Hit, Part
from ..tools.reference_image import CORNERS, corner_of

MAX_PIXELS = 64_000_000
"""Largest number of pixels that is decoded."""

MAX_SIDE = 4096
"""Larger pictures are scaled down when they are read: 64 MB at most stay in memory."""

_FORMATS = (b"png", b"jpeg", b"jpg")
_ALLOCATION_MB = 512
"""Room for `MAX_PIXELS` of eight bytes each, a PNG of 16 bits."""


class ImageFileError(ValueError):
    """Refusal of an image file; the message states the reason."""


def read_image(path: str) -> QImage:
    """Return the picture in a PNG or JPEG file, its longer side at most `MAX_SIDE` pixels.

    Raises
    ------
    ImageFileError
        If the file is missing, neither PNG nor JPEG, broken or too large.
    """
    try:
        data = read(path)
    except StorageError as problem:
        raise ImageFileError(str(problem)) from None
    name = f"“{Path(path).name}”"
    QImageReader.setAllocationLimit(_ALLOCATION_MB)
    buffer = QBuffer()
    buffer.setData(QByteArray(data))
    buffer.open(QIODevice.OpenModeFlag.ReadOnly)
    # The content decides on the format, not the name.
    kind = bytes(QImageReader.imageFormat(buffer).data())
    if kind not in _FORMATS:
        raise ImageFileError(f"{name} is not a PNG or JPEG image.")
    reader = QImageReader(buffer, QByteArray(kind))
    reader.setAutoTransform(True)
    return _read(reader, name)


def _read(reader: QImageReader, name: str) -> QImage:
    size = reader.size()
    if size.width() * size.height() > MAX_PIXELS:
        raise ImageFileError(
            f"{name} has {size.width()} × {size.height()} pixels; "
            f"the limit is {MAX_PIXELS // 1_000_000} million. Scale the image down first."
        )
    shrink = MAX_SIDE / max(size.width(), size.height(), 1)
    if shrink < 1:
        width, height = round(size.width() * shrink), round(size.height() * shrink)
        reader.setScaledSize(QSize(max(width, 1), max(height, 1)))
    image = reader.read()
    if image.isNull() or not image.width() or not image.height():
        raise ImageFileError(f"{name} is damaged and cannot be shown ({reader.errorString().rstrip('.')}).")
    return image.convertToFormat(QImage.Format.Format_ARGB32_Premultiplied)


_LIGHT, _DARK = 200, 60
"""Smallest lightness of paper and largest of ink in every colour channel, of 255."""

_SAMPLE = QSize(64, 64)


def is_page(image: QImage) -> bool:
    """Return whether a picture is a scan or drawing: mostly light, or light and dark with little between."""
    sample = image.scaled(
        image.size().boundedTo(_SAMPLE),
        Qt.AspectRatioMode.IgnoreAspectRatio,
        Qt.TransformationMode.SmoothTransformation,
    )
    sample = sample.convertToFormat(QImage.Format.Format_RGBA8888)
    pixels = _view(sample)
    solid = pixels[..., 3] > 0
    if not solid.any():
        return False
    paper = float((pixels[..., :3].min(axis=2)[solid] >= _LIGHT).mean())
    ink = float((pixels[..., :3].max(axis=2)[solid] <= _DARK).mean())
    return paper >= 0.5 or (paper >= 0.2 and paper + ink >= 0.9)


def inverted_lightness(image: QImage) -> QImage:
    """Return the picture with light for dark: c + 255 − (max + min) keeps hue and saturation (HSL)."""
    result = image.convertToFormat(QImage.Format.Format_RGBA8888)
    pixels = _view(result)
    colours = pixels[..., :3]
    turned = 255 - colours.max(axis=2, keepdims=True) - colours.min(axis=2, keepdims=True)
    colours += turned  # modulo 256, where the exact result lies from 0 to 255
    return result


def _view(image: QImage) -> np.ndarray[tuple[int, int, int], np.dtype[np.uint8]]:
    """Return the pixels of an image in RGBA8888, (height, width, 4); they live as long as the image."""
    rows = np.frombuffer(image.bits(), np.uint8).reshape(image.height(), image.bytesPerLine())
    return rows[:, : 4 * image.width()].reshape(image.height(), image.width(), 4)


GRIP_REACH = 12.0
"""Pixels from a corner within which it is grabbed."""

_GRIP = 5.0
_FAR = 1e6
_MARGIN = 4.0


class ImageLayer(Layer):
    """Layer of a picture; a dashed frame in its place if its file is missing."""

    z = -6.0
    is_still = True

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self._has_grips = False
        self._image: ReferenceImage | None = None
        self._pixels: QImage | None = None
        self._key: tuple[object, ...] = (None,) * 4
        self._visible_part: QPixmap | None = None
        self._levels: list[QImage] = []
        self._is_page: bool | None = None
        # A level, and its inverted version for dark paper.
        self._dark: tuple[QImage, QImage] | None = None
        self.set_visible(False)
        # The grips lie over curves and points: while visible, they get the mouse.
        self._grips = Layer(plot, self._paint_grips, z=20.0)
        self._grips.set_visible(False)

    def render(self, image: ReferenceImage | None, pixels: QImage | None) -> None:
        """Draw this picture from the next paint on."""
        if image is not self._image or pixels is not self._pixels:
            if pixels is not self._pixels:
                self._is_page = None
            self._image, self._pixels = image, pixels
            if pixels is None:
                self._visible_part, self._levels, self._dark = None, [], None
            self.set_visible(image is not None)
            self.update()
            self._grips.update()
            self._show_grips()

    def set_grips(self, visible: bool) -> None:
        """Show or hide the grips of the tool that moves the picture."""
        self._has_grips = visible
        self._show_grips()

    def _show_grips(self) -> None:
        self._grips.set_visible(self._has_grips and self._image is not None)

    @property
    def corners(self) -> FloatArray | None:
        """The lower left and the upper right corner of the picture, (2, 2); None without one."""
        image = self._image
        if image is None:
            return None
        corner, size = np.array([image.x, image.y]), np.array([image.width, image.height])
        return np.array([corner, corner + size])

    def hit(self, pixel: Vector, pixel_map: PixelMap) -> Hit | None:
        """Return the part of the picture under `pixel`: a corner or the inside."""
        image = self._image
        if image is None:
            return None
        for corner in range(len(CORNERS)):
            position = corner_of(image, corner)
            if math.dist(pixel_map.point(*position), pixel) <= GRIP_REACH:
                return Hit(Part.IMAGE_CORNER, -1, position, knot=corner)
        if _rect(image, pixel_map).contains(QPointF(*pixel)):
            return Hit(Part.IMAGE, -1, (image.x, image.y))
        return None

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Draw the picture, or a frame in its place."""
        image = self._image
        if image is None:
            return
        rect = _rect(image, pixel_map)
        if self._pixels is None:
            self._paint_frame(painter, rect)
            return
        key = (image, self._pixels, pixel_map, self.theme)
        if any(old is not new for old, new in zip(self._key, key, strict=True)):
            ratio = painter.device().devicePixelRatioF()
            level = self._for_paper(self._level_for(rect, ratio))
            self._visible_part = _visible_part(level, rect, pixel_map, ratio)
            self._key = key
        if self._visible_part is not None:
            painter.setOpacity(image.opacity)
            if self._is_inverted:
                # Screen mode draws the ink only: black, the inverted page, adds nothing to the paper.
                painter.setCompositionMode(QPainter.CompositionMode.CompositionMode_Screen)
            painter.drawPixmap(QPointF(0, 0), self._visible_part)
            painter.setCompositionMode(QPainter.CompositionMode.CompositionMode_SourceOver)
            painter.setOpacity(1)

    def _level_for(self, rect: QRectF, ratio: float) -> QImage:
        """Return the picture halved until it is less than twice as large as drawn: smoother and faster."""
        assert self._pixels is not None
        if not self._levels or self._levels[0] is not self._pixels:
            self._levels = [self._pixels]
        level = 0
        while self._levels[level].width() > 2 * ratio * rect.width() and self._levels[level].width() > 1:
            level += 1
            if level == len(self._levels):
                size = self._levels[-1].size() / 2
                self._levels.append(
                    self._levels[-1].scaled(
                        size.expandedTo(QSize(1, 1)),
                        Qt.AspectRatioMode.IgnoreAspectRatio,
                        Qt.TransformationMode.SmoothTransformation,
                    )
                )
        return self._levels[level]

    @property
    def _is_inverted(self) -> bool:
        return bool(self._is_page) and self.theme.paper.lightness() < 128

    def _for_paper(self, level: QImage) -> QImage:
        """Return a level as it is drawn: on dark paper, a page with light ink on black."""
        if self._is_page is None:
            self._is_page = is_page(level)
        if not self._is_inverted:
            return level
        if self._dark is None or self._dark[0] is not level:
            self._dark = (level, inverted_lightness(level))
        return self._dark[1]

    def _paint_frame(self, painter: QPainter, rect: QRectF) -> None:
        visible = rect.intersected(QRectF(-_FAR, -_FAR, 2 * _FAR, 2 * _FAR))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.setPen(QPen(self.theme.muted, 1, Qt.PenStyle.DashLine))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRect(visible)
        painter.drawText(visible, int(Qt.AlignmentFlag.AlignCenter), "Image not found")

    def _paint_grips(self, painter: QPainter, pixel_map: PixelMap) -> None:
        image = self._image
        if image is None:
            return
        rect = _rect(image, pixel_map).intersected(QRectF(-_FAR, -_FAR, 2 * _FAR, 2 * _FAR))
        painter.setPen(QPen(self.theme.accent, 1.5))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRect(rect)
        painter.setBrush(self.theme.paper)
        for corner in range(len(CORNERS)):
            x, y = pixel_map.point(*corner_of(image, corner))
            if max(abs(x), abs(y)) < _FAR:
                painter.drawRect(QRectF(x - _GRIP, y - _GRIP, 2 * _GRIP, 2 * _GRIP))


def _rect(image: ReferenceImage, pixel_map: PixelMap) -> QRectF:
    """Return the rectangle of the picture in pixels."""
    left, top = pixel_map.point(image.x, image.y + image.height)
    return QRectF(left, top, image.width * pixel_map.sx, image.height * pixel_map.sy)


def _visible_part(pixels: QImage, rect: QRectF, pixel_map: PixelMap, ratio: float) -> QPixmap | None:
    """Return the visible part of the picture, scaled once and not at every paint."""
    area = QRectF(0, 0, pixel_map.width, pixel_map.height)
    visible = rect.intersected(area.adjusted(-_MARGIN, -_MARGIN, _MARGIN, _MARGIN))
    if visible.isEmpty() or rect.isEmpty():
        return None
    across, down = pixels.width() / rect.width(), pixels.height() / rect.height()
    source = QRectF(
        (visible.left() - rect.left()) * across,
        (visible.top() - rect.top()) * down,
        visible.width() * across,
        visible.height() * down,
    )
    result = transparent(pixel_map.width, pixel_map.height, ratio)
    painter = QPainter(result)
    painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, True)
    painter.drawImage(visible, pixels, source)
    painter.end()
    return result
