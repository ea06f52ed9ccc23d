"""SVG files that Curvebench wrote: the parts of them that are no curves, and styles that are defaults."""

from __future__ import annotations

import xml.etree.ElementTree as ET

from msgspec.structs import replace

from ...document.style import INK, USUAL_WIDTH, Style
from ..drawing import styles
from .coordinates import box_of
from .xml_tree import tag_of

MARK = "Largest deviation from the true curves"
"""Words in the metadata of every picture."""

NO_CURVES = ("paper", "points", "grid", "handles", "basis")
"""Ids of the elements that are drawn beside the curves."""

_INKS = (styles.INK.ink, styles.DARK.ink)
_ROUNDING = 1e-9


class OwnFile:
    """Test for files that Curvebench wrote, and the parts of them that are no curves.

    Attributes
    ----------
    is_so
        Whether Curvebench wrote the file.
    has_nominal_size
        Whether the size of the file is only nominal.
    """

    def __init__(self, root: ET.Element) -> None:
        notes = ("".join(child.itertext()) for child in root if tag_of(child) == "metadata")
        self.is_own = any(MARK in note for note in notes)
        self.has_nominal_size = self.is_own and root.get("width", "")[-1:].isdigit()
        box = box_of(root.get("viewBox", ""))
        self._usual_width = USUAL_WIDTH * max(box[2:]) if box else 0.0

    def is_no_curve(self, element: ET.Element) -> bool:
        """Whether an element is the paper, or something else beside the curves."""
        return self.is_own and element.get("id") in NO_CURVES

    def restored(self, style: Style) -> Style:
        """Return a style with defaults in place of the ink and the line width of a picture."""
        if not self.is_own:
            return style
        stroke, fill = (INK if paint in _INKS else paint for paint in (style.stroke, style.fill))
        usual = self._usual_width
        is_usual = style.width is not None and abs(style.width - usual) <= _ROUNDING * usual
        return replace(style, stroke=stroke, fill=fill, width=None if is_usual else style.width)
