"""Texts and pictures of other programs as elements of SVG, y negated."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import replace

from ...document.kept import WHOLE, KeptPicture, KeptRun, KeptText
from ...document.style import NO_PAINT
from ..drawing.drawing import Drawing
from .clip_elements import ClipElements
from .numbers import number
from .tree import escaped, quoted


def kept_elements(drawing: Drawing, clips: ClipElements, *, behind: bool) -> list[str]:
    """Return what a drawing shows beside curves, in front of them or behind them; pictures that are in it."""
    pictures = [each for each in drawing.kept_pictures if each.behind is behind and each.data]
    texts = [each for each in drawing.kept_texts if each.behind is behind]
    elements = [(_picture(each), each.clips) for each in pictures]
    elements += [(_text(each), each.clips) for each in texts]
    return [f"  {clips.around(*each)}" for each in elements]


def _matrix(kept: KeptText | KeptPicture) -> str:
    (right, up), (other_right, other_up) = kept.across, kept.down
    values = (right, -up, other_right, -other_up, kept.x, -kept.y)
    return f'transform="matrix({" ".join(map(number, values))})"'


def _picture(picture: KeptPicture) -> str:
    """Return a picture; one that is cut in a box of its own, which shows nothing beyond."""
    if picture.part != WHOLE:
        left, top, right, bottom = picture.part
        across, down = right - left, bottom - top
        box = " ".join(map(number, (left, top, across, down)))
        places = zip(("x", "y", "width", "height"), (left, top, across, down), strict=True)
        said = " ".join(f'{name}="{number(value)}"' for name, value in places)
        inner = _picture(replace(picture, part=WHOLE, x=0.0, y=0.0, across=(1.0, 0.0), down=(0.0, -1.0)))
        return f'<g {_matrix(picture)}><svg {said} viewBox="{box}" overflow="hidden">{inner}</svg></g>'
    kind = "png" if picture.data.startswith("iVBOR") else "jpeg"
    opacity = f' opacity="{picture.opacity:g}"' if picture.opacity < 1 else ""
    return (
        f'<image {_matrix(picture)} width="1" height="1" preserveAspectRatio="none"{opacity} '
        f'href="data:image/{kind};base64,{picture.data}"/>'
    )


def _text(text: KeptText) -> str:
    runs = "".join(
        f"<tspan{_moved(run)} {' '.join(_looks(run))}>{escaped(run.words)}</tspan>" for run in text.runs
    )
    anchor = f' text-anchor="{text.anchor.value}"'
    return f'<text {_matrix(text)} x="0" y="0"{anchor} xml:space="preserve">{runs}</text>'


def _moved(run: KeptRun) -> str:
    ways = {"dx": run.right, "dy": run.down}
    return "".join(f' {name}="{number(way)}"' for name, way in ways.items() if way)


def _looks(run: KeptRun) -> Iterator[str]:
    if run.font:
        families = ", ".join(f"'{each}'" if " " in each else each for each in run.font)
        yield f'font-family="{quoted(families)}"'
    yield f'font-size="{number(run.size)}"'
    yield f'font-weight="{run.weight:g}"'
    if run.italic:
        yield 'font-style="italic"'
    if run.spacing:
        yield f'letter-spacing="{number(run.spacing)}"'
    yield f'fill="{run.fill}"'
    if run.fill_opacity < 1:
        yield f'fill-opacity="{run.fill_opacity:g}"'
    if run.stroke != NO_PAINT:
        yield f'stroke="{run.stroke}" stroke-width="{number(run.width)}"'
        yield f'stroke-opacity="{run.stroke_opacity:g}"'
