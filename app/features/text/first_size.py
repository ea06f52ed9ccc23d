"""The size of the first text of a document."""

from __future__ import annotations

from ...document.page import Page
from ...document.transforms import clean_step_within
from ...plotting.pixel_map import PixelMap

_SHARE, _SHARE_OF_PAGE, _MOST_OF_PAGE = 1 / 8, 1 / 30, 1 / 6
"""Of the height of the view, and of the page."""

_READABLE = 50
"""Pixels that it has at most, and two fifths of them at least, where the page has room for them."""


def first_size(shown: PixelMap, page: Page | None) -> float:
    """Return a clean number for a text that is read here, and on paper."""
    _, bottom, _, top = shown.box
    most = (top - bottom) * _SHARE
    if page is not None:
        readable = _READABLE * (top - bottom) / shown.height
        most = min(most, max(page.height * _SHARE_OF_PAGE, readable), page.height * _MOST_OF_PAGE)
    return clean_step_within(most)
