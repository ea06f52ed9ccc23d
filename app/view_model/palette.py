"""The colours of points by index, without Qt: for the screen and for pictures."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

OKABE_ITO: Final = {
    # On light paper five of the seven are too pale. Lightness alone is moved, by hand and search,
    # so that colours stay apart for red-, green- and blue-blind eyes too (tests/gui/test_theme.py).
    "light": ("#006097", "#c35500", "#00835f", "#b2618e", "#c08404", "#3798cb", "#554f00"),
    "dark": ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#f0e442"),
}
"""Blue, vermillion, bluish green, reddish purple, orange, sky blue, yellow; ink stands for black.

Okabe & Ito, "Color Universal Design" (2008); the dark theme has them as published.
"""

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


def point_palette(n: int, theme: str, ink: str) -> list[str]:
    """Return one colour, "#rrggbb", for each of `n` points on the paper of a theme, "light" or "dark".

    Up to eight points have the Okabe–Ito colours and the ink; more run through an even ramp of hues whose
    lightness alternates.
    """
    few = [*OKABE_ITO[theme], ink]
    return few[:n] if n <= len(few) else [f"#{code & 0xFFFFFF:06x}" for code in _ramp(n, theme).tolist()]


def _ramp(n: int, theme: str) -> NDArray[np.int64]:
    """Return ``n`` packed colours 0xffRRGGBB from violet-blue over green to magenta, n >= 2."""
    # At this lightness and chroma every hue is legible, and within sRGB to a rounding.
    middle, chroma = (0.74, 0.115) if theme == "dark" else (0.59, 0.105)
    hue = np.radians(np.linspace(265.0, -20.0, n))
    lightness = middle + np.where(np.arange(n) % 2 == 0, -0.03, 0.03)
    lab = np.stack([lightness, chroma * np.cos(hue), chroma * np.sin(hue)], axis=-1)
    rgb = np.clip((lab @ _LAB_TO_LMS.T) ** 3 @ _LMS_TO_RGB.T, 0.0, 1.0)
    srgb = np.where(rgb <= 0.0031308, 12.92 * rgb, 1.055 * rgb ** (1.0 / 2.4) - 0.055)
    red, green, blue = np.rint(255.0 * srgb).astype(np.int64).T
    code: NDArray[np.int64] = (0xFF << 24) | (red << 16) | (green << 8) | blue
    return code
