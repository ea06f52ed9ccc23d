"""The same points under other families and other rules for the parameters."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass

from app.document import edits
from app.document.model import Curve, Document, Family, ParametrizationKind
from app.view_model.analysis.settings import Ghost
from app.view_model.curve_view import CurveView, view_of

FAMILIES = {
    Ghost.LAGRANGE: Family.LAGRANGE,
    Ghost.HERMITE: Family.HERMITE,
    Ghost.QUINTIC_HERMITE: Family.QUINTIC_HERMITE,
}
KINDS = {
    Ghost.UNIFORM: ParametrizationKind.UNIFORM,
    Ghost.CHORD_LENGTH: ParametrizationKind.CHORD_LENGTH,
    Ghost.CENTRIPETAL: ParametrizationKind.CENTRIPETAL,
    Ghost.CHEBYSHEV: ParametrizationKind.CHEBYSHEV,
}
NAMES = {
    Ghost.LAGRANGE: "Lagrange",
    Ghost.HERMITE: "Hermite",
    Ghost.QUINTIC_HERMITE: "Quintic Hermite",
    Ghost.UNIFORM: "Uniform",
    Ghost.CHORD_LENGTH: "Chord length",
    Ghost.CENTRIPETAL: "Centripetal",
    Ghost.CHEBYSHEV: "Chebyshev",
}

_FAMILY_NAMES = {family: NAMES[ghost] for ghost, family in FAMILIES.items()}
_KIND_NAMES = {
    **{kind: NAMES[ghost] for ghost, kind in KINDS.items()},
    ParametrizationKind.POWER: "Power",
    ParametrizationKind.MANUAL: "Manual",
}


def rules_text(curve: Curve) -> str:
    """Return the family and the rule of a curve in words."""
    return f"{_FAMILY_NAMES[curve.family]} · {_KIND_NAMES[curve.parametrization.kind]}"


@dataclass(frozen=True, eq=False)
class GhostView:
    """One variant of a curve.

    Attributes
    ----------
    is_real
        Whether it is the curve itself: it has these rules already.
    """

    ghost: Ghost
    view: CurveView
    is_real: bool


def with_ghost_real(document: Document, curve: int, ghost: Ghost) -> Document:
    """Return the document with the family or the rule of a ghost."""
    if ghost in FAMILIES:
        return edits.set_family(document, curve, FAMILIES[ghost])
    return edits.set_parametrization(document, curve, KINDS[ghost], ())


def ghost_views(
    view: CurveView, ghosts: Collection[Ghost], previous: Mapping[Ghost, GhostView]
) -> dict[Ghost, GhostView]:
    """Return the variants of a curve; those of the frame before lend what did not change."""
    views = {}
    for ghost in Ghost:
        if ghost in ghosts:
            variant = _variant(view.source, ghost)
            is_real = _rules(variant) == _rules(view.source)
            old = previous.get(ghost)
            last = old.view if old is not None and not old.is_real else None
            views[ghost] = GhostView(ghost, view if is_real else view_of(variant, last), is_real)
    return views


def _variant(curve: Curve, ghost: Ghost) -> Curve:
    return with_ghost_real(Document((curve,)), 0, ghost).curves[0]


def _rules(curve: Curve) -> tuple[Family, ParametrizationKind]:
    return curve.family, curve.parametrization.kind
