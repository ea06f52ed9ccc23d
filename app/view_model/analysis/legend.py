"""The legend on the canvas."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass

from ...document.words import short
from ..curve.curve_view import CurveView
from ..line_styles import CURVE_STYLE, LineStyle
from .ghost import Ghost
from .ghost_views import GhostView, rules_text
from .overlay import Figure, Overlay
from .settings import AnalysisSettings

_MOST_WITH_GROWTH = 60
"""Knots up to which a Lebesgue constant takes some 20 ms at most."""


@dataclass(frozen=True)
class LegendRow:
    """A line of the legend.

    Attributes
    ----------
    style
        The style of the figure that is explained; None for the heading of the lines below.
    is_muted
        Whether its figure is not drawn at the moment.
    tip
        The reason, or a further explanation.
    ghost
        The ghost that it explains, if any, which can be applied and hidden there.
    figure
        A number at its end.
    brief
        A shorter text for little room; empty for none.
    """

    style: LineStyle | None
    text: str
    is_muted: bool = False
    tip: str = ""
    ghost: Ghost | None = None
    figure: str = ""
    brief: str = ""


def legend_rows(
    view: CurveView,
    settings: AnalysisSettings,
    ghosts: Iterable[GhostView],
    figures: Collection[Figure],
    busy: Collection[Overlay],
    *,
    in_drag: bool = False,
) -> list[LegendRow]:
    """Return the lines of the legend: for figures that need an explanation.

    Ghosts have their Lebesgue constants, but not during a drag, or with many points: these would take longer
    than a frame.
    """
    if not view.is_current:
        return []
    visible = sorted(settings.overlays, key=lambda overlay: overlay.sort_key)
    drawn = {id(figure.style) for figure in figures}
    rows = [
        LegendRow(style, text, is_muted=overlay not in busy and id(style) not in drawn)
        for overlay in visible
        for style, text in overlay.legend(view, settings)
    ]
    # Late results stand last, so that nothing moves when they arrive.
    for overlay in visible:
        rows += [LegendRow(style, text) for style, text in overlay.finds if id(style) in drawn]
        if overlay.finds and overlay in busy:
            rows.append(LegendRow(overlay.finds[0][0], f"{overlay.name.capitalize()} …", is_muted=True))
    # A ghost that is the curve itself needs no line.
    ghost_rows = [_ghost_row(ghost, in_drag=in_drag) for ghost in ghosts if not ghost.is_real]
    if not ghost_rows:
        return rows
    active = LegendRow(CURVE_STYLE, rules_text(view.source), figure=_growth(view, in_drag=in_drag))
    return [active, *ghost_rows, *rows]


def line_rows(
    lines: Sequence[tuple[LineStyle, str]], heading: str = "", *, muted: bool = False
) -> list[LegendRow]:
    """Return a row for each of some lines, with its style and its name, below a heading if there is one."""
    rows = [LegendRow(style, name, is_muted=muted) for style, name in lines]
    return [LegendRow(None, heading, is_muted=True), *rows] if rows and heading else rows


def _growth(view: CurveView, *, in_drag: bool) -> str:
    if len(view.parameters) > _MOST_WITH_GROWTH:
        return ""
    return "Λ …" if in_drag else f"Λ {short(view.growth)} {view.growth_holds}".rstrip()


def _ghost_row(view: GhostView, *, in_drag: bool) -> LegendRow:
    ghost = view.ghost
    if view.waits:
        text, tip = f"{ghost.title} …", "Drawn when the drag ends"
    elif not view.view.is_current:
        text, tip = f"{ghost.title}: none", view.view.problem
    else:
        text, brief = ghost.title, ghost.short
        if view.twin is not None:
            text, brief = f"{text} = {view.twin.title}", f"{brief} = {view.twin.short}"
        figure = _growth(view.view, in_drag=in_drag)
        return LegendRow(ghost.style, text, ghost=ghost, figure=figure, brief=brief)
    return LegendRow(ghost.style, text, True, tip, ghost)
