"""Writes `fonts/blocks.ttf`, a font of few letters whose outlines are known to the last digit.

Needs fontTools, which comes with matplotlib. Its em is 1000 units; a line is 1200 high.
"""

from pathlib import Path

from fontTools.fontBuilder import FontBuilder
from fontTools.pens.ttGlyphPen import TTGlyphPen

ADVANCES = {".notdef": 500, "space": 300, "I": 400, "o": 600, "f": 300, "i": 300, "f_i": 550}


def rectangle(pen, left, bottom, right, top):
    """Draw a rectangle, clockwise as the outer contours of such fonts go."""
    pen.moveTo((left, bottom))
    for corner in ((left, top), (right, top), (right, bottom)):
        pen.lineTo(corner)
    pen.closePath()


def ring(pen, radius, turn):
    """Draw a round contour about (300, 250), two parabolas for each quarter turn, 1 counterclockwise."""
    corners = [(1.0, 0.41), (0.41, 1.0), (-0.41, 1.0), (-1.0, 0.41)]
    corners += [(-x, -y) for x, y in corners]
    places = [(300 + round(radius * x), 250 + round(radius * y)) for x, y in corners[::turn]]
    # None: no point of the contour is given, all are halfway between the control points.
    pen.qCurveTo(*places, None)
    pen.closePath()


def drawn(name):
    """Return the outline of a glyph."""
    pen = TTGlyphPen(None)
    if name == ".notdef":
        rectangle(pen, 50, 0, 450, 700)
    if name == "I":
        rectangle(pen, 100, 0, 300, 700)
    if name == "o":
        ring(pen, 250, -1)
        ring(pen, 150, 1)
    if name in ("f", "f_i"):
        rectangle(pen, 50, 0, 150, 700)
    if name in ("i", "f_i"):
        right = 250 if name == "f_i" else 0
        rectangle(pen, 100 + right, 0, 200 + right, 500)
        rectangle(pen, 100 + right, 600, 200 + right, 700)
    return pen.glyph()


def main():
    """Write the font."""
    font = FontBuilder(1000, isTTF=True)
    font.setupGlyphOrder(list(ADVANCES))
    font.setupCharacterMap({32: "space", **{ord(each): each for each in "Iofi"}})
    glyphs = {name: drawn(name) for name in ADVANCES}
    font.setupGlyf(glyphs)
    lefts = {name: getattr(font.font["glyf"][name], "xMin", 0) for name in ADVANCES}
    font.setupHorizontalMetrics({name: (width, lefts[name]) for name, width in ADVANCES.items()})
    font.setupHorizontalHeader(ascent=900, descent=-300)
    font.setupNameTable({"familyName": "Curvebench Blocks", "styleName": "Regular"})
    font.setupOS2(sTypoAscender=900, sTypoDescender=-300, usWinAscent=900, usWinDescent=300)
    font.setupPost()
    font.addOpenTypeFeatures("feature kern { pos I o -100; } kern; feature liga { sub f i by f_i; } liga;")
    font.save(Path(__file__).parent / "fonts" / "blocks.ttf")


if __name__ == "__main__":
    main()
