"""What would calm a curve: other parameters or another family, each tried out beside the document."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from msgspec.structs import replace

from app.document import edits
from app.document.model import Document, ParametrizationKind, VelocityRule
from app.families import HERMITE, QUINTIC_HERMITE
from app.tasks.progress import Report, silent, told
from app.view_model.analysis.wiggle import overshoot
from app.view_model.curve_view import CurveView, view_of
from app.view_model.growth import growth_of_points
from curvecore.arrays import FloatArray

_IN_USE = "The curve is like that already."

_MOST_LAGRANGE = 250
"""Points up to which Lagrange curves are tried: beyond it takes seconds, and nobody would want one."""


@dataclass(frozen=True, eq=False)
class Cure:
    """Something to try.

    Attributes
    ----------
    name
        Its key in `CURES`.
    label
        What the window calls it.
    step
        The name of the step in the history.
    document
        The document with it; None where it changes nothing or cannot be.
    points
        The curve as a polyline (k, 2), empty without one.
    overshoot
        How far the same segment swings out then; NaN without a curve.
    lebesgue
        The Lebesgue constant of its points then; NaN where it is not computed.
    problem
        Why it cannot be, as a sentence; empty if it can.
    """

    name: str
    label: str
    step: str
    document: Document | None
    points: FloatArray
    overshoot: float
    lebesgue: float
    problem: str = ""

    @property
    def is_in_use(self) -> bool:
        """Whether the curve is like that already."""
        return self.document is None and self.problem == _IN_USE


@dataclass(frozen=True, eq=False)
class Cures:
    """All cures for one segment of a curve, and how it is without any.

    Attributes
    ----------
    view
        The curve as it is.
    knot
        Where the segment begins.
    """

    view: CurveView
    knot: int
    overshoot: float
    lebesgue: float
    cures: tuple[Cure, ...]


CURES = (
    ("chordLength", "Chord-length t", "Use chord length parameters"),
    ("centripetal", "Centripetal t", "Use centripetal parameters"),
    ("chebyshev", "Chebyshev t", "Use chebyshev parameters"),
    ("hermite", "Hermite, local tangents", "Convert to Hermite"),
    ("quintic", "Quintic Hermite", "Convert to quintic Hermite"),
    ("spline", "C² cubic spline", "Convert to the C² spline"),
)
"""The key, what the row says, and the name of the step."""

_KINDS = {
    "chordLength": ParametrizationKind.CHORD_LENGTH,
    "centripetal": ParametrizationKind.CENTRIPETAL,
    "chebyshev": ParametrizationKind.CHEBYSHEV,
}


def cured(document: Document, curve: int, key: str, parameters: list[float]) -> Document:
    """Return the document with a cure applied to one of its curves."""
    if key in _KINDS:
        return edits.set_parametrization(document, curve, _KINDS[key], parameters)
    family = QUINTIC_HERMITE if key == "quintic" else HERMITE
    rule = VelocityRule.BESSEL if key == "hermite" else VelocityRule.NATURAL_SPLINE
    result = edits.set_velocity_rule(edits.set_family(document, curve, family), curve, rule)
    if key == "spline":
        result = edits.estimate_derivatives(result, curve, range(len(document.curves[curve].points)))
    return result


def cures_of(document: Document, curve: int, view: CurveView, knot: int, report: Report = silent) -> Cures:
    """Try all cures for a segment."""
    found = []
    for key, label, step in told(CURES, report, "Trying"):
        document_then = cured(document, curve, key, view.parameters.tolist())
        found.append(_tried((key, label, step), document_then, curve, view, knot))
    return Cures(view, knot, overshoot(view, knot)[0], _lebesgue(view), tuple(found))


def _tried(words: tuple[str, str, str], document: Document, curve: int, view: CurveView, knot: int) -> Cure:
    nothing = np.empty((0, 2))
    if _shape(document, curve) == _shape(Document((view.source,)), 0):
        return Cure(*words, None, nothing, overshoot(view, knot)[0], _lebesgue(view), _IN_USE)
    family = document.curves[curve].family
    if not family.is_local and len(view.parameters) > _MOST_LAGRANGE:
        what = "for one polynomial" if family.is_one_polynomial else "to try it"
        return Cure(*words, None, nothing, np.nan, np.nan, f"Too many points {what}.")
    other = view_of(document.curves[curve])
    if not other.is_current or knot > len(other.parameters) - 2:
        return Cure(*words, None, nothing, np.nan, np.nan, other.problem or "There is no such segment.")
    return Cure(*words, document, other.polyline, overshoot(other, knot)[0], _lebesgue(other))


def _shape(document: Document, curve: int) -> object:
    """Return what shapes a curve: the velocity rule of a curve without velocities does not."""
    source = document.curves[curve]
    if not source.family.derivatives:
        return replace(source, velocity_rule=VelocityRule.NATURAL_SPLINE)
    return source


def _lebesgue(view: CurveView) -> float:
    if view.basis_curve is None or (
        not view.source.family.is_local and len(view.parameters) > _MOST_LAGRANGE
    ):
        return float("nan")
    return growth_of_points(view)
