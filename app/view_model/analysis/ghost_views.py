"""The same points under other families and other rules for the parameters."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import cached_property

from curvecore.arrays import FloatArray

from ...document import rule_edits
from ...document.model import Curve, Document
from ..curve.curve_view import Box, CurveView, view_of
from ..curve.distances import coincide
from ..geometry import all_along
from .ghost import Ghost, all_ghosts
from .overlay import is_quick


def rules_text(curve: Curve) -> str:
    """Return the family and the rule of a curve in words."""
    return f"{curve.family.label} · {Ghost(kind=curve.parametrization.kind).title}"


_SAMPLES, _PER_SEGMENT = 480, 2
"""Samples of a polynomial, enough for a preview, and the least number per segment."""

_LONG = 200
"""Points of the longest curve that follows a drag where every point reaches everywhere."""


@dataclass(frozen=True, eq=False)
class GhostView:
    """One variant of a curve.

    Attributes
    ----------
    is_real
        Whether it is the curve itself: it has these rules already.
    waits
        Whether it is too slow to follow a drag; `view` is then that of the curve itself.
    is_sketch
        Whether it is drawn by samples: flattening a polynomial whose parameters change takes milliseconds,
        and seconds for a long one.
    twin
        The family or rule of the same curve, be it the curve itself or another ghost; None without one.
    """

    ghost: Ghost
    view: CurveView
    is_real: bool
    waits: bool = False
    is_sketch: bool = False
    twin: Ghost | None = None

    @property
    def is_drawn(self) -> bool:
        """Whether the ghost is drawn beside the curve."""
        return self.view.is_current and not self.is_real and not self.waits

    def line(self, tolerance: float, box: Box) -> FloatArray:
        """Return the variant as a polyline (k, 2), within `tolerance` unless it is drawn by samples."""
        return self._sampled if self.is_sketch else self.view.flattened(tolerance, box).points

    @cached_property
    def _sampled(self) -> FloatArray:
        curve = self.view.present_curve
        count = max(_SAMPLES // (len(curve.parameters) - 1), _PER_SEGMENT)
        return curve.evaluate(all_along(curve.parameters, count))


def with_ghost_real(document: Document, curve: int, ghost: Ghost) -> Document:
    """Return the document with the family or the rule of a ghost."""
    if ghost.family is not None:
        return rule_edits.set_family(document, curve, ghost.family)
    assert ghost.kind is not None
    return rule_edits.set_parametrization(document, curve, ghost.kind, ())


def ghost_views(
    view: CurveView, ghosts: Collection[Ghost], previous: Mapping[Ghost, GhostView], *, in_drag: bool = False
) -> dict[Ghost, GhostView]:
    """Return the variants of a curve; those of the frame before lend unchanged results."""
    views = dict[Ghost, GhostView]()
    for ghost in all_ghosts():
        if ghost in ghosts:
            variant = with_ghost_real(Document((view.source,)), 0, ghost).curves[0]
            is_same_rule = variant.parametrization.kind is view.source.parametrization.kind
            is_real = variant.family == view.source.family and is_same_rule
            if is_real or (
                in_drag and not variant.family.curve_class.is_local and len(variant.points) > _LONG
            ):
                views[ghost] = GhostView(ghost, view, is_real, not is_real)
                continue
            old = previous.get(ghost)
            last = old.view if old is not None and not (old.is_real or old.waits) else None
            new_view = view_of(variant, last)
            is_sketch = not is_quick(new_view) or (in_drag and not variant.family.curve_class.is_local)
            # Searched for when the drag is over.
            known_twin = old.twin if old is not None else None
            twin = known_twin if in_drag else _twin(ghost, new_view, view, views)
            views[ghost] = GhostView(ghost, new_view, is_real, is_sketch=is_sketch, twin=twin)
    return views


def _twin(
    ghost: Ghost, view_of_ghost: CurveView, view: CurveView, others: Mapping[Ghost, GhostView]
) -> Ghost | None:
    """Return the ghost of the same curve as a variant: of the curve itself, or one of the ghosts before."""
    source = view.source
    active = Ghost(family=source.family) if ghost.is_of_family else Ghost(kind=source.parametrization.kind)
    drawn = (other_ghost for other_ghost in others.values() if other_ghost.is_drawn)
    alike = [other_ghost for other_ghost in drawn if other_ghost.ghost.is_of_family is ghost.is_of_family]
    candidates = [(active, view), *((other_ghost.ghost, other_ghost.view) for other_ghost in alike)]
    return next((other_ghost for other_ghost, other in candidates if coincide(view_of_ghost, other)), None)
