"""What the legend on the canvas explains."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass

from app.view_model.analysis.figures import Figure, Style, number
from app.view_model.analysis.ghosts import GhostView, rules_text
from app.view_model.analysis.settings import AnalysisSettings, Ghost, Overlay
from app.view_model.curve_view import CurveView
from app.view_model.looks import CURVE_LOOK, Look


@dataclass(frozen=True)
class LegendRow:
    """A line of the legend.

    Attributes
    ----------
    sign
        What is explained; None for the heading of the lines below it.
    is_muted
        Whether nothing is drawn of it now.
    tip
        Why, or more about it.
    """

    sign: Style | Ghost | Look | None
    text: str
    is_muted: bool = False
    tip: str = ""


_ALWAYS = {
    Overlay.VELOCITIES: (Style.VELOCITY, "Velocity c′"),
    Overlay.ACCELERATIONS: (Style.ACCELERATION, "Acceleration c″"),
    Overlay.BEZIER: (Style.BEZIER, "Bézier polygon"),
    Overlay.POLYGON: (Style.POLYGON, "Polygon of the points"),
}
_MARKS = {
    Style.INFLECTION: "Inflection",
    Style.SHARPEST: "Sharpest bend",
    Style.FLATTEST: "Flattest place",
    Style.CROSSING: "Crossing",
}


def legend_rows(
    view: CurveView,
    settings: AnalysisSettings,
    ghosts: Iterable[GhostView],
    settled: Collection[Figure],
    busy: Collection[Overlay],
) -> list[LegendRow]:
    """Return the lines of the legend: what cannot be understood without one."""
    if not view.is_current:
        return []
    rows = [LegendRow(style, text) for each, (style, text) in _ALWAYS.items() if each in settings.overlays]
    if Overlay.BAND in settings.overlays:
        rows.append(LegendRow(Style.BAND, f"{_worst(settings)}, {_errors(settings)}"))
    if Overlay.ENSEMBLE in settings.overlays:
        rows.append(LegendRow(Style.ENSEMBLE, f"{settings.ensemble_count} random cases, {_errors(settings)}"))
    drawn = {figure.style for figure in settled}
    if Overlay.MARKS in settings.overlays:
        rows += [LegendRow(style, text) for style, text in _MARKS.items() if style in drawn]
        if Overlay.MARKS in busy:
            rows.append(LegendRow(Style.INFLECTION, "Marks …", is_muted=True))
    # A ghost that is the curve itself needs no line of its own.
    ghost_rows = [_ghost_row(ghost) for ghost in ghosts if not ghost.is_real]
    return [LegendRow(CURVE_LOOK, rules_text(view.source)), *ghost_rows, *rows] if ghost_rows else rows


def line_rows(
    lines: Sequence[tuple[Look, str]], heading: str = "", *, muted: bool = False
) -> list[LegendRow]:
    """Return a row for each of some lines, with its look and its name, below a heading if there is one."""
    rows = [LegendRow(look, name, is_muted=muted) for look, name in lines]
    return [LegendRow(None, heading, is_muted=True), *rows] if rows and heading else rows


def _worst(settings: AnalysisSettings) -> str:
    # Errors of the parameters are added up as first changes; of the points nothing is left out.
    return "Worst case to first order" if settings.parameter_error else "Worst case"


def _errors(settings: AnalysisSettings) -> str:
    text = f"ε = {number(settings.point_error or 0.0)}"
    return f"{text}, δ = {number(settings.parameter_error)}" if settings.parameter_error else text


def _ghost_row(ghost: GhostView) -> LegendRow:
    name = ghost.ghost.title
    if ghost.waits:
        return LegendRow(ghost.ghost, f"{name} …", True, "Drawn as soon as the drag is over")
    if not ghost.view.is_current:
        return LegendRow(ghost.ghost, f"{name}: none", True, ghost.view.problem)
    return LegendRow(ghost.ghost, name)
