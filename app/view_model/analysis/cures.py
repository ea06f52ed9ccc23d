"""Cures for a curve that swings out: other parameters or another family, each tried beside the document."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray

from ...document import point_edits, rule_edits
from ...document.derivatives import VelocityRule
from ...document.model import Curve, Document, ParametrizationKind
from ...families import FAMILIES, HERMITE, QUINTIC_HERMITE, Family
from ...tasks.progress import Report, silent, told
from ..basis import growth_of_points
from ..curve.curve_view import CurveView, view_of
from ..curve.distances import dense, is_kept, largest_distance
from .wiggle import overshoot

_IN_USE = "The curve is like that already."
_SAME = "It gives the same curve."

_WORSE = 1.05
"""Growth of a swing from which on it is called worse: less cannot be told from the two digits shown."""

_MOST_LAGRANGE = 250
"""Points up to which Lagrange curves are tried: beyond it takes seconds, and nobody would want one."""


class Remedy(NamedTuple):
    """Other parameters, or another family, with a velocity rule where it has velocities.

    Attributes
    ----------
    name
        A key, of which object names are made.
    label, step
        Its words in the window, and the name of the step in the history.
    rule, family
        The rule for the parameters, or the family.
    velocity_rule, estimates
        The rule for the velocities of the family, and whether what was set by hand is estimated, too.
    """

    name: str
    label: str
    step: str
    rule: ParametrizationKind | None = None
    family: Family = HERMITE
    velocity_rule: VelocityRule = VelocityRule.NATURAL_SPLINE
    estimates: bool = False

    def applied(self, document: Document, curve: int, parameters: list[float]) -> Document:
        """Return the document with this remedy applied to one of its curves."""
        if self.rule is not None:
            return rule_edits.set_parametrization(document, curve, self.rule, parameters)
        result = rule_edits.set_family(document, curve, self.family)
        if not self.family.derivatives:
            return result
        result = rule_edits.set_rule(result, curve, self.velocity_rule)
        if self.estimates:
            result = point_edits.estimate_derivatives(
                result, curve, range(len(document.curves[curve].points))
            )
        return result


def _parameters(name: str, kind: ParametrizationKind) -> Remedy:
    return Remedy(name, kind.label, f"Use {kind.phrase} parameters", kind)


CURES = (
    _parameters("chordLength", ParametrizationKind.CHORD_LENGTH),
    _parameters("centripetal", ParametrizationKind.CENTRIPETAL),
    _parameters("chebyshev", ParametrizationKind.CHEBYSHEV),
    Remedy(
        "hermite",
        "Hermite, local tangents",
        "Convert to Hermite",
        velocity_rule=VelocityRule.BESSEL,
    ),
    Remedy("quintic", "Quintic Hermite", "Convert to quintic Hermite", family=QUINTIC_HERMITE),
    Remedy("spline", "C² cubic spline", "Convert to the C² spline", estimates=True),
    *(
        Remedy(family.name, family.label, f"Convert to {family.title}", family=family)
        for family in FAMILIES
        if family.curve_class.is_calm
    ),
)
"""All remedies, in the order of the window."""


@dataclass(frozen=True, eq=False)
class Cure:
    """A remedy tried out on a curve.

    Attributes
    ----------
    document
        The document with it; None where it changes nothing or cannot be.
    points
        The curve as a polyline (k, 2), empty without one.
    overshoot
        The swing of the same segment then; NaN without a curve.
    lebesgue
        The Lebesgue constant of its points then; NaN where it is not computed.
    problem
        Why it cannot be, as a sentence; empty if it can.
    """

    remedy: Remedy
    document: Document | None = None
    points: FloatArray = field(default_factory=lambda: np.empty((0, 2)))
    overshoot: float = np.nan
    lebesgue: float = np.nan
    problem: str = ""

    @property
    def is_in_use(self) -> bool:
        """Whether the curve is like that already."""
        return self.problem == _IN_USE

    @property
    def is_same(self) -> bool:
        """Whether the curve would stay where it is."""
        return self.problem == _SAME

    def is_worse(self, before: float) -> bool:
        """Whether the curve would swing out farther than it did, by more than can be overlooked."""
        return self.overshoot > _WORSE * before


@dataclass(frozen=True, eq=False)
class Cures:
    """All cures for one segment of a curve, and how it is without any.

    Attributes
    ----------
    knot
        The beginning of the segment.
    """

    knot: int
    overshoot: float
    lebesgue: float
    cures: tuple[Cure, ...]


def cures_of(document: Document, curve: int, view: CurveView, knot: int, report: Report = silent) -> Cures:
    """Try all cures for a segment."""
    found = []
    for remedy in told(CURES, report, "Trying"):
        document_then = remedy.applied(document, curve, view.parameters.tolist())
        found.append(_tried(remedy, document_then, curve, view, knot))
    return Cures(knot, overshoot(view, knot)[0], _lebesgue(view), tuple(found))


def _tried(remedy: Remedy, document: Document, curve: int, view: CurveView, knot: int) -> Cure:
    source = document.curves[curve]
    if _shape(source) == _shape(view.source):
        return Cure(remedy, overshoot=overshoot(view, knot)[0], lebesgue=_lebesgue(view), problem=_IN_USE)
    family = source.family
    if not family.curve_class.is_local and len(view.parameters) > _MOST_LAGRANGE:
        what = "for one polynomial" if family.curve_class.is_one_polynomial else "to try it"
        return Cure(remedy, problem=f"Too many points {what}.")
    other = view_of(source)
    if not other.is_current or knot > len(other.parameters) - 2:
        return Cure(remedy, problem=other.problem or "There is no such segment.")
    swing, growth = overshoot(other, knot)[0], _lebesgue(other)
    if np.array_equal(other.parameters, view.parameters):
        t = dense(view.parameters)
        if is_kept(largest_distance(view, t, other, t), (view.source,)):
            return Cure(remedy, overshoot=swing, lebesgue=growth, problem=_SAME)
    return Cure(remedy, document, other.polyline, swing, growth)


def _shape(source: Curve) -> Curve:
    """Return a curve without what does not shape it: the velocity rule where there are no velocities."""
    if not source.family.derivatives:
        return replace(source, velocity_rule=VelocityRule.NATURAL_SPLINE)
    return source


def _lebesgue(view: CurveView) -> float:
    if view.basis_curve is None or (
        not view.source.family.curve_class.is_local and len(view.parameters) > _MOST_LAGRANGE
    ):
        return float("nan")
    return growth_of_points(view)
