"""Texts whose words fill a frame: written, edited, made of texts in lines and made these again."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec.structs import replace

from ...document.content import Anchor, Inner, Lettering, TextLine, TextRun, lettering
from ...document.contents import corners_of, plane_of
from ...document.flow import USUAL_LINE, Flow
from ...document.form_edits import framed
from ...document.model import Curve
from ...document.wrapping import advance, ascent_share, laid_out
from ...qt.contents import fitted, in_box

Runs = Sequence[tuple[TextRun, ...]]
"""Those of each line."""

_ROOM = 1e-3
"""Of its width by which a frame around lines is wider: they fit whatever rounding does."""


def filling(runs: Runs, box: Inner, anchor: Anchor, flow: Flow) -> Lettering:
    """Return a text whose lines are paragraphs that fill a frame."""
    return replace(lettering(_paragraphs(runs, anchor), box), flow=flow)


def refilled(text: Lettering, runs: Runs, anchor: Anchor | None, flow: Flow) -> Lettering:
    """Return a text in a frame that says something else, and fills it otherwise."""
    first = text.lines[0]
    if not any(run.words.strip() for line in runs for run in line):
        return text
    lines = _paragraphs(runs, anchor or first.anchor, first.x, first.y)
    return replace(text, lines=lines, flow=flow)


def _paragraphs(runs: Runs, anchor: Anchor, x: float = 0.0, y: float = 0.0) -> tuple[TextLine, ...]:
    """Return lines of which those without letters are as high as the ones before."""
    look = next((run for line in runs for run in line if run.words), runs[0][0])
    found = list[TextLine]()
    for line in runs:
        kept = tuple(run for run in line if run.words)
        found.append(TextLine(x, y, kept or (replace(look, words="", right=0.0, down=0.0),), anchor))
        look = kept[-1] if kept else look
    return tuple(found)


def in_frame(curve: Curve) -> Curve:
    """Return the curve of a text in a frame around its lines: paragraphs, which stay in place."""
    text = curve.form
    assert isinstance(text, Lettering)
    first = text.lines[0]
    long = max(sum(run.right + advance(run) for run in line.runs) for line in text.lines) * (1 + _ROOM)
    run = max(first.runs, key=lambda each: each.size)
    many, line = len(text.lines) - 1, _line_of(text)
    left = first.x - long * first.anchor.share
    top = first.y - (ascent_share(run) + (line - 1) / 2) * run.size
    box = (left, top, left + long, top + (many + 1) * line * run.size)
    # Letters stay where they are when the frame around them is another one.
    new = in_box(curve, text, box)
    made = new.form
    assert isinstance(made, Lettering)
    lines = _paragraphs([each.runs for each in text.lines], first.anchor)
    return replace(new, form=replace(made, lines=lines, flow=Flow(line)))


def _line_of(text: Lettering) -> float:
    """Return the way from line to line of a text, in sizes."""
    first, last, many = text.lines[0], text.lines[-1], len(text.lines) - 1
    size = max(run.size for run in first.runs)
    way = (last.y - first.y) / many / size if many else USUAL_LINE
    return way if 0.05 <= way <= 100.0 else USUAL_LINE


def in_frame_of(curve: Curve, box: Inner) -> Curve:
    """Return the curve of a text that fills a box of the plane, y up, instead of where it was."""
    text = curve.form
    assert isinstance(text, Lettering)
    scale, (left, low, right, top) = plane_of(text, corners_of(curve)).scale, box
    flow = Flow(_line_of(text))
    inner = (0.0, 0.0, (right - left) / scale, (top - low) / scale)
    form = filling([each.runs for each in text.lines], inner, text.lines[0].anchor, flow)
    frame = framed(form, [(left, top), (right, top), (right, low), (left, low)], curve.name)
    form = replace(form, x=left, y=low, width=right - left, height=top - low)
    return replace(curve, form=form, points=frame.points, parametrization=frame.parametrization)


def in_lines(curve: Curve) -> Curve:
    """Return the curve of a text in a frame with its lines as they are, whatever is said in them later."""
    text = curve.form
    assert isinstance(text, Lettering)
    laid, (left, _, right, _) = laid_out(text), text.box
    anchor = text.lines[0].anchor
    x = left + (right - left) * anchor.share
    lines = tuple(
        TextLine(x, line.y, _without_end(line.runs), anchor) for line in laid.lines if line.words.strip()
    )
    return fitted(replace(curve, form=replace(text, lines=lines, flow=None)))


def _without_end(runs: tuple[TextRun, ...]) -> tuple[TextRun, ...]:
    kept = list(runs)
    while len(kept) > 1 and not kept[-1].words.strip():
        kept.pop()
    return (*kept[:-1], replace(kept[-1], words=kept[-1].words.rstrip()))
