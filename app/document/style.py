"""Style of a curve: stroke and fill."""

from __future__ import annotations

from typing import Annotated, Final

from msgspec.structs import replace

from .fields import LENGTH, SHARE, Requirement, Value, at_least, at_most_items, matching
from .words import NamedEnum

INK: Final = ""
"""Paint of the default colour: that of the theme, or of an exported picture."""

NO_PAINT: Final = "none"
"""Paint of nothing."""

LARGEST_DASHES: Final = 64
"""Largest number of dashes and gaps of a style."""

LEAST_DASH: Final = 1e-3
"""Length, in widths, that is drawn for a dash of length 0, which would have no direction."""

USUAL_WIDTH: Final = 0.003
"""Width of a line without a width of its own, relative to the longer side of the picture."""

_PAINT = matching("#[0-9a-f]{6}|none|", 'be written as "#rrggbb" in lower case, or "none"')
_DASHES = at_most_items(LARGEST_DASHES, f"hold at most {LARGEST_DASHES} numbers")
_HAS_DASH = Requirement(lambda dash: not dash or any(dash), "hold a number greater than 0", of_all=True)


class LineCap(NamedEnum):
    """Ends of strokes and of their dashes."""

    BUTT = "butt", "Butt"
    ROUND = "round", "Round"
    SQUARE = "square", "Square"


class LineJoin(NamedEnum):
    """Corners of strokes."""

    MITER = "miter", "Miter"
    ROUND = "round", "Round"
    BEVEL = "bevel", "Bevel"


class FillRule(NamedEnum):
    """Rule for the inside of curves that cross or enclose each other."""

    NONZERO = "nonzero", "Nonzero"
    EVENODD = "evenodd", "Even-odd"


class Style(Value, frozen=True):
    """Stroke and fill. A paint is `INK`, `NO_PAINT` or "#rrggbb"; opacities are from 0, invisible, to 1.

    Attributes
    ----------
    stroke, stroke_opacity
        Paint of the line.
    width
        Width of the line, in the unit of the document; None for the default width, the same at every zoom.
    cap, join, miter_limit
        Ends and corners of the line; longer miters than the limit times the width become bevels.
    dash, dash_offset
        Lengths of dashes and gaps in turn, and the start of the pattern, in multiples of the width.
    fill, fill_rule, fill_opacity
        Paint of the inside; an open curve is closed for it by a straight line.
    """

    stroke: Annotated[str, _PAINT, "Stroke colour"] = INK
    width: Annotated[float | None, at_least(0), LENGTH, "Stroke width"] = None
    cap: Annotated[LineCap, "Line ends"] = LineCap.ROUND
    join: Annotated[LineJoin, "Line corners"] = LineJoin.ROUND
    miter_limit: Annotated[float, at_least(1), "Miter limit"] = 4.0
    dash: Annotated[tuple[float, ...], _DASHES, at_least(0), _HAS_DASH, "Dashes"] = ()
    dash_offset: Annotated[float, "Start of the dashes"] = 0.0
    stroke_opacity: Annotated[float, SHARE, "Stroke opacity"] = 1.0
    fill: Annotated[str, _PAINT, "Fill"] = NO_PAINT
    fill_rule: Annotated[FillRule, "Fill rule"] = FillRule.NONZERO
    fill_opacity: Annotated[float, SHARE, "Fill opacity"] = 1.0

    @property
    def has_stroke(self) -> bool:
        """Whether the line is drawn."""
        return self.stroke != NO_PAINT

    @property
    def has_fill(self) -> bool:
        """Whether the inside is filled."""
        return self.fill != NO_PAINT

    @property
    def has_caps(self) -> bool:
        """Whether the ends of the line are drawn: a line of length 0 is a dot then."""
        return self.has_stroke and self.cap is not LineCap.BUTT

    @property
    def dashes_and_gaps(self) -> tuple[float, ...]:
        """The dashes as they are drawn: an odd number is repeated, with dashes and gaps exchanged."""
        return self.dash if len(self.dash) % 2 == 0 else self.dash * 2

    def in_colour(self, paint: str) -> Style:
        """Return the style with another colour of its line, or of its fill where it has no line."""
        is_inside = self.has_fill and not self.has_stroke
        return replace(self, **{"fill" if is_inside else "stroke": paint})

    @property
    def swapped(self) -> Style:
        """The style with the paints of fill and stroke exchanged."""
        return replace(
            self,
            stroke=self.fill,
            stroke_opacity=self.fill_opacity,
            fill=self.stroke,
            fill_opacity=self.stroke_opacity,
        )

    @property
    def colour(self) -> str:
        """The colour that represents the curve: that of its line, or of its fill where it has no line."""
        paint = self.stroke if self.has_stroke else self.fill
        return INK if paint == NO_PAINT else paint


PLAIN_STYLE: Final = Style()
"""Style of new curves: a line in the default colour."""
