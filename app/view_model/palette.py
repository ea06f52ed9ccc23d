"""The colours of papers, of curves on them and of points by index, without Qt: for screen and pictures."""

from __future__ import annotations

from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from curvecore.arrays import FloatArray

PAPER: Final = {"light": "#fafafa", "dark": "#15181c"}
INK: Final = {"light": "#1f2328", "dark": "#e6e8ea"}
ACCENT: Final = {"light": "#2563d9", "dark": "#6ea8fe"}
"""Paper, ink and accent of each theme."""

LEAST_CONTRAST: Final = 3.0
"""Least contrast of a curve against its paper: WCAG 2.1, success criterion 1.4.11, for graphics."""

OKABE_ITO: Final = {
    # On light paper five of the seven are too pale. Lightness alone is moved, by hand and search,
    # so that colours stay apart for red-, green- and blue-blind eyes too (tests/gui/test_theme.py).
    "light": ("#006097", "#c35500", "#00835f", "#b2618e", "#c08404", "#3798cb", "#554f00"),
    # Words are written in these colours too: on dark paper the published blue is too dark for them, and
    # beside a lighter one green has to be darker.
    "dark": ("#1491dd", "#d55e00", "#13936c", "#cc79a7", "#e69f00", "#56b4e9", "#f0e442"),
    "published": ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#f0e442"),
}
"""Blue, vermillion, bluish green, reddish purple, orange, sky blue, yellow; ink stands for black.

Okabe & Ito, "Color Universal Design" (2008).
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

_RGB_TO_LMS: Final = np.linalg.inv(_LMS_TO_RGB)
_LMS_TO_LAB: Final = np.linalg.inv(_LAB_TO_LMS)
_HALVINGS: Final = 10
"""Halvings of the range of lightness: then it is known to a quarter of a step of eight bits."""

_CHROMA: Final = np.linspace(1.0, 0.0, 129)[:, None]
"""Shares of a colour's chroma that are tried, the largest first."""


def contrast(one: str, other: str) -> float:
    """Return the contrast ratio of two colours "#rrggbb", 1 to 21, as WCAG 2.1 defines it."""
    dark, light = sorted((_luminance(one), _luminance(other)))
    return (light + 0.05) / (dark + 0.05)


def colour_on(paper: str | None, code: str) -> str:
    """Return the colour in which a colour is drawn on a paper, all "#rrggbb".

    Parameters
    ----------
    paper : str or None
        None where the paper is unknown, as in a picture without background.
    code : str
        The colour as set.

    Returns
    -------
    str
        `code` itself where it has a contrast of `LEAST_CONTRAST`, or on no paper; else the nearest colour of
        the same hue, darker on light paper and lighter on dark paper, that has it.
    """
    if paper is None or contrast(code, paper) >= LEAST_CONTRAST:
        return code
    return _moved_off(paper, code)


def adjustment_of(paper: str | None, code: str) -> str:
    """Return words about the difference of a colour drawn on a paper; empty without one."""
    if not code or paper is None or (drawn := colour_on(paper, code)) == code:
        return ""
    how = "darker" if _luminance(drawn) < _luminance(code) else "lighter"
    return f"drawn {how} than {code} for contrast with this paper"


@lru_cache(maxsize=4096)
def _moved_off(paper: str, code: str) -> str:
    """Return a colour with its lightness moved away from that of a paper, just enough for the contrast.

    The hue stays; chroma shrinks where sRGB has no colour so light or dark.
    """
    lightness, a, b = (np.cbrt(_linear(code) @ _RGB_TO_LMS.T) @ _LMS_TO_LAB.T).tolist()
    far = 0.0 if contrast("#000000", paper) >= contrast("#ffffff", paper) else 1.0
    near, result = lightness, "#000000" if far == 0.0 else "#ffffff"
    for _ in range(_HALVINGS):
        middle = (near + far) / 2
        moved = _within_srgb(middle, a, b)
        if contrast(moved, paper) >= LEAST_CONTRAST:
            far, result = middle, moved
        else:
            near = middle
    return result


def _within_srgb(lightness: float, a: float, b: float) -> str:
    """Return the colour of a lightness and hue in OKLab with as much of its chroma as sRGB has."""
    lab = np.hstack([np.full_like(_CHROMA, lightness), _CHROMA * (a, b)])
    rgb = _rgb(lab)
    slack = 1e-4  # of the matrices, which are rounded: far below a step of eight bits
    fits = np.all((rgb >= -slack) & (rgb <= 1.0 + slack), axis=1)
    (code,) = _packed(rgb[[int(np.argmax(fits)) if fits.any() else -1]])
    return f"#{code & 0xFFFFFF:06x}"


def _rgb(lab: FloatArray) -> FloatArray:
    """Return colours (k, 3) of OKLab in linear light."""
    return np.asarray((lab @ _LAB_TO_LMS.T) ** 3 @ _LMS_TO_RGB.T)


def _linear(code: str) -> FloatArray:
    """Return red, green and blue of "#rrggbb" in linear light, (3,), each in [0, 1]."""
    srgb = np.array([channel / 255.0 for channel in bytes.fromhex(code[1:])])
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


@lru_cache(maxsize=4096)
def _luminance(code: str) -> float:
    """Return the relative luminance of "#rrggbb", 0 to 1."""
    return float(_linear(code) @ (0.2126, 0.7152, 0.0722))


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
    return _packed(_rgb(lab))


def _packed(linear: FloatArray) -> NDArray[np.int64]:
    """Return colours (k, 3) in linear light as packed sRGB, 0xffRRGGBB, clipped to the range."""
    rgb = np.clip(linear, 0.0, 1.0)
    srgb = np.where(rgb <= 0.0031308, 12.92 * rgb, 1.055 * rgb ** (1.0 / 2.4) - 0.055)
    red, green, blue = np.rint(255.0 * srgb).astype(np.int64).T
    code: NDArray[np.int64] = (0xFF << 24) | (red << 16) | (green << 8) | blue
    return code
