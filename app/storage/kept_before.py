"""Texts and pictures as files of version 2 had them at first: beside the curves, in front or behind."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import chain

from msgspec.structs import replace

from ..document.clip import Clip
from ..document.content import (
    WHOLE,
    Anchor,
    Content,
    Inner,
    Picture,
    RunPaint,
    TextLine,
    TextRun,
    lettering,
    rough_box,
)
from ..document.contents import Plane, shortened
from ..document.form_edits import framed
from ..document.limits import EditError
from ..document.model import Curve, Vector
from ..document.style import NO_PAINT, Style
from ..document.value import Value
from .format_error import FormatError


class _Run(Value, frozen=True):
    """A part of a line in one font and one paint."""

    words: str
    font: tuple[str, ...] = ()
    size: float = 16.0
    weight: float = 400.0
    italic: bool = False
    spacing: float = 0.0
    right: float = 0.0
    down: float = 0.0
    fill: str = "#000000"
    fill_opacity: float = 1.0
    stroke: str = "none"
    stroke_opacity: float = 1.0
    width: float = 1.0

    @property
    def paint(self) -> RunPaint:
        """How it is painted."""
        return RunPaint(self.fill, self.fill_opacity, self.stroke, self.stroke_opacity, self.width)


class _Kept(Value, frozen=True, kw_only=True):
    """Where something lies, and what holds for it."""

    x: float
    y: float
    across: Vector
    down: Vector
    behind: bool = False
    locked: bool = False
    groups: tuple[str, ...] = ()
    clips: tuple[Clip, ...] = ()

    @property
    def plane(self) -> Plane:
        """The map from its units, y downwards."""
        return Plane(self.x, self.y, self.across, self.down)

    def framed(self, content: Content, inner: Inner, style: Style) -> Curve:
        """Return the frame of what this was."""
        left, top, right, bottom = inner
        places = ((left, top), (right, top), (right, bottom), (left, bottom))
        try:
            name = shortened(content.title)
            curve = framed(content, [self.plane.place(*each) for each in places], name)
        except EditError as reason:
            raise FormatError(str(reason)) from None
        style = replace(style, clips=self.clips)
        return replace(curve, style=style, groups=self.groups, locked=self.locked)


class KeptText(_Kept, frozen=True, kw_only=True):
    """A line of a text; one that follows belongs to the line before."""

    runs: tuple[_Run, ...]
    anchor: Anchor = Anchor.START
    follows: bool = False


class KeptPicture(_Kept, frozen=True, kw_only=True):
    """A picture."""

    data: str = ""
    part: Inner = WHOLE
    opacity: float = 1.0


def with_kept(
    curves: tuple[Curve, ...], texts: Sequence[KeptText], pictures: Sequence[KeptPicture]
) -> tuple[Curve, ...]:
    """Return curves with texts and pictures among them: in their groups, or behind or in front of all."""
    found = [*map(_picture, pictures), *map(_text, _whole(texts))]
    behind = [each for was, each in found if was.behind]
    new = list(curves)
    for curve in reversed(behind):
        _insert(new, curve, is_behind=True)
    for was, curve in found:
        if not was.behind:
            _insert(new, curve, is_behind=False)
    return tuple(new)


def _insert(curves: list[Curve], curve: Curve, *, is_behind: bool) -> None:
    groups = curve.groups
    beside = [at for at, each in enumerate(curves) if groups and each.groups[: len(groups)] == groups]
    if beside:
        curves.insert(beside[0] if is_behind else beside[-1] + 1, curve)
    else:
        curves.insert(0 if is_behind else len(curves), replace(curve, groups=()))


def _whole(texts: Iterable[KeptText]) -> list[list[KeptText]]:
    whole: list[list[KeptText]] = []
    for each in texts:
        if each.follows and whole:
            whole[-1].append(each)
        else:
            whole.append([each])
    return whole


def _text(lines: Sequence[KeptText]) -> tuple[_Kept, Curve]:
    first = lines[0]
    common = next(chain.from_iterable(line.runs for line in lines), _Run("")).paint
    made = tuple(_line(line, first, common) for line in lines)
    box = rough_box(made)
    content = lettering(made, box)
    style = Style(
        stroke=common.stroke,
        stroke_opacity=common.stroke_opacity,
        width=common.width * first.plane.scale,
        fill=common.fill,
        fill_opacity=common.fill_opacity,
    )
    return first, first.framed(content, box, style)


def _line(line: KeptText, first: KeptText, common: RunPaint) -> TextLine:
    """Return a line in the units of the text, which are those of its first line."""
    (a, b), (c, d), x, y = first.across, first.down, line.x - first.x, line.y - first.y
    area = a * d - b * c
    if not area:
        raise FormatError("kept_texts must hold texts that are not flat")
    runs = tuple(
        TextRun(
            run.words,
            run.font,
            run.size,
            run.weight,
            run.italic,
            run.spacing,
            run.right,
            run.down,
            None if run.paint == common else run.paint,
        )
        for run in line.runs
    )
    return TextLine((d * x - c * y) / area, (a * y - b * x) / area, runs, line.anchor)


def _picture(was: KeptPicture) -> tuple[_Kept, Curve]:
    left, top, right, bottom = was.part
    content = Picture(left, -bottom, right - left, bottom - top, was.data, was.part)
    return was, was.framed(content, was.part, Style(stroke=NO_PAINT, opacity=was.opacity))
