"""Errors of the data: how large they are, in numbers and words."""

from __future__ import annotations

from ..curve.curve_view import CurveView
from ..geometry import size_of
from .figures import number
from .overlay_settings import ErrorSize, SettingValues


def usual_error(view: CurveView) -> float:
    """Return a round number near one hundredth of the size of the points."""
    size = size_of(view.points) if len(view.points) else 0.0
    return float(f"{size / 100:.0e}") if size > 0 else 0.01


POINT_ERROR = ErrorSize(
    "pointError",
    "Error of the points",
    short="ε points",
    tip="Largest error of every point; velocities and accelerations stay (a number or an expression)",
    usual=usual_error,
)
"""In the plane's unit."""

PARAMETER_ERROR = ErrorSize(
    "parameterError",
    "Error of the parameters",
    short="δ in t",
    tip="Largest error of every t; for the band to first order (a number or an expression)",
)


def errors_text(settings: SettingValues) -> str:
    """Return the errors as the legend has them: ε = 0.01, δ = 0.001."""
    delta = settings.value(PARAMETER_ERROR)
    text = f"ε = {number(settings.value(POINT_ERROR))}"
    return f"{text}, δ = {number(delta)}" if delta else text
