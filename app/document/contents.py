"""Curves that are frames of texts and pictures: where what they show lies, and what keeps them frames."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence, Set
from typing import NamedTuple

from msgspec.structs import replace

from .content import Content, Lettering, Picture, RunPaint
from .limits import EditError
from .model import Curve, Document, Parametrization, ParametrizationKind, Point, Vector
from .style import NO_PAINT, Style
from .words import count_of

_NEAR = 1e-6
"""Share of the size of a frame by which its corners, and ways to the next ones, may be off."""

_LONGEST = 40
"""Letters of a text that are told."""

_SIDES = 4
_PAINTS = ("fill", "fill_opacity", "fill_gradient", "stroke", "stroke_opacity", "stroke_gradient", "width")
"""The fields of a style that letters with a paint of their own have otherwise."""

_known: tuple[tuple[Curve, ...], bool] = ((), False)


class Plane(NamedTuple):
    """Map from the units of what a frame shows, y downwards, to the plane.

    Attributes
    ----------
    x, y
        Where it takes the origin.
    across, down
        Where one unit leads.
    """

    x: float
    y: float
    across: Vector
    down: Vector

    def place(self, x: float, y: float) -> Vector:
        """Return where a place in those units lies."""
        (a, b), (c, d) = self.across, self.down
        return (self.x + a * x + c * y, self.y + b * x + d * y)

    @property
    def scale(self) -> float:
        """How long a unit is, in the mean."""
        (a, b), (c, d) = self.across, self.down
        return math.sqrt(abs(a * d - b * c))


def content_of(curve: Curve) -> Content | None:
    """Return the text or the picture that a curve is the frame of; None of all others."""
    form = curve.form
    return form if isinstance(form, (Lettering, Picture)) else None


def is_content(curve: Curve) -> bool:
    """Whether a curve is the frame of a text or a picture."""
    return curve.form is not None and curve.form.is_content


def texts_at(document: Document, places: Iterable[int]) -> dict[int, Lettering]:
    """Return the texts among curves, by their places in order."""
    forms = {place: document.curves[place].form for place in sorted(places)}
    return {place: form for place, form in forms.items() if form is not None and isinstance(form, Lettering)}


def has_paints(curve: Curve) -> bool:
    """Whether a curve shows its fill and its stroke: all but pictures do."""
    return curve.form is None or curve.form.has_paints


def with_shown_style(curve: Curve, style: Style) -> Curve:
    """Return a curve in a style, as far as it shows that: a picture neither fill nor stroke."""
    if not has_paints(curve):
        style = replace(curve.style, opacity=style.opacity, clips=style.clips)
    return replace(curve, style=style)


def as_model(curve: Curve) -> Curve:
    """Return a curve as one that others are made like: the rules of a frame are nobody's choice."""
    return replace(curve, form=None, parametrization=Parametrization()) if is_content(curve) else curve


def has_contents(curves: tuple[Curve, ...]) -> bool:
    """Whether any curve is the frame of a text or a picture; asked again and again of the same."""
    global _known  # noqa: PLW0603
    if _known[0] is not curves:
        _known = curves, any(map(is_content, curves))
    return _known[1]


def plane_of(content: Content, corners: Sequence[Vector]) -> Plane:
    """Return the map of what a frame with these corners shows, from the upper left one on clockwise."""
    left, top, right, bottom = content.inner
    (x, y), (x_right, y_right), _, (x_low, y_low) = corners
    across = ((x_right - x) / (right - left), (y_right - y) / (right - left))
    down = ((x_low - x) / (bottom - top), (y_low - y) / (bottom - top))
    return Plane(x - left * across[0] - top * down[0], y - left * across[1] - top * down[1], across, down)


def corners_of(curve: Curve) -> list[Vector]:
    """Return the corners of a frame."""
    return [point.position for point in curve.points]


def words_of(curve: Curve) -> str:
    """Return what a text or a picture is called, to begin a sentence: “Dear Sir” is a text."""
    form = curve.form
    assert form is not None
    return f"“{shortened(curve.name)}” is a {form.noun}"


def shortened(words: str) -> str:
    """Return words in a line, as many as a list has room for."""
    line = " ".join(words.split())
    return line if len(line) <= _LONGEST else f"{line[: _LONGEST - 1]}…"


# The guard at the door


def is_framed(curve: Curve) -> bool:
    """Whether the frame of a text or a picture is one still: an affine image of a box."""
    rule, points = curve.parametrization, curve.points
    is_so = curve.is_closed and rule.kind is ParametrizationKind.UNIFORM and len(points) == _SIDES
    if not is_so or curve.shape or curve.family.name != "hermite":
        return False
    a, b, c, d = (point.position for point in points)
    size = max(math.dist(a, b), math.dist(b, c), math.dist(a, c), math.dist(b, d))
    room = _NEAR * size
    if math.dist((a[0] + c[0], a[1] + c[1]), (b[0] + d[0], b[1] + d[1])) > room:
        return False
    area = abs((b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0]))
    if not area > _NEAR**2 * size * size:
        return False
    # A uniform parameter gives each side a quarter of the interval.
    step, room = (rule.end - rule.start) / _SIDES, room / (rule.end - rule.start) * _SIDES
    nexts = (*points[1:], points[0])
    return all(
        _leads(start.velocity_after, start, end, step, room) and _leads(end.velocity, start, end, step, room)
        for start, end in zip(points, nexts, strict=True)
    )


def _leads(velocity: Vector | None, start: Point, end: Point, step: float, room: float) -> bool:
    if velocity is None:
        return False
    return math.dist(velocity, ((end.x - start.x) / step, (end.y - start.y) / step)) <= room


def why_no_frame(before: Document, after: Document) -> str:
    """Return which text or picture would be none any more, as a sentence; empty where none would.

    What is the same object as before is not looked at.
    """
    if not has_contents(before.curves) and len(before.curves) == len(after.curves):
        return ""
    known = set(map(id, before.curves))
    frames = (each for each in after.curves if each.form is not None and each.form.is_content)
    torn = next((each for each in frames if id(each) not in known and not is_framed(each)), None)
    return "" if torn is None else refusal_of(torn)


def refusal_of(curve: Curve) -> str:
    """Return why a text or a picture has no points to edit, and what to do."""
    if isinstance(curve.form, Lettering):
        return f"{words_of(curve)}: Object to Path makes outlines of it."
    return f"{words_of(curve)}: it is moved, scaled and turned as a whole."


def refuse_contents(curves: Iterable[Curve]) -> None:
    """Raise EditError for what has no outline: a text, a picture."""
    for curve in curves:
        if is_content(curve):
            raise EditError(refusal_of(curve))


def repainted(document: Document, before: Document) -> Document:
    """Return the document whose texts are painted by their styles where these have changed.

    What a style says now holds for all letters, also for those that had a paint of their own.
    """
    now, were = document.curves, before.curves
    if now is were or not has_contents(were) or len(now) != len(were):
        return document
    curves = tuple(new if new is old else _repainted(new, old) for new, old in zip(now, were, strict=True))
    is_same = all(new is old for new, old in zip(curves, now, strict=True))
    return document if is_same else replace(document, curves=curves)


def _repainted(curve: Curve, before: Curve) -> Curve:
    form, style, was = curve.form, curve.style, before.style
    is_moved = curve.points is not before.points
    # What is moved takes its gradient along, which is no other paint for that.
    if style is was or is_moved or form is not before.form or not isinstance(form, Lettering):
        return curve
    changed = {name for name in _PAINTS if getattr(style, name) != getattr(was, name)}
    if not changed:
        return curve
    unit = plane_of(form, corners_of(curve)).scale
    lines = tuple(
        replace(line, runs=tuple(
            replace(run, paint=_paint(run.paint, changed, style, unit)) for run in line.runs
        ))
        for line in form.lines
    )  # fmt: skip
    return curve if lines == form.lines else replace(curve, form=replace(form, lines=lines))


def _paint(paint: RunPaint | None, changed: Set[str], style: Style, unit: float) -> RunPaint | None:
    """Return what is left of a paint of their own that letters have, where the style has changed so."""
    if paint is None:
        return None
    if changed & {"fill", "fill_gradient"}:
        paint = replace(paint, fill=style.fill, fill_opacity=style.fill_opacity)
    elif "fill_opacity" in changed:
        paint = replace(paint, fill_opacity=style.fill_opacity)
    if changed & {"stroke", "stroke_gradient", "stroke_opacity", "width"}:
        width = paint.width if style.width is None else style.width / unit
        paint = replace(paint, stroke=style.stroke, stroke_opacity=style.stroke_opacity, width=width)
    own = (paint.fill, paint.fill_opacity)
    is_lined = style.stroke != NO_PAINT or paint.stroke != NO_PAINT
    is_same = own == (style.fill, style.fill_opacity) and not (is_lined and paint.stroke != style.stroke)
    return None if is_same else paint


def lettered_style(style: Style, paint: RunPaint | None, unit: float) -> Style:
    """Return the style of letters that may have a paint of their own, where a unit of text is so long."""
    if paint is None:
        return style
    return replace(
        style,
        fill=paint.fill,
        fill_opacity=paint.fill_opacity,
        fill_gradient=None,
        stroke=paint.stroke,
        stroke_opacity=paint.stroke_opacity,
        stroke_gradient=None,
        width=paint.width * unit,
    )


# Without them


def without_contents(document: Document) -> Document:
    """Return the document without texts and pictures; itself where there are none."""
    if not any(map(is_content, document.curves)):
        return document
    return replace(document, curves=tuple(each for each in document.curves if not is_content(each)))


def words_about_contents(curves: Sequence[Curve]) -> str:
    """Return "2 texts and 1 picture" of those among curves; empty for none."""
    texts = sum(isinstance(each.form, Lettering) for each in curves)
    pictures = sum(isinstance(each.form, Picture) for each in curves)
    counts = [count_of(count, word) for count, word in ((texts, "text"), (pictures, "picture")) if count]
    return " and ".join(counts)
