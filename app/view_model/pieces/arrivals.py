"""Curves that come from elsewhere: in front, and where the pointer is."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import msgspec
from msgspec.structs import replace

from ...document.curve_edits import without
from ...document.curve_tree import Container
from ...document.model import Curve, Document, Vector
from ...document.several_curves import add_curves, is_blank, moved, whole_curves
from ...document.shapes import shape_of
from ...storage.validation import foresee
from ..boxes.bounds import around
from ..curve.curve_view import CurveView, view_of
from ..curve.transformed import views_ahead


class Arrival(msgspec.Struct, frozen=True):
    """A document with curves that were added to it.

    Attributes
    ----------
    document
        The document.
    places
        Where they are in it.
    views
        Their views, where these were made ahead.
    """

    document: Document
    places: range
    views: tuple[CurveView, ...] = ()

    @property
    def curves(self) -> tuple[Curve, ...]:
        """The curves that were added."""
        return self.document.curves[self.places.start : self.places.stop]


def with_curves(document: Document, curves: Sequence[Curve]) -> Arrival:
    """Add curves in front, visible and free, under names of their own.

    A lone curve without points is what a new document begins with; it gives way.
    """
    base = without(document, 0) if is_blank(document) else document
    first = len(base.curves)
    return Arrival(add_curves(base, curves, first), range(first, first + len(curves)))


class Target(msgspec.Struct, frozen=True):
    """Place for curves from elsewhere.

    Attributes
    ----------
    document
        What they come into.
    place
        Where their middle is to be; None where they are.
    pixel
        How exactly.
    views
        Views of curves that may be what comes, too: nothing is computed anew of a copy.
    """

    document: Document
    place: Vector | None = None
    pixel: float = 1.0
    views: Sequence[CurveView] = ()

    def filled(self, curves: Sequence[Curve], told: Callable[[float], object] | None = None) -> Arrival:
        """Return the document with the curves; where somebody is `told`, it is validated and has views."""
        added = with_curves(self.document, curves)
        known = {id(view.source.points): view for view in self.views}
        originals = [known.get(id(curve.points)) for curve in added.curves]
        if self.place is not None:
            moved_there = centred_at(added, originals, self.place, self.pixel)
            added = replace(added, document=moved_there)
        if told is None:
            return added
        foresee(self.document, added.document)
        return replace(added, views=tuple(views_ahead(added.curves, told, originals)))


def with_parts(document: Document, parts: Sequence[Curve], active: int) -> Arrival:
    """Add parts of curves in front of the active one and its shape, in the same groups."""
    first, model = shape_of(document, active).stop, document.curves[active]
    alone = [replace(part, shape="", groups=model.groups) for part in parts]
    added = add_curves(document, alone, first, Container(model.groups))
    return Arrival(added, range(first, first + len(parts)))


def centred_at(
    added: Arrival, originals: Sequence[CurveView | None], place: Vector, pixel: float
) -> Document:
    """Return the document with what was added moved so that its middle is at a place.

    It is there to a `pixel`, by a clean number: the coordinates get no digits that nobody sees.
    """
    document, group = added.document, whole_curves(added.document, added.places)
    views = [view or view_of(curve) for curve, view in zip(added.curves, originals, strict=True)]
    bounds = around([view.extent[1] for view in views if len(view.points)])
    if bounds is None or not all(map(math.isfinite, (*place, *bounds.centre))):
        return document
    decimals = -math.floor(math.log10(pixel))
    across, up = (round(to - at, decimals) for to, at in zip(place, bounds.centre, strict=True))
    return moved(document, group, (across, up))
