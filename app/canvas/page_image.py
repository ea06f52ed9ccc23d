"""Pictures of pages on a dark canvas: paper turns dark and ink light, colours keep their hue.

A white page at half its strength is a grey slab on dark paper, on which neither its ink nor the curve stands
out. Photographs are left as they are.
"""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QImage

_LIGHT, _DARK = 200, 60
"""Paper is at least as light as that in all colours, ink at most as light as that (of 255)."""

_SAMPLE = QSize(64, 64)


def is_page(image: QImage) -> bool:
    """Tell whether a picture is mostly light, or light and dark with little between: a scan or a drawing."""
    few = image.scaled(
        image.size().boundedTo(_SAMPLE),
        Qt.AspectRatioMode.IgnoreAspectRatio,
        Qt.TransformationMode.SmoothTransformation,
    )
    few = few.convertToFormat(QImage.Format.Format_RGBA8888)
    pixels = _view(few)
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
