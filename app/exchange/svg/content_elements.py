"""Texts and pictures in their frames as elements of SVG, y negated."""

from __future__ import annotations

import math
from collections.abc import Iterator

from msgspec.structs import replace

from ...document.content import WHOLE, Content, Lettering, Picture, RunPaint, TextRun
from ...document.contents import Plane
from ...document.model import Vector
from ...document.style import NO_PAINT, Style
from .escapes import escaped, quoted
from .numbers import number


def content_element(content: Content, plane: Plane, said: str) -> str:
    """Return a text or a picture that lies so; `said` are attributes of it, each after a blank."""
    if isinstance(content, Lettering):
        return _text(content, plane, said)
    if content.link and not content.data:
        return _linked(content, plane, said)
    return _picture(content, _matrix(plane), said)


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
    values = (right, -up, other_right, -other_up, plane.x, -plane.y)
    if values == (1, 0, 0, 1, 0, 0):
        return ""
    return f' transform="matrix({" ".join(map(number, values))})"'


def _picture(picture: Picture, matrix: str, said: str) -> str:
    """Return a picture; one that is cut in a box of its own, which shows nothing beyond."""
    if picture.part != WHOLE:
        left, top, right, bottom = picture.part
        across, down = right - left, bottom - top
        box = " ".join(map(number, (left, top, across, down)))
        places = zip(("x", "y", "width", "height"), (left, top, across, down), strict=True)
        numbers = " ".join(f'{name}="{number(value)}"' for name, value in places)
        inner = _picture(replace(picture, part=WHOLE), "", "")
        return f'<g{said}{matrix}><svg {numbers} viewBox="{box}" overflow="hidden">{inner}</svg></g>'
    kind = "png" if picture.data.startswith("iVBOR") else "jpeg"
    return (
        f'<image{said}{matrix} width="1" height="1" preserveAspectRatio="none" '
        f'href="data:image/{kind};base64,{picture.data}"/>'
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
        f'href="{quoted(picture.link)}"/>'
    )


def _text(text: Lettering, plane: Plane, said: str) -> str:
    lines = "".join(
        f'<tspan x="{number(line.x)}" y="{number(line.y)}"{_anchored(line.anchor.value)}>'
        + "".join(map(_run, line.runs))
        + "</tspan>"
        for line in text.lines
    )
    return f'<text{said}{_matrix(plane)} xml:space="preserve">{lines}</text>'


def _anchored(anchor: str) -> str:
    return "" if anchor == "start" else f' text-anchor="{anchor}"'


def _run(run: TextRun) -> str:
    ways = {"dx": run.right, "dy": run.down}
    moved = "".join(f' {name}="{number(way)}"' for name, way in ways.items() if way)
    return f"<tspan{moved} {' '.join(_looks(run))}>{escaped(run.words)}</tspan>"


def _looks(run: TextRun) -> Iterator[str]:
    if run.font:
        families = ", ".join(f"'{each}'" if " " in each else each for each in run.font)
        yield f'font-family="{quoted(families)}"'
    yield f'font-size="{number(run.size)}"'
    yield f'font-weight="{run.weight:g}"'
    if run.italic:
        yield 'font-style="italic"'
    if run.spacing:
        yield f'letter-spacing="{number(run.spacing)}"'
    if run.paint is not None:
        yield from _paint(run.paint)


def _paint(paint: RunPaint) -> Iterator[str]:
    yield f'fill="{paint.fill}"'
    yield f'fill-opacity="{paint.fill_opacity:g}"'
    yield f'stroke="{paint.stroke}"'
    if paint.stroke != NO_PAINT:
        yield f'stroke-width="{number(paint.width)}" stroke-opacity="{paint.stroke_opacity:g}"'
