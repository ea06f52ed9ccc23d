"""Texts and pictures in their frames as elements of SVG, y negated."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from msgspec.structs import replace

from ...document.content import WHOLE, Content, Lettering, Picture, RunPaint, TextRun
from ...document.contents import Plane, plane_of
from ...document.model import Vector
from ...document.style import NO_PAINT, Style
from ..cubics_in import lines
from ..drawing.outlines import Outline
from .clips import clip_of_box
from .escapes import escaped, quoted
from .numbers import number

_NOISE = 1e-13


def content_element(content: Content, plane: Plane, said: str) -> str:
    """Return a text or a picture that lies so; `said` are attributes of it, each after a blank.

    Pictures refer to their files by XLink: Inkscape shows no others.
    """
    if isinstance(content, Lettering):
        return _text(content, plane, said)
    if content.link and not content.data:
        return _linked(content, plane, said)
    return _picture(content, _matrix(plane), said)


def uncut(frame: Outline) -> Outline:
    """Return all of a picture of which a frame shows a part, cut by a clip; anything else as it is."""
    picture = frame.content
    if not isinstance(picture, Picture) or not picture.data or picture.part == WHOLE:
        return frame
    plane, (left, top, right, bottom) = plane_of(picture, frame.corners), picture.part
    places = [plane.place(*each) for each in ((0, 0), (1, 0), (1, 1), (0, 1), (0, 0))]
    style = frame.style
    if left > 0 or top > 0 or right < 1 or bottom < 1:
        (a, b), (c, d) = plane.across, plane.down
        matrix = np.array([[a, c, plane.x], [b, d, plane.y]])
        clip = clip_of_box((left, top, right - left, bottom - top), matrix)
        style = replace(style, clips=(*style.clips, clip))
    return replace(
        frame, control_points=lines(np.array(places)), style=style, content=replace(picture, part=WHOLE)
    )


def in_units_of(plane: Plane, style: Style) -> Style:
    """Return a style of the drawing as one in the units of what lies so, y turned up; without clips."""
    style = replace(style, clips=())
    if style.width is not None:
        style = replace(style, width=style.width / plane.scale)
    if not style.is_placed:
        return style
    (a, b), (c, d) = plane.across, plane.down
    area = a * d - b * c

    def there(place: Vector) -> Vector:
        x, y = place[0] - plane.x, place[1] - plane.y
        return (d * x - c * y) / area, -(a * y - b * x) / area

    return style.mapped(there)


def _matrix(plane: Plane) -> str:
    (right, up), (other_right, other_up) = plane.across, plane.down
    linear = _without_noise(right, -up, other_right, -other_up)
    values = (*linear, *_without_noise(plane.x, -plane.y))
    if values == (1, 0, 0, 1, 0, 0):
        return ""
    return f' transform="matrix({" ".join(map(number, values))})"'


def _without_noise(*values: float) -> tuple[float, ...]:
    """Return numbers that are next to each other without the digits that rounding left of the larger ones."""
    least = _NOISE * max(1.0, *map(abs, values))
    plain = [float(f"{each:.12g}") for each in values]
    return tuple(0.0 if abs(each) < least else each for each in plain)


def _picture(picture: Picture, matrix: str, said: str) -> str:
    """Return all of a picture that is in the file."""
    kind = "png" if picture.data.startswith("iVBOR") else "jpeg"
    return (
        f'<image{said}{matrix} width="1" height="1" preserveAspectRatio="none" '
        f'xlink:href="data:image/{kind};base64,{picture.data}"/>'
    )


def _linked(picture: Picture, plane: Plane, said: str) -> str:
    """Return a picture whose file lies elsewhere: its place, in units that are as long both ways."""
    left, top, right, bottom = picture.part
    (a, b), (c, d) = plane.across, plane.down
    width, height = math.hypot(a, b) * (right - left), math.hypot(c, d) * (bottom - top)
    across = (a * (right - left) / width, b * (right - left) / width)
    down = (c * (bottom - top) / height, d * (bottom - top) / height)
    own = Plane(plane.x + left * a + top * c, plane.y + left * b + top * d, across, down)
    ratio = ' preserveAspectRatio="none"' if picture.stretched else ""
    return (
        f'<image{said}{_matrix(own)} width="{number(width)}" height="{number(height)}"{ratio} '
        f'xlink:href="{quoted(picture.link)}"/>'
    )


def _text(text: Lettering, plane: Plane, said: str) -> str:
    # What its first letters are in is said once.
    font = replace(text.lines[0].runs[0], words="", right=0.0, down=0.0, paint=None)
    looks = "".join(f" {each}" for each in _font(font, TextRun("")))
    lines = lines_of(text, font)
    return f'<text{said}{_matrix(plane)} xml:space="preserve"{looks}>{lines}</text>'


def lines_of(text: Lettering, font: TextRun) -> str:
    """Return the lines of a text as spans, within what is in a font."""
    return "".join(
        f'<tspan x="{number(line.x)}" y="{number(line.y)}"{_anchored(line.anchor.value)}>'
        + "".join(_run(run, font) for run in line.runs)
        + "</tspan>"
        for line in text.lines
    )


def _anchored(anchor: str) -> str:
    return "" if anchor == "start" else f' text-anchor="{anchor}"'


def _run(run: TextRun, font: TextRun) -> str:
    ways = {"dx": run.right, "dy": run.down}
    said = [f'{name}="{number(way)}"' for name, way in ways.items() if way]
    said += _font(run, font)
    if run.paint is not None:
        said += _paint(run.paint)
    words = escaped(run.words)
    return f"<tspan {' '.join(said)}>{words}</tspan>" if said else words


def _font(run: TextRun, around: TextRun) -> Iterator[str]:
    """Yield attributes of the font of letters, where it is another one than around them."""
    if run.font != around.font:
        families = ", ".join(f"'{each}'" if " " in each else each for each in run.font)
        yield f'font-family="{quoted(families) or "sans-serif"}"'
    if run.size != around.size:
        yield f'font-size="{number(run.size)}"'
    if run.weight != around.weight:
        yield f'font-weight="{run.weight:g}"'
    if run.italic != around.italic:
        yield f'font-style="{"italic" if run.italic else "normal"}"'
    if run.spacing != around.spacing:
        yield f'letter-spacing="{number(run.spacing)}"'


def _paint(paint: RunPaint) -> Iterator[str]:
    yield f'fill="{paint.fill}"'
    yield f'fill-opacity="{paint.fill_opacity:g}"'
    yield f'stroke="{paint.stroke}"'
    if paint.stroke != NO_PAINT:
        yield f'stroke-width="{number(paint.width)}" stroke-opacity="{paint.stroke_opacity:g}"'
