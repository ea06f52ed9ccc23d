"""The colours of points and curves: apart for every eye, legible on either paper."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray
from PySide6.QtGui import QColor

from app.theme import Theme

_OKABE_ITO: Final = {
    # On light paper five of the seven are too pale. Lightness alone is moved, by hand and search,
    # so that colours stay apart for red-, green- and blue-blind eyes too (tests/gui/test_theme.py).
    "light": ("#006097", "#c35500", "#00835f", "#b2618e", "#c08404", "#3798cb", "#554f00"),
    "dark": ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#f0e442"),
}
"""Blue, vermillion, bluish green, reddish purple, orange, sky blue, yellow; ink stands for black.

Okabe & Ito, "Color Universal Design" (2008); the dark theme has them as published.
"""

CURVE_COLOURS: Final = {
    "Ink": "",
    "Blue": "#0072b2",
    "Vermillion": "#d55e00",
    "Bluish green": "#009e73",
    "Reddish purple": "#cc79a7",
    "Orange": "#e69f00",
    "Sky blue": "#56b4e9",
    "Yellow": "#f0e442",
}
"""The colours a curve can have, as a document writes them; the ink is that of the theme."""


def curve_colour(code: str, theme: Theme) -> QColor:
    """Return the colour of a curve in this theme: the Okabe–Ito colours are darker on light paper."""
    published = _OKABE_ITO["dark"]
    if code in published:
        return QColor(_OKABE_ITO[theme.name][published.index(code)])
    return QColor(code) if code else QColor(theme.curve)


# OKLab to cone responses (cube roots), and those to linear RGB:
# B. Ottosson, "A perceptual color space for image processing" (2020).
_LAB_TO_LMS: Final = np.array(
    [
        [1.0, 0.3963377774, 0.2158037573],
        [1.0, -0.1055613458, -0.0638541728],
        [1.0, -0.0894841775, -1.2914855480],
    ]
)
_LMS_TO_RGB: Final = np.array(
    [
        [4.0767416621, -3.3077115913, 0.2309699292],
        [-1.2684380046, 2.6097574011, -0.3413193965],
        [-0.0041960863, -0.7034186147, 1.7076147010],
    ]
)


def point_colours(n: int, theme: Theme) -> list[QColor]:
    """
    Return one colour for each of ``n`` points, all legible on the theme's paper.

    Up to eight points have the Okabe–Ito colours, darker on light paper; the eighth is the ink.
    More points run through an even ramp of hues whose lightness alternates, so that neighbours
    can be told apart however many there are.

    Parameters
    ----------
    n : int
        How many, 0 or more.
    theme : Theme
        Where they will be drawn.

    Returns
    -------
    list of QColor
        The colours by point index.
    """
    few = [*_OKABE_ITO[theme.name], theme.ink.name()]
    if n <= len(few):
        return [QColor(name) for name in few[:n]]
    return [QColor(code) for code in _ramp(n, theme).tolist()]


def _ramp(n: int, theme: Theme) -> NDArray[np.int64]:
    """Return ``n`` packed colours 0xffRRGGBB from violet-blue over green to magenta, n >= 2."""
    # At this lightness and chroma every hue is legible, and within sRGB to a rounding.
    middle, chroma = (0.74, 0.115) if theme.name == "dark" else (0.59, 0.105)
    hue = np.radians(np.linspace(265.0, -20.0, n))
    lightness = middle + np.where(np.arange(n) % 2 == 0, -0.03, 0.03)
    lab = np.stack([lightness, chroma * np.cos(hue), chroma * np.sin(hue)], axis=-1)
    rgb = np.clip((lab @ _LAB_TO_LMS.T) ** 3 @ _LMS_TO_RGB.T, 0.0, 1.0)
    srgb = np.where(rgb <= 0.0031308, 12.92 * rgb, 1.055 * rgb ** (1.0 / 2.4) - 0.055)
    red, green, blue = np.rint(255.0 * srgb).astype(np.int64).T
    code: NDArray[np.int64] = (0xFF << 24) | (red << 16) | (green << 8) | blue
    return code
