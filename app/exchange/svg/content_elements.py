"""Texts and pictures in their frames as elements of SVG, y negated."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np
from msgspec.structs import replace

from ...document.content import WHOLE, Content, Lettering, Picture, RunPaint, TextRun
from ...document.contents import Plane, plane_of
from ...document.model import Vector
from ...document.style import NO_PAINT, Style
from ..cubics_in import lines
from ..drawing.outlines import Outline
from . import flowed
from .clips import clip_of_box
from .escapes import escaped, quoted
from .line_roles import ROLE, line_height, lines_with_empty, place_and_height
from .numbers import number
from .text_path_elements import on_path

_NOISE = 1e-13


def content_element(content: Content, plane: Plane, said: str, path: str = "") -> str:
    """Return a text or a picture that lies so; `said` are attributes of it, each after a blank.

    A text may lie along the `path` of an id, or fill the rectangle of one.
    Pictures refer to their files by XLink: Inkscape shows no others.
    """
    if isinstance(content, Lettering):
        return _text(content, plane, said, path)
    if content.link and not content.data:
        return _linked(content, plane, said)
    return _picture(content, _matrix(plane), said)


def refers(content: Content) -> bool:
    """Whether a text or a picture refers to something by XLink: a path, or what it shows."""
    return content.along is not None if isinstance(content, Lettering) else True


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


def _text(text: Lettering, plane: Plane, said: str, path: str) -> str:
    # What its first letters are in is said once.
    first = replace(text.lines[0].runs[0], words="", right=0.0, down=0.0, raised=0.0, paint=None)
    font = replace(first, **common_lines(text))
    # Its size always: what nobody says is 16 in a browser, and 12 in Inkscape.
    looks = "".join(f" {each}" for each in _font(font, TextRun("", size=0.0)))
    if path and text.flow is None:
        anchored = _anchored(text.lines[0].anchor.value)
        words = on_path(text, path, lambda run: _run(run, font))
        return f'<text{said}{anchored}{_matrix(plane)} xml:space="preserve"{looks}>{words}</text>'
    height = line_height(text)
    lines = lines_of(text, font, height)
    if text.flow is not None:
        place, declared = flowed.place_of(text), flowed.declarations(text, path)
    else:
        place, declared = ({}, {}) if height is None else place_and_height(text, height)
    said += "".join(f' {name}="{value}"' for name, value in place.items())
    said = flowed.with_style(said, declared) if declared else said
    return f'<text{said}{_matrix(plane)} xml:space="preserve"{looks}>{lines}</text>'


def common_lines(text: Lettering) -> dict[str, bool]:
    """Return which lines all letters of a text are decorated by: nothing within can take them away."""
    runs = [run for line in text.lines for run in line.runs if run.words]
    return {name: all(getattr(run, name) for run in runs) for name in ("underline", "strike")}


def decoration(run: TextRun) -> str:
    """Return the value of the property that decorates letters."""
    lines = ["underline"] * run.underline + ["line-through"] * run.strike
    return " ".join(lines) or "none"


def lines_of(text: Lettering, font: TextRun, height: float | None = None) -> str:
    """Return the lines of a text as spans, within what is in a font; with a height as lines of Inkscape's."""
    if text.flow is not None:
        return flowed.flowed_lines(text, lambda run, ways: _run(run, font, ways))
    role = "" if height is None else f' {ROLE}="line"'
    return "".join(
        f'<tspan{role} x="{number(line.x)}" y="{number(line.y)}"{_anchored(line.anchor.value)}>'
        + "".join(_run(run, font) for run in line.runs)
        + "</tspan>"
        for line in (text.lines if height is None else lines_with_empty(text, height))
    )


def _anchored(anchor: str) -> str:
    return "" if anchor == "start" else f' text-anchor="{anchor}"'


def _run(run: TextRun, font: TextRun, ways: Sequence[float] = ()) -> str:
    """Return a run within what is in a font; its letters may be moved by ways of their own."""
    across = " ".join(map(number, ways or [run.right]))
    said = [f'dx="{across}"'] if run.right or any(ways) else []
    said += [f'dy="{number(run.down)}"'] if run.down else []
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
    if run.word_spacing != around.word_spacing:
        yield f'word-spacing="{number(run.word_spacing)}"'
    if (run.underline, run.strike) != (around.underline, around.strike):
        yield f'text-decoration="{decoration(run)}"'
    if run.raised != around.raised:
        # A length: what “super” and per cent are of is one thing to Inkscape, and another to librsvg.
        yield f'baseline-shift="{number(run.raised)}"'


def _paint(paint: RunPaint) -> Iterator[str]:
    yield f'fill="{paint.fill}"'
    yield f'fill-opacity="{paint.fill_opacity:g}"'
    yield f'stroke="{paint.stroke}"'
    if paint.stroke != NO_PAINT:
        yield f'stroke-width="{number(paint.width)}" stroke-opacity="{paint.stroke_opacity:g}"'
